#include "motion.hpp"

#include <algorithm>
#include <cmath>

#include "portable.hpp"
#include "view.hpp"

namespace thermedge::sim {
namespace {

void shift(Quad& quad, Vec3 by) { quad.corner = quad.corner + by; }
void shift(Box& box, Vec3 by) { box.centre = box.centre + by; }
void shift(Sphere& sphere, Vec3 by) { sphere.centre = sphere.centre + by; }
void shift(Cylinder& cylinder, Vec3 by) {
  cylinder.from = cylinder.from + by;
  cylinder.to = cylinder.to + by;
}

// What is straight ahead of the camera's first place, level. Lengths are shares of the distance to
// the point that it looks at, so that things fit into scenes of any size.
struct Stage {
  Vec3 eye, right, ahead, up;
  double size_m;

  explicit Stage(const Viewpoint& view) : eye(view.position), up{0, 0, 1} {
    const Vec3 way = view.look_at - view.position;
    size_m = norm(way);
    ahead = unit(way);
    right = unit(cross(ahead, up));
  }
  [[nodiscard]] Vec3 at(double to_right, double depth) const {
    return eye + right * (to_right * size_m) + ahead * (depth * size_m);
  }
};

constexpr double kBoxDepth = 0.4;
constexpr double kBoxSize = 0.1;
constexpr double kBoxReach = 0.12;  // to both sides
constexpr double kHotDepth = 0.5;
constexpr double kHotRadius = 0.03;
constexpr double kHotHeight = 0.25;
constexpr double kHotEnd = 0.08;  // right of the middle

// Metres a second of what moves by `px_per_frame` at this depth.
double speed_of(const CameraOptions& camera, double px_per_frame, double depth_m) {
  return px_per_frame * camera.rate_hz * depth_m / intrinsics_of(camera).fx_px;
}

Object moving_box(const SceneOptions& options, const World& world) {
  const Stage stage(world.view);
  Box box;
  box.centre = stage.at(-kBoxReach, kBoxDepth);
  box.size = Vec3{1, 1, 1} * (kBoxSize * stage.size_m);
  box.yaw_rad = radians(30);
  // Sides of different temperature, so that the edges between them show.
  for (std::size_t side = 0; side < kSides; ++side) {
    const double share = 1 - 0.15 * static_cast<double>(side);
    box.surfaces[side].temperature_degc =
        world.reflected_degc + share * options.moving.box_warmer_degc;
  }
  const double way_m = 2 * kBoxReach * stage.size_m;
  const double speed =
      speed_of(options.camera, options.moving.box_speed_px, kBoxDepth * stage.size_m);
  Motion motion;
  if (speed > 0) {
    motion = {stage.right * way_m, 0, way_m / speed, true};
  }
  return {"moving box", box, motion};
}

Object hot_thing(const SceneOptions& options, const World& world) {
  const Stage stage(world.view);
  const SinCos half = sin_cos(radians(options.camera.fov_deg) / 2);
  // Just outside of the picture, whose border distortion may carry outwards.
  const double outside = 1.3 * kHotDepth * half.sin / half.cos + kHotRadius;
  const Vec3 middle = stage.at(-outside, kHotDepth);
  const Vec3 up = stage.up * (kHotHeight / 2 * stage.size_m);
  Cylinder cylinder;
  cylinder.from = middle - up;
  cylinder.to = middle + up;
  cylinder.radius = kHotRadius * stage.size_m;
  cylinder.surface.temperature_degc = options.moving.hot_degc;
  cylinder.ends.fill(cylinder.surface);
  const double way_m = (outside + kHotEnd) * stage.size_m;
  const double speed =
      speed_of(options.camera, options.moving.hot_speed_px, kHotDepth * stage.size_m);
  return {
      "hot thing", cylinder, {stage.right * way_m, options.moving.hot_at_s, way_m / speed, false}};
}

}  // namespace

Vec3 moved_by(const Motion& motion, double seconds) {
  const double ways = std::max(0.0, (seconds - motion.from_s) / motion.in_s);
  const double phase = ways - 2 * std::floor(ways / 2);
  const double share = motion.back ? (phase <= 1 ? phase : 2 - phase) : std::min(ways, 1.0);
  return motion.by_m * share;
}

World world_at(const World& world, double seconds) {
  World now = world;
  for (Object& object : now.objects) {
    const Vec3 by = moved_by(object.motion, seconds);
    std::visit([&](auto& shape) { shift(shape, by); }, object.shape);
  }
  return now;
}

void add_moving_things(const SceneOptions& options, World& world) {
  if (options.moving.box != 0) {
    world.objects.push_back(moving_box(options, world));
  }
  if (options.moving.hot != 0) {
    world.objects.push_back(hot_thing(options, world));
  }
}

}  // namespace thermedge::sim
