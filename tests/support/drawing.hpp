// Edge maps and curves for tests, drawn by hand.
#pragma once

#include <cstdint>
#include <ostream>
#include <random>
#include <string_view>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/stages/contours.hpp"

namespace thermedge::test {

inline Image<std::uint8_t> blank_map(int width, int height) {
  Image<std::uint8_t> map(width, height);
  fill_pixels(map.view(), std::uint8_t{0});
  return map;
}

// One string per row; '#' is an edge.
inline Image<std::uint8_t> drawn_map(const std::vector<std::string_view>& rows) {
  auto map = blank_map(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()));
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      map(x, y) = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#' ? 255 : 0;
    }
  }
  return map;
}

inline Image<std::uint8_t> random_map(int width, int height, double density, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution is_edge(density);
  auto map = blank_map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      map(x, y) = is_edge(random) ? 255 : 0;
    }
  }
  return map;
}

// From `from` to `to`, both included, along a row, a column or a diagonal.
inline std::vector<Pixel> straight(Pixel from, Pixel to) {
  const auto sign = [](int value) { return (value > 0) - (value < 0); };
  const Pixel step{sign(to.x - from.x), sign(to.y - from.y)};
  std::vector<Pixel> pixels{from};
  while (!(pixels.back() == to)) {
    pixels.push_back({pixels.back().x + step.x, pixels.back().y + step.y});
  }
  return pixels;
}

// Straight runs from point to point; what two runs share counts once.
inline std::vector<Pixel> polyline(const std::vector<Pixel>& points) {
  std::vector<Pixel> pixels{points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto run = straight(points[i - 1], points[i]);
    pixels.insert(pixels.end(), run.begin() + 1, run.end());
  }
  return pixels;
}

inline void add_contour(ContourSet& set, const std::vector<Pixel>& pixels, bool closed = false) {
  const Range range{static_cast<std::uint32_t>(set.points.size()),
                    static_cast<std::uint32_t>(pixels.size())};
  set.points.insert(set.points.end(), pixels.begin(), pixels.end());
  set.items.push_back({range, closed});
}

inline ContourSet contour_set(const std::vector<std::vector<Pixel>>& curves) {
  ContourSet set;
  for (const auto& curve : curves) {
    add_contour(set, curve);
  }
  return set;
}

inline std::vector<Pixel> pixels_of(const ContourSet& set, std::size_t index) {
  const auto pixels = set.pixels(set.items[index]);
  return {pixels.begin(), pixels.end()};
}

}  // namespace thermedge::test

namespace thermedge {

// How GoogleTest prints a pixel; it looks in the namespace of the type.
inline void PrintTo(const Pixel& pixel, std::ostream* out) {
  *out << "(" << pixel.x << ", " << pixel.y << ")";
}

}  // namespace thermedge
