#include "thermedge/stages/significance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "edgel_contrast.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge {
namespace {

struct Vector {
  double x = 0;
  double y = 0;
};

// Contribution of the slope of the scene around an edge to its contrast, counts.
double contrast_of_slope(ImageView<const std::uint16_t> frame, const Edgels& edgels, Range range,
                         const SignificanceTuning& tuning) {
  const double far_px = tuning.slope_px;
  double sum = 0;
  int samples = 0;
  detail::for_each_run(range, [&](std::size_t first, std::size_t count) {
    detail::RunOfDoubles steps;
    detail::differences(frame, edgels, first, count, far_px, steps);
    for (std::size_t i = 0; i < count; ++i) {
      const bool seen = !std::isnan(steps[i]);
      sum += seen ? steps[i] : 0;
      samples += seen ? 1 : 0;
    }
  });
  const double mean_px = (tuning.contrast.nearest_px + tuning.contrast.farthest_px) / 2;
  return samples > 0 ? sum / samples * mean_px / far_px : 0;
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

// Unit vectors at all directions of edges.
std::array<Vector, kEdgeDirections> directions() {
  std::array<Vector, kEdgeDirections> along;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double angle = static_cast<double>(i) * std::numbers::pi / kEdgeOrientations;
    along[i] = {std::cos(angle), std::sin(angle)};
  }
  return along;
}

}  // namespace

void test_significance(ImageView<const std::uint16_t> frame, double sigma_counts,
                       ImageView<const std::int32_t> direction, const SignificanceOptions& options,
                       EdgeSet& edges, const SignificanceTuning& tuning) {
  const auto pixels = static_cast<double>(frame.size());
  Edgels& edgels = edges.edgels;
  const auto along = directions();
  const auto orient = [&](const Edge& edge) {
    for (std::size_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
      const int steps = direction(static_cast<int>(edgels.x[i]), static_cast<int>(edgels.y[i]));
      const Vector way = along[static_cast<std::size_t>(steps)];
      if (way.x * edgels.ny[i] - way.y * edgels.nx[i] < 0) {
        detail::flip_normals(edgels, {static_cast<std::uint32_t>(i), 1});
      }
    }
  };
  const auto significance = [&](detail::Contrast contrast, const Edge& edge) {
    if (sigma_counts == 0) {
      return detail::z_of(contrast, 0, 0);
    }
    const double slope = contrast_of_slope(frame, edgels, edge.edgels, tuning);
    contrast.counts = std::clamp(contrast.counts - slope, 0.0, contrast.counts);
    const double stripes = options.stripe_sigmas * alignment(edgels, edge.edgels);
    return detail::z_of(contrast, sigma_counts, stripes * stripes);
  };
  detail::measure_all(frame, sigma_counts, 1, tuning.contrast.farthest_px, tuning.contrast, edges,
                      orient, significance, [&](const Edge& edge) {
                        return options.model ? options.model->log10_nfa(edge, pixels)
                                             : std::numeric_limits<double>::quiet_NaN();
                      });
}

double FalseAlarmModel::log10_nfa(const Edge& edge, double pixels) const {
  const double evidence = edge.z + per_score * std::min(edge.score, most_score);
  return std::log10(pixels / px_per_candidate) + detail::log10_tail((evidence - mean) / deviation);
}

}  // namespace thermedge
