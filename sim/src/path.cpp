#include "path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "portable.hpp"
#include "random.hpp"
#include "view.hpp"

namespace thermedge::sim {
namespace {

enum Stream : std::uint64_t { kPosition = 20, kAngle = 23 };

// Three smooth random courses of time in -1..1, zero at the start. `jerky`: most
// ways are short.
Vec3 wander(std::uint64_t seed, std::uint64_t stream, double knots, bool jerky = false) {
  const double whole = std::floor(knots);
  const double t = knots - whole;
  const double blend = t * t * (3 - 2 * t);
  const auto course = [&](std::uint64_t axis) {
    const Random random(seed, stream + axis);
    const auto at = [&](double knot) {
      const double place =
          knot == 0 ? 0.0 : random.uniform(static_cast<std::uint64_t>(knot), -1, 1);
      return jerky ? place * std::abs(place) : place;
    };
    return at(whole) + (at(whole + 1) - at(whole)) * blend;
  };
  return {course(0), course(1), course(2)};
}

// There and back: 0..1..0.. with a soft turn at both ends.
double to_and_fro(double turns) {
  const double phase = turns - 2 * std::floor(turns / 2);
  const double t = phase <= 1 ? phase : 2 - phase;
  constexpr double kTurn = 0.05;  // share of the way in which the speed builds up
  const auto ease = [](double s) { return s * s / (2 * kTurn); };
  const double whole = 1 - kTurn;
  if (t < kTurn) {
    return ease(t) / whole;
  }
  return t > 1 - kTurn ? 1 - ease(1 - t) / whole : (t - kTurn / 2) / whole;
}

// The point at `distance` along the way, and where the way goes there.
struct WayPoint {
  Vec3 position, heading;
};

WayPoint along(const std::vector<Vec3>& way, double distance) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec3 leg = way[i] - way[i - 1];
    const double length = norm(leg);
    if (distance <= length || i + 1 == way.size()) {
      const double share = length > 0 ? std::min(distance / length, 1.0) : 0;
      return {way[i - 1] + leg * share, length > 0 ? leg * (1 / length) : Vec3{}};
    }
    distance -= length;
  }
  return {way.front(), {}};
}

// Half the tangent of the viewpoint's roll, as turned() wants it.
Vec3 roll(const Viewpoint& view) {
  const SinCos half = sin_cos(view.roll_rad / 2);
  return {0, 0, half.sin / half.cos};
}

Pose drive(const Viewpoint& view, const SceneOptions& options, double seconds) {
  const Vec3 ahead = view.look_at - view.position;
  constexpr double kStraightM = 3;
  std::vector<Vec3> way = {view.position};
  if (view.waypoints.empty()) {
    way.push_back(view.position + unit(Vec3{ahead.x, ahead.y, 0}) * kStraightM);
  }
  way.insert(way.end(), view.waypoints.begin(), view.waypoints.end());
  double length = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    length += norm(way[i] - way[i - 1]);
  }
  const double distance = length * to_and_fro(seconds * view.speed_m_per_s / length);
  // The mean over positions a little before and after turns corners softly.
  constexpr double kLookM = 0.4;
  const WayPoint here = along(way, distance);
  const Vec3 heading = along(way, std::max(0.0, distance - kLookM)).heading + here.heading +
                       along(way, distance + kLookM).heading;
  const double tilt = ahead.z / norm({ahead.x, ahead.y, 0});
  const Vec3 level = unit({heading.x, heading.y, 0});
  const Vec3 bumps = wander(options.seed, kAngle, seconds * 6);
  const Axes axes = turned(upright({level.x, level.y, tilt}), roll(view));
  return pose_of(here.position + Vec3{0, 0, 0.004 * bumps.z},
                 turned(axes, {0.002 * bumps.x, 0.001 * bumps.y, 0.001 * bumps.z}));
}

Pose shake(const Viewpoint& view, const Axes& start, const SceneOptions& options, double seconds) {
  constexpr double kKnotsPerSecond = 8;
  constexpr double kReach = 80 / 383.0 / 2;  // half the tangent of 80 px
  const double knots = seconds * kKnotsPerSecond;
  const Vec3 angle = wander(options.seed, kAngle, knots, true);
  const Vec3 jitter = wander(options.seed, kPosition, knots / 4);
  return pose_of(view.position + jitter * 0.015,
                 turned(start, Vec3{0.6 * angle.x, angle.y, angle.z / 10} * kReach));
}

}  // namespace

Pose pose_at(const Viewpoint& view, const SceneOptions& options, int index) {
  const double seconds = index / options.camera.rate_hz * options.path_speed;
  const Axes start = turned(upright(view.look_at - view.position), roll(view));
  switch (options.path) {
    case PathKind::kHand: {
      constexpr double kKnotsPerSecond = 10;
      constexpr double kReach = 6 / 383.0 / 2;  // half the tangent of 6 px
      const double knots = seconds * kKnotsPerSecond;
      const Vec3 angle = wander(options.seed, kAngle, knots);
      const Vec3 jitter = wander(options.seed, kPosition, knots / 4);
      return pose_of(view.position + jitter * 0.015,
                     turned(start, Vec3{angle.x, angle.y, angle.z / 2} * kReach));
    }
    case PathKind::kDrive:
      return drive(view, options, seconds);
    case PathKind::kPan: {
      constexpr double kPeriodS = 8;
      constexpr double kReachRad = radians(20);
      const double turns = seconds / kPeriodS;
      const double sine = sin_cos(2 * std::numbers::pi * (turns - std::floor(turns))).sin;
      const SinCos half = sin_cos(kReachRad * sine / 2);
      return pose_of(view.position, turned(start, {0, half.sin / half.cos, 0}));
    }
    case PathKind::kShake:
      return shake(view, start, options, seconds);
    case PathKind::kStill:
      break;
  }
  return pose_of(view.position, start);
}

}  // namespace thermedge::sim
