// ODS, OIS, AP, figure of merit and structure on cases that can be done by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "support/images.hpp"
#include "thermedge/eval/scores.hpp"
#include "thermedge/eval/structure.hpp"

namespace thermedge::eval {
namespace {

using Map = Image<std::uint8_t>;

// '#' or a digit 1..9 (times 25): set.
Map map_of(const std::vector<std::string>& rows) {
  Map map(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const char c = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      map(x, y) = c == '#'               ? 255
                  : c >= '1' && c <= '9' ? static_cast<std::uint8_t>(25 * (c - '0'))
                                         : 0;
    }
  }
  return map;
}

TruthMaps truth_of(const std::vector<std::string>& rows) {
  TruthMaps truth;
  truth.annotators.push_back(map_of(rows));
  return truth;
}

TEST(Thresholds, AreSpreadWithoutTheEnds) {
  EXPECT_EQ(spread_thresholds(1), std::vector<int>{128});
  EXPECT_EQ(spread_thresholds(3), (std::vector<int>{64, 128, 192}));
  const auto usual = spread_thresholds(99);
  ASSERT_EQ(usual.size(), 99U);
  EXPECT_EQ(usual.front(), 3);
  EXPECT_EQ(usual[49], 128);
  EXPECT_EQ(usual.back(), 253);
  const auto most = spread_thresholds(254);
  EXPECT_EQ(most.size(), 254U);
  EXPECT_EQ(most.front(), 1);
  EXPECT_EQ(most.back(), 254);
}

TEST(Scores, OfHandMadeCounts) {
  // Thresholds 50, 100, 150 over two frames; 100 true pixels in each.
  const std::vector<std::vector<MatchCounts>> counts{
      {{80, 100, 80, 160}, {60, 100, 60, 75}, {20, 100, 20, 20}},
      {{40, 100, 40, 160}, {36, 100, 36, 45}, {4, 100, 4, 4}},
  };
  const std::vector<int> thresholds{50, 100, 150};
  const Scores scores = score(counts, thresholds);
  // Sums: R .6 P .375; R .48 P .8; R .12 P 1. The F of the second is .6; between the first two it
  // is larger nearby: R = .6 - .12 d, P = .375 + .425 d.
  double best = 0;
  for (int i = 0; i < 100; ++i) {
    const double d = i / 99.0;
    best = std::max(best, f_measure(0.375 + 0.425 * d, 0.6 - 0.12 * d));
  }
  EXPECT_NEAR(scores.f, best, 1e-12);
  EXPECT_GE(scores.f, 0.6);
  EXPECT_NEAR(scores.f, f_measure(scores.precision, scores.recall), 1e-12);
  EXPECT_NEAR(scores.threshold, 50 + 50 * (scores.precision - 0.375) / 0.425, 1e-9);
  // Each frame is best at the second threshold.
  EXPECT_NEAR(scores.ois, 0.6, 1e-12);
  // Recalls .12 .48 .6 with precisions 1 .8 .375, in steps of 0.01 from .12 to .60.
  double area = 0;
  for (int i = 12; i <= 60; ++i) {
    const double r = i * 0.01;
    area += r <= 0.48 ? 1 - 0.2 * (r - 0.12) / 0.36 : 0.8 - 0.425 * (r - 0.48) / 0.12;
  }
  EXPECT_NEAR(scores.ap, area * 0.01, 0.0101);  // the ends may fall to either side by rounding
  EXPECT_GT(scores.ap, 0.38);
}

TEST(Scores, OisTakesEachFrameAtItsBest) {
  const std::vector<std::vector<MatchCounts>> counts{
      {{50, 50, 50, 50}, {0, 50, 0, 0}},
      {{10, 50, 10, 1000}, {40, 50, 40, 40}},
  };
  const Scores scores = score(counts, std::vector<int>{10, 20});
  EXPECT_NEAR(scores.ois, f_measure(1.0, 0.9), 1e-12);
}

TEST(Scores, TakeTheFirstOfEquallyGoodThresholds) {
  const std::vector<std::vector<MatchCounts>> counts{
      {{5, 5, 5, 10}, {5, 5, 5, 5}, {5, 5, 5, 5}, {1, 5, 1, 1}}};
  EXPECT_EQ(score(counts, std::vector<int>{10, 20, 40, 80}).threshold, 20);
}

TEST(Scores, OfNothing) {
  const std::vector<std::vector<MatchCounts>> counts{{MatchCounts{}, MatchCounts{}}};
  const Scores scores = score(counts, std::vector<int>{10, 20});
  EXPECT_EQ(scores.f, 1);
  EXPECT_EQ(scores.precision, 1);
  EXPECT_EQ(scores.recall, 1);
  EXPECT_EQ(scores.ois, 1);
}

TEST(Counts, RespectThresholdsAnnotatorsAndAccepted) {
  const Map strength = map_of({".........", "222..888.", "........."});
  TruthMaps truth = truth_of({".........",
                              "....."
                              "###.",
                              "........."});
  const std::vector<int> thresholds{25, 100, 230};
  for (const bool thin : {true, false}) {
    const CountOptions options{0.1, thin};  // 0.949 px: the pixel itself
    auto counts = count_matches(strength.view(), truth, thresholds, options);
    ASSERT_TRUE(counts);
    EXPECT_EQ((*counts)[0], (MatchCounts{3, 3, 3, 6}));
    EXPECT_EQ((*counts)[1], (MatchCounts{3, 3, 3, 3}));
    EXPECT_EQ((*counts)[2], (MatchCounts{0, 3, 0, 0}));

    // A second annotator: recall is asked twice, precision once.
    TruthMaps two = truth_of({".........", "##.......", "........."});
    two.annotators.push_back(truth.annotators[0].clone());
    counts = count_matches(strength.view(), two, thresholds, options);
    EXPECT_EQ((*counts)[0], (MatchCounts{5, 5, 5, 6}));

    // The weak edge may be found, but need not be.
    TruthMaps lenient = truth_of({".........", ".....###.", "........."});
    lenient.accepted.push_back(map_of({".........", "###..###.", "........."}));
    counts = count_matches(strength.view(), lenient, thresholds, options);
    EXPECT_EQ((*counts)[0], (MatchCounts{3, 3, 6, 6}));
    EXPECT_EQ((*counts)[1], (MatchCounts{3, 3, 3, 3}));
  }
}

TEST(Counts, OfEmptyMapsAreZero) {
  const Map nothing = map_of({"....", "...."});
  for (const bool thin : {true, false}) {
    const auto counts = count_matches(nothing.view(), truth_of({"....", "...."}),
                                      std::vector<int>{1, 255}, {0.0075, thin});
    ASSERT_TRUE(counts);
    EXPECT_EQ((*counts)[0], MatchCounts{});
    EXPECT_EQ((*counts)[1], MatchCounts{});
  }
}

// Lines of any width, at a single threshold and at the one of a sweep where the map is the truth.
TEST(Counts, OfAMapAgainstItselfAreExact) {
  const Map strength = map_of({".99999.", ".99999.", "22.9...", "..9...."});
  const TruthMaps truth = truth_of({".#####.", ".#####.", "...#...", "..#...."});
  for (const bool thin : {true, false}) {
    const auto counts =
        count_matches(strength.view(), truth, std::vector<int>{200}, {0.0075, thin});
    ASSERT_TRUE(counts);
    EXPECT_EQ((*counts)[0], (MatchCounts{12, 12, 12, 12}));
  }
  const auto swept = count_matches(strength.view(), truth, std::vector<int>{10, 200}, {});
  ASSERT_TRUE(swept);
  EXPECT_LT((*swept)[0].recall(), 1);
  EXPECT_EQ((*swept)[1].f_measure(), 1);
}

TEST(Counts, RefuseOtherSizesAndNoTruth) {
  const Map map = map_of({"....", "...."});
  const auto other = count_matches(map.view(), truth_of({"..."}), std::vector<int>{1}, {});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().message, "4x2 pixels, but its truth has 3x1");
  EXPECT_FALSE(count_matches(map.view(), TruthMaps{}, std::vector<int>{1}, {}));
}

TEST(PrattFom, OfHandMadeMaps) {
  std::vector<Map> truth;
  truth.push_back(map_of({"......", "######", "......", "......"}));
  const auto merit = [&](const std::vector<std::string>& rows) {
    return pratt_merit(map_of(rows).view(), truth).mean;
  };
  EXPECT_EQ(merit({"......", "######", "......", "......"}), 1.0);
  EXPECT_NEAR(merit({"......", "......", "######", "......"}), 0.9, 1e-12);       // d = 1
  EXPECT_NEAR(merit({"......", "......", "......", "######"}), 9 / 13.0, 1e-12);  // d = 2
  EXPECT_NEAR(merit({"......", "###...", "......", "......"}), 0.5, 1e-12);       // half is missing
  EXPECT_EQ(merit({"......", "......", "......", "......"}), 0.0);
  truth.push_back(map_of({"......", "......", "......", "......"}));
  const PrattFom both = pratt_merit(map_of({"......", "######", "......", "......"}).view(), truth);
  EXPECT_NEAR(both.mean, 0.5, 1e-12);
  EXPECT_EQ(both.best, 1.0);
  EXPECT_EQ(pratt_merit(truth[1].view(), std::span(truth).subspan(1)).mean, 1.0);
}

TEST(Structure, OfHandMadeMaps) {
  // A ring and a line that touch nothing.
  const auto apart = measure_structure(map_of({".#.......",  //
                                               "#.#..###.",  //
                                               ".#......#"})
                                           .view());
  EXPECT_EQ(apart.edge_pixels, 8U);
  EXPECT_EQ(apart.fragments_px, (std::vector<std::int32_t>{4, 4}));
  EXPECT_EQ(apart.contours_px, (std::vector<std::int32_t>{4, 4}));
  EXPECT_EQ(apart.spurs, 0U);

  // Two arms of 3 px and a line of 9 meet in a junction.
  const auto fork = measure_structure(map_of({"...........##",  //
                                              "..........#..",  //
                                              "##########...",  //
                                              "..........#..",  //
                                              "...........##"})
                                          .view());
  EXPECT_EQ(fork.fragments_px, std::vector<std::int32_t>{16});
  EXPECT_EQ(fork.contours_px, (std::vector<std::int32_t>{3, 9, 3})) << "the junction is nobody's";
  EXPECT_EQ(fork.spurs, 3U);
  EXPECT_EQ(measure_structure(map_of({"...........##",  //
                                      "..........#..",  //
                                      "##########...",  //
                                      "..........#..",  //
                                      "...........##"})
                                  .view(),
                              4)
                .spurs,
            2U);
  EXPECT_EQ(measure_structure(map_of({"#########"}).view()).spurs, 0U);
}

TEST(Structure, SummaryOfHandMadeLengths) {
  MapStructure a;
  a.edge_pixels = 40;
  a.fragments_px = {30, 10};
  a.contours_px = {20, 9, 10};
  a.spurs = 1;
  MapStructure b;
  b.edge_pixels = 10;
  b.fragments_px = {9, 1};
  b.contours_px = {9, 1};
  const auto summary = summarise_structure(std::vector<MapStructure>{a, b});
  EXPECT_DOUBLE_EQ(summary.edge_pixels, 25);
  EXPECT_DOUBLE_EQ(summary.fragments_per_1000_px, 80);
  EXPECT_DOUBLE_EQ(summary.spurs_per_1000_px, 20);
  EXPECT_DOUBLE_EQ(summary.median_contour_px, 9);            // 1 9 9 10 20
  EXPECT_DOUBLE_EQ(summary.weighted_median_contour_px, 10);  // 1 10 19 29 49, half: 24.5
  EXPECT_DOUBLE_EQ(summary.short_fragments, 0.5);
  EXPECT_DOUBLE_EQ(summary.short_fragments_px, 0.2);
  EXPECT_EQ(summary.contour_lengths, (std::vector<std::size_t>{1, 0, 0, 3, 1}));
  const auto nothing = summarise_structure(std::vector<MapStructure>(3));
  EXPECT_EQ(nothing.edge_pixels, 0);
  EXPECT_EQ(nothing.fragments_per_1000_px, 0);
}

}  // namespace
}  // namespace thermedge::eval
