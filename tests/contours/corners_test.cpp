// Corners of drawn contours whose corners are known.
#include "thermedge/stages/corners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "support/drawing.hpp"
#include "support/outlines.hpp"

namespace thermedge::test {
namespace {

using Indices = std::vector<std::uint32_t>;

Indices corners_of(const std::vector<Pixel>& pixels, bool closed, const CornerOptions& options = {},
                   const CornerTuning& tuning = {}) {
  ContourSet contours;
  add_contour(contours, pixels, closed);
  CornerSet found;
  const Status status = CornerFinder(options, tuning).run(contours, found);
  EXPECT_TRUE(status) << status.error().message;
  EXPECT_EQ(found.ranges.size(), 1U);
  EXPECT_EQ(found.ranges.front(), (Range{0, static_cast<std::uint32_t>(found.indices.size())}));
  EXPECT_TRUE(std::is_sorted(found.indices.begin(), found.indices.end()));
  return found.indices;
}

std::vector<Pixel> an_l() { return polyline({{100, 40}, {100, 100}, {160, 100}}); }

TEST(CornerFinder, AnLHasItsBendAndItsEnds) {
  EXPECT_EQ(corners_of(an_l(), false), (Indices{0, 60, 120}));
}

TEST(CornerFinder, AStraightContourHasItsEndsAlone) {
  EXPECT_EQ(corners_of(straight({10, 20}, {70, 20}), false), (Indices{0, 60}));
  EXPECT_EQ(corners_of(straight({10, 20}, {70, 80}), false), (Indices{0, 60}));
}

TEST(CornerFinder, TheEndsAreCornersHoweverShortTheContour) {
  EXPECT_EQ(corners_of({{5, 5}}, false), (Indices{0}));
  EXPECT_EQ(corners_of({{5, 5}, {6, 5}}, false), (Indices{0, 1}));
  for (int length = 2; length < 40; ++length) {
    const auto corners = corners_of(straight({9, 9}, {9 + length, 9}), false);
    EXPECT_EQ(corners, (Indices{0, static_cast<std::uint32_t>(length)}));
  }
}

TEST(CornerFinder, ARectangleHasFourCornersWhereverItBegins) {
  auto outline = polyline({{100, 100}, {180, 100}, {180, 160}, {100, 160}, {100, 101}});
  const std::vector<Pixel> wanted{{100, 100}, {180, 100}, {180, 160}, {100, 160}};
  for (std::size_t begin = 0; begin < outline.size(); ++begin) {
    const auto corners = corners_of(outline, true);
    ASSERT_EQ(corners.size(), 4U) << "begins at " << begin;
    for (const std::uint32_t corner : corners) {
      EXPECT_EQ(std::count(wanted.begin(), wanted.end(), outline[corner]), 1);
    }
    std::rotate(outline.begin(), outline.begin() + 1, outline.end());
  }
}

TEST(CornerFinder, AClosedTearHasOneCorner) {
  const auto corners = corners_of(outline_pixels(tear_points({80, 80}, 30)), true);
  EXPECT_EQ(corners.size(), 1U);
}

// Angle by angle, at three places between the pixels.
TEST(CornerFinder, TurnedSquaresHaveFourCornersWithinTwoPixels) {
  int squares = 0;
  int exact = 0;
  for (int degrees = 0; degrees < 90; ++degrees) {
    for (const double shift : {0.13, 0.41, 0.77}) {
      const auto points = polygon_points({120 + shift, 120 - 0.6 * shift}, 40, 4, degrees);
      const auto pixels = outline_pixels(points);
      const auto corners = corners_of(pixels, true);
      ++squares;
      exact += corners.size() == 4;
      for (const Place& point : points) {
        EXPECT_TRUE(
            std::any_of(corners.begin(), corners.end(),
                        [&](std::uint32_t corner) { return distance(pixels[corner], point) <= 2; }))
            << degrees << " degrees, shifted by " << shift;
      }
    }
  }
  EXPECT_GE(exact, 0.97 * squares);
}

TEST(CornerFinder, BendsAreFoundFromSixtyDegreesOn) {
  for (const double turn : {60.0, 90.0, 120.0, 150.0}) {
    for (int degrees = 0; degrees < 180; degrees += 3) {
      const auto pixels = line_pixels(bend_points({200.2, 199.7}, 40, degrees, turn));
      const auto corners = corners_of(pixels, false);
      EXPECT_EQ(corners.front(), 0U);
      EXPECT_EQ(corners.back(), pixels.size() - 1);
      EXPECT_TRUE(std::any_of(corners.begin() + 1, corners.end() - 1,
                              [&](std::uint32_t corner) {
                                return distance(pixels[corner], {200.2, 199.7}) <= 2.5;
                              }))
          << turn << " degrees at " << degrees;
    }
  }
}

TEST(CornerFinder, BendsByFifteenDegreesAreNone) {
  int found = 0;
  for (int degrees = 0; degrees < 180; ++degrees) {
    found +=
        corners_of(line_pixels(bend_points({200.2, 199.7}, 40, degrees, 15)), false).size() > 2;
  }
  EXPECT_LE(found, 5);
}

TEST(CornerFinder, EllipsesHaveNone) {
  std::size_t found = 0;
  for (const auto& [a, b] : {std::pair{8.0, 8.0},
                             {20.0, 20.0},
                             {100.0, 100.0},
                             {30.0, 20.0},
                             {50.0, 30.0},
                             {80.0, 40.0}}) {
    for (int degrees = 0; degrees < 180; degrees += 5) {
      found +=
          corners_of(outline_pixels(ellipse_points({150.3, 149.8}, a, b, degrees)), true).size();
    }
  }
  EXPECT_LE(found, 4U);  // of 216 ellipses
}

TEST(CornerFinder, ZigzagsHaveOneAtEachTurn) {
  for (int degrees = 4; degrees < 180; degrees += 10) {
    const auto points = zigzag_points({100.3, 120.6}, 20, 8, degrees, 90);
    const auto pixels = line_pixels(points);
    const auto corners = corners_of(pixels, false);
    EXPECT_EQ(corners.size(), points.size()) << degrees << " degrees";
    for (const Place& point : points) {
      EXPECT_TRUE(
          std::any_of(corners.begin(), corners.end(),
                      [&](std::uint32_t corner) { return distance(pixels[corner], point) <= 2.2; }))
          << degrees << " degrees";
    }
  }
}

// The corner of the bend is a diagonal step between two samples. What follows farther away tells
// them apart, and where nothing does, both are corners.
TEST(CornerFinder, OfTwoEqualPeaksTheOneOnTheCurvedSide) {
  const auto symmetric = polyline({{60, 100}, {99, 100}, {100, 101}, {100, 140}});
  EXPECT_EQ(corners_of(symmetric, false), (Indices{0, 39, 40, 79}));
  const auto longer = polyline({{60, 100}, {99, 100}, {100, 101}, {100, 140}, {90, 150}});
  const auto corners = corners_of(longer, false);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_EQ(corners[1], 40U);
}

TEST(CornerFinder, ABendNearAnEndIsLeftToTheEnd) {
  const auto hook = polyline({{100, 105}, {100, 100}, {160, 100}});
  CornerOptions options;
  EXPECT_EQ(corners_of(hook, false, options), (Indices{0, 65}));
  options.end_distance_px = 3.9;
  EXPECT_EQ(corners_of(hook, false, options).size(), 3U);
  options.end_distance_px = 1000;
  EXPECT_EQ(corners_of(an_l(), false, options), (Indices{0, 120}));
}

TEST(CornerFinder, WiderAnglesThanTheOptionAreNoCorners) {
  const auto bend = line_pixels(bend_points({160, 100}, 50, 0, 45));  // encloses 135 degrees
  CornerOptions options;
  EXPECT_EQ(corners_of(bend, false, options).size(), 3U);
  options.max_angle_deg = 130;
  EXPECT_EQ(corners_of(bend, false, options).size(), 2U);
}

TEST(CornerFinder, ALargerRatioLeavesFewerCorners) {
  CornerOptions options;
  options.curvature_ratio = 3;
  EXPECT_EQ(corners_of(an_l(), false, options), (Indices{0, 60, 120}));
  options.curvature_ratio = 8;
  EXPECT_EQ(corners_of(an_l(), false, options), (Indices{0, 120}));
}

TEST(CornerFinder, ALargerSigmaSeesNoSmallZigzags) {
  const auto pixels = line_pixels(zigzag_points({50.3, 50.6}, 8, 8, 20, 90));
  CornerOptions fine;
  fine.sigma_px = 1.5;
  CornerOptions coarse;
  coarse.sigma_px = 10;
  EXPECT_EQ(corners_of(pixels, false, fine).size(), 9U);
  EXPECT_EQ(corners_of(pixels, false, coarse).size(), 2U);
}

TEST(CornerFinder, EveryTunedNumberMatters) {
  const auto rounded = outline_pixels(rounded_rectangle_points({100.2, 99.7}, 50, 30, 8, 0));
  CornerTuning short_arms;
  short_arms.arm_sigmas = 2;
  EXPECT_EQ(corners_of(rounded, true).size(), 4U);
  EXPECT_LT(corners_of(rounded, true, {}, short_arms).size(), 4U);
  CornerTuning least;
  least.least_share = 10;
  EXPECT_EQ(corners_of(an_l(), false, {}, least), (Indices{0, 120}));
  // Two turns to the same side, 10 px apart.
  const auto narrow = polyline({{20, 50}, {60, 50}, {60, 60}, {20, 60}});
  CornerTuning deep;
  deep.saddle_share = 0.01;
  EXPECT_EQ(corners_of(narrow, false), (Indices{0, 40, 50, 90}));
  EXPECT_EQ(corners_of(narrow, false, {}, deep), (Indices{0, 90}));
}

// What lies beside a contour does not matter, nor does what was found before.
TEST(CornerFinder, EachContourIsOnItsOwn) {
  ContourSet contours = contour_set({an_l(), straight({30, 200}, {60, 200}), an_l()});
  add_contour(contours, polyline({{200, 200}, {260, 200}, {260, 260}, {200, 260}, {200, 201}}),
              true);
  CornerFinder finder({});
  CornerSet corners;
  for (int run = 0; run < 2; ++run) {
    ASSERT_TRUE(finder.run(contours, corners));
    EXPECT_EQ(corners.ranges, (std::vector<Range>{{0, 3}, {3, 2}, {5, 3}, {8, 4}}));
    EXPECT_EQ(corners.indices, (Indices{0, 60, 120, 0, 30, 0, 60, 120, 0, 60, 120, 180}));
  }
  ASSERT_TRUE(finder.run({}, corners));
  EXPECT_TRUE(corners.ranges.empty() && corners.indices.empty());
}

TEST(CornerFinder, AContourThatStandsStill) {
  EXPECT_EQ(corners_of(std::vector<Pixel>(60, Pixel{7, 9}), false), (Indices{0, 59}));
  EXPECT_EQ(corners_of(std::vector<Pixel>(60, Pixel{7, 9}), true), Indices{});
}

TEST(CornerFinder, TakesClosedContoursFromOnePixelUp) {
  for (std::size_t length = 1; length < 60; ++length) {
    auto pixels = outline_pixels(ellipse_points({40, 40}, 10, 10, 0));
    pixels.resize(std::min(length, pixels.size()));
    for (const std::uint32_t corner : corners_of(pixels, true)) {
      EXPECT_LT(corner, length);
    }
  }
}

TEST(CornerFinder, NamesTheOptionThatIsOutOfRange) {
  const auto error_of = [](const CornerOptions& options) {
    CornerSet corners;
    const Status status = CornerFinder(options).run({}, corners);
    return status ? "" : status.error().message;
  };
  CornerOptions options;
  options.sigma_px = 0;
  EXPECT_NE(error_of(options).find("corners.sigma_px"), std::string::npos);
  options = {};
  options.max_angle_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of(options).find("corners.max_angle_deg"), std::string::npos);
  EXPECT_EQ(error_of({}), "");
}

}  // namespace
}  // namespace thermedge::test
