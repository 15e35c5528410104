// Edge maps for tests: seeded, the same on every machine.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>

#include "thermedge/image.hpp"

namespace thermedge::test {

// Random walks, drawn with a pen of `pen_px`, each with a strength of its own; and single pixels.
// Integers only: the generator is defined to the bit, distributions are not.
inline Image<std::uint8_t> random_edge_map(int width, int height, int walks, int pen_px,
                                           unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  Image<std::uint8_t> map(width, height);
  fill_pixels(map.view(), std::uint8_t{0});
  const auto paint = [&](int x, int y, int size, int strength) {
    for (int v = std::max(0, y); v < std::min(height, y + size); ++v) {
      for (int u = std::max(0, x); u < std::min(width, x + size); ++u) {
        map(u, v) = std::max(map(u, v), static_cast<std::uint8_t>(strength));
      }
    }
  };
  for (int i = 0; i < walks; ++i) {
    int x = below(width);
    int y = below(height);
    int strength = 40 + below(200);
    const int across = below(3) - 1;
    const int down = across == 0 ? 1 : below(3) - 1;
    for (int step = 0; step < 30; ++step) {
      paint(x, y, pen_px, strength);
      strength = std::clamp(strength + below(21) - 10, 1, 255);
      x += across + (below(4) == 0 ? below(3) - 1 : 0);
      y += down + (below(4) == 0 ? below(3) - 1 : 0);
    }
  }
  for (int i = 0; i < 2 * walks; ++i) {
    const int x = below(width);
    const int y = below(height);
    paint(x, y, 1, 1 + below(255));
  }
  return map;
}

// The map moved, with some pixels gone: as another annotator would draw it.
inline Image<std::uint8_t> annotated(ImageView<const std::uint8_t> map, int dx, int dy,
                                     unsigned seed) {
  std::mt19937 random(seed);
  Image<std::uint8_t> result(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const bool there = map.contains(x - dx, y - dy) && map(x - dx, y - dy) >= 60;
      result(x, y) = there && random() % 10 != 0 ? 255 : 0;
    }
  }
  return result;
}

}  // namespace thermedge::test
