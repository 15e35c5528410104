// The oriented filter as plain sums in double precision: every kernel is one two-dimensional table,
// and every pixel is looked at on its own.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "float_frame.hpp"
#include "thermedge/image.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge::test {

inline constexpr int kOrientations = 24;  // 12 of edges, each with either side warmer
inline constexpr double kFloatRounding = 0x1p-24;

inline double angle_of(int orientation) { return orientation * std::numbers::pi / 12; }

// Weights at -radius .. radius of a Gaussian that is cut off at 3.5 standard deviations, and of its
// derivative, scaled by the variance.
struct Bell {
  explicit Bell(double sigma_px) : radius(static_cast<int>(std::ceil(3.5 * sigma_px))) {
    double sum = 0;
    for (int k = -radius; k <= radius; ++k) {
      smooth.push_back(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
      sum += smooth.back();
    }
    for (int k = -radius; k <= radius; ++k) {
      double& weight = smooth[static_cast<std::size_t>(k + radius)];
      weight /= sum;
      slope.push_back(k * weight);
      half_slope += k > 0 ? slope.back() : 0;
    }
  }
  [[nodiscard]] static double at(const std::vector<double>& weights, int k) {
    const int i = k + static_cast<int>(weights.size()) / 2;
    return i < 0 || i >= static_cast<int>(weights.size()) ? 0
                                                          : weights[static_cast<std::size_t>(i)];
  }

  int radius;
  std::vector<double> smooth, slope;
  double half_slope = 0;  // sum of the positive weights of the derivative
};

// A kernel as one table: the response at a pixel is the sum of at(i, j) times the pixel (i, j)
// away.
struct PlainKernel {
  [[nodiscard]] double& at(int i, int j) {
    const int side = 2 * reach + 1;
    return weights[static_cast<std::size_t>((j + reach) * side + i + reach)];
  }
  [[nodiscard]] double at(int i, int j) const { return const_cast<PlainKernel&>(*this).at(i, j); }

  int reach = 0;
  std::vector<double> weights = {0};
  // The error of the response in single precision is at most this times (2 A + terms R), where A is
  // the largest pixel and R the range of the frame.
  double error = 0;
  double terms = 0;
};

// White noise of deviation 1 gives responses of this deviation.
inline double noise_gain(const PlainKernel& kernel) {
  double power = 0;
  for (const double weight : kernel.weights) {
    power += weight * weight;
  }
  return std::sqrt(power);
}

// Derivatives across the edge of a round Gaussian, added up along the edge: at the pixels of a line
// through the origin, halves rounded towards it, with weights of a Gaussian that makes the whole
// `along_px` long.
//
// What single precision makes of it, with the unit rounding u: a smoothed pixel is off by u A for
// the last addition and by (r + 3) u R for the sum before it, over a radius of r. A derivative adds
// up differences of such pixels with weights whose positive ones have the sum D: 2 u A D and
// (3 r + 9) u R D. Rounded weights add 3 u R D. Projected on the normal and scaled, which five
// roundings more can shift, times |nx| + |ny|. The line adds up 2 L + 1 of them with weights of the
// sum W, which are rounded too: (L + 3) u more of each.
inline PlainKernel oriented_kernel(int orientation, KernelSize size) {
  const Bell bell(size.across_px);
  const double variance = size.along_px * size.along_px - size.across_px * size.across_px;
  const int length = std::min(10, static_cast<int>(std::ceil(2.25 * std::sqrt(variance))));
  const double tangent_x = std::cos(angle_of(orientation));
  const double tangent_y = std::sin(angle_of(orientation));
  const auto pixel = [](double v) {
    const int size_px = static_cast<int>(std::ceil(std::abs(v) - 0.5 - 1e-6));
    return v < 0 ? -size_px : size_px;
  };
  PlainKernel kernel;
  kernel.reach = bell.radius + length;
  kernel.weights.assign(static_cast<std::size_t>(std::pow(2 * kernel.reach + 1, 2)), 0.0);
  double line_sum = 0;
  for (int k = -length; k <= length; ++k) {
    const double weight = k == 0 ? 1 : std::exp(-0.5 * k * k / variance);
    line_sum += weight;
    for (int j = -kernel.reach; j <= kernel.reach; ++j) {
      for (int i = -kernel.reach; i <= kernel.reach; ++i) {
        const int x = i - pixel(k * tangent_x);
        const int y = j - pixel(k * tangent_y);
        kernel.at(i, j) +=
            weight * (-tangent_y * Bell::at(bell.slope, x) * Bell::at(bell.smooth, y) +
                      tangent_x * Bell::at(bell.smooth, x) * Bell::at(bell.slope, y));
      }
    }
  }
  const double gain = noise_gain(kernel);
  for (double& weight : kernel.weights) {
    weight /= gain;
  }
  kernel.error = kFloatRounding * bell.half_slope * line_sum / gain *
                 (std::abs(tangent_x) + std::abs(tangent_y));
  kernel.terms = 3 * bell.radius + length + 20;
  return kernel;
}

// The derivative along x or y of a round Gaussian.
inline PlainKernel round_kernel(bool along_x, double sigma_px) {
  const Bell bell(sigma_px);
  PlainKernel kernel;
  kernel.reach = bell.radius;
  kernel.weights.assign(static_cast<std::size_t>(std::pow(2 * kernel.reach + 1, 2)), 0.0);
  for (int j = -kernel.reach; j <= kernel.reach; ++j) {
    for (int i = -kernel.reach; i <= kernel.reach; ++i) {
      kernel.at(i, j) = along_x ? Bell::at(bell.slope, i) * Bell::at(bell.smooth, j)
                                : Bell::at(bell.smooth, i) * Bell::at(bell.slope, j);
    }
  }
  kernel.error = kFloatRounding * bell.half_slope;
  kernel.terms = 3 * bell.radius + 12;
  return kernel;
}

// A frame mirrored about the outer edges of its border pixels.
class MirroredFrame {
 public:
  MirroredFrame(ImageView<const float> in, int margin) : margin_(margin) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    padded_.resize(in.width() + 2 * margin, in.height() + 2 * margin);
    for (int y = 0; y < padded_.height(); ++y) {
      for (int x = 0; x < padded_.width(); ++x) {
        padded_(x, y) = static_cast<double>(in(detail::mirrored(x - margin, in.width()),
                                               detail::mirrored(y - margin, in.height())));
        low = std::min(low, padded_(x, y));
        high = std::max(high, padded_(x, y));
      }
    }
    range_ = high - low;
    largest_ = std::max(std::abs(low), std::abs(high));
  }

  [[nodiscard]] double response(const PlainKernel& kernel, int x, int y) const {
    double sum = 0;
    for (int j = -kernel.reach; j <= kernel.reach; ++j) {
      const double* row = padded_.row(y + margin_ + j) + x + margin_;
      for (int i = -kernel.reach; i <= kernel.reach; ++i) {
        sum += kernel.at(i, j) * row[i];
      }
    }
    return sum;
  }
  [[nodiscard]] double error_of(const PlainKernel& kernel) const {
    return kernel.error * (2 * largest_ + kernel.terms * range_);
  }

 private:
  int margin_;
  Image<double> padded_;
  double range_ = 0, largest_ = 0;
};

// Of the 9 kernel sizes between those for clean frames and those for noise.
inline KernelSize kernel_size(const OrientedFilterOptions& options, double noisiness) {
  const double share = std::round(8 * noisiness) / 8;
  return {options.clean_across_px + share * (options.across_px - options.clean_across_px),
          options.clean_along_px + share * (options.along_px - options.clean_along_px)};
}

inline std::vector<PlainKernel> oriented_kernels(KernelSize size) {
  std::vector<PlainKernel> kernels;
  for (int i = 0; i < kOrientations; ++i) {
    kernels.push_back(oriented_kernel(i, size));
  }
  return kernels;
}

enum class PlainClass : std::uint8_t { kNone, kWeak, kStrong };

// Sets the 8-connected groups that hold a strong pixel and have at least `least_px` pixels to 255,
// all else to 0.
inline Image<std::uint8_t> plain_hysteresis(Image<PlainClass> classes, std::size_t least_px) {
  const int width = classes.width();
  const int height = classes.height();
  Image<std::uint8_t> out(width, height);
  fill_pixels(out.view(), std::uint8_t{0});
  std::vector<std::pair<int, int>> group;
  for (int y0 = 0; y0 < height; ++y0) {
    for (int x0 = 0; x0 < width; ++x0) {
      if (classes(x0, y0) == PlainClass::kNone) {
        continue;
      }
      bool strong = false;
      group = {{x0, y0}};
      for (std::size_t next = 0; next < group.size(); ++next) {
        const auto [x, y] = group[next];
        strong = strong || classes(x, y) == PlainClass::kStrong;
        classes(x, y) = PlainClass::kNone;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j) {
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
            if (classes(i, j) != PlainClass::kNone &&
                std::find(group.begin(), group.end(), std::pair{i, j}) == group.end()) {
              group.emplace_back(i, j);
            }
          }
        }
      }
      for (const auto& [x, y] : group) {
        out(x, y) = strong && group.size() >= least_px ? 255 : 0;
      }
    }
  }
  return out;
}

}  // namespace thermedge::test
