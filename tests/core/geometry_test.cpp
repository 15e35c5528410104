// Distances, ranges and points of edges.
#include "thermedge/geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "support/edge_sets.hpp"

namespace thermedge {
namespace {

TEST(SquaredDistance, HoldsForTheFarthestPixels) {
  static_assert(squared_distance({3, -4}, {}) == 25);
  static_assert(squared_distance({7, 1}, {7, 1}) == 0);
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  constexpr std::int64_t kSide = std::int64_t{1} << 30;
  EXPECT_EQ(squared_distance({1 << 29, 0}, {-(1 << 29), 0}), kSide * kSide);
  EXPECT_EQ(squared_distance({kMost, 5}, {-9, 5}), (2 * kSide + 8) * (2 * kSide + 8));
}

TEST(Slice, IsTheRangeAndWritesThrough) {
  std::vector<int> values(10);
  std::iota(values.begin(), values.end(), 0);
  const auto part = slice(values, {3, 4});
  EXPECT_EQ(std::vector<int>(part.begin(), part.end()), (std::vector{3, 4, 5, 6}));
  part[0] = 77;
  EXPECT_EQ(values[3], 77);
  EXPECT_TRUE(slice(std::as_const(values), {10, 0}).empty());
  EXPECT_EQ(slice(std::as_const(values), {9, 1})[0], 9);
}

TEST(EdgePoints, AreThoseOfTheEdgeAlone) {
  EdgeSet set;
  test::add_edge(set, {{1, 2}, {3, 4}});
  test::add_edge(set, {{5, 6}, {7, 8}, {9, 10}});
  test::add_edge(set, {});
  const EdgePoints points = set.points_of(set.edges[1]);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[2].y, 10);
  std::vector<float> read;
  for (const Point point : points) {
    read.insert(read.end(), {point.x, point.y});
  }
  EXPECT_EQ(read, (std::vector<float>{5, 6, 7, 8, 9, 10}));
  const EdgePoints none = set.points_of(set.edges[2]);
  EXPECT_TRUE(none.begin() == none.end());
}

TEST(EdgePoints, SuitTheAlgorithmsOfTheLibrary) {
  static_assert(std::forward_iterator<EdgePoints::Iterator>);
  EdgeSet set;
  test::add_edge(set, {{4, 1}, {2, 7}, {9, 7}});
  const EdgePoints points = set.points_of(set.edges[0]);
  auto at = points.begin();
  EXPECT_EQ((*at++).x, 4);
  EXPECT_EQ((*at).x, 2);
  const auto lowest = std::ranges::max_element(points.begin(), points.end(), {}, &Point::y);
  EXPECT_EQ((*lowest).x, 2);
  EXPECT_EQ(std::ranges::distance(points.begin(), points.end()), 3);
}

}  // namespace
}  // namespace thermedge
