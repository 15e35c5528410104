// Digital lines, and curves joined end to end.
#include "thermedge/stages/contour_chains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "support/drawing.hpp"

namespace thermedge::detail {
namespace {

using test::contour_set;
using test::pixels_of;
using test::straight;
using Pixels = std::vector<Pixel>;

Pixels line(Pixel from, Pixel to) {
  Pixels points;
  append_line(from, to, points);
  return points;
}

Pixels reversed(Pixels pixels) {
  std::reverse(pixels.begin(), pixels.end());
  return pixels;
}

Pixels joined(const std::vector<Pixels>& parts) {
  Pixels pixels;
  for (const Pixels& part : parts) {
    pixels.insert(pixels.end(), part.begin(), part.end());
  }
  return pixels;
}

ContourSet assembled(const CurveChains& chains, const ContourSet& contours) {
  ContourSet chained;
  CurveChains copy = chains;
  copy.assemble(contours, chained);
  return chained;
}

TEST(AppendLine, IsTheRoundedLineBetweenItsEnds) {
  for (int dy = -9; dy <= 9; ++dy) {
    for (int dx = -9; dx <= 9; ++dx) {
      const Pixel from{20, 30};
      const int steps = std::max(std::abs(dx), std::abs(dy));
      Pixels expected{{-1, -1}};  // what was there stays
      for (int i = 1; i < steps; ++i) {
        const double share = static_cast<double>(i) / steps;
        expected.push_back({from.x + static_cast<int>(std::lround(share * dx)),
                            from.y + static_cast<int>(std::lround(share * dy))});
      }
      Pixels points{{-1, -1}};
      append_line(from, {from.x + dx, from.y + dy}, points);
      EXPECT_EQ(points, expected) << dx << ", " << dy;
    }
  }
}

TEST(AppendLine, IsMirroredAndTransposedWithItsEnds) {
  for (int dy = 0; dy <= 12; ++dy) {
    for (int dx = 0; dx <= 12; ++dx) {
      const Pixels points = line({0, 0}, {dx, dy});
      const Pixels mirrored = line({0, 0}, {-dx, dy});
      const Pixels transposed = line({0, 0}, {dy, dx});
      ASSERT_EQ(mirrored.size(), points.size());
      ASSERT_EQ(transposed.size(), points.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(mirrored[i], (Pixel{-points[i].x, points[i].y}));
        EXPECT_EQ(transposed[i], (Pixel{points[i].y, points[i].x}));
      }
    }
  }
}

TEST(CurveChains, WithoutJoinsTheCurvesStay) {
  ContourSet contours = contour_set({straight({0, 0}, {5, 0}), {{9, 9}}});
  test::add_contour(contours, {{3, 3}, {4, 3}, {4, 4}}, true);
  CurveChains chains;
  chains.reset(contours);
  EXPECT_EQ(chains.ends(), 6);
  for (const int end : {0, 1, 2, 3}) {
    EXPECT_TRUE(chains.is_free(end));
  }
  EXPECT_FALSE(chains.is_free(4) || chains.is_free(5));  // a closed curve has no ends
  const ContourSet chained = assembled(chains, contours);
  ASSERT_EQ(chained.items.size(), 3U);
  EXPECT_EQ(chained.points, contours.points);
  EXPECT_FALSE(chained.items[0].closed || chained.items[1].closed);
  EXPECT_TRUE(chained.items[2].closed);
}

// The earlier curve keeps its direction; the other one goes before or behind it.
TEST(CurveChains, AnyTwoEndsOfTwoCurvesAreJoined) {
  const Pixels a = straight({0, 0}, {6, 0});
  const Pixels b = straight({12, 20}, {30, 20});
  const ContourSet contours = contour_set({a, b});
  for (const std::int32_t end_of_a : {0, 1}) {
    for (const std::int32_t end_of_b : {2, 3}) {
      CurveChains chains;
      chains.reset(contours);
      EXPECT_FALSE(chains.join(end_of_a, end_of_b));
      EXPECT_FALSE(chains.is_free(end_of_a) || chains.is_free(end_of_b));
      EXPECT_TRUE(chains.is_free(other_end(end_of_a)) && chains.is_free(other_end(end_of_b)));
      const bool a_first = end_of_a == 1;
      const Pixels turned_b = a_first == (end_of_b == 2) ? b : reversed(b);
      const Pixels& first = a_first ? a : turned_b;
      const Pixels& second = a_first ? turned_b : a;
      const ContourSet chained = assembled(chains, contours);
      ASSERT_EQ(chained.items.size(), 1U);
      EXPECT_EQ(pixels_of(chained, 0), joined({first, line(first.back(), second.front()), second}));
    }
  }
}

TEST(CurveChains, BeginAsFarAheadOfTheirEarliestCurveAsCurvesAreJoined) {
  const Pixels a = straight({20, 0}, {25, 0});
  const Pixels b = straight({10, 0}, {15, 0});
  const Pixels c = straight({5, 0}, {0, 0});
  const ContourSet contours = contour_set({a, b, c});
  CurveChains chains;
  chains.reset(contours);
  chains.join(0, 3);
  chains.join(4, 2);
  const ContourSet chained = assembled(chains, contours);
  ASSERT_EQ(chained.items.size(), 1U);
  EXPECT_EQ(pixels_of(chained, 0), straight({0, 0}, {25, 0}));
}

TEST(CurveChains, JoiningTheEndsOfAChainClosesIt) {
  const Pixels a = straight({0, 0}, {10, 0});
  const Pixels b = straight({14, 4}, {14, 12});
  const Pixels c = straight({0, 16}, {10, 16});
  const ContourSet contours = contour_set({a, b, c});
  for (const auto& [first, second] : {std::pair{0, 4}, {4, 0}}) {
    CurveChains chains;
    chains.reset(contours);
    EXPECT_FALSE(chains.join(1, 2));
    EXPECT_FALSE(chains.join(3, 5, Pixel{14, 16}));
    EXPECT_TRUE(chains.join(first, second));
    const ContourSet chained = assembled(chains, contours);
    ASSERT_EQ(chained.items.size(), 1U);
    EXPECT_TRUE(chained.items[0].closed);
    EXPECT_EQ(pixels_of(chained, 0),
              joined({a, line({10, 0}, {14, 4}), b, line({14, 12}, {14, 16}), Pixels{{14, 16}},
                      line({14, 16}, {10, 16}), reversed(c), line({0, 16}, {0, 0})}));
  }
}

TEST(CurveChains, AJoinOfTheEndsOfOneCurveMayGoByACorner) {
  const Pixels curve = straight({0, 0}, {8, 0});
  const ContourSet contours = contour_set({curve});
  CurveChains chains;
  chains.reset(contours);
  EXPECT_TRUE(chains.join(0, 1, Pixel{4, 6}));
  const ContourSet chained = assembled(chains, contours);
  EXPECT_TRUE(chained.items[0].closed);
  EXPECT_EQ(pixels_of(chained, 0),
            joined({curve, line({8, 0}, {4, 6}), Pixels{{4, 6}}, line({4, 6}, {0, 0})}));
}

TEST(CurveChains, EndsAreCarriedOnToAPixel) {
  const Pixels a = straight({5, 5}, {9, 5});
  const Pixels b = straight({12, 5}, {15, 5});
  const ContourSet contours = contour_set({a, b});
  CurveChains chains;
  chains.reset(contours);
  chains.join(1, 2);
  chains.extend(0, {1, 4});
  chains.extend(3, {19, 9});
  EXPECT_FALSE(chains.is_free(0) || chains.is_free(3));
  const ContourSet chained = assembled(chains, contours);
  ASSERT_EQ(chained.items.size(), 1U);
  EXPECT_FALSE(chained.items[0].closed);
  EXPECT_EQ(pixels_of(chained, 0),
            joined({Pixels{{1, 4}}, line({1, 4}, {5, 5}), a, line({9, 5}, {12, 5}), b,
                    line({15, 5}, {19, 9}), Pixels{{19, 9}}}));
}

TEST(CurveChains, TellWhichChainACurveBecamePartOf) {
  const ContourSet contours = contour_set(
      {straight({0, 0}, {3, 0}), straight({0, 9}, {3, 9}), straight({9, 0}, {12, 0}), {{7, 7}}});
  CurveChains chains;
  chains.reserve(contours.items.size());
  const std::size_t reserved = chains.memory_bytes();
  for (int run = 0; run < 2; ++run) {
    chains.reset(contours);
    chains.join(1, 4);
    ContourSet chained;
    chains.assemble(contours, chained);
    ASSERT_EQ(chained.items.size(), 3U);
    EXPECT_EQ(chains.chain_of(0), 0);
    EXPECT_EQ(chains.chain_of(1), 1);
    EXPECT_EQ(chains.chain_of(2), 0);
    EXPECT_EQ(chains.chain_of(3), 2);
  }
  EXPECT_EQ(chains.memory_bytes(), reserved);
}

}  // namespace
}  // namespace thermedge::detail
