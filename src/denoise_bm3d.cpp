#include "denoise_bm3d.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "denoise_math.hpp"

namespace thermedge::detail {
namespace {

constexpr int kReferenceRowsPerBand = 12;
constexpr int kRowsPerTask = 16;

// Levels for matching: noise alone makes a sum of 64 squared differences of about 2048, so good
// matches stay far below the largest distance, 65535.
constexpr float kLevelsPerSigma = 4;

int tasks_for(int rows) { return (rows + kRowsPerTask - 1) / kRowsPerTask; }

// Reference blocks along one side: every `step` pixels, and one at the very end.
int reference_count(int side, int step) { return (side - kBlockPx + step - 1) / step + 1; }
int reference_position(int index, int side, int step) {
  return std::min(index * step, side - kBlockPx);
}

}  // namespace

Bm3d::Bm3d(const Bm3dOptions& options) : options_(options) {
  const double beta_squared = options.kaiser_beta * options.kaiser_beta;
  for (int i = 0; i < kBlockPx; ++i) {
    const double position = 2.0 * i / (kBlockPx - 1) - 1;
    profile_[i] = static_cast<float>(bessel_i0_of_square(beta_squared * (1 - position * position)) /
                                     bessel_i0_of_square(beta_squared));
  }
  for (int i = 0; i < kBlockPx * kBlockPx; ++i) {
    window_[i] = profile_[i / kBlockPx] * profile_[i % kBlockPx];
  }
}

// All candidates lie inside the frame: at its borders the window is shifted inwards.
SearchWindow Bm3d::window_of(BlockPosition reference) const {
  const int side = 2 * options_.search_radius_px + 1;
  const int columns = width_ - kBlockPx + 1;
  const int rows = height_ - kBlockPx + 1;
  SearchWindow window;
  window.width = std::min(side, columns);
  window.height = std::min(side, rows);
  window.x = std::clamp(reference.x - options_.search_radius_px, 0, columns - window.width);
  window.y = std::clamp(reference.y - options_.search_radius_px, 0, rows - window.height);
  return window;
}

Bm3d::Band Bm3d::band(int index) const {
  Band band;
  band.first_reference_row = index * kReferenceRowsPerBand;
  band.end_reference_row = std::min(band.first_reference_row + kReferenceRowsPerBand,
                                    reference_count(height_, options_.step_px));
  const auto window_at = [&](int reference_row) {
    return window_of({0, reference_position(reference_row, height_, options_.step_px)});
  };
  const SearchWindow last = window_at(band.end_reference_row - 1);
  band.first_row = window_at(band.first_reference_row).y;
  band.end_row = last.y + last.height - 1 + kBlockPx;
  return band;
}

Accumulator Bm3d::accumulator(int index) {
  const auto rows_of_band = [&](Image<float>& all) {
    return all.view().crop(0, index * band_rows_, width_, band_rows_);
  };
  return {rows_of_band(band_sums_), rows_of_band(band_weights_), band(index).first_row};
}

void Bm3d::prepare(int width, int height) {
  width_ = std::max(width, kBlockPx);
  height_ = std::max(height, kBlockPx);
  const int reference_rows = reference_count(height_, options_.step_px);
  bands_ = (reference_rows + kReferenceRowsPerBand - 1) / kReferenceRowsPerBand;
  band_rows_ = 0;
  for (int i = 0; i < bands_; ++i) {
    band_rows_ = std::max(band_rows_, band(i).end_row - band(i).first_row);
  }
  noisy_.resize(width_, height_);
  estimate_.resize(width_, height_);
  levels_.resize(width_, height_);
  transposed_levels_.resize(height_, width_);
  band_sums_.resize(width_, bands_ * band_rows_);
  band_weights_.resize(width_, bands_ * band_rows_);
  sums_.resize(width_, height_);
  weights_.resize(width_, height_);
  if (match_scratch_.size() < static_cast<std::size_t>(bands_)) {
    match_scratch_.resize(static_cast<std::size_t>(bands_));
  }
}

// Modulo 2^16 where the frame has a huge range: small differences stay right.
void Bm3d::quantise_row(const float* values, int y) {
  for (int x = 0; x < width_; ++x) {
    const auto level = static_cast<std::int16_t>(std::llrint(values[x] * kLevelsPerSigma));
    levels_(x, y) = level;
    transposed_levels_(y, x) = level;
  }
}

void Bm3d::load(ImageView<const float> in, const NoiseUnits& units, Runner& runner) {
  runner.run(tasks_for(height_), [&](int task) {
    const int end = std::min((task + 1) * kRowsPerTask, height_);
    for (int y = task * kRowsPerTask; y < end; ++y) {
      mirrored_row(in, units, y, 0, width_, noisy_.row(y));
      quantise_row(noisy_.row(y), y);
    }
  });
}

void Bm3d::filter_band(Stage stage, int index) {
  const Band rows = band(index);
  const Accumulator sums = accumulator(index);
  fill_pixels(sums.sums, 0.0F);
  fill_pixels(sums.weights, 0.0F);
  MatchScratch& scratch = match_scratch_[static_cast<std::size_t>(index)];
  const int largest = stage == Stage::kHard ? options_.group_hard : options_.group_wiener;
  const int columns = reference_count(width_, options_.step_px);
  const MatchGuide guide{levels_.view(), transposed_levels_.view()};
  BlockPosition group[kLargestGroup];
  for (int j = rows.first_reference_row; j < rows.end_reference_row; ++j) {
    for (int i = 0; i < columns; ++i) {
      const BlockPosition reference = {reference_position(i, width_, options_.step_px),
                                       reference_position(j, height_, options_.step_px)};
      const SearchWindow window = window_of(reference);
      const int candidates = std::min(window.width * window.height, largest);
      const auto size = std::bit_floor(static_cast<unsigned>(candidates));
      match_blocks(guide, reference, window, static_cast<int>(size), scratch, group);
      const std::span<const BlockPosition> blocks(group, size);
      if (stage == Stage::kHard) {
        filter_hard(noisy_.view(), blocks, static_cast<float>(options_.lambda), window_, sums);
      } else {
        filter_wiener(noisy_.view(), estimate_.view(), blocks, window_, sums);
      }
    }
  }
}

// Adds up the bands, and spreads the weights along the rows.
void Bm3d::merge_rows(int first_row, int end_row) {
  for (int y = first_row; y < end_row; ++y) {
    float* sums = sums_.row(y);
    float* weights = weights_.row(y);
    std::fill_n(sums, width_, 0.0F);
    std::fill_n(weights, width_, 0.0F);
    for (int i = 0; i < bands_; ++i) {
      const Band rows = band(i);
      if (y < rows.first_row || y >= rows.end_row) {
        continue;
      }
      const Accumulator band_sums = accumulator(i);
      const float* more_sums = band_sums.sums.row(y - rows.first_row);
      const float* more_weights = band_sums.weights.row(y - rows.first_row);
      for (int x = 0; x < width_; ++x) {
        sums[x] += more_sums[x];
        weights[x] += more_weights[x];
      }
    }
    // In place from the right: a weight is read before it is replaced.
    for (int x = width_ - 1; x >= 0; --x) {
      float sum = 0;
      for (int i = 0; i <= std::min(x, kBlockPx - 1); ++i) {
        sum += profile_[i] * weights[x - i];
      }
      weights[x] = sum;
    }
  }
}

void Bm3d::finish_rows(int first_row, int end_row) {
  for (int y = first_row; y < end_row; ++y) {
    for (int x = 0; x < width_; ++x) {
      float weight = 0;
      for (int i = 0; i <= std::min(y, kBlockPx - 1); ++i) {
        weight += profile_[i] * weights_(x, y - i);
      }
      estimate_(x, y) = sums_(x, y) / weight;
    }
    quantise_row(estimate_.row(y), y);
  }
}

void Bm3d::run_stage(Stage stage, Runner& runner) {
  runner.run(bands_, [&](int index) { filter_band(stage, index); });
  const auto by_rows = [&](auto&& process) {
    runner.run(tasks_for(height_), [&](int task) {
      process(task * kRowsPerTask, std::min((task + 1) * kRowsPerTask, height_));
    });
  };
  by_rows([&](int first, int end) { merge_rows(first, end); });
  by_rows([&](int first, int end) { finish_rows(first, end); });
}

void Bm3d::run(ImageView<const float> in, const NoiseUnits& units, ImageView<float> out,
               Runner& runner) {
  prepare(in.width(), in.height());
  load(in, units, runner);
  run_stage(Stage::kHard, runner);
  if (options_.wiener) {
    run_stage(Stage::kWiener, runner);
  }
  for (int y = 0; y < out.height(); ++y) {
    std::transform(estimate_.row(y), estimate_.row(y) + out.width(), out.row(y),
                   [&](float value) { return units.to_counts(value); });
  }
}

}  // namespace thermedge::detail
