#include "camera_view.hpp"

#include <cmath>

namespace thermedge::eval {
namespace {

struct Vector {
  double x, y, z;
};

// v turned by the quaternion.
Vector turn(const std::array<double, 4>& xyzw, Vector v) {
  const auto [x, y, z, w] = xyzw;
  const Vector t{2 * (y * v.z - z * v.y), 2 * (z * v.x - x * v.z), 2 * (x * v.y - y * v.x)};
  return {v.x + w * t.x + y * t.z - z * t.y, v.y + w * t.y + z * t.x - x * t.z,
          v.z + w * t.z + x * t.y - y * t.x};
}

double stretch(const CameraView& view, double square) {
  return 1 + square * (view.k1 + square * view.k2);
}

// x / z and y / z of the ray of a pixel: fixed-point iteration.
Point ray(const CameraView& view, Point pixel) {
  const Point bent{(pixel.x - view.cx_px) / view.fx_px, (pixel.y - view.cy_px) / view.fy_px};
  Point p = bent;
  constexpr int kSteps = 30;
  for (int step = 0; step < kSteps; ++step) {
    const double factor = stretch(view, p.x * p.x + p.y * p.y);
    p = {bent.x / factor, bent.y / factor};
  }
  return p;
}

}  // namespace

std::optional<Point> turned(Point point, const CameraView& from, const CameraView& to) {
  const Point p = ray(from, point);
  const auto [x, y, z, w] = to.orientation_xyzw;
  const Vector v = turn({-x, -y, -z, w}, turn(from.orientation_xyzw, {p.x, p.y, 1}));
  if (v.z <= 0) {
    return std::nullopt;
  }
  const Point q{v.x / v.z, v.y / v.z};
  const double factor = stretch(to, q.x * q.x + q.y * q.y);
  return Point{to.cx_px + to.fx_px * q.x * factor, to.cy_px + to.fy_px * q.y * factor};
}

}  // namespace thermedge::eval
