// Hysteresis over classes of edge pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::detail {

inline constexpr std::uint8_t kKeptEdge = 255;

// The first pixel of this value, or `end`.
template <class Byte>
Byte* find_pixel(Byte* begin, Byte* end, std::uint8_t value) {
  auto* found = std::memchr(begin, value, static_cast<std::size_t>(end - begin));
  return found != nullptr ? static_cast<Byte*>(found) : end;
}

// Keeps the 8-connected groups of at least `min_group_px` pixels that hold a strong one. `classes`:
// of PixelClass, those of the border kNoEdge; afterwards kKeptEdge or kNoEdge. `scratch` grows to
// the size of the largest group, all pixels at most.
void apply_hysteresis(ImageView<std::uint8_t> classes, std::size_t min_group_px,
                      std::vector<std::ptrdiff_t>& scratch);

}  // namespace thermedge::detail
