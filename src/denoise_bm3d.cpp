#include "denoise_bm3d.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "denoise_math.hpp"
#include "simd/bm3d_sums.hpp"

namespace thermedge::detail {
namespace {

constexpr int kBandPx = 48;
constexpr int kRowsPerTask = 16;
// Zeros left of the weights of a row and above those of a column, so that spreading them need not
// ask where the frame begins.
constexpr int kWeightMargin = kBlockPx;

template <class Process>
void for_each_row(int rows, Runner& runner, const Process& process) {
  runner.run((rows + kRowsPerTask - 1) / kRowsPerTask, [&](int task) {
    const int end = std::min((task + 1) * kRowsPerTask, rows);
    for (int y = task * kRowsPerTask; y < end; ++y) {
      process(y);
    }
  });
}

// A block, then as many steps as cover the side; whole cells.
int continued(int side, int step) {
  const int unit = std::max(step, kCellPx);
  return kBlockPx + (std::max(side - kBlockPx, 0) + unit - 1) / unit * unit;
}

}  // namespace

Bm3d::Bm3d(const Bm3dOptions& options)
    : options_(resolved(options)), pattern_(options_.search_radius_px) {
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

Bm3d::Band Bm3d::band(int index) const {
  const int radius = options_.search_radius_px;
  Band band;
  band.first_y = index * kBandPx;
  band.end_y = std::min(band.first_y + kBandPx, height_ - kBlockPx + 1);
  band.first_row = std::max(band.first_y - radius, 0);
  band.end_row = std::min(band.end_y - 1 + radius + kBlockPx, height_);
  return band;
}

void Bm3d::prepare(int width, int height) {
  width_ = continued(width, options_.step_px);
  height_ = continued(height, options_.step_px);
  noisy_.resize(MatchGuide::readable_width(width_), height_);
  estimate_.resize(MatchGuide::readable_width(width_), height_);
  guide_.resize(width_, height_, options_.search_radius_px);
  sums_.resize(width_, height_);
  corner_weights_.resize(kWeightMargin + width_, height_);
  weights_.resize(width_, kWeightMargin + height_);
  fill_pixels(weights_.view().crop(0, 0, width_, kWeightMargin), 0.0F);
  bands_.resize(static_cast<std::size_t>((height_ - kBlockPx) / kBandPx + 1));
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    const Band rows = band(static_cast<int>(i));
    bands_[i].sums.resize(width_, rows.end_row - rows.first_row);
    bands_[i].weights.resize(kWeightMargin + width_, rows.end_row - rows.first_row);
    bands_[i].match.prepare(pattern_, (width_ - kBlockPx) / kCellPx + 1);
    bands_[i].groups.resize(static_cast<std::size_t>((width_ - kBlockPx) / options_.step_px + 1));
  }
}

void Bm3d::load(ImageView<const float> in, const NoiseUnits& units, Runner& runner) {
  for_each_row(height_, runner, [&](int y) {
    mirrored_row(in, units, y, 0, width_, noisy_.row(y));
    guide_.set_row(noisy_.row(y), y);
  });
}

void Bm3d::filter_row(Stage stage, int y, BandScratch& scratch, const Accumulator& sums) const {
  const int largest = stage == Stage::kHard ? options_.group_hard : options_.group_wiener;
  const int step = options_.step_px;
  // Reference blocks must be whole cells apart: those between cells are rows of their own.
  for (int x = 0; x < std::max(step, kCellPx); x += step) {
    ReferenceRow row;
    row.x = x;
    row.y = y;
    row.every = std::max(step / kCellPx, 1);
    row.count = std::max((width_ - kBlockPx - x) / (row.every * kCellPx) + 1, 0);
    match_row(guide_, pattern_, row, largest, scratch.match, scratch.groups);
    for (const BlockGroup& group : std::span(scratch.groups).first(row.count)) {
      if (stage == Stage::kHard) {
        filter_hard(noisy_.view(), group.view(), static_cast<float>(options_.lambda), window_,
                    sums);
      } else {
        filter_wiener(noisy_.view(), estimate_.view(), group.view(), window_, sums);
      }
    }
  }
}

void Bm3d::filter_band(Stage stage, int index) {
  const Band rows = band(index);
  BandScratch& scratch = bands_[static_cast<std::size_t>(index)];
  fill_pixels(scratch.sums.view(), 0.0F);
  fill_pixels(scratch.weights.view(), 0.0F);
  scratch.match.pairs_row = {};
  const Accumulator sums = {
      scratch.sums,
      scratch.weights.view().crop(kWeightMargin, 0, width_, scratch.weights.height()),
      rows.first_row};
  for (int y = rows.first_y; y < rows.end_y; y += options_.step_px) {
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

void Bm3d::run_stage(Stage stage, Runner& runner) {
  runner.run(static_cast<int>(bands_.size()), [&](int index) { filter_band(stage, index); });
  for_each_row(height_, runner, [&](int y) { merge_row(y); });
  for_each_row(height_, runner, [&](int y) { finish_row(y); });
}

void Bm3d::run(ImageView<const float> in, const NoiseUnits& units, ImageView<float> out,
               Runner& runner) {
  prepare(in.width(), in.height());
  load(in, units, runner);
  run_stage(Stage::kHard, runner);
  if (options_.wiener) {
    for_each_row(height_, runner, [&](int y) { guide_.set_row(estimate_.row(y), y); });
    run_stage(Stage::kWiener, runner);
  }
  for_each_row(out.height(), runner, [&](int y) {
    std::transform(estimate_.row(y), estimate_.row(y) + out.width(), out.row(y),
                   [&](float value) { return units.to_counts(value); });
  });
}

}  // namespace thermedge::detail

namespace thermedge {

Bm3dOptions resolved(const Bm3dOptions& options) {
  struct Numbers {
    int step_px, search_radius_px, group_hard, group_wiener;
  };
  const Numbers numbers = [&]() -> Numbers {
    switch (options.profile) {
      case Bm3dProfile::kQuality:
        return {2, 20, 16, 16};
      case Bm3dProfile::kFast:
        return {4, 12, 8, 8};
      case Bm3dProfile::kBalanced:
        break;
    }
    return {4, 16, 16, 16};
  }();
  Bm3dOptions filled = options;
  const auto fill = [](int& value, int from_profile) { value = value == 0 ? from_profile : value; };
  fill(filled.step_px, numbers.step_px);
  fill(filled.search_radius_px, numbers.search_radius_px);
  fill(filled.group_hard, numbers.group_hard);
  fill(filled.group_wiener, numbers.group_wiener);
  return filled;
}

}  // namespace thermedge
