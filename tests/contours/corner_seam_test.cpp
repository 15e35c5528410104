#include <gtest/gtest.h>

#include "thermedge/stages/corners_paper.hpp"

namespace thermedge {
namespace {

// A square of 10 px a side, 40 points, that starts two points before its first corner.
struct Square {
  ContourSet contours;
  CornerSet corners;

  explicit Square(bool closed) {
    for (int i = 0; i < 40; ++i) {
      const int along = (i + 8) % 10;
      const int side = (i + 8) / 10 % 4;
      const Pixel points[4] = {{along, 0}, {10, along}, {10 - along, 10}, {0, 10 - along}};
      contours.points.push_back(points[side]);
    }
    contours.items.push_back({{0, 40}, closed});
  }
  std::vector<std::uint32_t> merged(std::vector<std::uint32_t> indices, double distance_px) {
    corners.indices = std::move(indices);
    corners.ranges = {{0, static_cast<std::uint32_t>(corners.indices.size())}};
    merge_seam_corners(contours, distance_px, corners);
    const auto left = slice(corners.indices, corners.ranges[0]);
    return {left.begin(), left.end()};
  }
};

using Indices = std::vector<std::uint32_t>;

TEST(SeamCorners, BecomeOneWhereNear) {
  Square square(true);
  EXPECT_EQ(square.merged({2, 12, 22, 32, 38}, 5), (Indices{2, 12, 22, 32}));
  EXPECT_EQ(square.merged({0, 39}, 1), (Indices{0}));
}

TEST(SeamCorners, StayTwoWhereFar) {
  Square square(true);
  EXPECT_EQ(square.merged({2, 12, 22, 32, 38}, 3.9), (Indices{2, 12, 22, 32, 38}));
  EXPECT_EQ(square.merged({2, 12, 22, 32}, 5), (Indices{2, 12, 22, 32}));
  EXPECT_EQ(square.merged({2}, 5), (Indices{2}));
}

TEST(SeamCorners, AreOnlyThoseOfClosedCurves) {
  Square square(false);
  EXPECT_EQ(square.merged({0, 39}, 5), (Indices{0, 39}));
}

}  // namespace
}  // namespace thermedge
