// Corners of contours: points at which the direction of a contour jumps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/contours.hpp"

namespace thermedge {

struct CornerOptions {
  double sigma_px = 3;           // Gaussian that smooths the contour before curvature, 0.5..10 px
  double curvature_ratio = 1.5;  // a corner is sharper than this times the mean of its arms, >= 1
  double max_angle_deg = 150;    // wider angles between the two arms are no corners, 90..180
  double end_distance_px = 5;    // a corner no farther than this from an end of its open contour,
                                 // along it, is left out: the end stands for it, px

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<CornerOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("sigma_px", o.sigma_px, Bounds{0.5, 10}, "smoothing of the contour before curvature, px");
  v("curvature_ratio", o.curvature_ratio, Bounds{1, 100},
    "a corner is sharper than this many times the mean of its arms");
  v("max_angle_deg", o.max_angle_deg, Bounds{90, 180}, "wider angles are no corners, degrees");
  v("end_distance_px", o.end_distance_px, Bounds{0, 1000},
    "no farther than this from an end of its contour, the end stands for a corner, px");
}

// Chosen on drawn squares, bends, ellipses and rounded rectangles at all angles and on the squares
// of a calibration board (docs/experiments.md).
struct CornerTuning {
  double arm_sigmas = 4.5;  // length of an arm in units of sigma_px. A longer one sees neighbouring
                            // shapes, a shorter one the steps between pixels.
  double saddle_share = 0.5;  // on both sides of a corner the curvature falls to this share of it
                              // before it rises above it, 0..1
  double least_share = 0.5;   // least curvature of a corner, as a share of that of a sharp bend by
                              // max_angle_deg along a row of pixels, 0..1
};

// Indices into the points of their contour, ascending; one Range per contour.
struct CornerSet {
  std::vector<std::uint32_t> indices;
  std::vector<Range> ranges;
  void clear();
};

// The corners of each contour, of that contour alone. The first and the last point of an open
// contour are always corners. In between, and on closed contours, which have no ends and may have
// no corner at all, a corner is a peak of the smoothed contour's curvature (eq. 9) that stands out
// of the samples around it, and where the tangents of the two arms enclose a sharp angle.
//
// Contours that are shifted, mirrored, transposed, walked backwards or, if closed, begun elsewhere
// have the same pixels as corners, exactly: sums are sums of whole numbers or run outwards from
// the corner, equally on both sides. Of equal peaks without a saddle between them the middle is the
// corner. Where the middle lies between two samples, the one on the side of the larger curvature
// is; on a contour that is symmetric about that place, both are.
//
// Paper: Algorithm 4; differs: PaperCornerFinder is the paper's own rule with its faults.
// One object per thread; allocates on the first frame of a size only.
class CornerFinder {
 public:
  explicit CornerFinder(const CornerOptions& options, const CornerTuning& tuning = {})
      : options_(options), tuning_(tuning) {}

  // `corners` is cleared first. Coordinates: -2^29 .. 2^29.
  // Errors: an option out of range.
  [[nodiscard]] Status run(const ContourSet& contours, CornerSet& corners);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(kernel_, padded_, x_steps_, y_steps_, curvature_, candidates_, sharp_);
  }

 private:
  struct Curve {
    std::span<const Pixel> pixels;
    bool closed;
  };
  // Samples that stand for one corner: the same twice, or two neighbours that nothing tells apart.
  struct Candidate {
    std::size_t first, last;
  };
  // Numbers of samples.
  struct Arms {
    std::size_t before, after;
  };

  void prepare(const ContourSet& contours, CornerSet& corners);
  void set_kernel();
  void smooth_steps(const Curve& curve, std::int32_t Pixel::*coordinate,
                    std::vector<double>& smoothed);
  void find_curvature(const Curve& curve);
  [[nodiscard]] double least_curvature() const;
  void find_candidates(const Curve& curve);
  void remove_near_ends(const Curve& curve);
  void remove_blunt(const Curve& curve);
  [[nodiscard]] Arms arms_of(const Curve& curve, std::size_t candidate) const;
  [[nodiscard]] bool stands_out(const Candidate& candidate, const Arms& arms) const;
  [[nodiscard]] bool is_sharp(const Curve& curve, const Candidate& candidate,
                              const Arms& arms) const;
  void append(const Curve& curve, CornerSet& corners) const;

  CornerOptions options_;
  CornerTuning tuning_;
  std::vector<double> kernel_;  // whole numbers
  double kernel_sum_ = 0;
  std::vector<double> padded_;             // steps from sample to sample, with margins
  std::vector<double> x_steps_, y_steps_;  // smoothed: [i] leads from sample i - 1 to sample i
  std::vector<double> curvature_;          // 1/px
  std::vector<Candidate> candidates_, sharp_;
};

}  // namespace thermedge
