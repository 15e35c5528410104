// Algorithm 5: the three types of links, their order, bridges, and chains of curves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "support/drawing.hpp"
#include "thermedge/stages/linking.hpp"

namespace thermedge::test {
namespace {

constexpr int kWidth = 100;
constexpr int kHeight = 80;

LinkedContours link(const ContourSet& contours, double gap_px = 3) {
  LinkedContours linked;
  const Status status = Linker({gap_px}).run(contours, kWidth, kHeight, linked);
  EXPECT_TRUE(status) << status.error().message;
  return linked;
}

std::vector<Pixel> joined(const std::vector<std::vector<Pixel>>& parts) {
  std::vector<Pixel> pixels;
  for (const auto& part : parts) {
    pixels.insert(pixels.end(), part.begin(), part.end());
  }
  return pixels;
}

std::vector<Pixel> reversed(std::vector<Pixel> pixels) {
  std::reverse(pixels.begin(), pixels.end());
  return pixels;
}

void expect_link(const Link& found, LinkType type, std::uint32_t a, std::uint32_t b, Pixel from,
                 Pixel to) {
  EXPECT_EQ(found.type, type);
  EXPECT_EQ(found.a, a);
  EXPECT_EQ(found.b, b);
  EXPECT_EQ(found.from, from);
  EXPECT_EQ(found.to, to);
}

TEST(Linker, EndToEndInsertsTheBridge) {
  const auto left = straight({10, 10}, {30, 10});
  const auto right = straight({32, 11}, {50, 11});
  const LinkedContours linked = link(contour_set({left, right}));
  ASSERT_EQ(linked.contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(linked.contours, 0), joined({left, {{31, 11}}, right}));
  EXPECT_FALSE(linked.contours.items[0].closed);
  ASSERT_EQ(linked.links.size(), 1U);
  expect_link(linked.links[0], LinkType::kEndToEnd, 0, 0, {30, 10}, {32, 11});
  EXPECT_TRUE(linked.contours.junctions.empty());
}

TEST(Linker, NeighboursNeedNoBridge) {
  const auto left = straight({10, 10}, {30, 10});
  const auto right = straight({31, 11}, {50, 11});
  EXPECT_EQ(pixels_of(link(contour_set({left, right})).contours, 0), joined({left, right}));
}

// The first curve keeps its direction whichever of the ends meet.
TEST(Linker, AllFourPairsOfEnds) {
  const auto left = straight({10, 10}, {30, 10});
  const auto right = straight({32, 10}, {50, 10});
  const std::vector<Pixel> bridge{{31, 10}};
  const auto along = joined({left, bridge, right});
  EXPECT_EQ(pixels_of(link(contour_set({left, reversed(right)})).contours, 0), along);
  EXPECT_EQ(pixels_of(link(contour_set({reversed(left), right})).contours, 0), reversed(along));
  EXPECT_EQ(pixels_of(link(contour_set({reversed(left), reversed(right)})).contours, 0),
            reversed(along));
  EXPECT_EQ(pixels_of(link(contour_set({right, left})).contours, 0), along);
}

TEST(Linker, TheGapIsStrict) {
  const auto left = straight({10, 10}, {30, 10});
  const auto at = [&](Pixel start) {
    return link(contour_set({left, straight(start, {start.x + 20, start.y})})).links.size();
  };
  EXPECT_EQ(at({32, 12}), 1U);  // sqrt(8)
  EXPECT_EQ(at({33, 10}), 0U);  // 3
  EXPECT_EQ(at({33, 11}), 0U);
  const auto touching = contour_set({left, straight({31, 11}, {50, 11})});  // sqrt(2)
  EXPECT_EQ(link(touching, std::sqrt(2.0) - 1e-9).links.size(), 0U);
  EXPECT_EQ(link(touching, std::sqrt(2.0) + 1e-9).links.size(), 1U);
}

TEST(Linker, BridgesAreLines) {
  for (int dy = -9; dy <= 9; ++dy) {
    for (int dx = 1; dx <= 9; ++dx) {
      const auto left = straight({20, 30}, {40, 30});
      const auto right = straight({40 + dx, 30 + dy}, {60 + dx, 30 + dy});
      const LinkedContours linked = link(contour_set({left, right}), 14);
      ASSERT_EQ(linked.contours.items.size(), 1U);
      const auto pixels = pixels_of(linked.contours, 0);
      const int bridge = std::max(dx, std::abs(dy)) - 1;
      ASSERT_EQ(pixels.size(), left.size() + right.size() + static_cast<std::size_t>(bridge));
      for (std::size_t i = left.size(); i < left.size() + static_cast<std::size_t>(bridge); ++i) {
        const int chebyshev = std::max(std::abs(pixels[i].x - pixels[i - 1].x),
                                       std::abs(pixels[i].y - pixels[i - 1].y));
        ASSERT_EQ(chebyshev, 1);
        // Half a pixel at most beside the straight line, along the shorter axis.
        const int cross = (pixels[i].x - 40) * dy - (pixels[i].y - 30) * dx;
        ASSERT_LE(2 * std::abs(cross), std::max(dx, std::abs(dy)));
      }
    }
  }
}

TEST(Linker, TheEndsOfOneCurveCloseIt) {
  const auto shape = polyline({{10, 10}, {30, 10}, {30, 30}, {10, 30}, {10, 12}});
  const LinkedContours linked = link(contour_set({shape}));
  ASSERT_EQ(linked.contours.items.size(), 1U);
  EXPECT_TRUE(linked.contours.items[0].closed);
  EXPECT_EQ(pixels_of(linked.contours, 0), joined({shape, {{10, 11}}}));
  ASSERT_EQ(linked.links.size(), 1U);
  expect_link(linked.links[0], LinkType::kLoop, 0, 0, {10, 10}, {10, 12});
}

TEST(Linker, AChainOfCurvesThatComesBackIsALoop) {
  const auto top = straight({30, 10}, {50, 10});
  const auto right = straight({52, 12}, {52, 30});
  const auto bottom = straight({30, 32}, {50, 32});
  const auto left = straight({28, 30}, {28, 13});
  const LinkedContours linked = link(contour_set({top, right, bottom, left}), 4);
  ASSERT_EQ(linked.contours.items.size(), 1U);
  EXPECT_TRUE(linked.contours.items[0].closed);
  ASSERT_EQ(linked.links.size(), 4U);
  // sqrt(8) three times, by index of the first end; then sqrt(13) between `top` and `left`.
  expect_link(linked.links[0], LinkType::kEndToEnd, 0, 0, {50, 10}, {52, 12});
  expect_link(linked.links[1], LinkType::kEndToEnd, 0, 0, {52, 30}, {50, 32});
  expect_link(linked.links[2], LinkType::kEndToEnd, 0, 0, {30, 32}, {28, 30});
  expect_link(linked.links[3], LinkType::kLoop, 0, 0, {30, 10}, {28, 13});
  const auto pixels = pixels_of(linked.contours, 0);
  EXPECT_EQ(pixels, joined({top,
                            {{51, 11}},
                            right,
                            {{51, 31}},
                            reversed(bottom),
                            {{29, 31}},
                            left,
                            {{29, 12}, {29, 11}}}));
}

TEST(Linker, AChainBeginsBeforeItsEarliestCurve) {
  const auto first = straight({40, 10}, {50, 10});
  const auto before = straight({38, 10}, {20, 10});
  const auto behind = straight({52, 10}, {70, 10});
  const LinkedContours linked = link(contour_set({first, before, behind}));
  ASSERT_EQ(linked.contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(linked.contours, 0),
            joined({reversed(before), {{39, 10}}, first, {{51, 10}}, behind}));
}

TEST(Linker, TheNearestPairComesFirst) {
  const auto left = straight({10, 10}, {30, 10});
  const auto farther = straight({30, 13}, {30, 40});
  const auto nearer = straight({32, 10}, {50, 10});
  const LinkedContours linked = link(contour_set({left, farther, nearer}), 3.5);
  ASSERT_EQ(linked.contours.items.size(), 2U);
  ASSERT_EQ(linked.links.size(), 2U);
  expect_link(linked.links[0], LinkType::kEndToEnd, 0, 0, {30, 10}, {32, 10});
  // The end that came too late touches the joined curve.
  expect_link(linked.links[1], LinkType::kEndToMiddle, 1, 0, {30, 13}, {30, 10});
  EXPECT_EQ(linked.contours.junctions.size(), 1U);
}

TEST(Linker, TiesGoToTheEarlierEnd) {
  const auto left = straight({10, 10}, {30, 10});
  const auto up = straight({30, 8}, {30, 0});
  const auto down = straight({30, 12}, {30, 40});
  EXPECT_EQ(link(contour_set({left, up, down})).links[0].to, (Pixel{30, 8}));
  EXPECT_EQ(link(contour_set({left, down, up})).links[0].to, (Pixel{30, 12}));
}

TEST(Linker, AnEndAtTheMiddleIsAConnection) {
  const auto bar = straight({10, 10}, {50, 10});
  const auto stem = straight({30, 12}, {30, 40});
  const LinkedContours linked = link(contour_set({bar, stem}));
  EXPECT_EQ(pixels_of(linked.contours, 0), bar);
  EXPECT_EQ(pixels_of(linked.contours, 1), stem);
  ASSERT_EQ(linked.links.size(), 1U);
  expect_link(linked.links[0], LinkType::kEndToMiddle, 1, 0, {30, 12}, {30, 10});
  ASSERT_EQ(linked.contours.junctions.size(), 1U);
  EXPECT_EQ(linked.contours.junctions[0].at, (Pixel{30, 12}));
}

// Two pixels of the bar are equally far: the one in the smaller column is taken.
TEST(Linker, TheNearestPixelOfTheMiddle) {
  const auto bar = polyline({{10, 30}, {20, 20}, {30, 30}});
  const auto stem = straight({20, 22}, {20, 40});
  const LinkedContours linked = link(contour_set({bar, stem}));
  ASSERT_EQ(linked.links.size(), 1U);
  EXPECT_EQ(linked.links[0].to, (Pixel{19, 21}));
}

TEST(Linker, ClosedCurvesTakeNoPartWithTheirEndsButAreTouched) {
  ContourSet contours;
  add_contour(contours, polyline({{20, 20}, {40, 20}, {40, 40}, {20, 40}, {20, 21}}), true);
  add_contour(contours, straight({5, 20}, {18, 20}));
  const LinkedContours linked = link(contours);
  ASSERT_EQ(linked.contours.items.size(), 2U);
  EXPECT_TRUE(linked.contours.items[0].closed);
  EXPECT_FALSE(linked.contours.items[1].closed);
  ASSERT_EQ(linked.links.size(), 1U);
  expect_link(linked.links[0], LinkType::kEndToMiddle, 1, 0, {18, 20}, {20, 20});
}

// The bridge between `left` and `right` runs over a pixel of `post`.
TEST(Linker, APixelUnderABridgeStaysWithItsCurve) {
  const auto left = straight({10, 10}, {30, 10});
  const auto right = straight({34, 10}, {50, 10});
  const auto post = straight({32, 10}, {32, 40});
  const auto above = straight({32, 6}, {32, 0});
  ContourSet contours;
  add_contour(contours, post, true);  // takes no part with its ends
  for (const auto& pixels : {left, right, above}) {
    add_contour(contours, pixels);
  }
  const LinkedContours linked = link(contours, 4.2);
  ASSERT_EQ(linked.links.size(), 2U);
  expect_link(linked.links[0], LinkType::kEndToEnd, 1, 1, {30, 10}, {34, 10});
  expect_link(linked.links[1], LinkType::kEndToMiddle, 2, 0, {32, 6}, {32, 10});
}

TEST(Linker, AnEndBesideItsOwnCurveIsNoLink) {
  const auto hook = polyline({{10, 10}, {40, 10}, {40, 20}, {30, 20}, {30, 12}});
  EXPECT_TRUE(link(contour_set({hook})).links.empty());
}

TEST(Linker, ZeroGapPassesEverythingThrough) {
  ContourSet contours = contour_set({straight({10, 10}, {30, 10}), straight({31, 10}, {50, 10})});
  add_contour(contours, polyline({{20, 20}, {40, 20}, {40, 40}, {20, 40}, {20, 21}}), true);
  contours.junctions.push_back({{30, 10}});
  const LinkedContours linked = link(contours, 0);
  EXPECT_TRUE(linked.links.empty());
  EXPECT_EQ(linked.contours.points, contours.points);
  ASSERT_EQ(linked.contours.items.size(), contours.items.size());
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    EXPECT_EQ(linked.contours.items[i].points, contours.items[i].points);
    EXPECT_EQ(linked.contours.items[i].closed, contours.items[i].closed);
  }
  ASSERT_EQ(linked.contours.junctions.size(), 1U);
  EXPECT_EQ(linked.contours.junctions[0].at, (Pixel{30, 10}));
}

TEST(Linker, EndsAtTheBordersOfTheFrame) {
  const auto corner = contour_set({straight({0, 0}, {0, kHeight - 1}), straight({2, 0}, {2, 50})});
  EXPECT_EQ(link(corner, 32).links.size(), 2U);
}

// The text of the paper, in the plainest words: a list of all pairs, sorted.
std::vector<std::pair<Pixel, Pixel>> slow_joins(const ContourSet& contours, double gap_px) {
  std::vector<Pixel> ends;
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    ends.push_back(pixels_of(contours, i).front());
    ends.push_back(pixels_of(contours, i).back());
  }
  std::vector<std::tuple<std::int64_t, std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < ends.size(); ++a) {
    for (std::size_t b = a + 1; b < ends.size(); ++b) {
      const std::int64_t squared = squared_distance(ends[a], ends[b]);
      if (std::sqrt(static_cast<double>(squared)) < gap_px) {
        pairs.emplace_back(squared, a, b);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> used(ends.size(), false);
  std::vector<std::pair<Pixel, Pixel>> joins;
  for (const auto& [squared, a, b] : pairs) {
    if (!used[a] && !used[b]) {
      used[a] = used[b] = true;
      joins.emplace_back(ends[a], ends[b]);
    }
  }
  return joins;
}

// Many short curves at random, whose ends share pixels now and then.
ContourSet random_curves(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> x(0, kWidth - 8);
  std::uniform_int_distribution<int> y(0, kHeight - 8);
  std::uniform_int_distribution<int> length(0, 7);
  std::uniform_int_distribution<int> way(0, 2);
  std::vector<std::vector<Pixel>> curves;
  for (int i = 0; i < 150; ++i) {
    const Pixel from{x(random), y(random)};
    const int steps = length(random);
    const int direction = way(random);
    curves.push_back(straight(
        from, {from.x + (direction != 0 ? steps : 0), from.y + (direction != 1 ? steps : 0)}));
  }
  return contour_set(curves);
}

TEST(Linker, JoinsLikeTheReference) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const ContourSet contours = random_curves(seed);
    for (const double gap_px : {1.0, 2.9, 3.0, 5.0, 12.5}) {
      std::vector<std::pair<Pixel, Pixel>> joins;
      for (const Link& made : link(contours, gap_px).links) {
        if (made.type != LinkType::kEndToMiddle) {
          joins.emplace_back(made.from, made.to);
        }
      }
      ASSERT_EQ(joins, slow_joins(contours, gap_px)) << "seed " << seed << ", gap " << gap_px;
    }
  }
}

// Each join takes one curve away but for those that close one; every curve is used once.
TEST(Linker, CountsAddUp) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const ContourSet contours = random_curves(seed);
    const LinkedContours linked = link(contours, 5);
    std::map<LinkType, std::size_t> links;
    for (const Link& made : linked.links) {
      ++links[made.type];
      ASSERT_LT(made.a, linked.contours.items.size());
      ASSERT_LT(made.b, linked.contours.items.size());
      EXPECT_EQ(made.a != made.b, made.type == LinkType::kEndToMiddle);
    }
    EXPECT_EQ(linked.contours.items.size(), contours.items.size() - links[LinkType::kEndToEnd]);
    const auto closed = std::count_if(linked.contours.items.begin(), linked.contours.items.end(),
                                      [](const Contour& contour) { return contour.closed; });
    EXPECT_EQ(static_cast<std::size_t>(closed), links[LinkType::kLoop]);
    EXPECT_EQ(linked.contours.junctions.size(), links[LinkType::kEndToMiddle]);
    EXPECT_GE(linked.contours.points.size(), contours.points.size());
  }
}

TEST(Linker, RemembersNothing) {
  Linker linker({3});
  LinkedContours linked;
  ASSERT_TRUE(linker.run(random_curves(1), kWidth, kHeight, linked));
  const auto expected = linked.contours.points;
  ASSERT_TRUE(linker.run(random_curves(2), kWidth, kHeight, linked));
  ASSERT_TRUE(linker.run(random_curves(1), kWidth, kHeight, linked));
  EXPECT_EQ(linked.contours.points, expected);
  ASSERT_TRUE(linker.run({}, kWidth, kHeight, linked));
  EXPECT_TRUE(linked.contours.items.empty());
  EXPECT_TRUE(linked.links.empty());
}

TEST(Linker, NamesTheOptionThatIsOutOfRange) {
  for (const double gap_px : {-1.0, 32.5, std::numeric_limits<double>::quiet_NaN()}) {
    LinkedContours linked;
    const Status status = Linker({gap_px}).run({}, kWidth, kHeight, linked);
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find("linking.gap_px"), std::string::npos);
  }
}

}  // namespace
}  // namespace thermedge::test
