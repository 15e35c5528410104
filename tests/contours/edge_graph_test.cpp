// Curves from edge pixels by way of segments and junctions.
#include "thermedge/stages/edge_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/drawing.hpp"

namespace thermedge {
namespace {

struct Drawing {
  Drawing(int width, int height) : edges(width, height), response(width, height) {
    fill_pixels(edges.view(), std::uint8_t{0});
    fill_pixels(response.view(), 1.0F);
  }
  void draw(const std::vector<Pixel>& pixels) {
    for (const Pixel pixel : pixels) {
      edges(pixel.x, pixel.y) = 255;
    }
  }
  [[nodiscard]] LinkedContours curves(const GraphOptions& options = {}) const {
    LinkedContours curves;
    GraphTracer tracer(options);
    EXPECT_TRUE(tracer.run(edges, response, curves));
    return curves;
  }
  Image<std::uint8_t> edges;
  Image<float> response;
};

std::vector<Pixel> points_of(const LinkedContours& curves, std::size_t i) {
  const auto pixels = curves.contours.pixels(curves.contours.items[i]);
  return {pixels.begin(), pixels.end()};
}

// The same curve whichever end it begins with.
std::vector<std::pair<int, int>> canonical(const std::vector<Pixel>& points) {
  std::vector<std::pair<int, int>> forward;
  for (const Pixel point : points) {
    forward.emplace_back(point.x, point.y);
  }
  std::vector<std::pair<int, int>> backward(forward.rbegin(), forward.rend());
  return std::min(forward, backward);
}

TEST(GraphTracer, FollowsALine) {
  Drawing drawing(40, 30);
  const auto line = test::polyline({{5, 5}, {15, 15}, {30, 15}});
  drawing.draw(line);
  const LinkedContours curves = drawing.curves();
  ASSERT_EQ(curves.contours.items.size(), 1U);
  EXPECT_FALSE(curves.contours.items[0].closed);
  EXPECT_EQ(canonical(points_of(curves, 0)), canonical(line));
  EXPECT_TRUE(curves.contours.junctions.empty());
}

TEST(GraphTracer, DropsShortCurves) {
  Drawing drawing(40, 30);
  drawing.draw(test::straight({5, 5}, {14, 5}));    // 10
  drawing.draw(test::straight({5, 20}, {15, 20}));  // 11
  GraphOptions options;
  options.min_length_px = 11;
  EXPECT_EQ(drawing.curves(options).contours.items.size(), 1U);
}

TEST(GraphTracer, ClosesARing) {
  Drawing drawing(60, 50);
  drawing.draw(test::polyline({{10, 10}, {40, 10}, {40, 40}, {10, 40}, {10, 10}}));
  const LinkedContours curves = drawing.curves();
  ASSERT_EQ(curves.contours.items.size(), 1U);
  EXPECT_TRUE(curves.contours.items[0].closed);
  // Corners of a square are cut: of three pixels around a corner the outer one goes.
  EXPECT_GE(curves.contours.items[0].points.count, 116U);
}

TEST(GraphTracer, LinesThatCrossGoStraightOn) {
  Drawing drawing(60, 50);
  drawing.draw(test::straight({5, 25}, {55, 25}));
  drawing.draw(test::straight({30, 5}, {30, 45}));
  const LinkedContours curves = drawing.curves();
  ASSERT_EQ(curves.contours.items.size(), 2U);
  std::multiset<std::uint32_t> lengths;
  for (const Contour& contour : curves.contours.items) {
    lengths.insert(contour.points.count);
  }
  EXPECT_NEAR(*lengths.begin(), 41, 1);
  EXPECT_NEAR(*lengths.rbegin(), 51, 1);
  EXPECT_EQ(curves.contours.junctions.size(), 1U);
}

TEST(GraphTracer, ABranchEndsWhereItMeetsALine) {
  Drawing drawing(60, 50);
  drawing.draw(test::straight({5, 25}, {55, 25}));
  drawing.draw(test::straight({30, 26}, {30, 45}));
  const LinkedContours curves = drawing.curves();
  ASSERT_EQ(curves.contours.items.size(), 2U);
  ASSERT_EQ(curves.links.size(), 1U);
  const Link& link = curves.links[0];
  EXPECT_EQ(link.type, LinkType::kEndToMiddle);
  EXPECT_EQ(curves.contours.items[link.b].points.count, 51U);
  EXPECT_LE(squared_distance(link.to, {30, 25}), 2);
}

TEST(GraphTracer, ASharpTurnAtAJunctionIsAnEnd) {
  Drawing drawing(60, 60);
  drawing.draw(test::straight({30, 30}, {30, 5}));
  drawing.draw(test::straight({30, 30}, {10, 50}));
  drawing.draw(test::straight({30, 30}, {50, 50}));  // turns of 45, 45 and 90 degrees
  GraphOptions options;
  options.max_turn_deg = 40;
  EXPECT_EQ(drawing.curves(options).contours.items.size(), 3U);
  options.max_turn_deg = 50;
  EXPECT_EQ(drawing.curves(options).contours.items.size(), 2U);
}

TEST(GraphTracer, ThinsAndKeepsTheStrongerPixels) {
  Drawing drawing(40, 30);
  for (int x = 5; x <= 30; ++x) {
    for (const int y : {10, 11}) {
      drawing.edges(x, y) = 255;
      drawing.response(x, y) = y == 11 ? 2.0F : 1.0F;
    }
  }
  const LinkedContours curves = drawing.curves();
  ASSERT_EQ(curves.contours.items.size(), 1U);
  const auto points = points_of(curves, 0);
  EXPECT_GE(points.size(), 24U);
  EXPECT_TRUE(std::all_of(points.begin(), points.end(), [](Pixel p) { return p.y == 11; }));
}

Drawing random_drawing(unsigned seed) {
  std::mt19937 random(seed);
  Drawing drawing(70, 50);
  std::uniform_real_distribution<float> uniform(0.5F, 2.0F);
  for (int y = 1; y < 49; ++y) {
    for (int x = 1; x < 69; ++x) {
      drawing.edges(x, y) = random() % 100 < 5 + 2 * seed ? 255 : 0;
      drawing.response(x, y) = uniform(random);
    }
  }
  return drawing;
}

GraphOptions short_curves() {
  GraphOptions options;
  options.min_length_px = 3;
  return options;
}

// Pixels are left out where a curve runs through a junction, which is 3 px wide at most.
TEST(GraphTracer, CurvesRunThroughEdgePixelsFromNeighbourToNeighbour) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Drawing drawing = random_drawing(seed);
    const LinkedContours curves = drawing.curves(short_curves());
    ASSERT_GT(curves.contours.items.size(), 5U);
    std::size_t jumps = 0;
    for (std::size_t i = 0; i < curves.contours.items.size(); ++i) {
      const auto points = points_of(curves, i);
      for (std::size_t k = 0; k < points.size(); ++k) {
        ASSERT_EQ(drawing.edges(points[k].x, points[k].y), 255);
        if (k > 0) {
          jumps += squared_distance(points[k], points[k - 1]) > 2 ? 1 : 0;
          ASSERT_LE(squared_distance(points[k], points[k - 1]), 18) << "seed " << seed;
        }
      }
    }
    RecordProperty("jumps_" + std::to_string(seed), static_cast<int>(jumps));
  }
}

// A map turned over: transposed, or mirrored in x or y.
struct Turn {
  [[nodiscard]] Pixel operator()(Pixel at) const {
    const Pixel mirrored{mirror_x ? 69 - at.x : at.x, mirror_y ? 49 - at.y : at.y};
    return transpose ? Pixel{mirrored.y, mirrored.x} : mirrored;
  }
  bool transpose, mirror_x, mirror_y;
};

Drawing turned(const Drawing& drawing, const Turn& turn) {
  Drawing out(turn.transpose ? 50 : 70, turn.transpose ? 70 : 50);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 70; ++x) {
      const Pixel at = turn({x, y});
      out.edges(at.x, at.y) = drawing.edges(x, y);
      out.response(at.x, at.y) = drawing.response(x, y);
    }
  }
  return out;
}

// The same closed curve wherever it begins.
std::vector<std::pair<int, int>> canonical_ring(std::vector<Pixel> points) {
  auto best = canonical(points);
  for (std::size_t i = 1; i < points.size(); ++i) {
    std::rotate(points.begin(), points.begin() + 1, points.end());
    best = std::min(best, canonical(points));
  }
  return best;
}

using Canonical = std::multiset<std::vector<std::pair<int, int>>>;

Canonical canonical_curves(const LinkedContours& curves, const Turn& turn) {
  Canonical all;
  for (std::size_t i = 0; i < curves.contours.items.size(); ++i) {
    auto points = points_of(curves, i);
    std::transform(points.begin(), points.end(), points.begin(), turn);
    const bool closed = curves.contours.items[i].closed;
    all.insert(closed ? canonical_ring(points) : canonical(points));
  }
  return all;
}

Canonical canonical_junctions(const LinkedContours& curves, const Turn& turn) {
  Canonical all;
  for (const Junction& junction : curves.contours.junctions) {
    const Pixel at = turn(junction.at);
    all.insert({{at.x, at.y}});
  }
  return all;
}

// Where curves end on others, and on which.
Canonical canonical_links(const LinkedContours& curves, const Turn& turn) {
  Canonical all;
  for (const Link& link : curves.links) {
    auto points = points_of(curves, link.b);
    std::transform(points.begin(), points.end(), points.begin(), turn);
    const bool closed = curves.contours.items[link.b].closed;
    auto entry = closed ? canonical_ring(points) : canonical(points);
    const Pixel at = turn(link.to);
    entry.emplace_back(at.x, at.y);
    all.insert(entry);
  }
  return all;
}

TEST(GraphTracer, TheTurnedMapGivesTheTurnedCurves) {
  constexpr Turn kAsItIs{false, false, false};
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Drawing drawing = random_drawing(seed);
    const LinkedContours curves = drawing.curves(short_curves());
    ASSERT_GT(curves.contours.items.size(), 5U);
    for (const Turn& turn : {Turn{true, false, false}, Turn{false, true, false},
                             Turn{false, false, true}, Turn{true, true, false}}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (turn.transpose ? ", transposed" : "") +
                   (turn.mirror_x ? ", x" : "") + (turn.mirror_y ? ", y" : ""));
      const LinkedContours other = turned(drawing, turn).curves(short_curves());
      EXPECT_EQ(canonical_curves(curves, turn), canonical_curves(other, kAsItIs));
      EXPECT_EQ(canonical_junctions(curves, turn), canonical_junctions(other, kAsItIs));
      EXPECT_EQ(canonical_links(curves, turn), canonical_links(other, kAsItIs));
    }
  }
}

TEST(GraphTracer, TakesAnySize) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {5, 3}}) {
    Drawing drawing(width, height);
    fill_pixels(drawing.edges.view(), std::uint8_t{255});
    GraphOptions options;
    options.min_length_px = 1;
    EXPECT_GE(drawing.curves(options).contours.items.size(), 1U) << width << " x " << height;
  }
}

TEST(GraphTracer, RefusesSizesThatDifferAndOptionsOutOfRange) {
  LinkedContours curves;
  Image<std::uint8_t> edges(10, 10);
  fill_pixels(edges.view(), std::uint8_t{0});
  Image<float> response(9, 10);
  EXPECT_FALSE(GraphTracer({}).run(edges, response, curves));
  GraphOptions options;
  options.max_turn_deg = 200;
  Image<float> fitting(10, 10);
  const Status status = GraphTracer(options).run(edges, fitting, curves);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("graph.max_turn_deg"), std::string::npos);
}

}  // namespace
}  // namespace thermedge
