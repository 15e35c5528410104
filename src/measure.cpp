#include "thermedge/measure.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

namespace thermedge {
namespace {

struct Vector {
  double x = 0;
  double y = 0;
};

// Points of one edge as a curve that goes on beyond its ends: closed ones wrap, open ones are
// reflected at their end point, so that the end keeps its direction.
class Curve {
 public:
  Curve(const Edgels& edgels, const Edge& edge)
      : x_(edgels.x.data() + edge.edgels.first),
        y_(edgels.y.data() + edge.edgels.first),
        count_(edge.edgels.count),
        closed_(edge.closed) {}

  [[nodiscard]] Vector at(std::ptrdiff_t index) const {
    const std::ptrdiff_t last = count_ - 1;
    if (closed_) {
      return point((index % count_ + count_) % count_);
    }
    if (index < 0) {
      return reflected(0, std::min(-index, last));
    }
    if (index > last) {
      return reflected(last, std::max(2 * last - index, std::ptrdiff_t{0}));
    }
    return point(index);
  }

  // Unit normal, to the right of the walking direction. The tangent is the central difference of
  // the curve smoothed by the binomial weights of order 16 (sigma 2); both in one odd kernel.
  [[nodiscard]] Vector normal(std::ptrdiff_t index) const {
    constexpr std::array<double, 9> kWeights = {4862, 7072, 6188, 3808, 1700, 544, 119, 16, 1};
    Vector tangent;
    for (std::size_t k = 0; k < kWeights.size(); ++k) {
      const auto step = static_cast<std::ptrdiff_t>(k) + 1;
      const Vector ahead = at(index + step);
      const Vector behind = at(index - step);
      tangent.x += kWeights[k] * (ahead.x - behind.x);
      tangent.y += kWeights[k] * (ahead.y - behind.y);
    }
    const double length = std::sqrt(tangent.x * tangent.x + tangent.y * tangent.y);
    return length > 0 ? Vector{-tangent.y / length, tangent.x / length} : Vector{1, 0};
  }

 private:
  [[nodiscard]] Vector point(std::ptrdiff_t index) const { return {x_[index], y_[index]}; }
  [[nodiscard]] Vector reflected(std::ptrdiff_t end, std::ptrdiff_t index) const {
    const Vector centre = point(end);
    const Vector other = point(index);
    return {2 * centre.x - other.x, 2 * centre.y - other.y};
  }

  const float* x_;
  const float* y_;
  std::ptrdiff_t count_;
  bool closed_;
};

void set_normals(Edgels& edgels, const Edge& edge) {
  const Curve curve(edgels, edge);
  for (std::uint32_t i = 0; i < edge.edgels.count; ++i) {
    const Vector normal = curve.normal(i);
    edgels.nx[edge.edgels.first + i] = static_cast<float>(normal.x);
    edgels.ny[edge.edgels.first + i] = static_cast<float>(normal.y);
  }
}

// Bilinear; nothing outside the frame.
std::optional<double> sample(ImageView<const std::uint16_t> frame, Vector at) {
  const int last_x = frame.width() - 1;
  const int last_y = frame.height() - 1;
  if (!(at.x >= 0 && at.y >= 0 && at.x <= last_x && at.y <= last_y)) {
    return std::nullopt;
  }
  const int x = static_cast<int>(at.x);
  const int y = static_cast<int>(at.y);
  const std::uint16_t* row = frame.row(y) + x;
  const std::uint16_t* below = y < last_y ? row + frame.stride() : row;
  const int right = x < last_x ? 1 : 0;
  const double fx = at.x - x;
  const double fy = at.y - y;
  const double upper = row[0] + fx * (row[right] - row[0]);
  const double lower = below[0] + fx * (below[right] - below[0]);
  return upper + fy * (lower - upper);
}

// Counts `distance` px ahead along the normal of an edgel less those as far behind it.
std::optional<double> difference(ImageView<const std::uint16_t> frame, const Edgels& edgels,
                                 std::size_t i, double distance) {
  const Vector step{distance * edgels.nx[i], distance * edgels.ny[i]};
  const auto ahead = sample(frame, {edgels.x[i] + step.x, edgels.y[i] + step.y});
  const auto behind = sample(frame, {edgels.x[i] - step.x, edgels.y[i] - step.y});
  return ahead && behind ? std::optional(*ahead - *behind) : std::nullopt;
}

struct Contrast {
  double counts = 0;  // mean over the samples
  int samples = 0;
};

constexpr double kNearestPx = 1.5;

Contrast contrast_across(ImageView<const std::uint16_t> frame, const Edgels& edgels, Range range,
                         double farthest_px) {
  double sum = 0;
  int samples = 0;
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    for (double distance = kNearestPx; distance <= farthest_px; distance += 1) {
      if (const auto step = difference(frame, edgels, i, distance)) {
        sum += *step;
        ++samples;
      }
    }
  }
  return {samples > 0 ? sum / samples : 0, samples};
}

void flip_normals(Edgels& edgels, Range range) {
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    edgels.nx[i] = -edgels.nx[i];
    edgels.ny[i] = -edgels.ny[i];
  }
}

// Standard deviation of a position in whole pixels, found on a slope in noise.
double position_sigma(double sigma_counts, double slope) {
  constexpr double kOfWholePixels = 1.0 / 12;
  if (!(sigma_counts > 0)) {
    return std::sqrt(kOfWholePixels);
  }
  const double shift = sigma_counts / std::max(slope, sigma_counts / std::numbers::sqrt2);
  return std::sqrt(kOfWholePixels + shift * shift);
}

void measure_edgels(ImageView<const std::uint16_t> frame, double sigma_counts, Range range,
                    Edgels& edgels) {
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    const double slope = std::abs(difference(frame, edgels, i, 1).value_or(0)) / 2;
    edgels.magnitude_counts[i] = static_cast<float>(slope);
    edgels.position_sigma_px[i] = static_cast<float>(position_sigma(sigma_counts, slope));
  }
}

// `more_variance`: of the contrast, in units of the noise, beside that of its samples.
double z_of(const Contrast& contrast, double sigma_counts, double more_variance) {
  if (contrast.counts == 0) {
    return 0;
  }
  return sigma_counts > 0
             ? contrast.counts / (sigma_counts * std::sqrt(2.0 / contrast.samples + more_variance))
             : std::numeric_limits<double>::infinity();
}

// What the slope of the scene around an edge contributes to its contrast, counts.
double contrast_of_slope(ImageView<const std::uint16_t> frame, const Edgels& edgels, Range range,
                         double farthest_px) {
  constexpr double kFarPx = 16;
  double sum = 0;
  int samples = 0;
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    if (const auto step = difference(frame, edgels, i, kFarPx)) {
      sum += *step;
      ++samples;
    }
  }
  const double mean_px = (kNearestPx + farthest_px) / 2;
  return samples > 0 ? sum / samples * mean_px / kFarPx : 0;
}

// How much of an edge runs along one column or row: 1 for a straight one along an axis, 1 / sqrt(2)
// where half runs along either, next to 0 for one at 45 degrees.
double alignment(const Edgels& edgels, Range range) {
  const auto power_16 = [](float value) {
    double power = value;
    for (int i = 0; i < 4; ++i) {
      power *= power;
    }
    return power;
  };
  double upright = 0;
  double level = 0;
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    upright += power_16(edgels.nx[i]);
    level += power_16(edgels.ny[i]);
  }
  return std::sqrt(upright * upright + level * level) / range.count;
}

// log10 of P(Z > z) for a standard normal Z. Far out, where the probability itself would underflow,
// by the asymptotic series erfc(x) = exp(-x^2) / (x sqrt(pi)) (1 - 1/(2 x^2) + 3/(4 x^4) - ...).
double log10_tail(double z) {
  const double x = z / std::numbers::sqrt2;
  if (x < 10) {
    return std::log10(std::erfc(x) / 2);
  }
  const double inverse = 1 / (2 * x * x);
  const double series = 1 - inverse * (1 - 3 * inverse * (1 - 5 * inverse));
  return std::log10(series * std::numbers::inv_sqrtpi / (2 * x)) - x * x * std::numbers::log10e;
}

double number_of_tests(const EdgeSet& edges) {
  double tests = 0;
  for (const Edge& edge : edges.edges) {
    const double points = edge.edgels.count;
    tests += points * (points - 1) / 2;
  }
  return std::max(tests, 1.0);
}

}  // namespace

namespace {

// What speaks for an edge: its contrast on the frame as it came, and its score, as far as a
// denoiser can be trusted. On the edges that are found in noise it is a normal variable.
struct Evidence {
  double per_score;
  double most_score;
  double mean;
  double deviation;

  // In standard deviations.
  [[nodiscard]] double of(const Edge& edge) const {
    return (edge.z + per_score * std::min(edge.score, most_score) - mean) / deviation;
  }
};

// The contrast is that from kNearestPx to `farthest_px` on both sides. significance(contrast, edge)
// is the z of an edge; orient(edge) may turn normals round before.
template <class Orient, class Significance, class Tail>
void measure_all(ImageView<const std::uint16_t> frame, double sigma_counts, double tests,
                 double farthest_px, EdgeSet& edges, Orient&& orient, Significance&& significance,
                 Tail&& log10_p) {
  const double log10_tests = std::log10(tests);
  for (Edge& edge : edges.edges) {
    set_normals(edges.edgels, edge);
    orient(edge);
    Contrast contrast = contrast_across(frame, edges.edgels, edge.edgels, farthest_px);
    if (contrast.counts < 0) {
      flip_normals(edges.edgels, edge.edgels);
      contrast.counts = -contrast.counts;
    }
    measure_edgels(frame, sigma_counts, edge.edgels, edges.edgels);
    edge.contrast_counts = contrast.counts;
    edge.z = significance(contrast, edge);
    edge.log10_nfa = log10_tests + log10_p(edge);
  }
}

}  // namespace

void measure_edges(ImageView<const std::uint16_t> frame, double sigma_counts, EdgeSet& edges) {
  constexpr double kFarthestPx = 3.5;
  measure_all(
      frame, sigma_counts, number_of_tests(edges), kFarthestPx, edges, [](const Edge&) {},
      [&](const Contrast& contrast, const Edge&) { return z_of(contrast, sigma_counts, 0); },
      [](const Edge& edge) { return std::log10(2.0) + log10_tail(edge.z); });
}

void measure_edges(ImageView<const std::uint16_t> frame, double sigma_counts,
                   ImageView<const std::int32_t> direction, const SignificanceOptions& options,
                   EdgeSet& edges) {
  constexpr double kPixelsPerCandidate = 55000;
  constexpr Evidence kEvidence{1.6, 0.5, 1.3, 1.3};
  constexpr double kFarthestPx = 4.5;
  const double candidates = static_cast<double>(frame.size()) / kPixelsPerCandidate;
  Edgels& edgels = edges.edgels;
  const auto orient = [&](const Edge& edge) {
    for (std::size_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
      const int steps =
          direction(static_cast<int>(edgels.x[i]), static_cast<int>(edgels.y[i]));  // of 15 degrees
      const double along = steps * std::numbers::pi / 12;
      if (std::cos(along) * edgels.ny[i] - std::sin(along) * edgels.nx[i] < 0) {
        flip_normals(edgels, {static_cast<std::uint32_t>(i), 1});
      }
    }
  };
  const auto significance = [&](Contrast contrast, const Edge& edge) {
    if (sigma_counts == 0) {
      return z_of(contrast, 0, 0);
    }
    const double slope = contrast_of_slope(frame, edgels, edge.edgels, kFarthestPx);
    contrast.counts = std::clamp(contrast.counts - slope, 0.0, contrast.counts);
    const double stripes = options.stripe_sigmas * alignment(edgels, edge.edgels);
    return z_of(contrast, sigma_counts, stripes * stripes);
  };
  measure_all(frame, sigma_counts, candidates, kFarthestPx, edges, orient, significance,
              [&](const Edge& edge) { return log10_tail(kEvidence.of(edge)); });
}

void set_normals_from_shape(EdgeSet& edges) {
  for (const Edge& edge : edges.edges) {
    set_normals(edges.edgels, edge);
  }
}

}  // namespace thermedge
