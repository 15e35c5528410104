#include "view.hpp"

#include <algorithm>
#include <cmath>

#include "portable.hpp"

namespace thermedge::sim {
namespace {

// Shepperd's method: the largest component by a square root, the others from it.
std::array<double, 4> quaternion(const Axes& a) {
  const double xx = a.right.x;
  const double yy = a.down.y;
  const double zz = a.forward.z;
  const auto root = [](double square) { return std::sqrt(std::max(0.0, square)); };
  std::array<double, 4> q{};
  if (xx + yy + zz > 0) {
    const double s = 2 * root(1 + xx + yy + zz);
    q = {(a.down.z - a.forward.y) / s, (a.forward.x - a.right.z) / s, (a.right.y - a.down.x) / s,
         s / 4};
  } else if (xx >= yy && xx >= zz) {
    const double s = 2 * root(1 + xx - yy - zz);
    q = {s / 4, (a.down.x + a.right.y) / s, (a.forward.x + a.right.z) / s,
         (a.down.z - a.forward.y) / s};
  } else if (yy >= zz) {
    const double s = 2 * root(1 + yy - xx - zz);
    q = {(a.down.x + a.right.y) / s, s / 4, (a.forward.y + a.down.z) / s,
         (a.forward.x - a.right.z) / s};
  } else {
    const double s = 2 * root(1 + zz - xx - yy);
    q = {(a.forward.x + a.right.z) / s, (a.forward.y + a.down.z) / s, s / 4,
         (a.right.y - a.down.x) / s};
  }
  if (q[3] < 0) {
    q = {-q[0], -q[1], -q[2], -q[3]};
  }
  return q;
}

double stretch(const Intrinsics& i, double square) { return 1 + square * (i.k1 + square * i.k2); }

}  // namespace

Axes axes_of(const Pose& pose) {
  const auto [x, y, z, w] = pose.orientation_xyzw;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
          {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
          {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
}

Pose pose_of(Vec3 position, const Axes& axes) { return {position, quaternion(axes)}; }

Axes upright(Vec3 forward) {
  const Vec3 ahead = unit(forward);
  const Vec3 right = unit(cross(ahead, {0, 0, 1}));
  return {right, cross(ahead, right), ahead};
}

// The rotation of the quaternion (t, 1) / |(t, 1)|.
Axes turned(const Axes& axes, Vec3 t) {
  const double square = 1 + dot(t, t);
  const auto rotated = [&](Vec3 p) {
    const Vec3 c = cross(t, p);
    return p + (c + cross(t, c)) * (2 / square);
  };
  const auto outward = [&](Vec3 p) {
    return axes.right * p.x + axes.down * p.y + axes.forward * p.z;
  };
  return {outward(rotated({1, 0, 0})), outward(rotated({0, 1, 0})), outward(rotated({0, 0, 1}))};
}

Lens::Lens(const Intrinsics& intrinsics) : intrinsics_(intrinsics) {
  constexpr double kMargin = 1.1;
  const double w = intrinsics.width - 0.5;
  const double h = intrinsics.height - 0.5;
  for (const Point corner : {Point{-0.5, -0.5}, Point{w, -0.5}, Point{-0.5, h}, Point{w, h}}) {
    const Point p = ray(corner);
    reach_ = {std::max(reach_.x, kMargin * std::abs(p.x)),
              std::max(reach_.y, kMargin * std::abs(p.y))};
  }
}

Point Lens::ray(Point pixel) const {
  const Intrinsics& i = intrinsics_;
  const Point bent{(pixel.x - i.cx_px) / i.fx_px, (pixel.y - i.cy_px) / i.fy_px};
  Point p = bent;
  if (i.k1 == 0 && i.k2 == 0) {
    return p;
  }
  constexpr int kMostSteps = 50;
  for (int step = 0; step < kMostSteps; ++step) {
    const double factor = stretch(i, p.x * p.x + p.y * p.y);
    const Point next{bent.x / factor, bent.y / factor};
    const double change = std::abs(next.x - p.x) + std::abs(next.y - p.y);
    p = next;
    if (change < 1e-14) {
      break;
    }
  }
  return p;
}

Point Lens::pixel(Point ray) const {
  const Intrinsics& i = intrinsics_;
  const double factor = stretch(i, ray.x * ray.x + ray.y * ray.y);
  return {i.cx_px + i.fx_px * ray.x * factor, i.cy_px + i.fy_px * ray.y * factor};
}

double Lens::light(Point pixel, double vignetting) const {
  const double dx = pixel.x - intrinsics_.cx_px;
  const double dy = pixel.y - intrinsics_.cy_px;
  const double corner =
      intrinsics_.cx_px * intrinsics_.cx_px + intrinsics_.cy_px * intrinsics_.cy_px;
  return 1 - vignetting * (dx * dx + dy * dy) / corner;
}

Intrinsics intrinsics_of(const CameraOptions& camera) {
  const SinCos half = sin_cos(radians(camera.fov_deg) / 2);
  const double focal_px = camera.width / 2.0 * half.cos / half.sin;
  return {.width = camera.width,
          .height = camera.height,
          .fx_px = focal_px,
          .fy_px = focal_px,
          .cx_px = (camera.width - 1) / 2.0,
          .cy_px = (camera.height - 1) / 2.0,
          .k1 = camera.k1,
          .k2 = camera.k2};
}

}  // namespace thermedge::sim
