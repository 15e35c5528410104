// What scenes are painted from: polygons with a temperature.
#pragma once

#include <vector>

#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {

// Closed, without repeating the first point; it does not cross itself.
using Outline = std::vector<Point>;

// Straight through the given points.
[[nodiscard]] Outline polygon(std::vector<Point> points);
// Quadrilateral whose corners are rounded with a radius, px.
[[nodiscard]] Outline rounded(const std::vector<Point>& points, double radius_px);
[[nodiscard]] Outline rectangle(double x0, double y0, double x1, double y1, double radius_px = 0);
[[nodiscard]] Outline ellipse(Point centre, double radius_x, double radius_y);
// A round vessel seen from slightly above: straight sides down from the rim's ends, and the near
// half of an ellipse as its bottom.
[[nodiscard]] Outline vessel(Point rim_left, Point rim_right, Point bottom, double radius_x,
                             double radius_y);
// A band of constant width along a quadratic Bezier curve: cables, handles, pipes.
[[nodiscard]] Outline band(Point from, Point control, Point to, double width_px);
// Turned about a centre; the angle is given as its half's tangent, which keeps it exact.
[[nodiscard]] Outline turned(const Outline& outline, Point centre, double tangent_of_half_angle);

// Painted in order; a later object hides earlier ones.
struct Object {
  int id = 0;
  Outline outline;
  double counts = 0;                // at the centre of the outline's bounding box
  double slope_x = 0, slope_y = 0;  // counts per px
};

struct Box {
  double x_min = 0, y_min = 0, x_max = 0, y_max = 0;
};
[[nodiscard]] Box bounds(const Outline& outline);

// The noise-free scene in frame coordinates: a background and objects on it.
class Scene {
 public:
  Scene(double background_counts, double slope_x, double slope_y)
      : background_{background_counts, slope_x, slope_y} {}

  // Adds an object on top; its id is its number in the order of adding.
  void add(Outline outline, double counts, double slope_x = 0, double slope_y = 0);
  // Maps the scene, its temperature gradients included, to p * scale + shift.
  void transform(double scale_x, double scale_y, Point shift);

  [[nodiscard]] const std::vector<Object>& objects() const { return objects_; }
  [[nodiscard]] const Box& box(std::size_t object) const { return boxes_[object]; }
  [[nodiscard]] double background_at(Point p) const;
  [[nodiscard]] double object_at(std::size_t object, Point p) const;
  // The topmost object below `limit` that holds p; -1: the background.
  [[nodiscard]] int topmost_below(std::size_t limit, Point p) const;
  // Whether an object above `object` holds p.
  [[nodiscard]] bool hidden(std::size_t object, Point p) const;

 private:
  struct Background {
    double counts, slope_x, slope_y;
  };
  Background background_;
  std::vector<Object> objects_;
  std::vector<Box> boxes_;
};

}  // namespace thermedge::sim
