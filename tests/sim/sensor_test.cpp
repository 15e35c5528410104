// What the simulated sensor adds, and when its shutter falls.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sensor.hpp"

namespace thermedge::sim {
namespace {

// Nothing but what a test turns on.
CameraOptions quiet_camera() {
  CameraOptions camera;
  camera.width = 160;
  camera.height = 120;
  camera.sigma_counts = 0;
  camera.column_sigma_counts = 0;
  camera.row_sigma_counts = 0;
  camera.bad_pixels = 0;
  return camera;
}

Image<std::uint16_t> exposed(const CameraOptions& camera, int frame, float level = 3000) {
  Image<float> clean(camera.width, camera.height);
  fill_pixels(clean.view(), level);
  Image<std::uint16_t> counts(camera.width, camera.height);
  Sensor sensor(camera, 5);
  const auto runner = make_runner(1);
  sensor.expose(clean, frame, counts, *runner);
  return counts;
}

double mean_of(const CameraOptions& camera, const std::function<double(int, int)>& value) {
  double sum = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      sum += value(x, y);
    }
  }
  return sum / (camera.width * camera.height);
}

TEST(Sensor, PixelPatternHasItsSigmaAndStays) {
  CameraOptions camera = quiet_camera();
  camera.pixel_sigma_counts = 30;
  const auto first = exposed(camera, 0);
  const auto later = exposed(camera, 500);
  EXPECT_NEAR(
      std::sqrt(mean_of(camera, [&](int x, int y) { return std::pow(first(x, y) - 3000.0, 2); })),
      30, 0.7);
  EXPECT_EQ(mean_of(camera, [&](int x, int y) { return first(x, y) != later(x, y) ? 1 : 0; }), 0);
}

TEST(Sensor, PatternDriftsAndKeepsItsSigma) {
  CameraOptions camera = quiet_camera();
  camera.pixel_sigma_counts = 30;
  camera.drift_s = 10;  // 800 frames
  const auto first = exposed(camera, 0);
  double last = 1;
  for (const int frame : {40, 200, 400, 800, 2000}) {
    const auto now = exposed(camera, frame);
    const double variance =
        mean_of(camera, [&](int x, int y) { return std::pow(now(x, y) - 3000.0, 2); });
    EXPECT_NEAR(std::sqrt(variance), 30, 0.7);
    const double correlation =
        mean_of(camera,
                [&](int x, int y) { return (now(x, y) - 3000.0) * (first(x, y) - 3000.0); }) /
        variance;
    EXPECT_LT(correlation, last);
    last = frame < 800 ? correlation : 0.03;
  }
}

TEST(Sensor, GainsScaleWithTheDistanceFrom25DegC) {
  CameraOptions camera = quiet_camera();
  camera.gain_sigma = 0.01;
  const auto at_reference = exposed(camera, 0, 2500);
  const auto hot = exposed(camera, 0, 6500);
  EXPECT_EQ(mean_of(camera, [&](int x, int y) { return at_reference(x, y) == 2500 ? 1 : 0; }), 1);
  EXPECT_NEAR(
      std::sqrt(mean_of(camera, [&](int x, int y) { return std::pow(hot(x, y) - 6500.0, 2); })), 40,
      1);
}

TEST(Sensor, SaturatesAtBothEnds) {
  CameraOptions camera = quiet_camera();
  camera.sigma_counts = 50;
  const auto hot = exposed(camera, 0, 20000);
  const auto cold = exposed(camera, 0, -400);
  EXPECT_EQ(mean_of(camera, [&](int x, int y) { return hot(x, y); }), 16383);
  EXPECT_EQ(mean_of(camera, [&](int x, int y) { return cold(x, y); }), 0);
}

TEST(Sensor, SomePixelsFlicker) {
  CameraOptions camera = quiet_camera();
  camera.sigma_counts = 2;
  camera.flickering_pixels = 7;
  Image<std::uint16_t> jumps(camera.width, camera.height);
  fill_pixels(jumps.view(), std::uint16_t{0});
  for (int frame = 0; frame < 20; ++frame) {
    const auto now = exposed(camera, frame);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        jumps(x, y) = static_cast<std::uint16_t>(jumps(x, y) + (now(x, y) > 3015 ? 1 : 0));
      }
    }
  }
  const double share = mean_of(camera, [&](int x, int y) { return jumps(x, y) > 0 ? 1 : 0; });
  EXPECT_NEAR(share * camera.width * camera.height, 7, 0.1);
  EXPECT_LT(mean_of(camera, [&](int x, int y) { return jumps(x, y) > 18 ? 1 : 0; }), 1e-9);
}

TEST(Shutter, FallsOnTime) {
  CameraOptions camera = quiet_camera();
  camera.shutter_every = 50;
  camera.shutter_frames = 10;
  for (const int frame : {0, 10, 49, 61, 99, 111}) {
    EXPECT_FALSE(shutter_at(camera, 5, frame)) << frame;
  }
  for (const int frame : {50, 55, 59}) {
    ASSERT_TRUE(shutter_at(camera, 5, frame)) << frame;
    EXPECT_TRUE(shutter_at(camera, 5, frame)->frozen);
    EXPECT_EQ(shutter_at(camera, 5, frame)->shows_frame, 49);
  }
  EXPECT_EQ(shutter_at(camera, 5, 105)->shows_frame, 99);
  ASSERT_TRUE(shutter_at(camera, 5, 60));
  EXPECT_FALSE(shutter_at(camera, 5, 60)->frozen);
}

TEST(Shutter, JumpsByWhatItSays) {
  CameraOptions camera = quiet_camera();
  camera.shutter_every = 50;
  camera.shutter_frames = 10;
  camera.shutter_jump_counts = 100;
  for (const int event : {1, 2, 3}) {
    const int behind = 50 * event + 10;
    const double jump = shutter_at(camera, 5, behind)->jump_counts;
    EXPECT_GT(std::abs(jump), 1);
    EXPECT_NEAR(exposed(camera, behind)(3, 3) - exposed(camera, 50 * event - 1)(3, 3), jump, 1);
  }
}

TEST(Shutter, FreezesThePictureButNotTheTruth) {
  auto options = parse_scene(
      "sim:desk?frames=40&width=96&height=72&shutter_every=30&"
      "shutter_frames=5&rate=20");
  ASSERT_TRUE(options) << options.error().message;
  auto renderer = Renderer::create(*options);
  const auto runner = make_runner(1);
  const auto shown = renderer->render(29, *runner);
  const auto frozen = renderer->render(33, *runner);
  int same = 0;
  for (int x = 0; x < 96; ++x) {
    same += frozen->counts(x, 40) == shown->counts(x, 40) ? 1 : 0;
  }
  EXPECT_EQ(same, 96);
  EXPECT_NE(frozen->clean(60, 40), shown->clean(60, 40));
  EXPECT_NE(frozen->pose.orientation_xyzw, shown->pose.orientation_xyzw);
  EXPECT_FALSE(shown->shutter);
}

}  // namespace
}  // namespace thermedge::sim
