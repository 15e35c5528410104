// Bridges over gaps: to curves, ends and the border; where the step goes on and where it does not.
#include "thermedge/stages/gap_closing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/drawing.hpp"

namespace thermedge::test {
namespace {

constexpr int kWidth = 80;
constexpr int kHeight = 60;

// A step of 100 counts below row `edge_y`, and another one of `wall` from column `edge_x` on.
Image<float> corner_frame(double edge_y, int edge_x, double wall) {
  Image<float> frame(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool below = y > edge_y;
      frame(x, y) = static_cast<float>(x >= edge_x ? wall : (below ? 1100.0 : 1000.0));
    }
  }
  return frame;
}

Image<float> step_frame(double edge_y) { return corner_frame(edge_y, kWidth, 0); }

LinkedContours linked(const ContourSet& contours) {
  LinkedContours curves;
  curves.contours = contours;
  return curves;
}

LinkedContours bridge(const std::vector<std::vector<Pixel>>& curves, const Image<float>& frame,
                      const GapClosingOptions& options = {},
                      const std::vector<std::uint8_t>& eligible = {}) {
  LinkedContours bridged;
  std::vector<std::uint8_t> all(curves.size(), 1);
  const Status status = GapCloser(options).run(linked(contour_set(curves)), frame,
                                               eligible.empty() ? all : eligible, bridged);
  EXPECT_TRUE(status) << status.error().message;
  return bridged;
}

TEST(GapCloser, JoinsEndsOverAGapAlongTheStep) {
  const auto left = straight({20, 20}, {30, 20});
  const auto right = straight({38, 20}, {60, 20});
  const LinkedContours bridged = bridge({left, right}, step_frame(20.5));
  ASSERT_EQ(bridged.contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(bridged.contours, 0), straight({20, 20}, {60, 20}));
  ASSERT_EQ(bridged.links.size(), 1U);
  EXPECT_EQ(bridged.links[0].type, LinkType::kEndToEnd);
}

// The same curves on a frame whose step is on one side of the gap only.
TEST(GapCloser, RefusesAGapWithoutAStep) {
  const auto left = straight({20, 20}, {30, 20});
  const auto right = straight({38, 20}, {60, 20});
  EXPECT_EQ(bridge({left, right}, corner_frame(20.5, 29, 1050)).contours.items.size(), 2U);
}

TEST(GapCloser, TuningSaysUpToWhatLengthABridgeNeedsNoStep) {
  const auto left = straight({20, 20}, {30, 20});
  const auto right = straight({38, 20}, {60, 20});
  LinkedContours bridged;
  const std::vector<std::uint8_t> all(2, 1);
  ASSERT_TRUE(
      GapCloser({}, {.unseen_px = 8})
          .run(linked(contour_set({left, right})), corner_frame(20.5, 29, 1050), all, bridged));
  EXPECT_EQ(bridged.contours.items.size(), 1U);
}

// Warmer below on one side of the gap, warmer above on the other.
TEST(GapCloser, RefusesAStepTheOtherWayRound) {
  Image<float> frame = step_frame(20.5);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 31; x < kWidth; ++x) {
      frame(x, y) = 2100 - frame(x, y);
    }
  }
  const auto left = straight({20, 20}, {30, 20});
  const auto right = straight({39, 20}, {60, 20});
  EXPECT_EQ(bridge({left, right}, frame).contours.items.size(), 2U);
}

TEST(GapCloser, CarriesAnEndOnToAStrongerEdge) {
  const auto weak = straight({20, 20}, {43, 20});
  const auto strong = straight({50, 5}, {50, 55});
  const LinkedContours bridged = bridge({weak, strong}, corner_frame(20.5, 50, 3000));
  ASSERT_EQ(bridged.contours.items.size(), 2U);
  EXPECT_EQ(pixels_of(bridged.contours, 0), straight({20, 20}, {50, 20}));
  ASSERT_EQ(bridged.links.size(), 1U);
  EXPECT_EQ(bridged.links[0].type, LinkType::kEndToMiddle);
  EXPECT_EQ(bridged.links[0].a, 0U);
  EXPECT_EQ(bridged.links[0].b, 1U);
  ASSERT_EQ(bridged.contours.junctions.size(), 1U);
  EXPECT_EQ(bridged.contours.junctions[0].at, (Pixel{50, 20}));
}

TEST(GapCloser, CarriesAnEndOnToTheBorder) {
  const auto curve = straight({7, 20}, {70, 20});
  const LinkedContours bridged = bridge({curve}, step_frame(20.5));
  ASSERT_EQ(bridged.contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(bridged.contours, 0), straight({1, 20}, {78, 20}));
  EXPECT_TRUE(bridged.links.empty());
}

TEST(GapCloser, ReachesNoFartherThanTheGap) {
  const auto left = straight({20, 20}, {35, 20});
  const auto right = straight({46, 20}, {60, 20});
  GapClosingOptions options;
  EXPECT_EQ(bridge({left, right}, step_frame(20.5), options).contours.items.size(), 2U);
  options.gap_px = 11;
  EXPECT_EQ(bridge({left, right}, step_frame(20.5), options).contours.items.size(), 1U);
  options.gap_px = 0;
  const auto near = straight({37, 20}, {60, 20});
  EXPECT_EQ(bridge({left, near}, step_frame(20.5), options).contours.items.size(), 2U);
}

// An end is not led back beside its own curve, nor round a kink to another one.
TEST(GapCloser, RefusesAKink) {
  const auto along = straight({20, 20}, {40, 20});
  const auto across = straight({43, 26}, {43, 45});  // 70 degrees off, seen from (40, 20)
  GapClosingOptions options;
  options.min_contrast_ratio = 0;
  const LinkedContours bridged = bridge({along, across}, step_frame(20.5), options);
  EXPECT_EQ(bridged.contours.items.size(), 2U);
  EXPECT_TRUE(std::none_of(bridged.links.begin(), bridged.links.end(),
                           [](const Link& link) { return link.type == LinkType::kEndToEnd; }));
}

// The outline of a warm quarter of the frame, of which the corner is missing.
TEST(GapCloser, RunsIntoTheCornerThatTwoEndsHeadFor) {
  Image<float> frame(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = x > 40 && y > 30 ? 1200.0F : 1000.0F;
    }
  }
  const auto level = straight({60, 30}, {45, 30});
  const auto upright = straight({40, 34}, {40, 45});
  const LinkedContours bridged = bridge({level, upright}, frame);
  ASSERT_EQ(bridged.contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(bridged.contours, 0), polyline({{60, 30}, {40, 30}, {40, 45}}));
}

TEST(GapCloser, ClosesARing) {
  Image<float> frame(kWidth, kHeight);
  std::vector<Pixel> ring;
  for (int i = 0; i <= 100; ++i) {
    const double angle = 0.15 + i * (6.283 - 0.3) / 100;
    const Pixel at{static_cast<int>(std::lround(40 + 20 * std::cos(angle))),
                   static_cast<int>(std::lround(30 + 20 * std::sin(angle)))};
    if (ring.empty() || !(ring.back() == at)) {
      ring.push_back(at);
    }
  }
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = std::hypot(x - 40.0, y - 30.0) < 20 ? 1200.0F : 1000.0F;
    }
  }
  const LinkedContours bridged = bridge({ring}, frame);
  ASSERT_EQ(bridged.contours.items.size(), 1U);
  EXPECT_TRUE(bridged.contours.items[0].closed);
  ASSERT_EQ(bridged.links.size(), 1U);
  EXPECT_EQ(bridged.links[0].type, LinkType::kLoop);
}

TEST(GapCloser, LeavesAloneWhatIsNotWorthABridge) {
  const auto left = straight({20, 20}, {30, 20});
  const auto right = straight({38, 20}, {60, 20});
  for (const auto& eligible : {std::vector<std::uint8_t>{1, 0}, {0, 1}, {0, 0}}) {
    const LinkedContours bridged = bridge({left, right}, step_frame(20.5), {}, eligible);
    ASSERT_EQ(bridged.contours.items.size(), 2U);
    EXPECT_TRUE(bridged.links.empty());
  }
}

// An end that touches another curve needs no bridge; links that came in follow their curves.
TEST(GapCloser, KeepsWhatWasConnected) {
  LinkedContours curves = linked(contour_set(
      {straight({20, 20}, {30, 20}), straight({31, 21}, {31, 50}), straight({38, 20}, {60, 20})}));
  curves.links.push_back({LinkType::kEndToMiddle, 0, 1, {30, 20}, {31, 21}});
  LinkedContours bridged;
  ASSERT_TRUE(
      GapCloser({}).run(curves, step_frame(20.5), std::vector<std::uint8_t>(3, 1), bridged));
  ASSERT_GE(bridged.links.size(), 1U);
  EXPECT_EQ(bridged.links[0].type, LinkType::kEndToMiddle);
  EXPECT_EQ(bridged.links[0].a, 0U);
  EXPECT_EQ(bridged.links[0].b, 1U);
  EXPECT_EQ(pixels_of(bridged.contours, 0), straight({20, 20}, {30, 20}));
}

TEST(GapCloser, TakesNoCurvesAtAll) {
  const LinkedContours bridged = bridge({}, step_frame(20.5));
  EXPECT_TRUE(bridged.contours.items.empty());
}

TEST(GapCloser, RefusesOptionsOutOfRange) {
  GapClosingOptions options;
  options.max_turn_deg = std::numeric_limits<double>::quiet_NaN();
  LinkedContours bridged;
  const Status status = GapCloser(options).run({}, step_frame(20.5), {}, bridged);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "gap_closing.max_turn_deg = nan is out of range: 0 to 90");
}

}  // namespace
}  // namespace thermedge::test
