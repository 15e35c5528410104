// Corners of curves by global and local curvature properties (GLCP; paper Algorithm 4, eqs. 9-13;
// He & Yung 2004, 2008).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/corners.hpp"

namespace thermedge {

struct PaperCornerOptions {
  double sigma_px = 3;           // Gaussian that smooths the curve before curvature, 0.5..10 px
  double curvature_ratio = 1.5;  // R: a corner is sharper than R times the mean of its region, >= 1
  double max_angle_deg = 162;    // wider angles are no corners (eq. 11), 90..180
  bool end_points = true;        // the ends of open curves are corners too ...
  double end_distance_px = 5;    // ... where farther than this from every other corner, px; as
                                 // near, two corners at the seam of a linked loop are one

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<PaperCornerOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("sigma_px", o.sigma_px, Bounds{0.5, 10}, "smoothing of the curve before curvature, px");
  v("curvature_ratio", o.curvature_ratio, Bounds{1, 100},
    "a corner is sharper than this many times the mean of its region");
  v("max_angle_deg", o.max_angle_deg, Bounds{90, 180}, "wider angles are no corners, degrees");
  v("end_points", o.end_points, Bounds{0, 1}, "ends of open curves are corners");
  v("end_distance_px", o.end_distance_px, Bounds{0, 1000},
    "an end is a corner only farther than this from every other corner, px");
}

// The corner finder that the paper used, to the letter: smoothing over 12 samples to each side
// (sigma 3) with zero-padded margins, central differences, K = ceil(100 K) / 100, adaptive
// threshold over the region of support, angle between tangents, ends added against the corners of
// the whole frame. docs/paper_map.md lists the known faults, which are kept.
// Corners depend on the last bit here: coordinates count from 1 and come in the order (row,
// column), and sums run in the order of that code, which is why the same corners come out. One
// object per thread; allocates on the first frame of a size only.
class PaperCornerFinder {
 public:
  explicit PaperCornerFinder(const PaperCornerOptions& options) : options_(options) {}

  // `corners` is cleared first. Coordinates of pixels must not be negative.
  // Errors: an option out of range.
  [[nodiscard]] Status run(const ContourSet& contours, CornerSet& corners);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(kernel_, padded_, rows_, columns_, curvature_, extrema_, candidates_,
                             sharp_, found_, last_in_row_, inner_.indices, inner_.ranges);
  }

 private:
  void prepare(const ContourSet& contours, CornerSet& corners);
  void find_curvature_corners(const ContourSet& contours);
  void smooth_curve(std::span<const Pixel> pixels, bool closed);
  void find_extrema();
  void find_candidates();
  void remove_wide_angles();
  void add_end_points(const ContourSet& contours, CornerSet& corners);
  void remember(Pixel corner);
  [[nodiscard]] bool is_far_from_corners(Pixel end) const;

  PaperCornerOptions options_;
  std::vector<double> kernel_;
  // Samples of one curve, with a margin of half a kernel at both ends; padded_ has twice that.
  std::vector<double> padded_, rows_, columns_, curvature_;
  std::vector<std::size_t> extrema_;  // samples: minima at even places, maxima at odd ones
  std::vector<std::size_t> candidates_, sharp_;
  CornerSet inner_;  // corners without the ends
  // All corners of the frame so far, chained by row for the search around an end; -1 ends a chain.
  struct Found {
    Pixel at;
    std::int32_t next;
  };
  std::vector<Found> found_;
  std::vector<std::int32_t> last_in_row_;
};

// Makes one of two corners of a closed curve that lie on both sides of its seam, at most
// `distance_px` apart along it: the later one goes. The public code reports such a corner twice.
// Paper: Algorithm 5, type 3 (a loop has no ends). `corners` belongs to `contours`. Thread-safe.
void merge_seam_corners(const ContourSet& contours, double distance_px, CornerSet& corners);

}  // namespace thermedge
