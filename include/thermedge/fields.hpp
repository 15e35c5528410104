// Dense pictures of a result: mask, ids, ranks, distances.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/edges.hpp"
#include "thermedge/image.hpp"

namespace thermedge {

// Each draws one pixel per edgel (nearest pixel) into an image of the frame's size, which is
// overwritten as a whole. Where edges cross, the better one is seen. Thread-safe.

// 255 on kept edges, 0 elsewhere.
void draw_mask(const EdgeSet& edges, ImageView<std::uint8_t> mask);

// Edge id + 1 on kept edges, 0 elsewhere (ids beyond 65534 are drawn as 65535).
void draw_labels(const EdgeSet& edges, ImageView<std::uint16_t> labels);

// Rank of all edges, kept or not, mapped to 255 (best) .. 1 (last), 0 elsewhere.
void draw_strength(const EdgeSet& edges, ImageView<std::uint8_t> strength);

// Exact Euclidean distance to the kept edges and who is nearest.
struct DistanceField {
  Image<float> distance_px;    // truncated at max_distance_px; 0 on an edge
  Image<std::int32_t> nearest; // index of the nearest edgel, -1 beyond max_distance_px
};

// Pixel-exact transform of Felzenszwalb & Huttenlocher (2012), in integers, then truncated.
// One object per thread.
class DistanceTransform {
 public:
  // max_distance_px > 0.
  void run(const EdgeSet& edges, int width, int height, float max_distance_px,
           DistanceField& field);

 private:
  Image<std::int32_t> column_, seed_;
  std::vector<std::int32_t> hull_;
  std::vector<std::int64_t> bounds_;
};

}  // namespace thermedge
