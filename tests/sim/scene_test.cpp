// The simulator from its outside: the same bits everywhere, noise with the stated statistics,
// scenes by name and key.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>

#include "random.hpp"
#include "support/runners.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {
namespace {

// FNV-1a over the pixel values.
std::uint64_t fingerprint(ImageView<const std::uint16_t> image) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      hash = (hash ^ image(x, y)) * 0x100000001b3ULL;
    }
  }
  return hash;
}

TrueFrame rendered(const std::string& spec, int index = 0) {
  const auto options = parse_scene(spec);
  EXPECT_TRUE(options) << options.error().message;
  auto frame = render(*options, index);
  EXPECT_TRUE(frame) << frame.error().message;
  return std::move(*frame);
}

TEST(Sim, GivesTheSameBitsOnEveryMachine) {
  EXPECT_EQ(fingerprint(rendered("sim:desk").counts), 0xa7769303730ea1bfULL);
  EXPECT_EQ(fingerprint(rendered("sim:corridor?seed=5&frames=20&sigma=20", 19).counts),
            0x38c5f7fa57d04d5eULL);
}

TEST(Sim, VariesWithSeedAndFrame) {
  const auto desk = fingerprint(rendered("sim:desk?frames=2").counts);
  EXPECT_NE(fingerprint(rendered("sim:desk?frames=2", 1).counts), desk);
  EXPECT_NE(fingerprint(rendered("sim:desk?seed=2").counts), desk);
}

TEST(Random, LogarithmIsRight) {
  for (const double x : {1e-300, 1e-9, 0.1, 0.5, 0.70710678, 0.99999, 1.0, 1.5, 7.0, 1e9}) {
    EXPECT_NEAR(exact_log(x), std::log(x), 1e-13 * (1 + std::abs(std::log(x))));
  }
}

TEST(Random, DeviatesAreNormalAndWhite) {
  constexpr int kCount = 400000;
  const Random random(3, 4);
  double sums[5] = {};
  double neighbours = 0;
  double largest = 0;
  double previous = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.normal(static_cast<std::uint64_t>(i));
    double power = 1;
    for (double& sum : sums) {
      sum += power;
      power *= value;
    }
    neighbours += value * previous;
    previous = value;
    largest = std::max(largest, std::abs(value));
  }
  EXPECT_NEAR(sums[1] / kCount, 0, 0.006);
  EXPECT_NEAR(sums[2] / kCount, 1, 0.01);
  EXPECT_NEAR(sums[3] / kCount, 0, 0.02);
  EXPECT_NEAR(sums[4] / kCount, 3, 0.06);
  EXPECT_NEAR(neighbours / kCount, 0, 0.006);
  EXPECT_GT(largest, 4.2);
}

TEST(Sim, NoiseIsWhiteNormalAndAsStrongAsAskedFor) {
  const auto frame = rendered("sim:desk?sigma=20&column_sigma=0&row_sigma=0&bad_pixels=0");
  const auto noise = [&](int x, int y) {
    return (static_cast<double>(frame.counts(x, y)) - double{frame.clean(x, y)}) / 20;
  };
  double mean = 0;
  double variance = 0;
  double kurtosis = 0;
  double across = 0;
  double down = 0;
  for (int y = 0; y + 1 < frame.counts.height(); ++y) {
    for (int x = 0; x + 1 < frame.counts.width(); ++x) {
      const double value = noise(x, y);
      mean += value;
      variance += value * value;
      kurtosis += value * value * value * value;
      across += value * noise(x + 1, y);
      down += value * noise(x, y + 1);
    }
  }
  const double count = (frame.counts.width() - 1) * (frame.counts.height() - 1);
  EXPECT_NEAR(mean / count, 0, 0.01);
  EXPECT_NEAR(std::sqrt(variance / count), 1, 0.01);
  EXPECT_NEAR(kurtosis / count, 3, 0.06);
  EXPECT_NEAR(across / count, 0, 0.01);
  EXPECT_NEAR(down / count, 0, 0.01);
}

TEST(Sim, FixedPatternStaysAndNoiseChanges) {
  const std::string spec = "sim:desk?frames=2&sigma=0&column_sigma=30&row_sigma=20&bad_pixels=4";
  const auto pattern = [](const TrueFrame& frame, int x, int y) {
    return std::lround(frame.counts(x, y) - frame.clean(x, y));
  };
  const auto first = rendered(spec, 0);
  const auto second = rendered(spec, 1);
  int same = 0;
  for (int x = 0; x < first.counts.width(); ++x) {
    same += std::abs(pattern(first, x, 100) - pattern(second, x, 100)) <= 1 ? 1 : 0;
  }
  EXPECT_GE(same, first.counts.width() - 4);
}

TEST(Sim, DeadPixelsAreStuckAndAsManyAsAskedFor) {
  for (const int wanted : {0, 9, 250}) {
    for (const int seed : {1, 2, 3}) {
      const auto frame =
          rendered("sim:corridor?width=16&height=16&bad_pixels=" + std::to_string(wanted) +
                   "&seed=" + std::to_string(seed));
      int lowest = 0;
      int highest = 0;
      for (int y = 0; y < frame.counts.height(); ++y) {
        for (int x = 0; x < frame.counts.width(); ++x) {
          lowest += frame.counts(x, y) == 0 ? 1 : 0;
          highest += frame.counts(x, y) == 16383 ? 1 : 0;
        }
      }
      EXPECT_EQ(lowest, (wanted + 1) / 2);
      EXPECT_EQ(highest, wanted / 2);
    }
  }
}

TEST(Sim, LiesAmongTheLevelsOfARealCamera) {
  for (const std::string& name : scene_names()) {
    const auto frame = rendered("sim:" + name);
    for (int y = 0; y < frame.clean.height(); ++y) {
      for (int x = 0; x < frame.clean.width(); ++x) {
        EXPECT_GT(frame.clean(x, y), 300);
        EXPECT_LT(frame.clean(x, y), 6000);
      }
    }
  }
}

TEST(Sim, GivesTheSameBitsForEveryRunner) {
  const auto options = parse_scene(
      "sim:office?frames=40&camera=pi450&shutter_every=20&"
      "shutter_frames=5&path=drive");
  for (const int index : {0, 21, 39}) {
    std::set<std::uint64_t> prints;
    for (const auto& runner : test::all_runners()) {
      auto renderer = Renderer::create(*options);
      auto frame = renderer->render(index, *runner);
      std::uint64_t print = fingerprint(frame->counts);
      for (const TrueEdge& edge : frame->edges) {
        for (const Point p : edge.points) {
          print = (print ^ std::bit_cast<std::uint64_t>(p.x)) * 0x100000001b3ULL;
        }
      }
      prints.insert(print);
    }
    EXPECT_EQ(prints.size(), 1U);
  }
}

TEST(Sim, FramesDoNotDependOnTheirOrder) {
  const auto options = parse_scene("sim:desk?frames=9&camera=pi450&width=96&height=72&drift=0.05");
  const auto runner = make_runner(1);
  auto forward = Renderer::create(*options);
  auto backward = Renderer::create(*options);
  std::vector<std::uint64_t> prints;
  for (int i = 0; i < 9; ++i) {
    prints.push_back(fingerprint(forward->render(i, *runner)->counts));
  }
  for (int i = 8; i >= 0; --i) {
    EXPECT_EQ(fingerprint(backward->render(i, *runner)->counts),
              prints[static_cast<std::size_t>(i)]);
  }
}

TEST(Truth, IsInsideTheFrameAndDense) {
  for (const std::string& name : scene_names()) {
    for (const int index : {0, 29}) {
      const auto frame = rendered("sim:" + name + "?frames=30", index);
      if (name != "empty") {
        ASSERT_GT(frame.edges.size(), 30U);
      }
      for (const TrueEdge& edge : frame.edges) {
        EXPECT_GE(edge.contrast_counts, 10);
        for (std::size_t i = 0; i < edge.points.size(); ++i) {
          const Point p = edge.points[i];
          EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x <= 381 && p.y <= 287);
          if (i > 0) {
            EXPECT_LE(std::hypot(p.x - edge.points[i - 1].x, p.y - edge.points[i - 1].y), 0.5001);
          }
        }
      }
    }
  }
}

TEST(Truth, OfAnEmptyWallIsNothing) {
  const auto frame = rendered("sim:empty?camera=pi450&vignetting=0");
  EXPECT_TRUE(frame.edges.empty());
  for (int y = 0; y < frame.clean.height(); ++y) {
    EXPECT_NEAR(frame.clean(100, y), frame.clean(0, 0), 0.01);
  }
}

TEST(Sim, ScalesToOtherSizes) {
  const auto frame = rendered("sim:desk?width=640&height=512");
  EXPECT_EQ(frame.counts.width(), 640);
  EXPECT_EQ(frame.counts.height(), 512);
  EXPECT_GT(frame.edges.size(), 15U);
}

TEST(ParseScene, NamesWhatIsWrong) {
  const auto message = [](const std::string& spec) {
    const auto options = parse_scene(spec);
    return options ? "" : options.error().message;
  };
  EXPECT_EQ(
      message("sim:magic"),
      "sim:magic: no such scene; there are desk, corridor, office, road, empty, and files that end "
      "in .toml");
  EXPECT_EQ(message("sim:desk?colour=1").substr(0, 76),
            "sim:desk?colour=1: unknown key 'colour'; known are camera, path, seed, frame");
  EXPECT_EQ(
      message("sim:desk?camera=magic"),
      "sim:desk?camera=magic: camera=magic: no such camera; there are pi450, boson, lepton35");
  EXPECT_EQ(
      message("sim:desk?path=zigzag"),
      "sim:desk?path=zigzag: path=zigzag: no such path; there are hand, drive, pan, shake, still");
  EXPECT_EQ(message("sim:desk?seed=1&frames=1.5"),
            "sim:desk?seed=1&frames=1.5: frames=1.5 should be a whole number from 1 to 1000000");
  EXPECT_EQ(message("sim:desk?sigma=loud"),
            "sim:desk?sigma=loud: sigma=loud should be a number from 0 to 5000");
  EXPECT_EQ(message("sim:desk?sigma=nan"),
            "sim:desk?sigma=nan: sigma=nan should be a number from 0 to 5000");
  EXPECT_EQ(message("sim:desk?sigma"), "sim:desk?sigma: sigma= should be a number from 0 to 5000");
}

TEST(ParseScene, ReadsEveryKey) {
  const auto options = parse_scene(
      "sim:corridor?seed=3&frames=20&width=64&height=48&blur=0.5&sigma=20&column_sigma=2&"
      "row_sigma=3&bad_pixels=7");
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(options->name, "corridor");
  EXPECT_EQ(options->seed, 3U);
  EXPECT_EQ(options->frames, 20);
  EXPECT_EQ(options->camera.width, 64);
  EXPECT_EQ(options->camera.height, 48);
  EXPECT_EQ(options->camera.blur_px, 0.5);
  EXPECT_EQ(options->camera.sigma_counts, 20);
  EXPECT_EQ(options->camera.column_sigma_counts, 2);
  EXPECT_EQ(options->camera.row_sigma_counts, 3);
  EXPECT_EQ(options->camera.bad_pixels, 7);
}

TEST(ParseScene, AppliesTheCameraFirst) {
  const auto options = parse_scene("sim:road?netd_mk=60&path=drive&camera=boson&fov=90");
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(options->camera.width, 640);
  EXPECT_DOUBLE_EQ(options->camera.sigma_counts, 6);
  EXPECT_EQ(options->camera.fov_deg, 90);
  EXPECT_EQ(options->camera.column_sigma_counts, camera_preset("boson")->column_sigma_counts);
  EXPECT_EQ(options->path, PathKind::kDrive);
}

TEST(Render, NamesWhatIsOutOfRange) {
  const auto message = [](const SceneOptions& options, int index) {
    const auto frame = render(options, index);
    return frame ? "" : frame.error().message;
  };
  SceneOptions options;
  options.camera.width = 8;
  EXPECT_EQ(message(options, 0), "sim:desk: width should be a whole number from 16 to 4096");
  options = {};
  options.camera.blur_px = std::nan("");
  EXPECT_EQ(message(options, 0), "sim:desk: blur should be a number from 0 to 20");
  options = {};
  options.camera.fov_deg = 110;
  options.camera.k1 = -0.3;
  EXPECT_EQ(message(options, 0),
            "sim:desk: k1 and k2 bend rays back at this fov; both should be nearer to 0");
  options = {};
  options.camera.shutter_every = 10;
  EXPECT_EQ(message(options, 0), "sim:desk: shutter_frames should be less than shutter_every");
  options = {};
  options.name = "magic";
  EXPECT_EQ(
      message(options, 0),
      "sim:magic: no such scene; there are desk, corridor, office, road, empty, and files that end "
      "in .toml");
  EXPECT_EQ(message({}, 1), "sim:desk: there is no frame 1; frames are 0 to 0");
  EXPECT_EQ(message({}, -1), "sim:desk: there is no frame -1; frames are 0 to 0");
}

}  // namespace
}  // namespace thermedge::sim
