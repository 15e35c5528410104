// Corners of drawn curves, and the parts of the rule that hold numbers: eqs. 9 to 11, end points.
#include "thermedge/stages/corners_paper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "corner_angle.hpp"
#include "curvature.hpp"
#include "support/drawing.hpp"

namespace thermedge::test {
namespace {

using Corners = std::vector<std::vector<std::uint32_t>>;

Corners corners_of(const ContourSet& contours, const PaperCornerOptions& options = {}) {
  CornerSet found;
  const Status status = PaperCornerFinder(options).run(contours, found);
  EXPECT_TRUE(status) << status.error().message;
  Corners corners;
  for (const Range& range : found.ranges) {
    const auto indices = slice(found.indices, range);
    corners.emplace_back(indices.begin(), indices.end());
  }
  return corners;
}

// An L with its corner at sample 60, far from the frame's origin.
std::vector<Pixel> an_l() { return polyline({{100, 40}, {100, 100}, {160, 100}}); }

TEST(Kernel, OfSigma3) {
  std::vector<double> kernel;
  detail::gaussian_kernel(3, kernel);
  ASSERT_EQ(kernel.size(), 25U);
  EXPECT_NEAR(std::accumulate(kernel.begin(), kernel.end(), 0.0), 1, 1e-15);
  EXPECT_NEAR(kernel[12] / kernel[15], std::exp(0.5), 1e-12);
  EXPECT_TRUE(std::equal(kernel.begin(), kernel.end(), kernel.rbegin()));
}

TEST(Kernel, HalfWidthGrowsWithSigmaUpTo30) {
  std::vector<double> kernel;
  for (const auto& [sigma, half_width] : {std::pair{0.5, 2}, {1.0, 4}, {5.0, 21}, {10.0, 30}}) {
    detail::gaussian_kernel(sigma, kernel);
    EXPECT_EQ(kernel.size(), static_cast<std::size_t>(2 * half_width + 1)) << "sigma " << sigma;
  }
}

TEST(Smooth, ReturnsTheKernelForAPulse) {
  std::vector<double> kernel;
  detail::gaussian_kernel(1, kernel);
  std::vector<double> pulse(3 * kernel.size(), 0.0);
  pulse[kernel.size() + 2] = 1;
  std::vector<double> smoothed(pulse.size() - kernel.size() + 1, 77.0);
  detail::smooth(pulse, kernel, smoothed);
  for (std::size_t i = 0; i < smoothed.size(); ++i) {
    const bool reached = i >= 3 && i < 3 + kernel.size();
    EXPECT_DOUBLE_EQ(smoothed[i], reached ? kernel[i - 3] : 0) << i;
  }
}

// As GNU Octave does; on straight lines the rounding error decides.
TEST(Smooth, AddsFromTheLastTapToTheFirst) {
  const std::vector<double> kernel{1, 1e16, -1e16};
  std::vector<double> smoothed(1);
  detail::smooth(std::vector<double>{1, 1, 1}, kernel, smoothed);
  EXPECT_EQ(smoothed[0], 1);
}

// Eq. 9 on a circle: 1 / r, rounded up to the next hundredth.
TEST(Curvature, OfCircles) {
  for (const double radius : {8.1, 15.0, 40.0}) {
    std::vector<double> x;
    std::vector<double> y;
    for (int i = 0; i < 40; ++i) {
      x.push_back(5 + radius * std::cos(i / radius));
      y.push_back(9 + radius * std::sin(i / radius));
    }
    std::vector<double> curvature(x.size());
    detail::rounded_curvature(x, y, curvature);
    for (std::size_t i = 2; i + 2 < x.size(); ++i) {
      EXPECT_DOUBLE_EQ(curvature[i], std::ceil(100 / radius) / 100) << "radius " << radius;
    }
  }
}

TEST(Curvature, OfALineIsZeroAndOfAPointIsNone) {
  const std::vector<double> x{1, 2, 3, 4, 5};
  const std::vector<double> still(5, 3.0);
  std::vector<double> curvature(5);
  detail::rounded_curvature(x, still, curvature);
  EXPECT_EQ(curvature, std::vector<double>(5, 0.0));
  detail::rounded_curvature(still, still, curvature);
  for (const double value : curvature) {
    EXPECT_TRUE(std::isnan(value));
  }
}

// Two straight arms that enclose `degrees`, turned by `turn` degrees.
double angle_between_arms(double degrees, double turn, std::size_t arm) {
  std::vector<double> rows;
  std::vector<double> columns;
  const auto add = [&](double along, double direction_deg) {
    const double direction = (direction_deg + turn) * std::numbers::pi / 180;
    rows.push_back(200 + along * std::cos(direction));
    columns.push_back(200 + along * std::sin(direction));
  };
  for (std::size_t i = arm; i > 0; --i) {
    add(static_cast<double>(i), 0);
  }
  add(0, 0);
  for (std::size_t i = 1; i <= arm; ++i) {
    add(static_cast<double>(i), degrees);
  }
  return detail::corner_angle_deg(rows, columns, arm);
}

// Eq. 11. Directions are not reduced: beyond 180 degrees the angle is seen from the other side.
TEST(CornerAngle, OfStraightArms) {
  for (const std::size_t arm : {1U, 2U, 3U, 4U, 20U}) {
    for (const double degrees : {10.0, 90.0, 161.9, 162.1, 180.0}) {
      EXPECT_NEAR(angle_between_arms(degrees, -170, arm), degrees, 1e-6);
      EXPECT_NEAR(angle_between_arms(degrees, 100, arm), degrees > 80 ? 360 - degrees : degrees,
                  1e-6);
    }
  }
}

TEST(CornerAngle, OnACircleIsStraight) {
  for (const double turn : {0.0, 1.0, 2.0, 3.0}) {
    std::vector<double> rows;
    std::vector<double> columns;
    for (int i = 0; i <= 40; ++i) {
      rows.push_back(90 + 30 * std::cos(turn + i * 0.05));
      columns.push_back(70 + 30 * std::sin(turn + i * 0.05));
    }
    EXPECT_NEAR(std::fmod(detail::corner_angle_deg(rows, columns, 17), 360), 180, 1e-6);
  }
}

// Half circles left and right of a cusp: the tangents there coincide, the chords do not.
TEST(CornerAngle, UsesTangentsNotChords) {
  std::vector<double> rows;
  std::vector<double> columns;
  for (int i = 20; i >= 0; --i) {
    rows.push_back(90 + 20 * std::sin(i * 0.05));
    columns.push_back(70 - 20 + 20 * std::cos(i * 0.05));
  }
  for (int i = 1; i <= 20; ++i) {
    rows.push_back(90 + 20 * std::sin(i * 0.05));
    columns.push_back(70 + 20 - 20 * std::cos(i * 0.05));
  }
  EXPECT_NEAR(detail::corner_angle_deg(rows, columns, 20), 0, 1e-6);
}

TEST(CornerAngle, OfAnArmThatReturnsToItsStart) {
  // Once around a square from its corner and a straight arm before it.
  std::vector<double> rows;
  std::vector<double> columns;
  for (const Pixel pixel : polyline({{10, 50}, {30, 50}, {50, 50}, {50, 70}, {30, 70}, {30, 50}})) {
    rows.push_back(pixel.y);
    columns.push_back(pixel.x);
  }
  const double angle = detail::corner_angle_deg(rows, columns, 20);
  EXPECT_TRUE(std::isfinite(angle));
  EXPECT_GT(angle, 90);
}

TEST(PaperCornerFinder, AnLHasItsBendAndItsEnds) {
  const auto corners = corners_of(contour_set({an_l()}));
  ASSERT_EQ(corners.size(), 1U);
  EXPECT_EQ(corners[0], (std::vector<std::uint32_t>{0, 60, 120}));
}

TEST(PaperCornerFinder, ARectangleHasFourCorners) {
  ContourSet contours;
  add_contour(contours, polyline({{100, 100}, {180, 100}, {180, 160}, {100, 160}, {100, 101}}),
              true);
  PaperCornerOptions options;
  options.end_points = false;
  const auto corners = corners_of(contours, options)[0];
  for (const std::uint32_t bend : {80U, 140U, 220U}) {
    EXPECT_TRUE(std::any_of(corners.begin(), corners.end(), [=](std::uint32_t corner) {
      return std::abs(static_cast<int>(corner) - static_cast<int>(bend)) <= 1;
    })) << bend;
  }
}

TEST(PaperCornerFinder, WiderAnglesThanTheOptionAreNoCorners) {
  // A bend by 45 degrees: the angle is 135.
  const auto bend = contour_set({polyline({{100, 100}, {160, 100}, {200, 140}})});
  PaperCornerOptions options;
  options.end_points = false;
  EXPECT_EQ(corners_of(bend, options)[0].size(), 1U);
  options.max_angle_deg = 130;
  EXPECT_EQ(corners_of(bend, options)[0].size(), 0U);
}

TEST(PaperCornerFinder, ALargerRatioLeavesFewerCorners) {
  const auto bend = contour_set({an_l()});
  PaperCornerOptions options;
  options.end_points = false;
  EXPECT_EQ(corners_of(bend, options)[0].size(), 1U);
  options.curvature_ratio = 100;
  EXPECT_EQ(corners_of(bend, options)[0].size(), 0U);
}

// The fault of the public code, which is kept.
TEST(PaperCornerFinder, AFrameWithoutAnyCornerLosesItsEndPoints) {
  const auto line = straight({100, 300}, {160, 300});
  EXPECT_TRUE(corners_of(contour_set({line}))[0].empty());
  const auto corners = corners_of(contour_set({line, an_l()}));
  EXPECT_EQ(corners[0], (std::vector<std::uint32_t>{0, 60}));
}

TEST(PaperCornerFinder, EndsNearACornerOfAnotherCurveAreNone) {
  const auto ends_at = [](Pixel end) {  // the corner of the L is at (100, 100)
    const auto line = straight(end, {end.x - 50, end.y});
    return corners_of(contour_set({an_l(), line}))[1].front() == 0;
  };
  EXPECT_FALSE(ends_at({96, 103}));  // 25
  EXPECT_TRUE(ends_at({95, 101}));   // 26
  EXPECT_FALSE(ends_at({95, 100}));  // 25
}

TEST(PaperCornerFinder, EndsNearAnEndThatCameFirstAreNone) {
  const auto corners = corners_of(
      contour_set({an_l(), straight({30, 200}, {60, 200}), straight({64, 203}, {90, 203})}));
  EXPECT_EQ(corners[1], (std::vector<std::uint32_t>{0, 30}));
  EXPECT_EQ(corners[2], (std::vector<std::uint32_t>{26}));
}

TEST(PaperCornerFinder, TheEndDistanceIsAnOption) {
  const auto contours = contour_set({an_l(), straight({96, 103}, {46, 103})});
  PaperCornerOptions options;
  options.end_distance_px = 4.9;
  EXPECT_EQ(corners_of(contours, options)[1], (std::vector<std::uint32_t>{0, 50}));
  options.end_distance_px = 1000;
  EXPECT_EQ(corners_of(contours, options)[0], (std::vector<std::uint32_t>{60}));
  options.end_distance_px = 0;
  EXPECT_EQ(corners_of(contours, options)[0], (std::vector<std::uint32_t>{0, 60, 120}));
}

TEST(PaperCornerFinder, ClosedCurvesHaveNoEnds) {
  ContourSet contours = contour_set({an_l()});
  add_contour(contours, polyline({{200, 200}, {204, 200}, {204, 204}, {200, 204}, {200, 201}}),
              true);
  PaperCornerOptions without_ends;
  without_ends.end_points = false;
  EXPECT_EQ(corners_of(contours)[1], corners_of(contours, without_ends)[1]);
  contours.items[1].closed = false;
  EXPECT_NE(corners_of(contours)[1], corners_of(contours, without_ends)[1]);
}

TEST(PaperCornerFinder, CurvesNoLongerThanTheKernelHaveEndsAlone) {
  const auto corner = polyline({{200, 200}, {206, 200}, {206, 205}});  // 12 samples
  ASSERT_EQ(corner.size(), 12U);
  const auto corners = corners_of(contour_set({an_l(), corner, {{10, 10}}}));
  EXPECT_EQ(corners[1], (std::vector<std::uint32_t>{0, 11}));
  EXPECT_EQ(corners[2], (std::vector<std::uint32_t>{0}));
}

TEST(PaperCornerFinder, OneSampleMoreThanTheKernelReachesIsEnough) {
  PaperCornerOptions without_ends;
  without_ends.end_points = false;
  const auto bend = polyline({{200, 200}, {206, 200}, {206, 206}});  // 13 samples
  EXPECT_EQ(corners_of(contour_set({bend}), without_ends)[0], (std::vector<std::uint32_t>{6}));
}

TEST(PaperCornerFinder, IndicesAscendWithinEachCurve) {
  std::vector<std::vector<Pixel>> curves;
  for (int i = 0; i < 8; ++i) {
    const int y = 20 + 60 * i;
    curves.push_back(polyline({{20, y}, {50 + i, y}, {50 + i, y + 40}, {120, y + 40}}));
  }
  for (const auto& corners : corners_of(contour_set(curves))) {
    EXPECT_GE(corners.size(), 3U);
    EXPECT_TRUE(std::is_sorted(corners.begin(), corners.end()));
    EXPECT_EQ(std::adjacent_find(corners.begin(), corners.end()), corners.end());
  }
}

// No real curve stands still, but nothing may go wrong if one does.
TEST(PaperCornerFinder, ACurveThatStandsStill) {
  ContourSet contours = contour_set({an_l(), std::vector<Pixel>(60, Pixel{7, 9})});
  add_contour(contours, std::vector<Pixel>(60, Pixel{0, 0}), true);
  const auto corners = corners_of(contours);
  ASSERT_EQ(corners.size(), 3U);
  for (const std::uint32_t index : corners[1]) {
    EXPECT_LT(index, 60U);
  }
}

TEST(PaperCornerFinder, RemembersNothing) {
  PaperCornerFinder finder{PaperCornerOptions{}};
  CornerSet corners;
  ASSERT_TRUE(finder.run(contour_set({an_l()}), corners));
  ASSERT_TRUE(finder.run(contour_set({straight({100, 30}, {160, 30})}), corners));
  EXPECT_TRUE(corners.indices.empty());
  ASSERT_EQ(corners.ranges.size(), 1U);
  ASSERT_TRUE(finder.run({}, corners));
  EXPECT_TRUE(corners.ranges.empty());
}

TEST(PaperCornerFinder, NamesTheOptionThatIsOutOfRange) {
  const auto error_of = [](const PaperCornerOptions& options) {
    CornerSet corners;
    const Status status = PaperCornerFinder(options).run({}, corners);
    return status ? "" : status.error().message;
  };
  PaperCornerOptions options;
  options.sigma_px = 0;
  EXPECT_NE(error_of(options).find("corners.sigma_px"), std::string::npos);
  options = {};
  options.max_angle_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of(options).find("corners.max_angle_deg"), std::string::npos);
  EXPECT_EQ(error_of({}), "");
}

}  // namespace
}  // namespace thermedge::test
