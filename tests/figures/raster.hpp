// Figures as pixels, for tests of what is drawn and where.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <utility>

#include "canvas.hpp"
#include "thermedge/figures/figure.hpp"

namespace thermedge::io {

// How GoogleTest prints a colour; it looks in the namespace of the type.
inline void PrintTo(const Rgb& colour, std::ostream* out) {
  *out << "rgb(" << +colour.r << ", " << +colour.g << ", " << +colour.b << ")";
}

}  // namespace thermedge::io

namespace thermedge::figures {

inline Image<Rgb> rasterised(const Figure& figure) {
  auto picture = figure.rasterise();
  EXPECT_TRUE(picture);
  return picture ? std::move(*picture) : Image<Rgb>(1, 1);
}

inline Image<Rgb> drawn(int width, int height, const std::function<void(Canvas&)>& draw) {
  return rasterised(Figure(width, height, draw));
}

// The pixels for which `wanted` holds: how many there are, and the first and last column and row.
struct Extent {
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
  int pixels = 0;
  [[nodiscard]] int width() const { return right - left + 1; }
  [[nodiscard]] int height() const { return bottom - top + 1; }
};

// Columns from left up to right, rows from top up to bottom; by default all of a picture.
struct Area {
  int left = 0, top = 0, right = 1 << 30, bottom = 1 << 30;
};

inline Extent extent_of(const Image<Rgb>& picture, const std::function<bool(Rgb)>& wanted,
                        const Area& area = {}) {
  Extent extent;
  for (int y = std::max(area.top, 0); y < std::min(area.bottom, picture.height()); ++y) {
    for (int x = std::max(area.left, 0); x < std::min(area.right, picture.width()); ++x) {
      if (wanted(picture(x, y))) {
        extent.left = std::min(extent.left, x);
        extent.right = std::max(extent.right, x);
        extent.top = std::min(extent.top, y);
        extent.bottom = std::max(extent.bottom, y);
        ++extent.pixels;
      }
    }
  }
  return extent;
}

inline Extent extent_of(const Image<Rgb>& picture, Rgb colour, const Area& area = {}) {
  return extent_of(
      picture, [&](Rgb pixel) { return pixel == colour; }, area);
}

// Everything that is not paper.
inline Extent drawn_extent(const Image<Rgb>& picture) {
  return extent_of(picture, [](Rgb pixel) { return pixel != kPaper; });
}

}  // namespace thermedge::figures
