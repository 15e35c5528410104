// Carries curves on over gaps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/contour_chains.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/linking.hpp"

namespace thermedge {

struct GapClosingOptions {
  double gap_px = 10;        // longest bridge, 0..32 px; 0: none
  double max_turn_deg = 45;  // sharpest turn into a bridge and out of it, 0..90
  double min_contrast_ratio =
      0.1;  // contrast across a bridge, of that across the curve's end, 0..1

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<GapClosingOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gap_px", o.gap_px, Bounds{0, 32}, "longest gap that a bridge crosses, px (0: no bridges)");
  v("max_turn_deg", o.max_turn_deg, Bounds{0, 90}, "sharpest turn into a bridge, degrees");
  v("min_contrast_ratio", o.min_contrast_ratio, Bounds{0, 1},
    "least contrast of a bridge, as a share of the contrast at the end of its curve");
}

// Bridges as a whole raise F at s20 from .870 to .878 (docs/experiments.md, "bridges"). No field is
// measured on its own: a line tells what its value trades off.
struct GapClosingTuning {
  int tip_pixels = 10;  // last pixels that tell the direction of an end and the contrast across it:
                        // fewer see the steps between pixels, more see past a bend
  double side_px = 2;  // to either side of a bridge its contrast is taken: nearer is on the blurred
                       // step, farther may be across the next edge
  double unseen_px = 2;  // bridges up to this length need no contrast: too few pixels to tell
  double turn_cost = 2;  // added to the length of a bridge for a turn by 90 degrees, in its
                         // lengths: a larger one prefers far targets that lie straight ahead
  int tip_reach_px = 4;  // a curve met within this of its end is met at its end, px
  double own_gaps = 4;   // an end may be bridged to its own curve where it is more than this many
                         // times gap_px along the curve: fewer close small hooks
  double step_px = 0.5;  // between the samples along a bridge: time against precision
  // Sine of the angle below which two ends do not head for a corner, 0..1: nearly parallel lines
  // meet anywhere.
  double least_corner_sine = 0.4;
};

// Where an edge meets a stronger one, the ridge of its gradient ends some pixels before, and a weak
// stretch makes a gap. From each free end, the shortest, straightest bridge to another curve, to an
// end or to the frame's border is taken, if the step that the edge has goes on across it. Bridges
// are taken by their length, with an addition for their turn, each end once. Two ends that meet
// become one curve, straight on or by way of the corner that both head for, but not by a kink; ends
// that meet a curve become a link of type 2.
// One object per thread; allocates on the first frame of a size only.
class GapCloser {
 public:
  explicit GapCloser(const GapClosingOptions& options, const GapClosingTuning& tuning = {})
      : options_(options), tuning_(tuning) {}

  // `frame`: what the edges were found on. `eligible`, one for each curve: 0 where it is not worth
  // a bridge. `bridged` is cleared first; links of type 2 go over into it. `valid`, where not
  // empty: 0 where no edge can be, so that no bridge leads over it either. Errors: an option out of
  // range.
  [[nodiscard]] Status run(const LinkedContours& curves, ImageView<const float> frame,
                           std::span<const std::uint8_t> eligible, LinkedContours& bridged,
                           ImageView<const std::uint8_t> valid = {});

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(chains_, window_, offsets_, bridges_, owner_, place_);
  }

 private:
  struct Vector {
    double x, y;
  };
  // What lies at a free end.
  struct Tip {
    Pixel at;
    Vector ahead;     // unit vector
    double contrast;  // ahead's right side over its left, of the last pixels
  };
  struct Bridge {
    double cost;
    std::int32_t end;
    Pixel to;
    std::int32_t partner;         // end that it meets, -1: none
    std::optional<Pixel> corner;  // by way of which it does
    double contrast;              // of the end, without its sign
  };

  // From an end to where it may be bridged to.
  struct Offset {
    Pixel step;
    std::ptrdiff_t place;  // in owner_, from the end
    double length;
  };

  void prepare(const LinkedContours& curves, ImageView<const float> frame, LinkedContours& bridged);
  void paint(const LinkedContours& curves, std::span<const std::uint8_t> eligible);
  [[nodiscard]] bool touches_another(std::int32_t end, Pixel at) const;
  [[nodiscard]] Tip tip_of(const ContourSet& contours, std::int32_t end,
                           ImageView<const float> frame) const;
  [[nodiscard]] static Vector direction(Pixel from, Pixel to);
  [[nodiscard]] std::optional<Bridge> find_target(const Tip& tip, std::int32_t end,
                                                  double least_cosine,
                                                  ImageView<const float> frame) const;
  [[nodiscard]] double distance_to_border(const Tip& tip) const;
  void meet_end(const ContourSet& contours, ImageView<const float> frame, const Tip& tip,
                double least_cosine, Bridge& bridge) const;
  [[nodiscard]] std::optional<Pixel> corner_of(const Tip& a, const Tip& b) const;
  [[nodiscard]] bool leads_over_invalid(const Tip& tip, Pixel to) const;
  [[nodiscard]] bool step_goes_on(const Tip& tip, Pixel to, ImageView<const float> frame) const;
  [[nodiscard]] std::optional<Bridge> find_bridge(const ContourSet& contours, std::int32_t end,
                                                  ImageView<const float> frame) const;
  [[nodiscard]] bool is_own(std::int32_t end, Pixel at) const;
  void join(const ContourSet& contours, LinkedContours& bridged);

  GapClosingOptions options_;
  GapClosingTuning tuning_;
  detail::CurveChains chains_;
  std::vector<Pixel> window_;    // offsets within gap_px, nearest first
  std::vector<Offset> offsets_;  // the same
  std::vector<Bridge> bridges_;
  Image<std::int32_t> owner_;            // curve of each pixel, -1: none
  Image<std::int32_t> place_;            // of the pixel within its curve
  ImageView<const std::uint8_t> valid_;  // of this run
};

}  // namespace thermedge
