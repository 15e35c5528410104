#include "chart.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace thermedge::figures {

Interval widened(Interval interval, double share) {
  if (!(interval.max > interval.min)) {
    const double half = std::max(std::abs(interval.min) * 0.05, 0.5);
    interval = {interval.min - half, interval.min + half};
  }
  const double margin = share * interval.length();
  return {interval.min - margin, interval.max + margin};
}

std::vector<double> ticks(const Interval& interval, int wanted) {
  const double raw = interval.length() / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double factor = raw / power;
  const double step = power * (factor > 5 ? 10 : factor > 2 ? 5 : factor > 1 ? 2 : 1);
  std::vector<double> values;
  // Counted in steps, so that 0 is exactly 0.
  const auto last = static_cast<long>(std::floor(interval.max / step + 1e-9));
  for (auto i = static_cast<long>(std::ceil(interval.min / step - 1e-9)); i <= last; ++i) {
    values.push_back(static_cast<double>(i) * step);
  }
  return values;
}

Chart::Chart(Canvas& canvas, const Box& box, const Interval& x, const Interval& y,
             std::string_view x_label, std::string_view y_label)
    : canvas_(canvas),
      unit_(box.width / 100),
      plot_{box.x + 11 * unit_, box.y + 5 * unit_, box.width - 13 * unit_, box.height - 14 * unit_},
      x_(x),
      y_(y) {
  draw_axes(x_label, y_label);
}

Point Chart::at(double x, double y) const {
  const double right = std::clamp((x - x_.min) / x_.length(), 0.0, 1.0);
  const double up = std::clamp((y - y_.min) / y_.length(), 0.0, 1.0);
  return {plot_.x + right * plot_.width, plot_.bottom() - up * plot_.height};
}

void Chart::draw_axes(std::string_view x_label, std::string_view y_label) {
  TextStyle style{.size = 2.7 * unit_, .colour = kSoftInk, .align = Align::kCentre};
  for (const double tick : ticks(x_, 6)) {
    const Point ends[] = {at(tick, y_.min), {at(tick, y_.min).x, plot_.bottom() + unit_}};
    canvas_.line(ends, false, kSoftInk, 0.15 * unit_);
    canvas_.text({ends[1].x, ends[1].y + 3 * unit_}, fmt::format("{:g}", tick), style);
  }
  style.align = Align::kRight;
  for (const double tick : ticks(y_, 5)) {
    const Point ends[] = {at(x_.min, tick), at(x_.max, tick)};
    canvas_.line(ends, false, kHairline, 0.12 * unit_);
    canvas_.text({plot_.x - unit_, ends[0].y + unit_}, fmt::format("{:g}", tick), style);
  }
  const Point corner[] = {at(x_.min, y_.max), at(x_.min, y_.min), at(x_.max, y_.min)};
  canvas_.line(corner, false, kSoftInk, 0.15 * unit_);
  style.colour = kInk;
  canvas_.text({plot_.right(), plot_.bottom() + 7.6 * unit_}, x_label, style);
  style.align = Align::kLeft;
  canvas_.text({plot_.x - 9 * unit_, plot_.y - 2 * unit_}, y_label, style);
}

void Chart::line(std::span<const Point> data, Rgb colour) {
  std::vector<Point> points;
  points.reserve(data.size());
  for (const Point& point : data) {
    points.push_back(at(point.x, point.y));
  }
  if (points.size() == 1) {
    canvas_.mark(Mark::kDisc, points[0], 1.2 * unit_, colour);
  }
  canvas_.line(points, false, colour, 0.3 * unit_);
}

void Chart::columns(std::span<const double> edges, std::span<const double> heights, Rgb colour) {
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const Point top = at(edges[i], heights[i]);
    const Point foot = at(edges[i + 1], 0);
    canvas_.fill({top.x, top.y, foot.x - top.x, foot.y - top.y}, colour);
  }
}

void Chart::bar(double x0, double x1, int row, Rgb colour, std::string_view text) {
  const double y = plot_.y + (1.5 + 4.6 * row) * unit_;
  const Point left = at(x0, y_.max);
  const Point right = at(x1, y_.max);
  canvas_.fill({left.x, y, std::max(right.x - left.x, 0.5 * unit_), 1.4 * unit_}, colour);
  // Behind the bar where there is room, else under its end.
  TextStyle style{.size = 2.5 * unit_, .colour = kInk};
  const double width = canvas_.text_width(text, style);
  const bool room = right.x + unit_ + width <= plot_.right();
  canvas_.text(
      {room ? right.x + unit_ : plot_.right() - width, room ? y + 1.6 * unit_ : y + 4 * unit_},
      text, style);
}

void Chart::label(const Point& place, std::string_view text, Rgb colour) {
  const Point corner = at(place.x, place.y);
  canvas_.text({corner.x + 0.8 * unit_, corner.y - 0.8 * unit_}, text,
               {.size = 2.5 * unit_, .colour = colour});
}

void Chart::horizontal(double y, Rgb colour) {
  const Point ends[] = {at(x_.min, y), at(x_.max, y)};
  canvas_.line(ends, false, colour, 0.25 * unit_);
}

}  // namespace thermedge::figures
