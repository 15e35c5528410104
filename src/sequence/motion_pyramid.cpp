#include "motion_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "float_frame.hpp"

namespace thermedge::detail {
namespace {

// Binomial coefficients of order 8 over their sum; and of order 2.
constexpr std::array kWide = {1 / 256.0F,  8 / 256.0F,  28 / 256.0F, 56 / 256.0F, 70 / 256.0F,
                              56 / 256.0F, 28 / 256.0F, 8 / 256.0F,  1 / 256.0F};
constexpr std::array kNarrow = {1 / 4.0F, 2 / 4.0F, 1 / 4.0F};

// Sum of the products of a kernel with itself, moved by `lag`.
template <std::size_t N>
double self_product(const std::array<float, N>& kernel, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = 0; i + lag < N; ++i) {
    sum += static_cast<double>(kernel[i]) * static_cast<double>(kernel[i + lag]);
  }
  return sum;
}

// `in` smoothed along both axes at every second pixel; `row` is scratch.
template <class T, std::size_t N>
void halve(ImageView<const T> in, const std::array<float, N>& kernel, Image<float>& row,
           ImageView<float> out) {
  constexpr int kReach = static_cast<int>(N / 2);
  const int width = in.width();
  row.resize(width + 2 * kReach, 1);
  float* sums = row.view().row(0);
  for (int y = 0; y < out.height(); ++y) {
    float* middle = sums + kReach;
    std::fill_n(middle, width, 0.0F);
    for (int k = -kReach; k <= kReach; ++k) {
      const T* from = in.row(mirrored(2 * y + k, in.height()));
      const float weight = kernel[static_cast<std::size_t>(k + kReach)];
      for (int x = 0; x < width; ++x) {
        middle[x] += weight * static_cast<float>(from[x]);
      }
    }
    for (int k = 1; k <= kReach; ++k) {
      middle[-k] = middle[mirrored(-k, width)];
      middle[width - 1 + k] = middle[mirrored(width - 1 + k, width)];
    }
    float* to = out.row(y);
    for (int x = 0; x < out.width(); ++x) {
      float sum = 0;
      for (std::size_t k = 0; k < N; ++k) {
        sum += kernel[k] * sums[static_cast<std::size_t>(2 * x) + k];
      }
      to[x] = sum;
    }
  }
}

}  // namespace

const double MotionPyramid::kPixelGain = self_product(kWide, 0);
// Half the difference of two pixels of level 0 that are two apart, which are four of the frame.
const double MotionPyramid::kGradientGain =
    std::sqrt(self_product(kWide, 0) * (self_product(kWide, 0) - self_product(kWide, 4)) / 2);

void MotionPyramid::build(ImageView<const std::uint16_t> counts) {
  int width = counts.width();
  int height = counts.height();
  for (Image<float>& level : levels_) {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    level.resize(width, height);
  }
  halve(counts, kWide, row_, levels_[0].view());
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    halve(ImageView<const float>(levels_[l - 1].view()), kNarrow, row_, levels_[l].view());
  }
}

}  // namespace thermedge::detail
