// From edge pixels to curves (paper Algorithm 3, CSS).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/geometry.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct Contour {
  Range points;         // in ContourSet::points, in walking order; never empty
  bool closed = false;  // the ends meet; the last point is not repeated
};

// Curves in the order in which they were found. Flat arrays: no allocation per curve.
// The later stages take the capacity of these arrays, which ContourTracer sets to the most that a
// frame of this size can hold, as the bound for their own memory.
struct ContourSet {
  std::vector<Pixel> points;
  std::vector<Contour> items;
  std::vector<Junction> junctions;

  [[nodiscard]] std::span<const Pixel> pixels(const Contour& contour) const {
    return slice(points, contour.points);
  }
  void clear();
};

struct ContourOptions {
  int min_component_px = 50;  // 8-connected components with fewer pixels are removed first; 0: off
  int gap_px = 1;             // reach of a walking step, 1..8 px (1: neighbours; 2 jumps one pixel)
  int min_length_px = 0;      // shortest curve kept, px; 0: more than (width + height) / 25 pixels
  double closed_gap_px = 3;   // T of eq. 13, 2-3 px in the text: a curve is closed where its ends
                              // are nearer; 5.66 is the rule of the public code of He & Yung

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<ContourOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("min_component_px", o.min_component_px, Bounds{0, 1e9},
    "components with fewer pixels are removed (0: none)");
  v("gap_px", o.gap_px, Bounds{1, 8}, "reach of a walking step, px");
  v("min_length_px", o.min_length_px, Bounds{0, 1e9},
    "shortest curve, px (0: more than (width + height) / 25)");
  v("closed_gap_px", o.closed_gap_px, Bounds{0, 100}, "ends nearer than this close a curve, px");
}

// Walks the edge map column by column: seed = next set pixel; from there, within the window of
// `gap_px`, always to the nearest set pixel (ties: smaller column, then smaller row), clearing what
// it visits, until the window is empty; then again from the seed, prepending.
// Paper: Algorithm 3, eq. 13; the order is that of the public code of He & Yung.
// One object per thread; allocates on the first frame of a size only.
class ContourTracer {
 public:
  explicit ContourTracer(const ContourOptions& options) : options_(options) {}

  // `edges`: nonzero = edge. `contours` is cleared first.
  // Junctions: ends of open curves at most gap_px + 1 away from a pixel of another curve.
  // Errors: an option out of range; a frame of more than 2^31 pixels.
  [[nodiscard]] Status run(ImageView<const std::uint8_t> edges, ContourSet& contours);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(map_, owner_, steps_, touching_, visited_);
  }

 private:
  void prepare(ImageView<const std::uint8_t> edges, ContourSet& contours);
  void remove_small_components();
  void collect_component(Pixel seed);
  void trace(Pixel seed, ContourSet& contours);
  void walk(Pixel from, std::vector<Pixel>& visited);
  void find_junctions(ContourSet& contours);

  ContourOptions options_;
  std::size_t min_points_ = 1;
  Image<std::uint8_t> map_;      // edges with a border of gap_px, cleared while walking
  Image<std::int32_t> owner_;    // curve of each pixel with a border of gap_px + 1, -1: none
  std::vector<Pixel> steps_;     // of a walk, nearest first
  std::vector<Pixel> touching_;  // offsets under which an end touches a pixel
  std::vector<Pixel> visited_;   // a component, or the second half of a walk
};

}  // namespace thermedge
