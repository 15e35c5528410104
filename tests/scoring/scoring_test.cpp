// Equations 14 to 18, the ranking, the budgets and the edges that come out.
#include "thermedge/stages/scoring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "support/drawing.hpp"

namespace thermedge::test {
namespace {

// Residual of a cubic by normal equations in long double, solved by elimination with complete
// pivoting; what is singular stays 0, which is one of the least-squares solutions.
double slow_residual(const std::vector<Pixel>& points) {
  long double mean = 0;
  for (const Pixel point : points) {
    mean += static_cast<long double>(point.x) / static_cast<long double>(points.size());
  }
  long double scale = 1;
  for (const Pixel point : points) {
    scale = std::max(scale, std::fabs(point.x - mean));
  }
  std::array<std::array<long double, 5>, 4> system{};
  const auto power = [&](Pixel point, int k) {
    return std::pow((point.x - mean) / scale, static_cast<long double>(k));
  };
  for (const Pixel point : points) {
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) {
        system[row][column] += power(point, row) * power(point, column);
      }
      system[row][4] += power(point, row) * point.y;
    }
  }
  std::array<int, 4> order{0, 1, 2, 3};
  std::array<long double, 4> solution{};
  int rank = 0;
  for (; rank < 4; ++rank) {
    int pivot_row = rank;
    int pivot_column = rank;
    for (int row = rank; row < 4; ++row) {
      for (int column = rank; column < 4; ++column) {
        if (std::fabs(system[row][column]) > std::fabs(system[pivot_row][pivot_column])) {
          pivot_row = row;
          pivot_column = column;
        }
      }
    }
    if (std::fabs(system[pivot_row][pivot_column]) < 1e-12L) {
      break;
    }
    std::swap(system[rank], system[pivot_row]);
    for (auto& row : system) {
      std::swap(row[rank], row[pivot_column]);
    }
    std::swap(order[rank], order[pivot_column]);
    for (int row = 0; row < 4; ++row) {
      const long double factor = row == rank ? 0 : system[row][rank] / system[rank][rank];
      for (int column = 0; column < 5; ++column) {
        system[row][column] -= factor * system[rank][column];
      }
    }
  }
  for (int i = 0; i < rank; ++i) {
    solution[order[i]] = system[i][4] / system[i][i];
  }
  long double residual = 0;
  for (const Pixel point : points) {
    long double rest = point.y;
    for (int k = 0; k < 4; ++k) {
      rest -= solution[k] * power(point, k);
    }
    residual += rest * rest;
  }
  return static_cast<double>(residual);
}

TEST(CubicResidual, OfExactCubicsIsZero) {
  for (const int shift : {0, 400, 15000}) {
    std::vector<Pixel> cubic;
    std::vector<Pixel> line;
    std::vector<Pixel> level;
    for (int x = -12; x <= 12; ++x) {
      cubic.push_back({x + shift, x * x * x - 7 * x * x + 3 * x + 100});
      line.push_back({x + shift, 3 * x + 7});
      level.push_back({x + shift, 9});
    }
    EXPECT_EQ(cubic_residual(cubic), 0) << shift;
    EXPECT_EQ(cubic_residual(line), 0) << shift;
    EXPECT_EQ(cubic_residual(level), 0) << shift;
  }
}

TEST(CubicResidual, OfUpToFourAbscissaeWithOnePointEachIsZero) {
  EXPECT_EQ(cubic_residual({}), 0);
  const std::vector<Pixel> points{{0, 5}, {1, -9}, {700, 40}, {3, 2}};
  for (std::size_t count = 1; count <= points.size(); ++count) {
    EXPECT_EQ(cubic_residual(std::span(points).first(count)), 0) << count;
  }
}

// All points on one abscissa: the fit is their mean.
TEST(CubicResidual, OfAVerticalLine) {
  EXPECT_NEAR(cubic_residual(straight({8, 0}, {8, 4})), 10, 1e-12);
  EXPECT_NEAR(cubic_residual(straight({300, 100}, {300, 199})), 83325, 1e-6);  // n (n^2 - 1) / 12
}

// Two abscissae: the mean of each.
TEST(CubicResidual, OfTwoColumns) {
  const std::vector<Pixel> points{{3, 0}, {3, 2}, {5, 10}, {5, 11}, {5, 12}};
  EXPECT_NEAR(cubic_residual(points), 2 + 2, 1e-12);
}

// The fourth difference of five equidistant points over its norm: 1 / sqrt(70) each unit.
TEST(CubicResidual, OfFivePointsByHand) {
  EXPECT_NEAR(cubic_residual(std::vector<Pixel>{{0, 0}, {1, 0}, {2, 1}, {3, 0}, {4, 0}}), 36.0 / 70,
              1e-12);
}

TEST(CubicResidual, IsThatOfTheNormalEquations) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 400; ++trial) {
    std::uniform_int_distribution<int> range(0, 1 + trial % 60);
    std::uniform_int_distribution<int> y(0, 300);
    const int shift = trial % 5 * 2000;
    std::vector<Pixel> points;
    for (int i = 0; i < 3 + trial % 80; ++i) {
      points.push_back({shift + range(random), y(random)});
    }
    const double expected = slow_residual(points);
    EXPECT_NEAR(cubic_residual(points), expected, 1e-7 * (1 + expected)) << "trial " << trial;
  }
}

TEST(CubicResidual, IgnoresWhereThePointsAre) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> y(0, 40);
  std::vector<Pixel> here;
  std::vector<Pixel> there;
  for (int x = 0; x < 50; ++x) {
    here.push_back({x, y(random)});
    there.push_back({16000 - x, 16000 - here.back().y});
  }
  EXPECT_NEAR(cubic_residual(here), cubic_residual(there), 1e-6);
}

TEST(EdgeScore, ByHand) {
  EdgeScoreTerms terms;
  terms.average_residual = 0.5;
  terms.width = 382;
  terms.height = 288;
  terms.points = 100;
  terms.corners = 4;
  terms.connected_points = 250;
  terms.loop_line_ratio = 2;
  // 0.5 * 382 * 288 * 16 / (10000 * 250 * 2)
  EXPECT_NEAR(edge_score(terms), 0.1760256, 1e-12);
  terms.loop_line_ratio = 1;
  EXPECT_NEAR(edge_score(terms), 0.3520512, 1e-12);
  terms.average_residual = 0;
  EXPECT_EQ(edge_score(terms), 0);
}

// A frame with hand-made curves, corners and links.
struct Frame {
  LinkedContours linked;
  CornerSet corners;

  void add(const std::vector<Pixel>& pixels, const std::vector<std::uint32_t>& indices = {},
           bool closed = false) {
    add_contour(linked.contours, pixels, closed);
    corners.ranges.push_back({static_cast<std::uint32_t>(corners.indices.size()),
                              static_cast<std::uint32_t>(indices.size())});
    corners.indices.insert(corners.indices.end(), indices.begin(), indices.end());
  }
  void connect(std::uint32_t a, std::uint32_t b) {
    linked.links.push_back({LinkType::kEndToMiddle, a, b, {}, {}});
  }
};

EdgeSet score(const Frame& frame, const ScoringOptions& options = {}) {
  EdgeSet edges;
  const Status status = Scorer(options).run(frame.linked, frame.corners, 382, 288, edges);
  EXPECT_TRUE(status) << status.error().message;
  return edges;
}

// The point in which the edgels of an edge begin tells which curve it was.
Pixel start_of(const EdgeSet& edges, std::size_t rank) {
  const std::size_t first = edges.edges[rank].edgels.first;
  return {static_cast<int>(edges.edgels.x[first]), static_cast<int>(edges.edgels.y[first])};
}

// A zigzag that no cubic fits; `length` points.
std::vector<Pixel> zigzag(Pixel from, int length) {
  std::vector<Pixel> pixels;
  for (int i = 0; i < length; ++i) {
    pixels.push_back({from.x + i, from.y + i % 2});
  }
  return pixels;
}

TEST(Scorer, FitsFromCornerToCorner) {
  const auto shape = polyline({{20, 20}, {20, 50}, {60, 50}});  // 30 down, 40 to the right
  Frame frame;
  frame.add(shape, {30});
  const EdgeSet edges = score(frame);
  ASSERT_EQ(edges.edges.size(), 1U);
  // The vertical part has 31 points on one abscissa: 31 * (31^2 - 1) / 12 = 2480; the other one 0.
  const double expected = 2480.0 / 71 * 382 * 288 * 9 / (71.0 * 71 * 71);
  EXPECT_NEAR(edges.edges[0].es, expected, 1e-9 * expected);
  EXPECT_EQ(edges.edges[0].score, -edges.edges[0].es);
}

TEST(Scorer, EndsCountAsCornersOnce) {
  const auto shape = polyline({{20, 20}, {20, 50}, {60, 50}});
  Frame without;
  without.add(shape, {30});
  Frame with;
  with.add(shape, {0, 30, 70});
  EXPECT_EQ(score(without).edges[0].es, score(with).edges[0].es);
  EXPECT_EQ(score(without).corners, (std::vector<std::uint32_t>{30}));
  EXPECT_EQ(score(with).corners, (std::vector<std::uint32_t>{0, 30, 70}));
}

TEST(Scorer, LoopsAreDividedByTheirRatio) {
  const auto shape = polyline({{20, 20}, {20, 40}, {40, 40}, {40, 20}, {21, 20}});
  Frame open;
  open.add(shape, {20, 40, 60});
  Frame closed;
  closed.add(shape, {20, 40, 60}, true);
  EXPECT_NEAR(score(open).edges[0].es / score(closed).edges[0].es, 2, 1e-12);
  ScoringOptions options;
  options.loop_line_ratio = 5;
  EXPECT_NEAR(score(open).edges[0].es / score(closed, options).edges[0].es, 5, 1e-12);
}

TEST(Scorer, ConnectedPointsCountOnceForEachEdge) {
  Frame frame;
  frame.add(zigzag({10, 10}, 50));
  frame.add(zigzag({10, 30}, 30));
  const double alone = score(frame).edges[0].es;
  frame.connect(1, 0);
  frame.connect(1, 0);  // both ends of the second curve
  const EdgeSet edges = score(frame);
  EXPECT_NEAR(edges.edges[0].es, alone * 50 / 80, 1e-12 * alone);
}

TEST(Scorer, TheBestComeFirst) {
  Frame frame;
  frame.add(zigzag({10, 10}, 20));
  frame.add(zigzag({10, 20}, 60));
  frame.add(straight({10, 30}, {30, 30}));
  frame.add(zigzag({10, 40}, 40));
  const EdgeSet edges = score(frame);
  ASSERT_EQ(edges.edges.size(), 4U);
  EXPECT_EQ(start_of(edges, 0), (Pixel{10, 30}));
  EXPECT_EQ(start_of(edges, 1), (Pixel{10, 20}));
  EXPECT_EQ(start_of(edges, 2), (Pixel{10, 40}));
  EXPECT_EQ(start_of(edges, 3), (Pixel{10, 10}));
  for (std::size_t rank = 0; rank < 4; ++rank) {
    EXPECT_EQ(edges.edges[rank].rank, static_cast<int>(rank));
    EXPECT_EQ(edges.edges[rank].index, static_cast<int>(rank));
  }
}

TEST(Scorer, TiesGoToTheLongerThenTheEarlierCurve) {
  Frame frame;
  frame.add(straight({10, 10}, {30, 10}));
  frame.add(straight({10, 20}, {40, 20}));
  frame.add(straight({10, 30}, {40, 30}));
  frame.add(straight({10, 40}, {20, 50}));
  const EdgeSet edges = score(frame);
  EXPECT_EQ(start_of(edges, 0), (Pixel{10, 20}));
  EXPECT_EQ(start_of(edges, 1), (Pixel{10, 30}));
  EXPECT_EQ(start_of(edges, 2), (Pixel{10, 10}));
  EXPECT_EQ(start_of(edges, 3), (Pixel{10, 40}));
}

TEST(Scorer, ProminentAndLongEdgesComeFirstWhereProminenceIsGiven) {
  Frame frame;
  frame.add(straight({10, 10}, {49, 10}));
  frame.add(straight({10, 20}, {49, 20}));
  frame.add(straight({10, 30}, {29, 30}));
  Image<float> suppressed_response(382, 288);
  fill_pixels(suppressed_response.view(), 0.0F);
  for (int x = 0; x < suppressed_response.width(); ++x) {
    suppressed_response(x, 10) = 2;
    suppressed_response(x, 20) = 6;
    suppressed_response(x, 30) = 2;
  }
  EdgeSet edges;
  ASSERT_TRUE(Scorer({}).run(frame.linked, frame.corners, suppressed_response, edges));
  ASSERT_EQ(edges.edges.size(), 3U);
  EXPECT_EQ(start_of(edges, 0), (Pixel{10, 20}));
  EXPECT_EQ(start_of(edges, 1), (Pixel{10, 10}));
  EXPECT_EQ(start_of(edges, 2), (Pixel{10, 30}));
  EXPECT_NEAR(edges.edges[0].score, std::log(6.0) + 0.25 * std::log(40.0), 1e-9);
  EXPECT_NEAR(edges.edges[2].score, std::log(2.0) + 0.25 * std::log(20.0), 1e-9);
  EXPECT_NEAR(edges.edges[0].es, 0, 1e-9);  // still told
}

// A bridge has no suppressed_response of its own; it makes an edge longer, not weaker.
TEST(Scorer, PixelsWithoutProminenceCountForTheLengthOnly) {
  Image<float> suppressed_response(60, 20);
  fill_pixels(suppressed_response.view(), 0.0F);
  for (int x = 0; x < 20; ++x) {
    suppressed_response(x, 10) = 3;
  }
  const auto pixels = straight({10, 10}, {29, 10});  // the first half has one
  EXPECT_NEAR(saliency(pixels, suppressed_response), std::log(3.0) + 0.25 * std::log(20.0), 1e-9);
  fill_pixels(suppressed_response.view(), 0.0F);
  EXPECT_TRUE(std::isfinite(saliency(pixels, suppressed_response)));
}

TEST(Saliency, TuningWeighsTheLength) {
  Image<float> suppressed_response(50, 30);
  fill_pixels(suppressed_response.view(), 3.0F);
  const auto pixels = straight({10, 10}, {29, 10});
  EXPECT_NEAR(saliency(pixels, suppressed_response, {.length_weight = 0.5}),
              std::log(3.0) + 0.5 * std::log(20.0), 1e-9);
  EXPECT_NEAR(saliency(pixels, suppressed_response, {.least_mean = 5, .length_weight = 0}),
              std::log(5.0), 1e-9);
}

TEST(Scorer, StrengthFallsWithTheRank) {
  Frame frame;
  for (int i = 0; i < 5; ++i) {
    frame.add(straight({10, 10 * i + 10}, {40, 10 * i + 10}));
  }
  const EdgeSet by_es = score(frame);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(by_es.edges[i].display_strength, 1 - static_cast<double>(i) / 4);
  }
  Image<float> suppressed_response(382, 288);
  fill_pixels(suppressed_response.view(), 0.0F);
  for (int i = 0; i < 5; ++i) {
    std::fill_n(suppressed_response.row(10 * i + 10), suppressed_response.width(),
                static_cast<float>(i + 1));
  }
  EdgeSet by_saliency;
  ASSERT_TRUE(Scorer({}).run(frame.linked, frame.corners, suppressed_response, by_saliency));
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_LT(by_saliency.edges[i].display_strength, by_saliency.edges[i - 1].display_strength);
  }
  EXPECT_LT(by_saliency.edges[0].display_strength, 1) << "a stronger one may come in another frame";
}

TEST(Scorer, EdgelsFollowTheCurve) {
  const auto open = polyline({{20, 20}, {20, 30}, {40, 30}});
  const auto loop = polyline({{60, 60}, {70, 60}, {70, 70}, {60, 70}, {60, 61}});
  Frame frame;
  frame.add(open, {10});
  frame.add(loop, {10, 20}, true);
  const EdgeSet edges = score(frame);
  ASSERT_EQ(edges.edgels.size(), open.size() + loop.size());
  for (const Edge& edge : edges.edges) {
    const auto& pixels = edge.closed ? loop : open;
    ASSERT_EQ(edge.edgels.count, pixels.size());
    const int first = static_cast<int>(edge.edgels.first);
    const int last = first + static_cast<int>(pixels.size()) - 1;
    for (int i = first; i <= last; ++i) {
      EXPECT_EQ(edges.edgels.x[i], static_cast<float>(pixels[i - first].x));
      EXPECT_EQ(edges.edgels.y[i], static_cast<float>(pixels[i - first].y));
      EXPECT_EQ(edges.edgels.edge[i], edge.rank);
      EXPECT_EQ(edges.edgels.previous[i], i > first ? i - 1 : edge.closed ? last : -1);
      EXPECT_EQ(edges.edgels.next[i], i < last ? i + 1 : edge.closed ? first : -1);
      EXPECT_EQ(edges.edgels.nx[i], 0);
      EXPECT_EQ(edges.edgels.magnitude_counts[i], 0);
    }
    EXPECT_EQ(edges.corners_of(edge).size(), edge.closed ? 2U : 1U);
    EXPECT_EQ(edges.corners_of(edge)[0], 10U);
  }
}

TEST(Scorer, LengthAndBox) {
  Frame frame;
  frame.add(polyline({{20, 20}, {30, 30}, {50, 30}}));  // 10 diagonal steps and 20 straight ones
  frame.add({{60, 60}, {61, 60}, {61, 61}, {60, 61}}, {}, true);
  const EdgeSet edges = score(frame);
  const Edge& loop = edges.edges[edges.edges[0].closed ? 0 : 1];
  const Edge& line = edges.edges[edges.edges[0].closed ? 1 : 0];
  EXPECT_NEAR(line.length_px, 20 + 10 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(loop.length_px, 4);
  EXPECT_EQ(line.box.x_min, 20);
  EXPECT_EQ(line.box.x_max, 50);
  EXPECT_EQ(line.box.y_min, 20);
  EXPECT_EQ(line.box.y_max, 30);
}

// Ids of connections are ranks, not the numbers of the contours.
TEST(Scorer, ConnectionsAreMutualDistinctAndAscending) {
  Frame frame;
  for (const int length : {10, 20, 30, 40}) {  // ranks 3, 2, 1, 0
    frame.add(straight({10, length}, {9 + length, length}));
  }
  frame.connect(0, 3);
  frame.connect(3, 0);
  frame.connect(1, 3);
  frame.connect(2, 3);
  frame.linked.links.push_back({LinkType::kEndToEnd, 1, 1, {}, {}});
  frame.linked.contours.junctions = {{{3, 4}}, {{5, 6}}};
  const EdgeSet edges = score(frame);
  const auto of = [&](std::size_t rank) {
    const auto ids = edges.connections_of(edges.edges[rank]);
    return std::vector<std::int32_t>(ids.begin(), ids.end());
  };
  EXPECT_EQ(of(0), (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_EQ(of(1), (std::vector<std::int32_t>{0}));
  EXPECT_EQ(of(2), (std::vector<std::int32_t>{0}));
  EXPECT_EQ(of(3), (std::vector<std::int32_t>{0}));
  ASSERT_EQ(edges.junctions.size(), 2U);
  EXPECT_EQ(edges.junctions[1].at, (Pixel{5, 6}));
}

TEST(Scorer, ASinglePoint) {
  Frame frame;
  frame.add({{7, 8}});
  frame.add({{9, 8}}, {0}, true);
  const EdgeSet edges = score(frame);
  ASSERT_EQ(edges.edges.size(), 2U);
  EXPECT_EQ(edges.edges[0].es, 0);
  EXPECT_EQ(edges.edges[0].length_px, 0);
  EXPECT_EQ(edges.edgels.next[0], -1);
}

TEST(Scorer, RemembersNothing) {
  Frame frame;
  frame.add(zigzag({10, 10}, 20), {5});
  frame.add(zigzag({10, 20}, 60));
  frame.connect(0, 1);
  Scorer scorer{ScoringOptions{}};
  EdgeSet edges;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(scorer.run(frame.linked, frame.corners, 382, 288, edges));
    EXPECT_EQ(edges.edgels.size(), 80U);
    EXPECT_EQ(edges.connections.size(), 2U);
    EXPECT_EQ(edges.corners.size(), 1U);
  }
  ASSERT_TRUE(scorer.run({}, {}, 382, 288, edges));
  EXPECT_TRUE(edges.edges.empty());
  EXPECT_EQ(edges.kept, 0U);
}

TEST(Scorer, NamesTheOptionThatIsOutOfRange) {
  ScoringOptions options;
  options.loop_line_ratio = 0;
  EdgeSet edges;
  const Status status = Scorer(options).run({}, {}, 382, 288, edges);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("scoring.loop_line_ratio"), std::string::npos);
}

}  // namespace
}  // namespace thermedge::test
