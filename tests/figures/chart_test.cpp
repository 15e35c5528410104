// Charts: data lies where the axes say, and odd ranges do no harm.
#include "chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "drawn_text.hpp"
#include "raster.hpp"

namespace thermedge::figures {
namespace {

constexpr Rgb kRed = {200, 10, 20};
constexpr Rgb kBlue = {10, 30, 210};

// A chart on 1000 x 800 points, so that its unit is 10: the plot is 870 x 660 at (110, 50).
constexpr Box kBox = {0, 0, 1000, 800};
constexpr Box kPlot = {110, 50, 870, 660};

Image<Rgb> charted(const Interval& x, const Interval& y, const std::function<void(Chart&)>& draw) {
  return drawn(1000, 800, [&](Canvas& canvas) {
    Chart chart(canvas, kBox, x, y, "x, px", "y");
    draw(chart);
  });
}

struct TickCase {
  Interval interval;
  int wanted;
  std::vector<double> values;
};

TEST(Ticks, AreOneTwoOrFiveTimesAPowerOfTenApart) {
  for (const TickCase& axis : {TickCase{{0, 0.001}, 5, {0, 0.0002, 0.0004, 0.0006, 0.0008, 0.001}},
                               {{0, 60000}, 6, {0, 10000, 20000, 30000, 40000, 50000, 60000}},
                               {{0, 61000}, 6, {0, 20000, 40000, 60000}},
                               {{-7, -3}, 4, {-7, -6, -5, -4, -3}},
                               {{0, 3}, 1, {0}},
                               {{0.1, 0.9}, 1, {}},
                               {{99.9, 100.1}, 2, {99.9, 100, 100.1}}}) {
    const auto values = ticks(axis.interval, axis.wanted);
    ASSERT_EQ(values.size(), axis.values.size()) << axis.interval.min << " " << axis.interval.max;
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_NEAR(values[i], axis.values[i], 1e-9 * axis.interval.length());
    }
  }
  const auto around_zero = ticks({-0.3, 0.3}, 6);
  EXPECT_EQ(around_zero[around_zero.size() / 2], 0) << "0 itself, no 1e-17";
}

TEST(Intervals, AreWidenedAtBothEnds) {
  const Interval wide = widened({10, 20}, 0.1);
  EXPECT_DOUBLE_EQ(wide.min, 9);
  EXPECT_DOUBLE_EQ(wide.max, 21);
  for (const double at : {0.0, 3.0, -500.0, 60000.0}) {
    const Interval around = widened({at, at}, 0);
    EXPECT_DOUBLE_EQ((around.min + around.max) / 2, at);
    EXPECT_GE(around.length(), 1);
    EXPECT_GE(around.length(), 0.1 * std::abs(at) - 1e-9);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(widened({2, nan}, 0).length(), 1);
  EXPECT_DOUBLE_EQ(widened({5, 2}, 0).min, 4.5);
}

TEST(Chart, ColumnsStandOnTheAxisAtTheirHeights) {
  const std::vector<double> edges = {0, 2, 5, 10};
  const std::vector<double> heights = {10, 0, 5};
  const auto picture =
      charted({0, 10}, {0, 10}, [&](Chart& chart) { chart.columns(edges, heights, kRed); });
  // Left, top, right, bottom of the first and the last column.
  const auto column = [&](int x) {
    int top = -1;
    for (int y = 0; y < picture.height(); ++y) {
      top = top < 0 && picture(x, y) == kRed ? y : top;
    }
    return top;
  };
  EXPECT_NEAR(column(110 + 87), kPlot.y, 2);                        // x = 1
  EXPECT_EQ(column(110 + 304), -1);                                 // x = 3.5
  EXPECT_NEAR(column(110 + 652), kPlot.y + kPlot.height / 2, 1.5);  // x = 7.5
  const Extent red = extent_of(picture, kRed);
  EXPECT_NEAR(red.left, kPlot.x, 2);
  EXPECT_NEAR(red.right, kPlot.right() - 1, 2);
  EXPECT_NEAR(red.bottom, kPlot.bottom() - 1, 2);
}

TEST(Chart, LinesRunThroughTheirPoints) {
  const Point data[] = {{0, 0}, {5, 100}, {10, 0}};
  const auto picture = charted({0, 10}, {0, 100}, [&](Chart& chart) { chart.line(data, kRed); });
  for (const auto& [x, y] : {std::pair{2.5, 50.0}, {5.0, 99.8}, {7.5, 50.0}}) {
    EXPECT_EQ(picture(static_cast<int>(kPlot.x + x / 10 * kPlot.width),
                      static_cast<int>(kPlot.bottom() - y / 100 * kPlot.height)),
              kRed)
        << x;
  }
}

TEST(Chart, ASinglePointIsSeen) {
  const Point data[] = {{5, 50}};
  const auto picture = charted({0, 10}, {0, 100}, [&](Chart& chart) { chart.line(data, kRed); });
  const Extent dot = extent_of(picture, kRed);
  EXPECT_NEAR(dot.width(), 12, 2);
  EXPECT_NEAR((dot.left + dot.right) / 2.0, kPlot.x + kPlot.width / 2, 1);
  EXPECT_NEAR((dot.top + dot.bottom) / 2.0, kPlot.y + kPlot.height / 2, 1);
}

TEST(Chart, DataOutsideIsCutAtTheBorder) {
  const Point data[] = {{-100, 50}, {100, 50}};
  const std::vector<double> edges = {-5, 20};
  const std::vector<double> heights = {1e6};
  const auto picture = charted({0, 10}, {0, 100}, [&](Chart& chart) {
    chart.columns(edges, heights, kBlue);
    chart.line(data, kRed);
    chart.horizontal(500, kRed);
  });
  for (const Rgb colour : {kRed, kBlue}) {
    const Extent extent = extent_of(picture, colour);
    EXPECT_GE(extent.left, kPlot.x - 3) << "a round end apart";
    EXPECT_LE(extent.right, kPlot.right() + 3);
    EXPECT_GE(extent.top, kPlot.y - 3);
    EXPECT_LE(extent.bottom, kPlot.bottom() + 3);
  }
}

TEST(Chart, BarsHaveTheirTextWhereThereIsRoom) {
  const auto picture = charted({0, 100}, {0, 1}, [&](Chart& chart) {
    forget_drawn_text();
    chart.bar(10, 30, 0, kRed, "behind the bar");
    chart.bar(10, 95, 1, kBlue, "no room behind the bar");
    chart.bar(40, 40, 2, kInk, "a bar of no length");
  });
  const Extent first = extent_of(picture, kRed);
  const Extent second = extent_of(picture, kBlue);
  EXPECT_NEAR(first.left, kPlot.x + 0.1 * kPlot.width, 1);
  EXPECT_NEAR(first.right, kPlot.x + 0.3 * kPlot.width, 1);
  EXPECT_NEAR(second.right, kPlot.x + 0.95 * kPlot.width, 2);
  EXPECT_GT(second.top, first.bottom + 20);
  const auto& texts = drawn_text();
  ASSERT_EQ(texts.size(), 3U);
  EXPECT_GT(texts[0].box.x, first.right);
  EXPECT_LT(texts[0].box.y, first.bottom) << "on the same line";
  EXPECT_LE(texts[1].box.right(), kPlot.right() + 1);
  EXPECT_GT(texts[1].box.y, second.bottom) << "under the bar";
  EXPECT_EQ(picture(static_cast<int>(kPlot.x + 0.4 * kPlot.width) + 2,
                    static_cast<int>(kPlot.y) + 10 * 11),
            kInk);
}

// What is written at the axes: the ticks in their places, both labels, nothing over another text
// or beyond the box.
TEST(Chart, AxesAreLabelledInOrder) {
  struct Axes {
    Interval x, y;
  };
  for (const Axes& axes : {Axes{{0, 382}, {-3.2, 3.2}},
                           {{2434, 3758}, {0, 12.5}},
                           {{0, 65535}, {0, 100}},
                           {{0, 1}, {-0.0001, 0.0001}},
                           {{0, 60000}, {59999, 60001}}}) {
    forget_drawn_text();
    charted(axes.x, axes.y, [](Chart&) {});
    const auto& texts = drawn_text();
    const std::size_t x_ticks = ticks(axes.x, 6).size();
    const std::size_t y_ticks = ticks(axes.y, 5).size();
    ASSERT_EQ(texts.size(), x_ticks + y_ticks + 2);
    for (std::size_t i = 0; i < x_ticks; ++i) {
      EXPECT_NEAR(std::stod(texts[i].text), ticks(axes.x, 6)[i], 1e-3 * axes.x.length());
      const double share = (ticks(axes.x, 6)[i] - axes.x.min) / axes.x.length();
      EXPECT_NEAR(texts[i].box.x + texts[i].box.width / 2, kPlot.x + share * kPlot.width, 3);
    }
    for (std::size_t i = x_ticks; i < x_ticks + y_ticks; ++i) {
      EXPECT_NEAR(std::stod(texts[i].text), ticks(axes.y, 5)[i - x_ticks], 1e-3 * axes.y.length());
      EXPECT_LT(texts[i].box.right(), kPlot.x);
      EXPECT_TRUE(i == x_ticks || texts[i].box.bottom() < texts[i - 1].box.y) << "rising upwards";
    }
    EXPECT_EQ(texts[x_ticks + y_ticks].text, "x, px");
    EXPECT_EQ(texts.back().text, "y");
    // Half the gap between panels is free at both sides.
    expect_text_in_place(texts, {kBox.x - 20, kBox.y, kBox.width + 40, kBox.height});
  }
}

}  // namespace
}  // namespace thermedge::figures
