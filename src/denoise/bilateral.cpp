#include "bilateral.hpp"

#include <algorithm>
#include <cmath>

#include "bilateral_simd.hpp"
#include "float_frame.hpp"
#include "portable_math.hpp"

namespace thermedge::detail {
namespace {

constexpr int kRowsPerTask = 16;
// Where the weight of a difference falls to nothing; (1 - d^2 / cut^2)^4 is then close to the bell
// curve exp(-d^2 / 2).
const double kCut = std::sqrt(8.0);

}  // namespace

int BilateralFilter::radius() const {
  return static_cast<int>(std::ceil(tuning_.reach_sigmas * options_.space_px));
}

void BilateralFilter::prepare(int width, int height) {
  const int reach = radius();
  if (weights_.empty()) {
    for (int k = 0; k <= reach; ++k) {
      weights_.push_back(
          static_cast<float>(portable_exp(-0.5 * k * k / (options_.space_px * options_.space_px))));
    }
  }
  padded_.resize(width + 2 * reach + kBilateralSlack, height + 2 * reach);
  rows_.resize(width + kBilateralSlack, height + 2 * reach);
  result_.resize(width + kBilateralSlack, height);
}

void BilateralFilter::run(ImageView<const float> in, double range, ImageView<float> out,
                          ParallelRunner& runner) {
  prepare(in.width(), in.height());
  const int reach = radius();
  const int width = in.width();
  const int height = in.height();
  const auto cut = static_cast<float>(kCut * range);
  const auto for_each_row = [&](int count, auto&& task) {
    runner.run((count + kRowsPerTask - 1) / kRowsPerTask, [&](int part) {
      for (int y = part * kRowsPerTask; y < std::min((part + 1) * kRowsPerTask, count); ++y) {
        task(y);
      }
    });
  };
  for_each_row(padded_.height(), [&](int y) {
    mirrored_row(in, y - reach, reach, padded_.width(), padded_.row(y));
    bilateral_row(padded_.row(y) + reach, 1, weights_.data(), reach, cut, width, rows_.row(y));
  });
  for_each_row(height, [&](int y) {
    bilateral_row(rows_.row(y + reach), rows_.stride(), weights_.data(), reach, cut, width,
                  result_.row(y));
    std::copy_n(result_.row(y), width, out.row(y));
  });
}

}  // namespace thermedge::detail
