#include "bm3d.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "bm3d_sums_simd.hpp"
#include "portable_math.hpp"

namespace thermedge::detail {
namespace {

constexpr int kBandPx = 48;
constexpr int kRowsPerTask = 16;
// Zeros left of the weights of a row and above those of a column, so that spreading them need not
// ask where the frame begins.
constexpr int kWeightMargin = kBlockPx;

template <class Process>
void for_each_row(int rows, ParallelRunner& runner, const Process& process) {
  runner.run((rows + kRowsPerTask - 1) / kRowsPerTask, [&](int task) {
    const int end = std::min((task + 1) * kRowsPerTask, rows);
    for (int y = task * kRowsPerTask; y < end; ++y) {
      process(y);
    }
  });
}

// A block, then as many units as cover the side.
int continued(int side, int unit) {
  return kBlockPx + (std::max(side - kBlockPx, 0) + unit - 1) / unit * unit;
}

// How the wavelets of stage 1 see the frequencies of the cosine transform, along one axis.
class WaveletSpectra {
 public:
  WaveletSpectra() {
    for (int u = 0; u < kBlockPx; ++u) {
      // A cosine across, the same in all rows.
      BlockCoefficients block{};
      block[kBlockPx * u] = 1;
      transform_block(BlockTransform::kDct, true, block);
      transform_block(BlockTransform::kBior15, false, block);
      for (int i = 0; i < kBlockPx; ++i) {
        gains_[index(i, u)] = static_cast<double>(block[kBlockPx * i]) * block[kBlockPx * i];
      }
    }
    for (int i = 0; i < kBlockPx; ++i) {
      const auto begin = gains_.begin() + kBlockPx * i;
      const double sum = std::accumulate(begin, begin + kBlockPx, 0.0);
      std::transform(begin, begin + kBlockPx, begin, [=](double gain) { return gain / sum; });
    }
  }

  // Of the noise in the wavelet i across, j down, in units of what white noise of 1 has there.
  [[nodiscard]] double variance(int i, int j, const NoiseSpectrum& spectrum) const {
    double sum = 0;
    for (int v = 0; v < kBlockPx; ++v) {
      for (int u = 0; u < kBlockPx; ++u) {
        sum += gains_[index(i, u)] * gains_[index(j, v)] *
               spectrum[static_cast<std::size_t>(kBlockPx * v + u)];
      }
    }
    return sum;
  }

 private:
  static std::size_t index(int wavelet, int frequency) {
    return static_cast<std::size_t>(kBlockPx * wavelet + frequency);
  }
  std::array<double, kBlockPx * kBlockPx> gains_{};  // sum over the frequencies: 1
};

}  // namespace

Bm3dSettings bm3d_settings(const Bm3dOptions& options, const Bm3dTuning& tuning) {
  Bm3dSettings settings;
  settings.options = options;
  settings.tuning = tuning;
  switch (options.profile) {
    case Bm3dProfile::kQuality:
      settings.step_px = 2;
      settings.search_radius_px = 20;
      break;
    case Bm3dProfile::kBalanced:
      settings.wiener.thinning = Thinning::kChessboard;
      break;
    case Bm3dProfile::kFast:
      settings.hard.thinning = Thinning::kChessboard;
      settings.wiener.thinning = Thinning::kChessboard;
      break;
    case Bm3dProfile::kFastest:
      settings.hard.thinning = Thinning::kChessboard;
      settings.wiener.thinning = Thinning::kQuarter;
      break;
  }
  return settings;
}

Bm3d::Bm3d(const Bm3dSettings& settings)
    : settings_(settings),
      pattern_(settings.search_radius_px, settings.options.adjacent_blocks, settings.tuning) {
  const double beta = settings.options.kaiser_beta;
  const double beta_squared = beta * beta;
  for (int i = 0; i < kBlockPx; ++i) {
    const double position = 2.0 * i / (kBlockPx - 1) - 1;
    profile_[i] = static_cast<float>(bessel_i0_of_square(beta_squared * (1 - position * position)) /
                                     bessel_i0_of_square(beta_squared));
  }
  for (int i = 0; i < kBlockPx * kBlockPx; ++i) {
    window_[i] = profile_[i / kBlockPx] * profile_[i % kBlockPx];
  }
}

Bm3d::Band Bm3d::band(int index) const {
  const int radius = settings_.search_radius_px;
  Band band;
  band.first_y = index * kBandPx;
  band.end_y = std::min(band.first_y + kBandPx, height_ - kBlockPx + 1);
  band.first_row = std::max(band.first_y - radius, 0);
  band.end_row = std::min(band.end_y - 1 + radius + kBlockPx, height_);
  return band;
}

void Bm3d::prepare(int width, int height) {
  const bool is_thinned =
      settings_.hard.thinning != Thinning::kNone || settings_.wiener.thinning != Thinning::kNone;
  const int unit = std::max(settings_.step_px, is_thinned ? 2 * kCellPx : kCellPx);
  width_ = continued(width, unit);
  height_ = continued(height, unit);
  left_ = (width_ - width) / 2;
  top_ = (height_ - height) / 2;
  noisy_.resize(MatchGuide::readable_width(width_), height_);
  estimate_.resize(MatchGuide::readable_width(width_), height_);
  guide_.resize(width_, height_, settings_.search_radius_px);
  sums_.resize(width_, height_);
  corner_weights_.resize(kWeightMargin + width_, height_);
  weights_.resize(width_, kWeightMargin + height_);
  fill_pixels(weights_.view().crop(0, 0, width_, kWeightMargin), 0.0F);
  make_columns();
  bands_.resize(static_cast<std::size_t>((height_ - kBlockPx) / kBandPx + 1));
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    const Band rows = band(static_cast<int>(i));
    bands_[i].sums.resize(width_, rows.end_row - rows.first_row);
    bands_[i].weights.resize(kWeightMargin + width_, rows.end_row - rows.first_row);
    bands_[i].match.prepare(pattern_, (width_ - kBlockPx) / kCellPx + 1);
    bands_[i].groups.resize(all_columns_.size());
  }
}

// Coefficients come transposed: index kBlockPx * u + v. Blocks of a group were chosen because they
// look alike. The fewer independent values a block's noise has, the more alike is the noise itself,
// and the more of it is left in what they have in common: thresholds rise with the root of 64 over
// that number. For white noise all is as if there were no spectrum.
void Bm3d::find_noise_of_coefficients(const NoiseSpectrum& spectrum) {
  static const WaveletSpectra of_wavelets;
  double sum = 0;
  double squares = 0;
  for (const double variance : spectrum) {
    sum += variance;
    squares += variance * variance;
  }
  const double independent = sum * sum / squares;
  const double likeness = std::sqrt(kBlockPx * kBlockPx / independent);
  for (int u = 0; u < kBlockPx; ++u) {
    for (int v = 0; v < kBlockPx; ++v) {
      const int at = kBlockPx * u + v;
      const double deviation = likeness * std::sqrt(of_wavelets.variance(u, v, spectrum));
      thresholds_.all[at] = static_cast<float>(settings_.options.lambda * deviation);
      thresholds_.of_mean[at] = thresholds_.all[at];
      variances_[at] = static_cast<float>(likeness * likeness *
                                          spectrum[static_cast<std::size_t>(kBlockPx * v + u)]);
    }
  }
  thresholds_.of_mean[0] = 0;
  if (settings_.options.keep_slopes) {  // the coarsest ones, across and down
    thresholds_.of_mean[1] = thresholds_.of_mean[kBlockPx] = 0;
  }
}

void Bm3d::load(ImageView<const float> in, const NoiseUnits& units, ParallelRunner& runner) {
  for_each_row(height_, runner, [&](int y) {
    mirrored_row(in, units, y - top_, left_, width_, noisy_.row(y));
    guide_.set_row(noisy_.row(y), y);
  });
}

// Columns of cells, as many from either side.
void Bm3d::make_columns() {
  const int last = (width_ - kBlockPx) / kCellPx;
  const auto fill = [&](std::vector<int>& columns, int first, int every) {
    columns.clear();
    for (int column = first; column <= last; column += every) {
      columns.push_back(column);
    }
  };
  fill(all_columns_, 0, std::max(settings_.step_px / kCellPx, 1));
  fill(even_columns_, 0, 2);
  fill(odd_columns_, 1, 2);
}

// Every other row of a thinned stage, neither the first nor the last, is shifted or empty.
std::span<const int> Bm3d::columns_of(const StageSettings& stage, int y) const {
  if (stage.thinning == Thinning::kNone) {
    return all_columns_;
  }
  if (y / kCellPx % 2 == 0) {
    return even_columns_;
  }
  return stage.thinning == Thinning::kChessboard ? std::span<const int>(odd_columns_)
                                                 : std::span<const int>();
}

void Bm3d::filter_row(Stage stage, int y, BandScratch& scratch, const Accumulator& sums) const {
  const bool is_hard = stage == Stage::kHard;
  const StageSettings& settings = is_hard ? settings_.hard : settings_.wiener;
  // Blocks between whole cells are rows of their own.
  for (int x = 0; x < kCellPx; x += settings_.step_px) {
    ReferenceRow row{x, y, columns_of(settings, y)};
    if (x > 0) {
      row.columns = row.columns.first(row.columns.size() - 1);  // they begin after the last cell
    }
    if (row.columns.empty()) {
      continue;
    }
    match_row(guide_, pattern_, row, settings.largest_group, scratch.match, scratch.groups);
    for (const BlockGroup& group : std::span(scratch.groups).first(row.columns.size())) {
      if (is_hard) {
        filter_hard(noisy_.view(), group.view(), thresholds_, window_, sums);
      } else {
        filter_wiener(noisy_.view(), estimate_.view(), group.view(), variances_, window_, sums);
      }
    }
  }
}

void Bm3d::filter_band(Stage stage, int index) {
  const Band rows = band(index);
  BandScratch& scratch = bands_[static_cast<std::size_t>(index)];
  fill_pixels(scratch.sums.view(), 0.0F);
  fill_pixels(scratch.weights.view(), 0.0F);
  scratch.match.pairs_cells = 0;
  const Accumulator sums = {
      scratch.sums, scratch.weights.view().crop(kWeightMargin, 0, width_, scratch.weights.height()),
      rows.first_row};
  for (int y = rows.first_y; y < rows.end_y; y += settings_.step_px) {
    filter_row(stage, y, scratch, sums);
  }
}

void Bm3d::merge_row(int y) {
  std::fill_n(sums_.row(y), width_, 0.0F);
  std::fill_n(corner_weights_.row(y), corner_weights_.width(), 0.0F);
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    const Band rows = band(static_cast<int>(i));
    if (y >= rows.first_row && y < rows.end_row) {
      add_row(bands_[i].sums.row(y - rows.first_row), width_, sums_.row(y));
      add_row(bands_[i].weights.row(y - rows.first_row), corner_weights_.width(),
              corner_weights_.row(y));
    }
  }
  spread_row(profile_, corner_weights_.row(y) + kWeightMargin, 1, width_,
             weights_.row(kWeightMargin + y));
}

void Bm3d::finish_row(int y) {
  spread_row(profile_, weights_.row(kWeightMargin + y), weights_.stride(), width_,
             estimate_.row(y));
  divide_row(sums_.row(y), width_, estimate_.row(y));
}

void Bm3d::run_stage(Stage stage, ParallelRunner& runner) {
  runner.run(static_cast<int>(bands_.size()), [&](int index) { filter_band(stage, index); });
  for_each_row(height_, runner, [&](int y) { merge_row(y); });
  for_each_row(height_, runner, [&](int y) { finish_row(y); });
}

void Bm3d::run(ImageView<const float> in, const NoiseUnits& units, ImageView<float> out,
               ParallelRunner& runner) {
  prepare(in.width(), in.height());
  find_noise_of_coefficients(units.spectrum);
  load(in, units, runner);
  run_stage(Stage::kHard, runner);
  if (settings_.options.wiener) {
    for_each_row(height_, runner, [&](int y) { guide_.set_row(estimate_.row(y), y); });
    run_stage(Stage::kWiener, runner);
  }
  for_each_row(out.height(), runner, [&](int y) {
    const float* row = estimate_.row(y + top_) + left_;
    std::transform(row, row + out.width(), out.row(y),
                   [&](float value) { return units.to_counts(value); });
  });
}

}  // namespace thermedge::detail
