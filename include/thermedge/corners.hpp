// Corners of curves by global and local curvature properties (GLCP; paper Algorithm 4, eqs. 9-13;
// He & Yung 2004, 2008).
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/contours.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct CornerOptions {
  double sigma_px = 3;        // Gaussian that smooths the curve before curvature, 0.5..10 px
  double curvature_ratio = 1.5;  // R: a corner is sharper than R times the mean of its region, >= 1
  double max_angle_deg = 162;    // wider angles are no corners (eq. 11), 90..180
  bool end_points = true;        // the ends of open curves are corners too ...
  double end_distance_px = 5;    // ... where farther than this from every other corner, px
};

// Indices into the points of their contour, ascending; one Range per contour.
struct CornerSet {
  std::vector<std::uint32_t> indices;
  std::vector<Range> ranges;
  void clear();
};

// The corner finder that the paper used, to the letter: smoothing with a half width of 12 samples
// (sigma 3) and its zero-padded margins, central differences, K = ceil(100 K) / 100, adaptive
// threshold over the region of support, angle between tangents, ends added against the corners of
// the whole frame. docs/paper_map.md lists the known faults, which are kept.
// One object per thread; allocates only while curves grow longer than any before.
class CornerFinder {
 public:
  explicit CornerFinder(const CornerOptions& options) : options_(options) {}

  // `corners` is cleared first. Errors: an option out of range.
  [[nodiscard]] Status run(const ContourSet& contours, CornerSet& corners);

 private:
  CornerOptions options_;
  struct Scratch {
    std::vector<double> kernel, x, y, xs, ys, dx, dy, ddx, ddy, curvature;
    std::vector<std::int32_t> extrema, candidates, kept;
  } scratch_;
};

}  // namespace thermedge
