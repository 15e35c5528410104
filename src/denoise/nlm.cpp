#include "nlm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlm_simd.hpp"

namespace thermedge::detail {
namespace {

constexpr int kRowsPerTask = 48;

int tasks_for(int rows) { return (rows + kRowsPerTask - 1) / kRowsPerTask; }

// Distances are 16-bit sums that stop at their largest value, so levels are as fine as lets that
// value stand for a weight of e^-negligible_exponent.
double levels_per_sigma(double patch_weight, double h, double negligible_exponent) {
  return std::sqrt(kLargestDistance / (patch_weight * (2 + negligible_exponent * h * h)));
}

}  // namespace

void NonLocalMeans::prepare(int width, int height) {
  const int margin = options_.search_px / 2 + options_.patch_px / 2;
  values_.resize(width + 2 * margin, height + 2 * margin);
  levels_.resize(values_.width(), values_.height());
  boxes_.resize(values_.width() + kNlmSlack,
                tasks_for(height) * nlm_box_rows(kRowsPerTask, options_.patch_px));
  sums_.resize(width + kNlmSlack, height);
  weights_.resize(width + kNlmSlack, height);
}

void NonLocalMeans::pad(ImageView<const float> in, const NoiseUnits& units, double levels_per_sigma,
                        ParallelRunner& runner) {
  const int margin = options_.search_px / 2 + options_.patch_px / 2;
  runner.run(tasks_for(values_.height()), [&](int task) {
    const int end = std::min((task + 1) * kRowsPerTask, values_.height());
    for (int y = task * kRowsPerTask; y < end; ++y) {
      float* values = values_.row(y);
      mirrored_row(in, units, y - margin, margin, values_.width(), values);
      // Modulo 2^16 where the frame has a huge range: small differences stay right.
      std::transform(values, values + values_.width(), levels_.row(y), [&](float value) {
        return static_cast<std::uint16_t>(std::llrint(value * levels_per_sigma));
      });
    }
  });
}

void NonLocalMeans::run(ImageView<const float> in, const NoiseUnits& units, ImageView<float> out,
                        ParallelRunner& runner) {
  const double half = nlm_patch_half(options_.patch_px);
  const double patch_weight = half * half * half * half;
  const double levels =
      levels_per_sigma(patch_weight, options_.h_over_sigma, tuning_.negligible_exponent);
  prepare(in.width(), in.height());
  pad(in, units, levels, runner);
  const int box_rows = nlm_box_rows(kRowsPerTask, options_.patch_px);
  // In units of distance: what noise, that of rounding (variance 1/12) included, adds, and h^2.
  const double noise = patch_weight * 2 * (levels * levels + 1.0 / 12);
  const double h = levels * options_.h_over_sigma;
  const NlmWeights weigh{static_cast<float>(noise),
                         static_cast<float>(std::numbers::log2e / (patch_weight * h * h))};

  runner.run(tasks_for(in.height()), [&](int task) {
    const int y = task * kRowsPerTask;
    const int rows = std::min(kRowsPerTask, in.height() - y);
    const NlmBand band{values_.view(),
                       levels_.view(),
                       boxes_.view().crop(0, task * box_rows, boxes_.width(), box_rows),
                       sums_.view().crop(0, y, sums_.width(), rows),
                       weights_.view().crop(0, y, weights_.width(), rows),
                       y,
                       in.width()};
    nlm_band(band, options_.patch_px, options_.search_px, weigh);
    for (int row = y; row < y + rows; ++row) {
      for (int x = 0; x < in.width(); ++x) {
        out(x, row) = units.to_counts(sums_(x, row) / weights_(x, row));
      }
    }
  });
}

}  // namespace thermedge::detail
