// Scene files: what they mean, and what is said about wrong ones.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "support/files.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {
namespace {

const std::string kView = "[view]\nposition_m = [0, 0, 1]\nlook_at_m = [0, 5, 1]\n";
const std::string kBall =
    "[[object]]\ntype = 'sphere'\nname = 'sun'\ncentre_m = [0, 3, 1]\nradius_m = 0.5\n";

std::string message(const std::string& toml) {
  const auto world = parse_world(toml, "x.toml", 1);
  return world ? "" : world.error().message;
}

TEST(World, ReadsEveryShape) {
  const auto world = parse_world(
      "name = 'all'\nsky_degc = -5\nreflected_degc = 3\n" + kView +
          "roll_deg = 90\nwaypoints_m = [[0, 1, 1], [1, 2, 1]]\nspeed_m_per_s = 2\n" + kBall +
          "[[object]]\ntype = 'box'\ncentre_m = [1, 2, 3]\nsize_m = [1, 2, 3]\nyaw_deg = 180\n"
          "inside = true\ntemperature_degc = 30\ntop = { temperature_degc = 35 }\n"
          "patch = [{ side = 'left', shape = 'ellipse', centre_m = [0.1, 0.2], size_m = [0.3, "
          "0.4], "
          "turn_deg = 90, emissivity = 0.5 }]\n"
          "[[object]]\ntype = 'cylinder'\nfrom_m = [0, 0, 0]\nto_m = [0, 0, 2]\nradius_m = 0.1\n"
          "round = true\nto_end = { temperature_degc = 50 }\n"
          "[[object]]\ntype = 'quad'\ncorner_m = [0, 9, 0]\nright_m = [1, 0, 0]\nup_m = [0, 0, 1]\n"
          "[[object]]\ntype = 'plane'\npoint_m = [0, 0, -1]\nnormal_m = [0, 0, 2]\n"
          "gradient_degc_per_m = [0, 0.1, 0]\nvalue_noise_degc = 0.5\nvalue_noise_m = 2\n",
      "x.toml", 1);
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_EQ(world->sky_degc, -5);
  EXPECT_EQ(world->reflected_degc, 3);
  EXPECT_EQ(world->view.waypoints.size(), 2U);
  EXPECT_EQ(world->view.speed_m_per_s, 2);
  ASSERT_EQ(world->objects.size(), 5U);
  EXPECT_EQ(std::get<Sphere>(world->objects[0].shape).radius, 0.5);
  const Box& box = std::get<Box>(world->objects[1].shape);
  EXPECT_TRUE(box.inside);
  EXPECT_EQ(box.surfaces[static_cast<std::size_t>(Side::kTop)].temperature_degc, 35);
  EXPECT_EQ(box.surfaces[static_cast<std::size_t>(Side::kLeft)].temperature_degc, 30);
  const Patch& patch = box.patches[static_cast<std::size_t>(Side::kLeft)].at(0);
  EXPECT_EQ(patch.shape, Patch::Shape::kEllipse);
  EXPECT_EQ(patch.surface.temperature_degc, 30) << "as its side where nothing else is said";
  EXPECT_EQ(patch.surface.emissivity, 0.5);
  const Cylinder& cylinder = std::get<Cylinder>(world->objects[2].shape);
  EXPECT_TRUE(cylinder.round);
  EXPECT_EQ(cylinder.ends[1].temperature_degc, 50);
  EXPECT_EQ(std::get<Quad>(world->objects[3].shape).corner, (Vec3{0, 9, 0}));
  const Quad& plane = std::get<Quad>(world->objects[4].shape);
  EXPECT_EQ(plane.surface.value_noise_m, 2);
  EXPECT_GT(std::abs(plane.u.x + plane.v.x), 1000);
}

TEST(World, SeedsMoveGroupsTogether) {
  const auto toml = kView + kBall + "group = 'g'\njitter_m = [1, 0, 0]\nvary_degc = 5\n" +
                    "[[object]]\ntype = 'sphere'\ncentre_m = [2, 3, 1]\nradius_m = 0.1\n"
                    "group = 'g'\njitter_m = [1, 0, 0]\n";
  const auto centre = [](const World& world, std::size_t i) {
    return std::get<Sphere>(world.objects[i].shape).centre;
  };
  const auto one = parse_world(toml, "x", 1);
  const auto two = parse_world(toml, "x", 2);
  ASSERT_TRUE(one && two);
  EXPECT_NE(centre(*one, 0).x, centre(*two, 0).x);
  EXPECT_EQ(centre(*one, 0).y, 3);
  EXPECT_NEAR(centre(*one, 1).x - centre(*one, 0).x, 2, 1e-12);
  EXPECT_NEAR(centre(*two, 1).x - centre(*two, 0).x, 2, 1e-12);
  EXPECT_NE(std::get<Sphere>(one->objects[0].shape).surface.temperature_degc,
            std::get<Sphere>(two->objects[0].shape).surface.temperature_degc);
}

TEST(World, SaysWhatIsWrong) {
  EXPECT_EQ(message("a = [1\n").substr(0, 24), "x.toml: line 1: not TOML");
  EXPECT_EQ(message(kBall), "x.toml: needs [view] with position_m and look_at_m");
  EXPECT_EQ(message(kView), "x.toml: needs 1 to 2000 objects, written as [[object]]");
  EXPECT_EQ(message("colour = 1\n" + kView + kBall),
            "x.toml: unknown key 'colour'; known are name, sky_degc, reflected_degc, view, object");
  EXPECT_EQ(message(kView + kBall + "temperature_degc = -300\n"),
            "x.toml: object 'sun': temperature_degc = -300 should be from -272 to 1100 (0 K is "
            "-273.15 degC)");
  EXPECT_EQ(message(kView + kBall + "emissivity = 1.5\n"),
            "x.toml: object 'sun': emissivity = 1.5 should be from 0 to 1");
  EXPECT_EQ(message(kView + kBall + "emissivity = 'high'\n"),
            "x.toml: object 'sun': emissivity should be a number");
  EXPECT_EQ(message(kView + kBall + "heat = 3\n").substr(0, 63),
            "x.toml: object 'sun': unknown key 'heat'; known are name, type,");
  EXPECT_EQ(message(kView + "waypoints_m = []\n" + kBall),
            "x.toml: view: waypoints_m should be a list of points [x, y, z], and not empty");
  EXPECT_EQ(message(kView + "waypoints_m = [[1, 2]]\n" + kBall),
            "x.toml: view: waypoints_m: point should be 3 numbers from -100000 to 100000");
  EXPECT_EQ(message(kView + "waypoints_m = [[0, 0, 1]]\n" + kBall),
            "x.toml: view: waypoints_m should begin away from position_m, at the first point to "
            "drive to");
  EXPECT_EQ(
      message("[view]\nposition_m = [0, 0, 1]\nlook_at_m = [0, 0, 0]\n" + kBall),
      "x.toml: view: look_at_m should be ahead of position_m, not straight above or below it");
  EXPECT_EQ(message(kView + "[[object]]\ntype = 'cone'\n"),
            "x.toml: object '1': type = 'cone' should be plane, quad, box, cylinder or sphere");
  EXPECT_EQ(message(kView + "[[object]]\ntype = 'sphere'\nradius_m = 1\n"),
            "x.toml: object '1': needs centre_m");
  EXPECT_EQ(message(kView + "[[object]]\ntype = 'box'\ncentre_m = [0, 0, 0]\nsize_m = [1, 1, 0]\n"),
            "x.toml: object '1': size_m should be 3 numbers from 0.0001 to 100000");
  EXPECT_EQ(message("object = 3\n" + kView), "x.toml: object should be written as [[object]]");
  EXPECT_EQ(message(kView + "[[object]]\ntype = 'quad'\ncorner_m = [0, 0, 0]\n"
                            "right_m = [1, 0, 0]\nup_m = [2, 0, 0]\n"),
            "x.toml: object '1': right_m and up_m should point in different directions");
  EXPECT_EQ(message(kView + "[[object]]\ntype = 'cylinder'\nfrom_m = [0, 0, 0]\n"
                            "to_m = [0, 0, 0]\nradius_m = 1\n"),
            "x.toml: object '1': from_m and to_m should be different points");
  EXPECT_EQ(
      message(kView + "[[object]]\ntype = 'box'\ncentre_m = [0, 0, 0]\nsize_m = [1, 1, 1]\n"
                      "patch = [{ side = 'inner', size_m = [1, 1] }]\n"),
      "x.toml: object '1': patch 1: side = 'inner' should be front, back, left, right, top or "
      "bottom");
}

TEST(World, FilesAreScenesLikeTheBuiltInOnes) {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "mine.toml";
  test::write_text(path, kView + kBall + "temperature_degc = 30\n");
  const auto options = parse_scene("sim:" + path + "?width=64&height=48");
  ASSERT_TRUE(options) << options.error().message;
  const auto frame = render(*options, 0);
  ASSERT_TRUE(frame) << frame.error().message;
  ASSERT_EQ(frame->edges.size(), 1U);
  EXPECT_TRUE(frame->edges[0].closed);
  const auto missing = render(*parse_scene("sim:missing.toml"), 0);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, "missing.toml: cannot be read as a scene file");
  EXPECT_EQ(missing.error().code, ErrorCode::kIo);
}

// Whatever stands in a file: a world that can be rendered, or one line that names the file.
TEST(World, DamagedFilesGiveAnErrorOrAWorld) {
  const test::TemporaryDirectory directory;
  const std::string path = directory / "damaged.toml";
  std::mt19937 random(3);
  int good = 0;
  int bad = 0;
  for (const std::string name : {"office", "road"}) {
    const std::string whole(*built_in_scene(name));
    for (int i = 0; i < 200; ++i) {
      std::string toml = whole;
      // Every second time, some digits become others.
      for (int k = 0; k < (i % 2 == 0 ? 1 : 40); ++k) {
        char& c = toml[random() % toml.size()];
        if (i % 2 == 0) {
          c = "0123456789-.e[]'= x"[random() % 19];
        } else if (c >= '0' && c <= '9') {
          c = static_cast<char>('0' + random() % 10);
        }
      }
      test::write_text(path, i % 10 == 0 ? toml.substr(0, random() % toml.size()) : toml);
      const auto frame = render(*parse_scene("sim:" + path + "?width=24&height=16"), 0);
      if (frame) {
        ++good;
      } else {
        ++bad;
        EXPECT_EQ(frame.error().message.find(path), 0U) << frame.error().message;
        EXPECT_EQ(frame.error().message.find('\n'), std::string::npos) << frame.error().message;
      }
    }
  }
  EXPECT_GT(good, 20);
  EXPECT_GT(bad, 20);
}

TEST(World, BuiltInScenesAreGoodForEverySeed) {
  for (const std::string& name : scene_names()) {
    for (const std::uint64_t seed : {0U, 7U, 12345U}) {
      const auto world = parse_world(*built_in_scene(name), name, seed);
      EXPECT_TRUE(world) << world.error().message;
    }
  }
  EXPECT_FALSE(built_in_scene("nowhere"));
}

}  // namespace
}  // namespace thermedge::sim
