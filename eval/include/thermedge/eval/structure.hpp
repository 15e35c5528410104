// How broken the edges of a map are: fragments, contours between junctions, spurs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::eval {

// The structure of one map whose lines are one pixel wide. A fragment is a group of touching pixels
// (8-connected). A junction is a pixel around which set and unset pixels alternate three times or
// more; without the junctions, fragments fall into contours. A spur is a contour of fewer than
// `short_px` pixels that hangs on a junction by one end.
struct MapStructure {
  std::vector<std::int32_t> fragments_px;  // pixels of each, in reading order of their first pixel
  std::vector<std::int32_t> contours_px;
  std::size_t edge_pixels = 0;
  std::size_t spurs = 0;
};
// Nonzero: edge. Thread-safe.
[[nodiscard]] MapStructure measure_structure(ImageView<const std::uint8_t> map, int short_px = 10);

// Over a set of maps; all 0 where no map has an edge.
struct StructureSummary {
  double edge_pixels = 0;  // per map
  double fragments_per_1000_px = 0;
  double spurs_per_1000_px = 0;
  double median_contour_px = 0;
  double weighted_median_contour_px = 0;     // half of all contour pixels lie in longer contours
  double short_fragments = 0;                // share of the fragments that have fewer than short_px
  double short_fragments_px = 0;             // share of the edge pixels that lie in these
  std::vector<std::size_t> contour_lengths;  // how many contours have less than 2, 4, 8, 16 ... px
                                             // (each counted once), up to the longest
};
[[nodiscard]] StructureSummary summarise_structure(std::span<const MapStructure> maps,
                                                   int short_px = 10);

}  // namespace thermedge::eval
