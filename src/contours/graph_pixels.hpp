// Pixels of an edge map and their neighbours: shared by the parts of GraphTracer.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "thermedge/stages/edge_graph.hpp"

namespace thermedge {
namespace detail::graph {

inline constexpr std::int32_t kNone = -1;
inline constexpr std::int32_t kVisited = -2;  // part of a segment

// The eight neighbours of a pixel, around it; those at even places share a side with it.
inline constexpr std::array<Pixel, 8> kAround = {Pixel{1, 0}, {1, 1},   {0, 1},  {-1, 1},
                                                 {-1, 0},     {-1, -1}, {0, -1}, {1, -1}};

inline std::ptrdiff_t offset_of(Pixel step, std::ptrdiff_t stride) {
  return step.y * stride + step.x;
}

// The neighbours of a pixel that are set, as bits in the order of kAround.
inline unsigned set_around(const std::uint8_t* pixel, std::ptrdiff_t stride) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < kAround.size(); ++k) {
    bits |= static_cast<unsigned>(pixel[offset_of(kAround[k], stride)] != 0) << k;
  }
  return bits;
}

}  // namespace detail::graph

inline Pixel GraphTracer::position(std::int32_t pixel) const {
  const auto stride = static_cast<std::int32_t>(map_.stride());
  return {pixel % stride - 1, pixel / stride - 1};
}

inline float GraphTracer::strength_at(std::int32_t pixel) const {
  const Pixel at = position(pixel);
  return strength_(at.x, at.y);
}

// The first of the neighbours whose bits are set.
inline std::int32_t GraphTracer::neighbour(std::int32_t pixel, unsigned bits) const {
  const Pixel step = detail::graph::kAround[static_cast<std::size_t>(std::countr_zero(bits))];
  return static_cast<std::int32_t>(pixel + detail::graph::offset_of(step, map_.stride()));
}

inline std::int32_t GraphTracer::pixel_at(std::int32_t end) const {
  const auto pixels = pixels_of(static_cast<std::size_t>(end / 2));
  return end % 2 == 0 ? pixels.front() : pixels.back();
}

}  // namespace thermedge
