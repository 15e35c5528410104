// Pictures and edges of the ray ray_caster against closed forms, and against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "optics.hpp"
#include "portable.hpp"
#include "support/small_worlds.hpp"
#include "thermedge/radiometry/planck.hpp"

namespace thermedge::sim {
namespace {

using test::ball;
using test::black;
using test::crossing;
using test::facing;
using test::SmallWorld;

CameraOptions small_camera() { return {.width = 96, .height = 72, .fov_deg = 30}; }

double planck_counts(double degc) {
  const auto radiance = [](double t) { return band_radiance(t + kKelvinAtZeroCelsius); };
  return 2500 + (radiance(degc) - radiance(25)) / ((radiance(25.5) - radiance(24.5)) * 0.01);
}

TEST(Radiometer, FollowsPlanck) {
  const Radiometer radiometer(20);
  for (const double degc : {-60.0, -20.0, 0.0, 17.3, 25.0, 25.01, 36.6, 90.5, 400.0, 1000.0}) {
    EXPECT_NEAR(radiometer.counts(degc, 1), planck_counts(degc), 0.01 + 1e-6 * planck_counts(degc));
  }
  EXPECT_NEAR(radiometer.counts(26, 1) - radiometer.counts(25, 1), 100, 1);
  // What is not emitted is mirrored: at emissivity 0 everything has the surroundings' counts.
  EXPECT_NEAR(radiometer.counts(300, 0), planck_counts(20), 0.01);
  EXPECT_NEAR(radiometer.counts(40, 0.6), 0.6 * planck_counts(40) + 0.4 * planck_counts(20), 0.01);
}

TEST(Portable, SineAndCosineAreRight) {
  for (double x = -7; x < 7; x += 0.0137) {
    EXPECT_NEAR(sin_cos(x).sin, std::sin(x), 1e-14);
    EXPECT_NEAR(sin_cos(x).cos, std::cos(x), 1e-14);
  }
}

TEST(Truth, LiesWhereTheStepOfThePictureIs) {
  const CameraOptions camera = small_camera();
  for (const double column : {40.0, 40.1, 40.26, 40.5, 40.77}) {
    const double x = SmallWorld::metres(camera, column, 2);
    const SmallWorld world(camera, 20, facing(2, x, -5, 10, 31));
    // The position from the counts that are missing right of the step: sampling can't shift it.
    for (const int y : {10, 35, 36, 60}) {
      double missing = 0;
      for (int i = 20; i < 60; ++i) {
        missing += (planck_counts(31) - static_cast<double>(world.clean(i, y))) /
                   (planck_counts(31) - planck_counts(20));
      }
      EXPECT_NEAR(20 + missing - 0.5, column, 0.01);
    }
    const double middle = (planck_counts(31) + planck_counts(20)) / 2;
    // Interpolation on a straight line alone is wrong by up to 0.015 px.
    EXPECT_NEAR(crossing(world.clean, 30, middle), column, 0.018);
    ASSERT_EQ(world.edges.size(), 1U);
    EXPECT_EQ(world.edges[0].kind, EdgeKind::kOccluding);
    EXPECT_NEAR(world.edges[0].contrast_counts, planck_counts(31) - planck_counts(20), 0.5);
    EXPECT_NEAR(static_cast<double>(world.clean(80, 30)), planck_counts(31), 0.5);
    for (const Point p : world.edges[0].points) {
      EXPECT_NEAR(p.x, column, 1e-9);
    }
    EXPECT_NEAR(std::abs(world.edges[0].points.front().y - world.edges[0].points.back().y), 71,
                0.51);
  }
}

TEST(Truth, LiesOnASlantedStepAtEveryRow) {
  const CameraOptions camera = small_camera();
  Quad quad = facing(2, SmallWorld::metres(camera, 30, 2), -5, 10, 30);
  quad.corner.x -= 5 * 0.25;  // x grows by 0.25 m for each metre up
  quad.v.x = 10 * 0.25;
  const SmallWorld world(camera, 20, quad);
  const double middle = (planck_counts(30) + planck_counts(20)) / 2;
  const double centre_row = (camera.height - 1) / 2.0;
  for (int y = 1; y < camera.height - 1; ++y) {
    EXPECT_NEAR(crossing(world.clean, y, middle), 30 - 0.25 * (y - centre_row), 0.018);
  }
  for (const Point p : world.edges.at(0).points) {
    EXPECT_NEAR(p.x, 30 - 0.25 * (p.y - centre_row), 1e-9);
  }
}

TEST(Truth, BendsAsTheLensDoes) {
  CameraOptions camera = small_camera();
  camera.fov_deg = 70;
  camera.k1 = -0.2;
  camera.k2 = 0.05;
  const SmallWorld world(camera, 20, facing(2, -0.9, -50, 100, 30));
  ASSERT_EQ(world.edges.size(), 1U);
  double least = 1e9;
  double most = 0;
  const double middle = (planck_counts(30) + planck_counts(20)) / 2;
  for (const Point p : world.edges[0].points) {
    EXPECT_NEAR(world.lens().ray(p).x, -0.9 / 2, 1e-9);
    least = std::min(least, p.x);
    most = std::max(most, p.x);
    const double row = std::round(p.y);
    if (std::abs(p.y - row) < 0.02) {
      EXPECT_NEAR(crossing(world.clean, static_cast<int>(row), middle), p.x, 0.02);
    }
  }
  EXPECT_GT(most - least, 1);
}

// Both ends of the line lie left of the picture, its middle within.
TEST(Truth, ShowsLinesThatTheLensBendsIn) {
  CameraOptions camera = small_camera();
  camera.fov_deg = 80;
  camera.k1 = 0.3;
  const double x = Lens(intrinsics_of(camera)).ray({1.5, 35.5}).x;
  const SmallWorld world(camera, 20, facing(1, x, -0.75, 1.5, 30));
  int points = 0;
  for (const TrueEdge& edge : world.edges) {
    for (const Point p : edge.points) {
      points += std::abs(world.lens().ray(p).x - x) < 1e-9 ? 1 : 0;
    }
  }
  EXPECT_GT(points, 15);
}

TEST(Lens, UndoesItsDistortion) {
  CameraOptions camera = small_camera();
  camera.fov_deg = 80;
  camera.k1 = -0.15;
  camera.k2 = 0.03;
  const Lens lens(intrinsics_of(camera));
  for (const Point p : {Point{-0.5, -0.5}, Point{95.5, 3}, Point{47.5, 35.5}, Point{12, 60}}) {
    const Point back = lens.pixel(lens.ray(p));
    EXPECT_NEAR(back.x, p.x, 1e-9);
    EXPECT_NEAR(back.y, p.y, 1e-9);
  }
}

// Of a ball off the axis the outline is an ellipse: rays that touch the ball.
TEST(Truth, OfABallIsWhereRaysTouchIt) {
  const Vec3 centre{0.2, 3, 0.15};
  const SmallWorld world(small_camera(), 20, ball(centre, 0.3, 32));
  ASSERT_EQ(world.edges.size(), 1U);
  EXPECT_TRUE(world.edges[0].closed);
  for (const Point p : world.edges[0].points) {
    const Point ray = world.lens().ray(p);
    const Vec3 d = unit({ray.x, 1, -ray.y});
    EXPECT_NEAR(norm(centre - d * dot(centre, d)), 0.3, 1e-9);
  }
  EXPECT_NEAR(world.edges[0].contrast_counts, planck_counts(32) - planck_counts(20), 0.5);
}

TEST(Truth, EndsWhereSomethingHidesIt) {
  const SmallWorld world(small_camera(), 20, facing(3, -0.5, -0.2, 0.4, 30),
                         facing(2, -0.25, -5, 0.3, 40), facing(2, -0.25, -0.4, 0.3, 40));
  for (const TrueEdge& edge : world.edges) {
    for (const Point p : edge.points) {
      const Hit hit = world.ray_caster().cast(Point{p.x, p.y});
      EXPECT_TRUE(edge.object != 0 || hit.facet <= 0) << p.x << " " << p.y;
    }
  }
  EXPECT_GE(world.edges.size(), 7U);
}

TEST(Truth, TellsKindsApart) {
  Box box;
  box.centre = {0, 3, -0.3};
  box.size = {0.5, 0.5, 0.5};
  box.yaw_rad = 0.6;
  box.surfaces.fill(black(30));
  box.surfaces[static_cast<std::size_t>(Side::kTop)].temperature_degc = 33;
  box.surfaces[static_cast<std::size_t>(Side::kLeft)].temperature_degc = 31;
  box.surfaces[static_cast<std::size_t>(Side::kRight)].temperature_degc = 31;
  Patch patch;
  patch.width_m = 0.1;
  patch.height_m = 0.1;
  patch.surface = black(36);
  box.patches[static_cast<std::size_t>(Side::kTop)].push_back(patch);
  CameraOptions camera = small_camera();
  const SmallWorld world(camera, 20, box);
  std::map<EdgeKind, int> kinds;
  for (const TrueEdge& edge : world.edges) {
    ++kinds[edge.kind];
  }
  EXPECT_EQ(kinds[EdgeKind::kMaterial], 4);   // the patch
  EXPECT_EQ(kinds[EdgeKind::kCrease], 3);     // between the three faces that are seen
  EXPECT_EQ(kinds[EdgeKind::kOccluding], 6);  // the outline
}

TEST(Truth, ShowsWhereThingsPierceEachOther) {
  const SmallWorld world(small_camera(), 20, facing(3, -0.5, -0.5, 1, 30),
                         ball({0, 3.1, 0}, 0.2, 34));
  const auto crease = std::find_if(world.edges.begin(), world.edges.end(),
                                   [](const TrueEdge& e) { return e.kind == EdgeKind::kCrease; });
  ASSERT_NE(crease, world.edges.end());
  EXPECT_TRUE(crease->closed);
  const double radius = std::sqrt(0.2 * 0.2 - 0.1 * 0.1);
  for (const Point p : crease->points) {
    const Point ray = world.lens().ray(p);
    EXPECT_NEAR(std::hypot(ray.x, ray.y) * 3, radius, 1e-9);
  }
}

// Steep places of the picture that no true edge explains.
int unexplained(const SmallWorld& world) {
  int count = 0;
  for (int y = 4; y + 4 < world.clean.height(); ++y) {
    for (int x = 4; x + 4 < world.clean.width(); ++x) {
      const double dx = static_cast<double>(world.clean(x + 1, y) - world.clean(x - 1, y)) / 2;
      const double dy = static_cast<double>(world.clean(x, y + 1) - world.clean(x, y - 1)) / 2;
      const bool known = std::any_of(world.edges.begin(), world.edges.end(), [&](const auto& edge) {
        return std::any_of(edge.points.begin(), edge.points.end(),
                           [&](const Point p) { return std::hypot(p.x - x, p.y - y) < 3.5; });
      });
      count += std::hypot(dx, dy) > 10 && !known ? 1 : 0;
    }
  }
  return count;
}

TEST(Truth, HasEveryCut) {
  const auto tube = [](Vec3 from, Vec3 to, double radius, bool round) {
    Cylinder cylinder{from, to, radius, round, black(34), {black(34), black(34)}};
    return cylinder;
  };
  Quad slanted = facing(3, -0.4, -0.4, 0.8, 34);
  slanted.corner.y -= 0.3;
  slanted.u.y = 0.6;
  const Quad wall = facing(3, -0.8, -0.8, 1.6, 30);
  EXPECT_EQ(unexplained(SmallWorld(small_camera(), 20, wall, slanted)), 0);
  EXPECT_EQ(unexplained(SmallWorld(small_camera(), 20, wall,
                                   tube({-0.3, 2.6, 0.1}, {0.2, 3.4, 0.2}, 0.12, false))),
            0);
  EXPECT_EQ(unexplained(SmallWorld(small_camera(), 20, wall,
                                   tube({0.1, 2.6, 0}, {0.1, 3.4, 0}, 0.12, false))),
            0);
  EXPECT_EQ(unexplained(SmallWorld(small_camera(), 20, ball({-0.1, 3, 0}, 0.25, 30),
                                   ball({0.2, 2.9, 0.1}, 0.2, 34))),
            0);
  EXPECT_EQ(unexplained(SmallWorld(small_camera(), 20, ball({0, 3, 0}, 0.25, 30),
                                   tube({-0.5, 3, 0.1}, {0.5, 3, -0.1}, 0.08, true))),
            0);
  auto seam = tube({-0.3, 3, 0.1}, {0.3, 3, -0.1}, 0.2, true);
  seam.ends[1] = black(30);
  EXPECT_EQ(unexplained(SmallWorld(small_camera(), 20, seam)), 0);
}

TEST(Optics, KeepTheSumAndTheWidth) {
  const auto runner = make_runner(1);
  for (const double airy_px : {0.0, 1.5}) {
    Optics optics(1.3, airy_px);
    const int margin = optics.margin_px() * kSubpixels;
    Image<float> fine(41 * kSubpixels + 2 * margin, 41 * kSubpixels + 2 * margin);
    fill_pixels(fine.view(), 0.0F);
    for (int i = 0; i < kSubpixels * kSubpixels; ++i) {
      fine(margin + 20 * kSubpixels + i % kSubpixels, margin + 20 * kSubpixels + i / kSubpixels) =
          1000;
    }
    Image<float> pixels(41, 41);
    optics.run(fine, pixels, *runner);
    double sum = 0;
    double spread = 0;
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 41; ++x) {
        const double value = static_cast<double>(pixels(x, y));
        sum += value;
        spread += value * (x - 20) * (x - 20);
      }
    }
    EXPECT_NEAR(sum, 1000, 1e-2);
    if (airy_px == 0) {
      // The Gaussian, and two pairs of sub-pixels: those of the source and those of the pixel.
      EXPECT_NEAR(spread / sum, 1.3 * 1.3 + 2.0 / 16, 0.002);
    } else {
      EXPECT_GT(spread / sum, 1.3 * 1.3 + 0.5);
    }
    EXPECT_NEAR(static_cast<double>(pixels(17, 20)), static_cast<double>(pixels(23, 20)), 1e-3);
    EXPECT_NEAR(static_cast<double>(pixels(20, 17)), static_cast<double>(pixels(17, 20)), 1e-3);
  }
}

TEST(Optics, AiryIsDarkAtItsFirstRing) {
  const auto runner = make_runner(1);
  Optics optics(0, 4);
  const int margin = optics.margin_px() * kSubpixels;
  Image<float> fine(41 * kSubpixels + 2 * margin, 41 * kSubpixels + 2 * margin);
  fill_pixels(fine.view(), 0.0F);
  for (int i = 0; i < kSubpixels * kSubpixels; ++i) {
    fine(margin + 20 * kSubpixels + i % kSubpixels, margin + 20 * kSubpixels + i / kSubpixels) = 1;
  }
  Image<float> pixels(41, 41);
  optics.run(fine, pixels, *runner);
  EXPECT_LT(pixels(24, 20), 0.01F * pixels(20, 20));
  EXPECT_GT(pixels(25, 20), pixels(24, 20));
  EXPECT_GT(pixels(22, 20), 0.2F * pixels(20, 20));
}

TEST(Depth, IsAlongTheAxis) {
  const SmallWorld world(small_camera(), 20, facing(2.5, -5, -5, 5, 30));
  Image<std::uint16_t> depth(96, 72);
  const auto runner = make_runner(1);
  render_depth(world.ray_caster(), depth, *runner);
  EXPECT_EQ(depth(2, 70), 2500);
  EXPECT_EQ(depth(40, 40), 2500);
  EXPECT_EQ(depth(60, 40), 0);
}

// Identities, poses and edges come back with the camera.
TEST(Sequence, OfAPanComesBackToItself) {
  const auto options = parse_scene("sim:office?frames=17&rate=1&path=pan&camera=pi450&rate=1");
  ASSERT_TRUE(options) << options.error().message;
  auto renderer = Renderer::create(*options);
  const auto runner = make_runner(1);
  const auto first = renderer->render(0, *runner);
  std::map<int, int> objects;
  std::set<int> all;
  for (int i = 0; i <= 8; ++i) {
    const auto frame = renderer->render(i, *runner);
    for (const TrueEdge& edge : frame->edges) {
      EXPECT_EQ(objects.emplace(edge.id, edge.object).first->second, edge.object);
      all.insert(edge.id);
    }
    if (i == 8) {
      ASSERT_EQ(frame->edges.size(), first->edges.size());
      for (std::size_t k = 0; k < first->edges.size(); ++k) {
        EXPECT_EQ(frame->edges[k].id, first->edges[k].id);
        EXPECT_EQ(frame->edges[k].kind, first->edges[k].kind);
        ASSERT_EQ(frame->edges[k].points.size(), first->edges[k].points.size());
        EXPECT_EQ(frame->edges[k].points[0].x, first->edges[k].points[0].x);
      }
      EXPECT_EQ(frame->pose.orientation_xyzw, first->pose.orientation_xyzw);
      EXPECT_EQ(frame->stamp_ns, 8'000'000'000);
    }
  }
  EXPECT_GT(all.size(), 60U);
}

// An edge's points and its pose belong together: the same place of the world in every frame.
TEST(Sequence, PosesExplainWhereEdgesAre) {
  const auto options = parse_scene("sim:corridor?frames=60&path=drive");
  auto renderer = Renderer::create(*options);
  const auto runner = make_runner(1);
  for (const int index : {0, 59}) {
    const auto frame = renderer->render(index, *runner);
    const Axes axes = axes_of(frame->pose);
    const Lens lens(frame->intrinsics);
    // The upper right crease of the end wall: x from -1.2 to 1.2 at y = 13, z = 2.5.
    int found = 0;
    for (const TrueEdge& edge : frame->edges) {
      for (const Point p : edge.points) {
        const Point ray = lens.ray(p);
        const Vec3 d = axes.right * ray.x + axes.down * ray.y + axes.forward;
        const Vec3 hit = frame->pose.position_m + d * ((13 - frame->pose.position_m.y) / d.y);
        found += edge.kind == EdgeKind::kCrease && std::abs(hit.z - 2.5) < 1e-6 &&
                 std::abs(hit.x) <= 1.2;
      }
    }
    EXPECT_GT(found, 50);
  }
}

}  // namespace
}  // namespace thermedge::sim
