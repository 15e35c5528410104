// The pixels around a pixel, nearest first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "thermedge/geometry.hpp"

namespace thermedge::detail {

// The order in which a window is searched: by distance, ties to the smaller column, then row.
[[nodiscard]] inline bool nearer(Pixel a, Pixel b) {
  const std::int64_t a_squared = squared_distance(a, {});
  const std::int64_t b_squared = squared_distance(b, {});
  if (a_squared != b_squared) {
    return a_squared < b_squared;
  }
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

// Fills `offsets` with those offsets up to `reach` in x and y, (0, 0) among them, that
// `inside(offset)` wants, nearest first.
template <class Inside>
void list_offsets(std::int32_t reach, Inside&& inside, std::vector<Pixel>& offsets) {
  offsets.clear();
  for (std::int32_t dy = -reach; dy <= reach; ++dy) {
    for (std::int32_t dx = -reach; dx <= reach; ++dx) {
      if (const Pixel offset{dx, dy}; inside(offset)) {
        offsets.push_back(offset);
      }
    }
  }
  std::sort(offsets.begin(), offsets.end(), nearer);
}

}  // namespace thermedge::detail
