// A plot with axes inside a panel.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "canvas.hpp"

namespace thermedge::figures {

struct Interval {
  double min = 0, max = 1;
  [[nodiscard]] double length() const { return max - min; }
};

// The interval widened so that it is not empty, and by `share` of its length at both ends.
[[nodiscard]] Interval widened(Interval interval, double share);

// Round values (1, 2 or 5 times a power of ten apart), about `wanted` of them, within the interval.
[[nodiscard]] std::vector<double> ticks(const Interval& interval, int wanted);

// Draws axes with ticks and labels into `box` and data into what is left. Data outside of the
// intervals is cut at the border.
class Chart {
 public:
  Chart(Canvas& canvas, const Box& box, const Interval& x, const Interval& y,
        std::string_view x_label, std::string_view y_label);

  void line(std::span<const Point> data, Rgb colour);
  // Columns that stand on y = 0 (or the lower end of y): edges.size() - 1 heights.
  void columns(std::span<const double> edges, std::span<const double> heights, Rgb colour);
  // A horizontal bar from x0 to x1 with a text after it, as the `row`-th from above.
  void bar(double x0, double x1, int row, Rgb colour, std::string_view text);
  void horizontal(double y, Rgb colour);
  // A text to the upper right of a place.
  void label(const Point& place, std::string_view text, Rgb colour);

 private:
  [[nodiscard]] Point at(double x, double y) const;
  void draw_axes(std::string_view x_label, std::string_view y_label);

  Canvas& canvas_;
  double unit_;  // a hundredth of the width of the box
  Box plot_;
  Interval x_, y_;
};

}  // namespace thermedge::figures
