// From edge pixels to curves by way of a graph of segments and junctions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/linking.hpp"

namespace thermedge {

struct GraphOptions {
  int min_length_px = 8;          // shortest curve kept, points
  double max_turn_deg = 52;       // sharper turns at a junction are ends, 0..180
  double closed_gap_px = 3;       // a curve whose ends are nearer than this is closed ...
  double closed_length_gaps = 4;  // ... if its length is at least this many closed_gap_px

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<GraphOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("min_length_px", o.min_length_px, Bounds{1, 1e9}, "shortest curve, points");
  v("max_turn_deg", o.max_turn_deg, Bounds{0, 180},
    "largest turn of a curve that goes on through a junction, degrees");
  v("closed_gap_px", o.closed_gap_px, Bounds{0, 100},
    "a curve whose ends are nearer than this is closed, px");
  v("closed_length_gaps", o.closed_length_gaps, Bounds{0, 1000},
    "least length of a closed curve, in multiples of closed_gap_px");
}

struct GraphTuning {
  std::size_t direction_pixels = 8;  // last pixels of a segment that tell its direction: fewer see
                                     // the steps between pixels, more see past a bend
};

// Thins the edge map, the weakest pixels first, so that the ridge remains; splits it at its
// junctions into segments; joins at each junction the two that go on most smoothly, and of the
// others again, as long as they turn no more than max_turn_deg. The directions of segments are
// those of their last direction_pixels. Closed curves have no ends. What the curves are does not
// depend on the order in which pixels are visited, except for ties of response: the flipped or
// transposed map gives the flipped or transposed curves. One object per thread; allocates on the
// first frame of a size only.
class GraphTracer {
 public:
  explicit GraphTracer(const GraphOptions& options, const GraphTuning& tuning = {})
      : options_(options), tuning_(tuning) {}

  // `edges`: nonzero = edge; `response`, of the same size: which of two pixels side by side stays.
  // `curves` is cleared first; its links are of type kEndToMiddle, its junctions the pixels where
  // three or more segments meet. Curves share junction pixels.
  // Errors: an option out of range; sizes that differ; a frame of more than 2^30 pixels.
  [[nodiscard]] Status run(ImageView<const std::uint8_t> edges, ImageView<const float> response,
                           LinkedContours& curves);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(map_, neighbours_, label_, order_, pixels_, candidates_,
                             junction_pixels_, junctions_, segments_, ends_, used_, ends_at_,
                             ends_of_junction_, pairs_, through_, passed_);
  }

 private:
  // A segment is a run of pixels between junctions or free ends. Ends are numbered: 2 i is the
  // first pixel of segment i, 2 i + 1 the last one.
  struct End {
    std::int32_t junction;  // that it touches, -1: none
    std::int32_t partner;   // end that it goes on with, -1: none
    std::int32_t place;     // of this pair among those of the junction, the smoothest first
  };
  struct Pair {
    double smoothness;  // cosine of the turn
    float response;     // of the two pixels together, for turns that are equal
    std::int32_t a, b;  // ends
  };

  void prepare(ImageView<const std::uint8_t> edges, LinkedContours& curves);
  // A pixel that may be taken off.
  struct Candidate {
    float response;
    std::int32_t pixel;
  };

  void thin();
  void take_off_candidates();
  void find_neighbours();
  void find_junctions();
  void find_segments();
  void add_segment(std::int32_t seed);
  void walk(std::int32_t from);
  void join_segments();
  [[nodiscard]] std::int32_t neighbour(std::int32_t pixel, unsigned bits) const;
  [[nodiscard]] std::int32_t junction_beside(std::int32_t pixel, std::int32_t other_than) const;
  [[nodiscard]] std::span<const std::int32_t> pixels_of(std::size_t segment) const {
    return slice(pixels_, segments_[segment]);
  }
  [[nodiscard]] std::int32_t pixel_at(std::int32_t end) const;
  [[nodiscard]] Pixel position(std::int32_t pixel) const;
  [[nodiscard]] float strength_at(std::int32_t pixel) const;
  [[nodiscard]] std::int32_t label_at(Pixel at) const {
    return label_[static_cast<std::size_t>((at.y + 1) * map_.stride() + at.x + 1)];
  }
  [[nodiscard]] std::int32_t nearest_of_junction(std::int32_t junction, Pixel a, Pixel b) const;
  void append_curve(std::int32_t start, LinkedContours& curves);
  [[nodiscard]] std::int32_t strongest_of_junction(std::size_t junction) const;
  void close_curves(LinkedContours& curves) const;
  void connect_ends(LinkedContours& curves);

  GraphOptions options_;
  GraphTuning tuning_;
  ImageView<const float> strength_;   // of this run
  Image<std::uint8_t> map_;           // with a border of 1 pixel; 1: edge
  Image<std::uint8_t> neighbours_;    // a bit for each step to a connected pixel
  std::vector<std::int32_t> label_;   // junction of a pixel, or what has become of it
  std::vector<std::int32_t> order_;   // edge pixels, as offsets in the map
  std::vector<std::int32_t> pixels_;  // of segments
  std::vector<Candidate> candidates_;
  std::vector<std::int32_t> junction_pixels_;
  std::vector<Range> junctions_;  // in junction_pixels_
  std::vector<Range> segments_;   // in pixels_
  std::vector<End> ends_;
  std::vector<std::uint8_t> used_;       // segments that are part of a curve
  std::vector<std::int32_t> ends_at_;    // ends by junction
  std::vector<Range> ends_of_junction_;  // in ends_at_
  std::vector<Pair> pairs_;              // of one junction
  // The curve that goes through each junction most smoothly, -1: none.
  struct Passage {
    std::int32_t curve;
    std::int32_t place;  // of its pair of ends
  };
  std::vector<Passage> through_;
  std::vector<std::int32_t> passed_;  // ends by which a curve enters junctions
};

}  // namespace thermedge
