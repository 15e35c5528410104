#include "oriented_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "portable_math.hpp"

namespace thermedge::detail {
namespace {

// Unit vector along the edges of a direction. Those of directions that mirror each other do so to
// the last bit.
struct Tangent {
  double x;
  double y;
};
Tangent tangent_of(int direction) {
  const std::array<double, 4> cosines = {1, (std::numbers::sqrt2 * (std::numbers::sqrt3 + 1)) / 4,
                                         std::numbers::sqrt3 / 2, std::numbers::sqrt2 / 2};
  const std::array<double, 4> sines = {0, (std::numbers::sqrt2 * (std::numbers::sqrt3 - 1)) / 4,
                                       0.5, std::numbers::sqrt2 / 2};
  const int folded = direction <= 6 ? direction : kEdgeOrientations - direction;  // 0 .. 90 degrees
  const auto i = static_cast<std::size_t>(folded <= 3 ? folded : 6 - folded);
  const double x = folded <= 3 ? cosines[i] : sines[i];
  const double y = folded <= 3 ? sines[i] : cosines[i];
  return {direction <= 6 ? x : -x, y};
}

// A pixel of the line through the origin; halves go towards it, whatever the side.
int nearest_pixel(double value) { return static_cast<int>(std::lround(value * (1 - 1e-9))); }

LineWeights line_weights(double across_px, double along_px, double cutoff_sigmas) {
  // None where a kernel is as long as it is wide, to within rounding.
  const double variance = std::max(0.0, along_px * along_px - across_px * across_px);
  LineWeights line{
      static_cast<int>(std::min(std::ceil(cutoff_sigmas * std::sqrt(variance)),
                                static_cast<double>(OrientedFilterTuning::kMaxLineRadius))),
      {}};
  for (int k = 0; k <= line.radius; ++k) {
    line.weights[static_cast<std::size_t>(k)] =
        k == 0 ? 1.0F : static_cast<float>(portable_exp(-0.5 * k * k / variance));
  }
  return line;
}

Line make_line(int direction, const LineWeights& weights, const Derivative& derivative) {
  const Tangent tangent = tangent_of(direction);
  Line line{};
  for (int k = 0; k <= weights.radius; ++k) {
    line.dx[static_cast<std::size_t>(k)] = nearest_pixel(k * tangent.x);
    line.dy[static_cast<std::size_t>(k)] = nearest_pixel(k * tangent.y);
  }
  // The deviation that white noise leaves in it: the root of the sum of the squares of the whole
  // kernel.
  const int reach = derivative.radius + weights.radius;
  double power = 0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      double value = 0;
      for (int k = -weights.radius; k <= weights.radius; ++k) {
        const auto i = static_cast<std::size_t>(std::abs(k));
        const int sign = k < 0 ? -1 : 1;
        const int at_x = x - sign * line.dx[i];
        const int at_y = y - sign * line.dy[i];
        value += static_cast<double>(weights.weights[i]) *
                 (-tangent.y * derivative.at(at_x, at_y) + tangent.x * derivative.at(at_y, at_x));
      }
      power += value * value;
    }
  }
  const double gain = 1 / std::sqrt(power);
  line.gx_gain = static_cast<float>(-tangent.y * gain);
  line.gy_gain = static_cast<float>(tangent.x * gain);
  return line;
}

}  // namespace

Derivative::Derivative(double sigma_px, double cutoff_sigmas)
    : radius(static_cast<int>(std::ceil(cutoff_sigmas * sigma_px))),
      smooth(static_cast<std::size_t>(radius) + 1),
      slope(smooth.size()) {
  double sum = 0;
  std::vector<double> bell;
  for (int k = 0; k <= radius; ++k) {
    bell.push_back(portable_exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += k == 0 ? bell.back() : 2 * bell.back();
  }
  for (std::size_t k = 0; k < bell.size(); ++k) {
    smooth[k] = static_cast<float>(bell[k] / sum);
    slope[k] = static_cast<float>(static_cast<double>(k) * bell[k] / sum);
  }
}

double Derivative::at(int x, int y) const {
  if (std::abs(x) > radius || std::abs(y) > radius) {
    return 0;
  }
  const double sign = x < 0 ? -1 : 1;
  return sign * slope[static_cast<std::size_t>(std::abs(x))] *
         smooth[static_cast<std::size_t>(std::abs(y))];
}

double noise_gain(const Derivative& derivative) {
  double power = 0;
  for (int y = -derivative.radius; y <= derivative.radius; ++y) {
    for (int x = -derivative.radius; x <= derivative.radius; ++x) {
      power += derivative.at(x, y) * derivative.at(x, y);
    }
  }
  return std::sqrt(power);
}

Across across(int direction, const OrientedFilterTuning& tuning) {
  direction %= kEdgeOrientations;
  const Tangent tangent = tangent_of(direction);
  const double x = -tangent.y;  // the normal
  const double y = tangent.x;
  const int step_x = x < 0 ? -1 : 1;
  const int step_y = y < 0 ? -1 : 1;
  Across out{0, 0, step_x, step_y, 0, {}, {}};
  if (std::abs(x) >= std::abs(y)) {
    out.first_x = step_x;
    out.share = static_cast<float>(std::abs(y) / std::abs(x));
  } else {
    out.first_y = step_y;
    out.share = static_cast<float>(std::abs(x) / std::abs(y));
  }
  for (std::size_t i = 0; i < tuning.side_distances_px.size(); ++i) {
    out.side_x[i] = nearest_pixel(tuning.side_distances_px[i] * x);
    out.side_y[i] = nearest_pixel(tuning.side_distances_px[i] * y);
  }
  return out;
}

Kernels::Kernels(double across_px, double along_px, const OrientedFilterTuning& tuning)
    : derivative(std::clamp(across_px, 0.5, 2.0), tuning.derivative_cutoff_sigmas),
      weights(line_weights(across_px, along_px, tuning.line_cutoff_sigmas)),
      size{across_px, along_px} {
  for (int i = 0; i < kEdgeOrientations; ++i) {
    lines[static_cast<std::size_t>(i)] = make_line(i, weights, derivative);
  }
}

std::vector<Kernels> make_kernels(const OrientedFilterOptions& options,
                                  const OrientedFilterTuning& tuning) {
  std::vector<Kernels> kernels;
  for (int i = 0; i <= tuning.kernel_steps; ++i) {
    const double share = 1.0 * i / tuning.kernel_steps;
    const auto between = [&](double clean, double noisy) {
      return clean + share * (noisy - clean);
    };
    kernels.emplace_back(between(options.clean_across_px, options.across_px),
                         between(options.clean_along_px, options.along_px), tuning);
  }
  return kernels;
}

}  // namespace thermedge::detail
