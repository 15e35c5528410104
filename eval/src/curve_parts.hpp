// Curves part by part.
#pragma once

#include <algorithm>
#include <cmath>

#include "thermedge/eval/curves.hpp"

namespace thermedge::eval {

inline constexpr double kPiecePx = 0.5;  // longest piece that counts as one

inline Point between(Point a, Point b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

inline double distance(Point a, Point b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return std::sqrt(dx * dx + dy * dy);
}

// Calls visit(from, to) for each straight part of a curve; a lone point is a part of length 0.
template <class F>
void for_each_part(const Curve& curve, F&& visit) {
  const auto& points = curve.points;
  if (points.size() == 1) {
    visit(points[0], points[0]);
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    visit(points[i - 1], points[i]);
  }
  if (curve.closed && points.size() > 2) {
    visit(points.back(), points.front());
  }
}

[[nodiscard]] inline double length_px(const Curve& curve) {
  double sum = 0;
  for_each_part(curve, [&](Point from, Point to) { sum += distance(from, to); });
  return sum;
}

// Calls visit(middle, length) for equal pieces of at most kPiecePx between two points.
template <class F>
void for_each_piece(Point from, Point to, F&& visit) {
  const double length = distance(from, to);
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / kPiecePx)));
  for (int i = 0; i < pieces; ++i) {
    visit(between(from, to, (i + 0.5) / pieces), length / pieces);
  }
}

// The same for all parts of a curve.
template <class F>
void for_each_piece(const Curve& curve, F&& visit) {
  for_each_part(curve, [&](Point from, Point to) { for_each_piece(from, to, visit); });
}

}  // namespace thermedge::eval
