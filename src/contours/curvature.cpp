#include "curvature.hpp"

#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "edgel_runs_simd.hpp"

namespace thermedge::detail {
namespace {

// Difference quotient of `values` at `i`: central, one-sided at the ends.
template <class Values>
double slope(const Values& values, std::size_t i, std::size_t count) {
  if (i == 0) {
    return values(1) - values(0);
  }
  if (i + 1 == count) {
    return values(i) - values(i - 1);
  }
  return (values(i + 1) - values(i - 1)) / 2;
}

}  // namespace

void gaussian_kernel(double sigma, std::vector<double>& kernel) {
  constexpr int kLargestHalfWidth = 30;
  constexpr double kSmallestWeight = 1e-4;
  const double variance = sigma * sigma;
  int half_width = 1;
  for (int t = 1; t <= kLargestHalfWidth; ++t) {
    if (std::exp(-(t * t) / (2 * variance)) > kSmallestWeight) {
      half_width = t;
    }
  }
  kernel.clear();
  for (int t = -half_width; t <= half_width; ++t) {
    kernel.push_back(std::exp(-(t * t) / (2 * variance)) / (2 * std::numbers::pi * variance));
  }
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& weight : kernel) {
    weight /= sum;
  }
}

// Each sum adds its terms from the last tap to the first, as GNU Octave's conv does; on straight
// lines the rounding error decides between a curvature of 0 and of 0.01.
void smooth(std::span<const double> padded, std::span<const double> kernel,
            std::span<double> smoothed) {
  assert(padded.size() == smoothed.size() + kernel.size() - 1);
  backward_sums(padded.data(), kernel.data(), static_cast<int>(kernel.size()),
                static_cast<int>(smoothed.size()), smoothed.data());
}

void rounded_curvature(std::span<const double> x, std::span<const double> y,
                       std::span<double> curvature) {
  assert(x.size() >= 2 && x.size() == y.size() && x.size() == curvature.size());
  const std::size_t count = x.size();
  const auto dx = [&](std::size_t i) {
    return slope([&](std::size_t k) { return x[k]; }, i, count);
  };
  const auto dy = [&](std::size_t i) {
    return slope([&](std::size_t k) { return y[k]; }, i, count);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double x1 = dx(i);
    const double y1 = dy(i);
    const double speed_squared = x1 * x1 + y1 * y1;
    const double k = std::abs((x1 * slope(dy, i, count) - slope(dx, i, count) * y1) /
                              (speed_squared * std::sqrt(speed_squared)));
    curvature[i] = std::ceil(k * 100) / 100;
  }
}

}  // namespace thermedge::detail
