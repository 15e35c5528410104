#include "corner_angle.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace thermedge::detail {
namespace {

struct Point {
  double x;  // down
  double y;  // right
};

Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
double direction(Point v) { return std::atan2(v.y, v.x); }

// Centre of the circle through three points that are not on a line.
Point circle_centre(Point a, Point b, Point c) {
  const Point ab = b - a;
  const Point ac = c - a;
  const double ab_squared = ab.x * ab.x + ab.y * ab.y;
  const double ac_squared = ac.x * ac.x + ac.y * ac.y;
  const double scale = 2 * cross(ab, ac);
  return {a.x + (ab_squared * ac.y - ac_squared * ab.y) / scale,
          a.y + (ac_squared * ab.x - ab_squared * ac.x) / scale};
}

// Direction in which a circle leaves its point `a` towards `b`.
double tangent_direction(Point a, Point b, Point centre) {
  const Point radius = centre - a;
  const double turn = cross(radius, b - a);
  const double quarter = turn > 0 ? std::numbers::pi / 2 : turn < 0 ? -std::numbers::pi / 2 : 0.0;
  return direction(radius) + quarter;
}

// The arm of `length` samples that begins at `corner` and goes on in steps of `step` (1 or -1).
double arm_direction(std::span<const double> rows, std::span<const double> columns,
                     std::size_t corner, std::ptrdiff_t step, std::size_t length) {
  constexpr double kStraight = 1e-8;
  constexpr std::size_t kShort = 3;
  const auto sample = [&](std::size_t i) {
    const std::size_t at = corner + static_cast<std::size_t>(step) * i;
    return Point{rows[at], columns[at]};
  };
  const Point first = sample(0);
  const Point last = sample(length - 1);
  if (length <= kShort) {
    return direction(last - first);
  }
  // An arm that returns to its start, once around a loop, has no chord: thirds instead of halves.
  const bool returns = first.x == last.x && first.y == last.y;
  const Point middle = sample((returns ? (length + 2) / 3 : (length + 1) / 2) - 1);
  const Point far = returns ? sample((2 * length + 2) / 3 - 1) : last;
  if (std::abs(cross(first - middle, first - far)) < kStraight) {
    return direction(last - first);
  }
  return tangent_direction(first, middle, circle_centre(first, middle, far));
}

}  // namespace

double corner_angle_deg(std::span<const double> rows, std::span<const double> columns,
                        std::size_t corner) {
  const double before = arm_direction(rows, columns, corner, -1, corner + 1);
  const double behind = arm_direction(rows, columns, corner, 1, rows.size() - corner);
  constexpr double kDegrees = 180 / std::numbers::pi;
  return std::abs(before * kDegrees - behind * kDegrees);
}

}  // namespace thermedge::detail
