// What goes wrong and what moves in simulated sequences, and what the truth tells of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "facets.hpp"
#include "motion.hpp"
#include "path.hpp"
#include "sensor.hpp"
#include "support/hash.hpp"
#include "thermedge/sim/truth_file.hpp"
#include "view.hpp"

namespace thermedge::sim {
namespace {

const std::string kSmall = "sim:desk?width=96&height=72&bad_pixels=0&";

std::vector<TrueFrame> frames_of(const std::string& spec) {
  const auto options = parse_scene(spec);
  EXPECT_TRUE(options) << options.error().message;
  auto renderer = Renderer::create(*options);
  EXPECT_TRUE(renderer) << renderer.error().message;
  const auto runner = make_runner(1);
  std::vector<TrueFrame> frames;
  for (int i = 0; i < options->frames; ++i) {
    frames.push_back(std::move(*renderer->render(i, *runner)));
  }
  return frames;
}

// One letter a frame: d, f, n, o, p of its first event.
std::string events_of(const std::vector<TrueFrame>& frames) {
  std::string text;
  for (const TrueFrame& frame : frames) {
    text += frame.events.empty() ? '.' : "dfnop"[static_cast<int>(frame.events.front())];
  }
  return text;
}

double mean_difference(const TrueFrame& a, const TrueFrame& b, int power) {
  double sum = 0;
  for (int y = 0; y < a.counts.height(); ++y) {
    for (int x = 0; x < a.counts.width(); ++x) {
      sum += std::pow(double{1} * a.counts(x, y) - b.counts(x, y), power);
    }
  }
  return sum / (a.counts.width() * a.counts.height());
}

TEST(Freeze, RepeatsThePictureExactly) {
  const auto frames = frames_of(kSmall + "frames=12&freeze_every=6&freeze_frames=3");
  EXPECT_EQ(events_of(frames), "......fff...");
  for (const std::size_t i : {6U, 7U, 8U}) {
    EXPECT_EQ(mean_difference(frames[i], frames[5], 2), 0);
    ASSERT_TRUE(frames[i].freeze);
    EXPECT_EQ(frames[i].freeze->shows_frame, 5);
    EXPECT_NE(frames[i].pose.orientation_xyzw, frames[5].pose.orientation_xyzw);
  }
  EXPECT_GT(mean_difference(frames[9], frames[8], 2), 10);
  EXPECT_FALSE(frames[9].freeze);
}

TEST(Freeze, NearlyIsWithNewNoise) {
  const auto frames =
      frames_of(kSmall + "frames=12&freeze_every=6&freeze_frames=3&freeze_noise=0.25&sigma=20");
  EXPECT_EQ(events_of(frames), "......nnn...");
  EXPECT_NEAR(std::sqrt(mean_difference(frames[6], frames[5], 2)), 5, 0.2);
  EXPECT_NEAR(std::sqrt(mean_difference(frames[7], frames[6], 2)), 5 * std::sqrt(2.0), 0.3);
  EXPECT_NEAR(frames[7].freeze->noise_counts, 5, 1e-12);
}

TEST(Freeze, OfAShutterAndOfTheStreamMayMeet) {
  // The shutter closes in 6..8, the stream freezes in 8..10 and 16..18.
  const auto frames = frames_of(
      kSmall + "frames=12&freeze_every=8&freeze_frames=3&shutter_every=6&shutter_frames=3");
  EXPECT_EQ(events_of(frames), "......fffffo");
  EXPECT_EQ(mean_difference(frames[10], frames[5], 2), 0);
  EXPECT_EQ(frames[9].freeze->shows_frame, 5);
}

TEST(Jump, OffsetsThePictureAndComesBack) {
  const auto frames = frames_of(
      kSmall + "frames=14&path=still&sigma=1&jump_every=4&jump=100&freeze_every=7&freeze_frames=2");
  // The jump in frame 8 is seen after the freeze.
  EXPECT_EQ(events_of(frames), "....o..ffo..o.");
  const double jump = mean_difference(frames[4], frames[3], 1);
  EXPECT_GT(std::abs(jump), 50);
  EXPECT_LT(std::abs(jump), 150);
  EXPECT_NEAR(frames[4].offset_counts, jump, 0.1);
  EXPECT_NEAR(frames[8].offset_counts, jump, 0.1);
  EXPECT_NEAR(mean_difference(frames[9], frames[8], 1), -jump, 0.1);
  EXPECT_EQ(frames[9].offset_counts, 0);
  EXPECT_GT(std::abs(frames[12].offset_counts), 50);
}

TEST(Jump, OfTheShutterIsAnEventWhereItIsLargeEnough) {
  const auto spec = kSmall + "frames=12&shutter_every=4&shutter_frames=2&shutter_jump=";
  EXPECT_EQ(events_of(frames_of(spec + "500")), "....ffo.ffo.");
  EXPECT_EQ(events_of(frames_of(spec + "0.1")), "....ff..ff..");
}

TEST(Pattern, BecomesAnotherAtOnce) {
  const std::string still = kSmall + "frames=9&path=still&sigma=0&column_sigma=0&row_sigma=0&";
  const auto frames = frames_of(still + "pixel_sigma=30&pattern_every=3");
  EXPECT_EQ(events_of(frames), "...p..p..");
  EXPECT_EQ(mean_difference(frames[2], frames[0], 2), 0);
  EXPECT_NEAR(std::sqrt(mean_difference(frames[3], frames[2], 2)), 30 * std::sqrt(2.0), 1.5);
  EXPECT_NEAR(std::sqrt(mean_difference(frames[6], frames[0], 2)), 30 * std::sqrt(2.0), 1.5);
  EXPECT_EQ(mean_difference(frames[8], frames[6], 2), 0);
  // The first pattern is the one that there is without changes.
  EXPECT_EQ(mean_difference(frames_of(still + "pixel_sigma=30")[0], frames[0], 2), 0);
  EXPECT_EQ(events_of(frames_of(still + "pattern_every=3")), ".........");
}

TEST(Drop, LeavesGapsInNumbersAndStamps) {
  const auto all = frames_of(kSmall + "frames=14");
  const auto kept = frames_of(kSmall + "frames=10&drop_every=5&drop_frames=2");
  EXPECT_EQ(events_of(kept), ".....d..d.");
  const std::vector<int> numbers = {0, 1, 2, 3, 4, 7, 8, 9, 12, 13};
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].index, numbers[i]);
    const TrueFrame& same = all[static_cast<std::size_t>(numbers[i])];
    EXPECT_EQ(kept[i].stamp_ns, same.stamp_ns);
    EXPECT_EQ(mean_difference(kept[i], same, 2), 0);
    EXPECT_EQ(kept[i].dropped_frames, i == 5 || i == 8 ? 2 : 0);
  }
}

// The motion of the middle of the picture, px a frame of the plain camera at 80 Hz.
std::vector<double> speeds(PathKind path, double path_speed, std::uint64_t seed) {
  SceneOptions options;
  options.path = path;
  options.path_speed = path_speed;
  options.seed = seed;
  const Viewpoint view{{0, 0, 1}, {0, 1, 1}, 0, {}, 0.5};
  const Lens lens(intrinsics_of(options.camera));
  std::vector<double> result;
  Axes before = axes_of(pose_at(view, options, 0));
  for (int i = 1; i < 4000; ++i) {
    const Axes now = axes_of(pose_at(view, options, i));
    const Vec3 seen{dot(before.forward, now.right), dot(before.forward, now.down),
                    dot(before.forward, now.forward)};
    const Point p = lens.pixel({seen.x / seen.z, seen.y / seen.z});
    result.push_back(std::hypot(p.x - lens.intrinsics().cx_px, p.y - lens.intrinsics().cy_px));
    before = now;
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Shake, IsAsFastAsAHandThatRuns) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto px = speeds(PathKind::kShake, 1, seed);
    EXPECT_NEAR(px[px.size() / 2], 4.1, 0.4);
    EXPECT_GT(px.back(), 20);
    EXPECT_LT(px.back(), 30);
    // A hand that holds still, for comparison.
    EXPECT_LT(speeds(PathKind::kHand, 1, seed)[px.size() / 2], 1);
  }
}

TEST(Pan, IsFasterByItsSpeed) {
  const auto slow = speeds(PathKind::kPan, 1, 1);
  const auto fast = speeds(PathKind::kPan, 10, 1);
  EXPECT_NEAR(fast[2000] / slow[2000], 10, 0.6);
  EXPECT_GT(fast.back(), 10);
}

TEST(Motion, GoesThereAndBack) {
  Motion motion{{2, 0, 4}, 3, 2, false};
  EXPECT_EQ(moved_by(motion, 0), (Vec3{0, 0, 0}));
  EXPECT_EQ(moved_by(motion, 4), (Vec3{1, 0, 2}));
  EXPECT_EQ(moved_by(motion, 5), (Vec3{2, 0, 4}));
  EXPECT_EQ(moved_by(motion, 9), (Vec3{2, 0, 4}));
  motion.back = true;
  EXPECT_EQ(moved_by(motion, 6), (Vec3{1, 0, 2}));
  EXPECT_EQ(moved_by(motion, 7), (Vec3{0, 0, 0}));
  EXPECT_EQ(moved_by(motion, 8), (Vec3{1, 0, 2}));
}

// Mean x of the points of an object's edges.
double middle_of(const TrueFrame& frame, int object) {
  double sum = 0;
  double count = 0;
  for (const TrueEdge& edge : frame.edges) {
    for (const Point p : edge.points) {
      sum += edge.object == object ? p.x : 0;
      count += edge.object == object ? 1 : 0;
    }
  }
  return count > 0 ? sum / count : std::nan("");
}

TEST(MovingBox, MovesAtItsSpeedInEveryScene) {
  for (const std::string name : {"desk", "corridor", "office", "empty"}) {
    const auto frames =
        frames_of("sim:" + name + "?width=160&height=120&frames=11&path=still&box=1&box_speed=3");
    ASSERT_EQ(frames[10].moved.size(), 1U);
    const int box = frames[10].moved[0].object;
    EXPECT_NEAR((middle_of(frames[10], box) - middle_of(frames[0], box)) / 10, 3, 0.3) << name;
    // What was there without the box keeps its identity.
    std::map<int, int> objects;
    for (const TrueFrame& frame : frames) {
      for (const TrueEdge& edge : frame.edges) {
        EXPECT_EQ(objects.try_emplace(edge.id, edge.object).first->second, edge.object);
      }
    }
    EXPECT_EQ(frames_of("sim:" + name + "?box=1&box_speed=0")[0].moved.size(), 0U);
  }
}

TEST(HotThing, ComesInFromTheLeftAndStays) {
  const auto frames = frames_of(
      "sim:corridor?width=96&height=72&frames=60&path=still&hot=1&hot_at=0.1&hot_speed=4");
  const int hot = frames[0].moved.at(0).object;
  EXPECT_TRUE(std::isnan(middle_of(frames[0], hot)));
  EXPECT_TRUE(std::isnan(middle_of(frames[8], hot)));
  EXPECT_LT(middle_of(frames[24], hot), 48);
  EXPECT_GT(middle_of(frames[24], hot), 3);
  EXPECT_NEAR(middle_of(frames[58], hot), middle_of(frames[59], hot), 1e-9);
  EXPECT_GT(middle_of(frames[59], hot), 48);
  double hottest = 0;
  for (int x = 0; x < 96; ++x) {
    hottest = std::max(hottest, static_cast<double>(frames[59].clean(x, 36)));
  }
  EXPECT_GT(hottest, 5000);  // 60 degC
}

TEST(MovingThings, OfASceneFile) {
  const auto world = parse_world(
      "[view]\nposition_m = [0, 0, 0]\nlook_at_m = [0, 1, 0]\n[[object]]\ntype = 'sphere'\n"
      "centre_m = [0, 2, 0]\nradius_m = 0.3\ntemperature_degc = 30\nmoves_m = [1, 0, 0]\n"
      "moves_from_s = 2\nmoves_in_s = 4\nmoves_back = true\n",
      "ball", 1);
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_TRUE(world->objects[0].moves());
  const World later = world_at(*world, 4);
  EXPECT_EQ(std::get<Sphere>(later.objects[0].shape).centre, (Vec3{0.5, 2, 0}));
  const auto bad = parse_world(
      "[view]\nposition_m = [0, 0, 0]\nlook_at_m = [0, 1, 0]\n[[object]]\ntype = 'sphere'\n"
      "centre_m = [0, 2, 0]\nradius_m = 0.3\nmoves_in_s = 0\n",
      "ball", 1);
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("moves_in_s"), std::string::npos) << bad.error().message;
}

// A ball that sinks into the floor between two walls that pierce it: no number of an edge changes.
TEST(MovingThings, ChangeNoNumbersOfEdges) {
  const auto world = parse_world(
      "[view]\nposition_m = [0, 0, 1]\nlook_at_m = [0, 1, 1]\n"
      "[[object]]\ntype = 'sphere'\ncentre_m = [0, 2, 1]\nradius_m = 0.3\nmoves_m = [0, 0, -1]\n"
      "[[object]]\ntype = 'quad'\ncorner_m = [-1, 1, 0]\nright_m = [2, 0, 0]\nup_m = [0, 2, 0]\n"
      "[[object]]\ntype = 'quad'\ncorner_m = [-0.5, 1, -1]\nright_m = [0, 2, 0]\n"
      "up_m = [0, 0, 2]\n",
      "ball", 1);
  ASSERT_TRUE(world) << world.error().message;
  const Facets before = tessellate(world_at(*world, 0));
  const Facets later = tessellate(world_at(*world, 1));
  ASSERT_EQ(before.curves.size(), later.curves.size());
  EXPECT_EQ(before.curves.size(), 1U + 4 + 4 + 1);
  EXPECT_EQ(before.curves.back().curve.centre, later.curves.back().curve.centre);
}

TEST(Sequence, HasTheSameBitsOnEveryMachineAndInAnyOrder) {
  const std::string spec =
      kSmall +
      "frames=20&path=shake&box=1&hot=1&hot_at=0&freeze_every=9&freeze_noise=0.2&freeze_frames=2&"
      "jump_every=5&pattern_every=7&pixel_sigma=3&drop_every=6&drop_frames=1";
  const auto frames = frames_of(spec);
  const auto options = parse_scene(spec);
  auto renderer = Renderer::create(*options);
  const auto runner = make_runner(2);
  for (int i = 19; i >= 0; --i) {
    const auto again = renderer->render(i, *runner);
    const TrueFrame& first = frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(mean_difference(*again, first, 2), 0) << i;
    EXPECT_EQ(truth_line(*again), truth_line(first)) << i;
  }
  test::Hash hash;
  for (const TrueFrame& frame : frames) {
    hash.add_pixels(ImageView<const std::uint16_t>(frame.counts.view()));
  }
  EXPECT_EQ(hash.value(), 6276839889716313210ULL);
}

TEST(TruthLine, TellsWhatHappened) {
  const auto frames =
      frames_of(kSmall +
                "frames=8&freeze_every=4&freeze_frames=1&jump_every=5&drop_every=6&drop_frames=1&"
                "box=1&jump=80");
  const auto json = [&](std::size_t i) { return nlohmann::json::parse(truth_line(frames[i])); };
  EXPECT_TRUE(json(0)["freeze"].is_null());
  EXPECT_EQ(json(0)["events"], nlohmann::json::array());
  EXPECT_EQ(json(4)["freeze"]["frozen"], true);
  EXPECT_EQ(json(4)["freeze"]["shows_frame"], 3);
  EXPECT_EQ(json(4)["events"], nlohmann::json({"frozen"}));
  EXPECT_EQ(json(5)["events"], nlohmann::json({"offset_jump"}));
  EXPECT_GT(std::abs(json(5)["offset_counts"].get<double>()), 40);
  EXPECT_EQ(json(6)["events"][0], "dropped");
  EXPECT_EQ(json(6)["dropped_frames"], 1);
  EXPECT_EQ(json(6)["frame"], 7);
  EXPECT_EQ(json(6)["moved"][0]["object"], frames[6].moved[0].object);
  EXPECT_NE(json(6)["moved"][0]["by_m"][0], 0);
}

TEST(Sequence, OptionsThatDoNotFitAreErrors) {
  const auto message = [](const std::string& keys) {
    const auto options = parse_scene("sim:desk?" + keys);
    EXPECT_TRUE(options) << options.error().message;
    const auto renderer = Renderer::create(*options);
    return renderer ? "" : renderer.error().message;
  };
  EXPECT_EQ(message("freeze_every=5&freeze_frames=5"),
            "sim:desk: freeze_frames should be less than freeze_every");
  EXPECT_EQ(message("drop_every=2"), "sim:desk: drop_frames should be less than drop_every");
  EXPECT_EQ(message("frames=1000000&drop_every=9000&drop_frames=8999").substr(0, 30),
            "sim:desk: 1000000 frames besid");
  EXPECT_EQ(parse_scene("sim:desk?box=2").error().message,
            "sim:desk?box=2: box=2 should be a whole number from 0 to 1");
}

}  // namespace
}  // namespace thermedge::sim
