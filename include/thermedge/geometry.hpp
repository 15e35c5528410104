// Pixel positions, runs within flat arrays, junctions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace thermedge {

struct Pixel {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

[[nodiscard]] constexpr std::int64_t squared_distance(Pixel a, Pixel b) {
  const std::int64_t dx = std::int64_t{a.x} - b.x;
  const std::int64_t dy = std::int64_t{a.y} - b.y;
  return dx * dx + dy * dy;
}

// A run of elements in one of the flat arrays of a result.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  friend bool operator==(const Range&, const Range&) = default;
};

template <class T>
[[nodiscard]] std::span<const T> slice(const std::vector<T>& values, Range range) {
  return {values.data() + range.first, range.count};
}
template <class T>
[[nodiscard]] std::span<T> slice(std::vector<T>& values, Range range) {
  return {values.data() + range.first, range.count};
}

// The pixel at which the end of a contour touches another contour, or where several meet.
struct Junction {
  Pixel at;
};

}  // namespace thermedge
