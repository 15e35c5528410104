// Dense pictures of a result: mask, indices, strength, distances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"

namespace thermedge {

// Each draws one pixel per edgel (nearest pixel) into an image of the frame's size, which is
// overwritten as a whole; edgels outside are left out. Where edges cross, the better one is seen.
// Thread-safe.

// 255 on kept edges, 0 elsewhere.
void draw_mask(const EdgeSet& edges, ImageView<std::uint8_t> mask);

// Edge index + 1 on kept edges, 0 elsewhere (indices beyond 65534 are drawn as 65535).
void draw_labels(const EdgeSet& edges, ImageView<std::uint16_t> labels);

// Strength of all edges, kept or not, as 255 (1) .. 1 (0), 0 elsewhere.
void draw_strength(const EdgeSet& edges, ImageView<std::uint8_t> strength);

// The parts of a binary map: its edge pixels (nonzero) and the groups of them that touch each other
// (8-connected). Many groups for few pixels: broken edges or noise. Thread-safe.
struct MapCount {
  std::size_t edge_pixels = 0;
  std::size_t fragments = 0;
};
[[nodiscard]] MapCount count_fragments(ImageView<const std::uint8_t> map);

// Exact Euclidean distance to the kept edges, and which edgel is nearest.
struct DistanceField {
  Image<float> distance_px;     // truncated at max_distance_px; 0 on an edge
  Image<std::int32_t> nearest;  // index of the nearest edgel, -1 beyond max_distance_px
};

// Exact transform of Felzenszwalb & Huttenlocher (2012) in integers, between pixels: an edgel
// counts as the pixel that holds it. Among edgels at the same distance the smallest index is the
// nearest one. One object per thread; allocates on the first frame of a size only. Cost: about 1 ms
// for 382x288.
class DistanceTransform {
 public:
  // max_distance_px > 0. `field` gets the size of the frame.
  void run(const EdgeSet& edges, int width, int height, float max_distance_px,
           DistanceField& field);

 private:
  // The nearest edgel of the same column; no edgel: index -1.
  struct ColumnNearest {
    std::int32_t distance;
    std::int32_t edgel;
  };
  // A column that is nearest for the pixels of a row from `begin` up to the next one's.
  struct Reign {
    std::int32_t column;
    std::int32_t begin;
  };

  void place_edgels(const EdgeSet& edges);
  void search_columns();
  void find_reigns(int y);
  void fill_row(int y, float max_distance_px, DistanceField& field) const;

  std::int64_t edgels_ = 0;  // more than the largest index
  Image<ColumnNearest> nearest_;
  std::vector<Reign> reigns_;
};

}  // namespace thermedge
