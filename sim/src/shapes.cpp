#include "shapes.hpp"

#include <algorithm>
#include <cmath>

namespace thermedge::sim {
namespace {

// cos and sin of the multiples of a turn / 2^k, by halving angles: square roots only.
std::vector<Point> unit_circle(int doublings) {
  std::vector<Point> circle = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (int i = 0; i < doublings; ++i) {
    std::vector<Point> finer;
    for (std::size_t k = 0; k < circle.size(); ++k) {
      const Point a = circle[k];
      const Point b = circle[(k + 1) % circle.size()];
      const Point sum{a.x + b.x, a.y + b.y};
      const double length = std::sqrt(sum.x * sum.x + sum.y * sum.y);
      finer.push_back(a);
      finer.push_back({sum.x / length, sum.y / length});
    }
    circle = std::move(finer);
  }
  return circle;
}

Point bezier(Point a, Point b, Point c, double t) {
  const double s = 1 - t;
  return {s * s * a.x + 2 * s * t * b.x + t * t * c.x, s * s * a.y + 2 * s * t * b.y + t * t * c.y};
}

Point towards(Point from, Point to, double distance) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double length = std::sqrt(dx * dx + dy * dy);
  return {from.x + dx / length * distance, from.y + dy / length * distance};
}

constexpr int kCurveSteps = 16;

// Even-odd crossing count; for outlines that do not cross themselves.
bool holds(const Outline& outline, Point p) {
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Point a = outline[i];
    const Point b = outline[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
      inside = !inside;
    }
  }
  return inside;
}

bool holds(const Box& box, Point p) {
  return p.x >= box.x_min && p.x <= box.x_max && p.y >= box.y_min && p.y <= box.y_max;
}

}  // namespace

Outline polygon(std::vector<Point> points) { return points; }

Outline rounded(const std::vector<Point>& points, double radius_px) {
  if (radius_px <= 0) {
    return points;
  }
  Outline outline;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point corner = points[i];
    const Point before =
        towards(corner, points[(i + points.size() - 1) % points.size()], radius_px);
    const Point behind = towards(corner, points[(i + 1) % points.size()], radius_px);
    for (int k = 0; k <= kCurveSteps; ++k) {
      outline.push_back(bezier(before, corner, behind, static_cast<double>(k) / kCurveSteps));
    }
  }
  return outline;
}

Outline rectangle(double x0, double y0, double x1, double y1, double radius_px) {
  return rounded({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, radius_px);
}

Outline ellipse(Point centre, double radius_x, double radius_y) {
  static const std::vector<Point> kCircle = unit_circle(6);
  Outline outline;
  for (const Point p : kCircle) {
    outline.push_back({centre.x + radius_x * p.x, centre.y + radius_y * p.y});
  }
  return outline;
}

Outline vessel(Point rim_left, Point rim_right, Point bottom, double radius_x, double radius_y) {
  Outline outline = {rim_left, rim_right};
  for (const Point p : ellipse(bottom, radius_x, radius_y)) {
    if (p.y >= bottom.y) {  // from the right end round to the left one
      outline.push_back(p);
    }
  }
  return outline;
}

Outline band(Point from, Point control, Point to, double width_px) {
  constexpr int kSteps = 3 * kCurveSteps;
  Outline left;
  Outline right;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    const Point p = bezier(from, control, to, t);
    // The derivative of the curve, up to a factor.
    const double dx = (1 - t) * (control.x - from.x) + t * (to.x - control.x);
    const double dy = (1 - t) * (control.y - from.y) + t * (to.y - control.y);
    const double scale = width_px / 2 / std::sqrt(dx * dx + dy * dy);
    left.push_back({p.x - dy * scale, p.y + dx * scale});
    right.push_back({p.x + dy * scale, p.y - dx * scale});
  }
  left.insert(left.end(), right.rbegin(), right.rend());
  return left;
}

Outline turned(const Outline& outline, Point centre, double tangent_of_half_angle) {
  const double t = tangent_of_half_angle;
  const double c = (1 - t * t) / (1 + t * t);
  const double s = 2 * t / (1 + t * t);
  Outline result;
  for (const Point p : outline) {
    const double dx = p.x - centre.x;
    const double dy = p.y - centre.y;
    result.push_back({centre.x + c * dx - s * dy, centre.y + s * dx + c * dy});
  }
  return result;
}

Box bounds(const Outline& outline) {
  Box box{outline[0].x, outline[0].y, outline[0].x, outline[0].y};
  for (const Point p : outline) {
    box = {std::min(box.x_min, p.x), std::min(box.y_min, p.y), std::max(box.x_max, p.x),
           std::max(box.y_max, p.y)};
  }
  return box;
}

void Scene::add(Outline outline, double counts, double slope_x, double slope_y) {
  boxes_.push_back(bounds(outline));
  objects_.push_back(
      {static_cast<int>(objects_.size()), std::move(outline), counts, slope_x, slope_y});
}

void Scene::transform(double scale_x, double scale_y, Point shift) {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    for (Point& p : objects_[i].outline) {
      p = {p.x * scale_x + shift.x, p.y * scale_y + shift.y};
    }
    objects_[i].slope_x /= scale_x;
    objects_[i].slope_y /= scale_y;
    boxes_[i] = bounds(objects_[i].outline);
  }
  background_.slope_x /= scale_x;
  background_.slope_y /= scale_y;
  background_.counts -= background_.slope_x * shift.x + background_.slope_y * shift.y;
}

double Scene::background_at(Point p) const {
  return background_.counts + background_.slope_x * p.x + background_.slope_y * p.y;
}

double Scene::object_at(std::size_t object, Point p) const {
  const Object& o = objects_[object];
  const Box& box = boxes_[object];
  return o.counts + o.slope_x * (p.x - (box.x_min + box.x_max) / 2) +
         o.slope_y * (p.y - (box.y_min + box.y_max) / 2);
}

int Scene::topmost_below(std::size_t limit, Point p) const {
  for (std::size_t i = limit; i-- > 0;) {
    if (sim::holds(boxes_[i], p) && sim::holds(objects_[i].outline, p)) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

bool Scene::hidden(std::size_t object, Point p) const {
  return topmost_below(objects_.size(), p) > static_cast<int>(object);
}

}  // namespace thermedge::sim
