// Where the simulated camera goes.
#include <gtest/gtest.h>

#include <cmath>

#include "path.hpp"
#include "view.hpp"

namespace thermedge::sim {
namespace {

const Viewpoint kView{{1, 2, 1.5}, {2, 6, 1.2}, 0, {}, 0.5};

SceneOptions on_path(PathKind kind) {
  SceneOptions options;
  options.path = kind;
  options.frames = 1000;
  return options;
}

double turn_between(const Pose& a, const Pose& b) {
  double product = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    product += a.orientation_xyzw[i] * b.orientation_xyzw[i];
  }
  return 2 * std::acos(std::min(1.0, std::abs(product)));
}

TEST(Pose, LooksWhereItShould) {
  const Pose pose = pose_at(kView, on_path(PathKind::kStill), 7);
  EXPECT_EQ(pose.position_m, kView.position);
  const Axes axes = axes_of(pose);
  const Vec3 ahead = unit(kView.look_at - kView.position);
  EXPECT_NEAR(norm(axes.forward - ahead), 0, 1e-12);
  EXPECT_NEAR(axes.right.z, 0, 1e-12);
  EXPECT_LT(axes.down.z, -0.9);
  EXPECT_NEAR(norm(cross(axes.right, axes.down) - axes.forward), 0, 1e-12);
}

// Every branch of the way from axes to a quaternion.
TEST(Pose, QuaternionsKeepTheAxes) {
  for (const Vec3 forward : {Vec3{0, 1, 0}, Vec3{0, -1, 0.1}, Vec3{1, 0.2, -2}, Vec3{-3, 0.1, 0.4},
                             Vec3{0.2, -0.1, 5}, Vec3{-1, -1, -1}}) {
    for (const double roll : {0.0, 0.4, -3.0, 30.0}) {
      const Axes axes = turned(upright(forward), {0, 0, roll});
      const Axes back = axes_of(pose_of({}, axes));
      EXPECT_NEAR(norm(back.right - axes.right), 0, 1e-12);
      EXPECT_NEAR(norm(back.down - axes.down), 0, 1e-12);
      EXPECT_NEAR(norm(back.forward - axes.forward), 0, 1e-12);
    }
  }
}

TEST(Path, IsSmoothAndStaysInReach) {
  for (const PathKind kind : {PathKind::kHand, PathKind::kDrive, PathKind::kPan}) {
    const SceneOptions options = on_path(kind);
    Pose last = pose_at(kView, options, 0);
    double most = 0;
    for (int i = 1; i < 1000; ++i) {
      const Pose pose = pose_at(kView, options, i);
      EXPECT_LT(norm(pose.position_m - last.position_m), 0.02);
      EXPECT_LT(turn_between(pose, last), 0.02);
      most = std::max(most, norm(pose.position_m - kView.position) + turn_between(pose, last));
      last = pose;
    }
    EXPECT_GT(most, 0.003);
    EXPECT_LT(most, 3.2);
  }
}

TEST(Path, OfAHandStartsAtTheViewpointAndDependsOnTheSeed) {
  SceneOptions options = on_path(PathKind::kHand);
  EXPECT_EQ(pose_at(kView, options, 0).position_m, kView.position);
  const Pose one = pose_at(kView, options, 100);
  options.seed = 2;
  EXPECT_GT(turn_between(one, pose_at(kView, options, 100)), 1e-4);
}

TEST(Path, DriveFollowsItsWaypointsThereAndBack) {
  Viewpoint view = kView;
  view.waypoints = {{1, 4, 1.5}, {3, 4, 1.5}};
  view.speed_m_per_s = 1;
  const SceneOptions options = on_path(PathKind::kDrive);
  const auto nearest = [&](Vec3 place) {
    double least = 1e9;
    for (int i = 0; i < 640; ++i) {
      least = std::min(least, norm(pose_at(view, options, i).position_m - place));
    }
    return least;
  };
  EXPECT_LT(nearest({1, 4, 1.5}), 0.02);
  EXPECT_LT(nearest({3, 4, 1.5}), 0.02);
  // The way is 4 m long: after 8 s the camera is back.
  EXPECT_LT(norm(pose_at(view, options, 640).position_m - view.position), 0.01);
  EXPECT_GT(norm(pose_at(view, options, 320).position_m - view.position), 2.5);
}

TEST(Path, PanReachesTwentyDegreesToBothSides) {
  const SceneOptions options = on_path(PathKind::kPan);
  const Pose middle = pose_at(kView, options, 0);
  constexpr double kDegree = 3.14159265358979 / 180;
  EXPECT_NEAR(turn_between(middle, pose_at(kView, options, 160)), 20 * kDegree, 1e-6);
  EXPECT_NEAR(turn_between(pose_at(kView, options, 480), pose_at(kView, options, 160)),
              40 * kDegree, 1e-6);
}

}  // namespace
}  // namespace thermedge::sim
