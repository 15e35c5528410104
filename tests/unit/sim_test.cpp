// The simulated scenes: the same bits everywhere, noise with the stated statistics, truth where the
// picture has it.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/src/random.hpp"
#include "sim/src/render.hpp"
#include "support/images.hpp"
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
  EXPECT_EQ(fingerprint(rendered("sim:desk").counts), 0xe238f6e343cf643aULL);
  EXPECT_EQ(fingerprint(rendered("sim:corridor?seed=5&frames=20&sigma=20", 19).counts),
            0x77e01338361d232aULL);
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
  const auto frame = rendered("sim:desk?sigma=20&column_sigma=0&row_sigma=0&dead_pixels=0");
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
  const std::string spec = "sim:desk?frames=2&sigma=0&column_sigma=30&row_sigma=20&dead_pixels=4";
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
          rendered("sim:corridor?width=16&height=16&dead_pixels=" + std::to_string(wanted) +
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
  for (const std::string name : {"desk", "corridor"}) {
    const auto frame = rendered("sim:" + name);
    for (int y = 0; y < frame.clean.height(); ++y) {
      for (int x = 0; x < frame.clean.width(); ++x) {
        EXPECT_GT(frame.clean(x, y), 2000);
        EXPECT_LT(frame.clean(x, y), 3600);
      }
    }
  }
}

TEST(Scene, TakesItsTemperaturesAlongWhenTransformed) {
  Scene scene(1000, 2, 3);
  scene.add(rectangle(10, 10, 30, 20), 1500, -1, 4);
  Scene moved = scene;
  moved.transform(2, 3, {5, -7});
  for (const Point p : {Point{0, 0}, Point{12, 17}, Point{40, 3}}) {
    const Point q{2 * p.x + 5, 3 * p.y - 7};
    EXPECT_NEAR(moved.background_at(q), scene.background_at(p), 1e-9);
    EXPECT_NEAR(moved.object_at(0, q), scene.object_at(0, p), 1e-9);
    EXPECT_EQ(moved.topmost_below(1, q), scene.topmost_below(1, p));
  }
}

TEST(Cover, IsExactForStraightSides) {
  Image<double> coverage(8, 6);
  cover(rectangle(1.25, 0.5, 4.0, 3.75), {0, 0}, coverage);
  EXPECT_DOUBLE_EQ(coverage(1, 1), 0.25);  // the square of column 1 reaches from 0.5 to 1.5
  EXPECT_DOUBLE_EQ(coverage(2, 2), 1);
  EXPECT_DOUBLE_EQ(coverage(4, 4), 0.125);  // 0.5 wide, 0.25 high
  EXPECT_DOUBLE_EQ(coverage(5, 2), 0);
  cover(polygon({{-9, -9}, {20, -9}, {20, 20}, {-9, 20}}), {0, 0}, coverage);
  EXPECT_DOUBLE_EQ(coverage(0, 0), 1);
  EXPECT_DOUBLE_EQ(coverage(7, 5), 1);
}

TEST(Cover, SumsToTheAreaOfASlantedShape) {
  Image<double> coverage(40, 40);
  const Outline triangle = polygon({{3.3, 4.1}, {33.7, 9.9}, {12.2, 35.6}});
  cover(triangle, {0, 0}, coverage);
  double sum = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      sum += coverage(x, y);
    }
  }
  const double area = std::abs((33.7 - 3.3) * (35.6 - 4.1) - (12.2 - 3.3) * (9.9 - 4.1)) / 2;
  EXPECT_NEAR(sum, area, 1e-9);
}

TEST(Blur, KeepsTheSum) {
  Image<double> image(41, 41);
  fill_pixels(image.view(), 0.0);
  image(20, 20) = 1000;
  blur(image, 1.3);
  double sum = 0;
  double spread = 0;
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      sum += image(x, y);
      spread += image(x, y) * (x - 20) * (x - 20);
    }
  }
  EXPECT_NEAR(sum, 1000, 1e-9);
  EXPECT_NEAR(std::sqrt(spread / sum), 1.3, 0.01);
}

// Where row y of the picture crosses `level`, between pixels.
double crossing(ImageView<const float> image, int y, double level) {
  int x = 0;
  while (double{image(x + 1, y)} < level) {
    ++x;
  }
  return x + (level - double{image(x, y)}) / (double{image(x + 1, y)} - double{image(x, y)});
}

TEST(Truth, LiesWhereTheBlurredStepIs) {
  for (const double position : {20.0, 20.3, 20.77}) {
    Scene scene(1000, 0, 0);
    scene.add(polygon({{position, -50}, {90, -50}, {90, 90}, {position, 90}}), 1400);
    const Image<float> clean = render_clean(scene, 40, 30, 1.0);
    EXPECT_NEAR(crossing(clean, 15, 1200), position, 0.02);
    // Blur moves no energy across the step: what is missing to the right's level sums up to it.
    double missing = 0;
    for (int x = 0; x < clean.width(); ++x) {
      missing += (1400.0 - double{clean(x, 15)}) / 400.0;
    }
    EXPECT_NEAR(missing - 0.5, position, 0.001);
    const auto edges = true_edges(scene, 40, 30, 10);
    ASSERT_EQ(edges.size(), 1U);
    EXPECT_NEAR(edges[0].contrast_counts, 400, 1e-9);
    for (const Point p : edges[0].points) {
      EXPECT_EQ(p.x, position);
    }
  }
}

TEST(Truth, LiesOnASlantedStepAtEveryRow) {
  // The half plane x >= 15 + 0.3 y.
  Scene scene(1000, 0, 0);
  scene.add(polygon({{0, -50}, {150, -50}, {150, 100}, {45, 100}}), 1400);
  const Image<float> clean = render_clean(scene, 50, 40, 1.0);
  for (int y = 0; y < clean.height(); ++y) {
    EXPECT_NEAR(crossing(clean, y, 1200), 15 + 0.3 * y, 0.02);
  }
  for (const TrueEdge& edge : true_edges(scene, 50, 40, 10)) {
    for (const Point p : edge.points) {
      EXPECT_NEAR(p.x, 15 + 0.3 * p.y, 1e-9);
    }
  }
}

TEST(Truth, MovesWithTheHand) {
  const std::string spec = "sim:desk?frames=9&sigma=0&column_sigma=0&row_sigma=0";
  const auto first = rendered(spec, 0);
  const auto last = rendered(spec, 8);
  const auto charger = [](const TrueFrame& frame) {
    const TrueEdge* found = nullptr;
    for (const TrueEdge& edge : frame.edges) {
      found = edge.closed && (found == nullptr || edge.object > found->object) ? &edge : found;
    }
    return *found;
  };
  const TrueEdge before = charger(first);
  const TrueEdge behind = charger(last);
  ASSERT_EQ(before.object, behind.object);
  ASSERT_EQ(before.points.size(), behind.points.size());
  const double dx = behind.points[0].x - before.points[0].x;
  const double dy = behind.points[0].y - before.points[0].y;
  EXPECT_GT(std::hypot(dx, dy), 0.5);
  EXPECT_LT(std::hypot(dx, dy), 9);
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    EXPECT_NEAR(behind.points[i].x - before.points[i].x, dx, 1e-9);
    EXPECT_NEAR(behind.points[i].y - before.points[i].y, dy, 1e-9);
  }
}

TEST(Truth, LeavesOutStepsThatNobodyCouldSee) {
  Scene scene(1000, 0, 0);
  scene.add(rectangle(10, 10, 30, 30), 1009);
  EXPECT_TRUE(true_edges(scene, 40, 40, 10).empty());
  EXPECT_EQ(true_edges(scene, 40, 40, 8).size(), 1U);
}

TEST(Truth, EndsWhereAnotherObjectHidesIt) {
  Scene scene(1000, 0, 0);
  scene.add(rectangle(10, 10, 50, 30), 1100);
  scene.add(rectangle(30, 5, 40, 35), 1200);
  const auto edges = true_edges(scene, 60, 40, 10);
  ASSERT_EQ(edges.size(), 3U);
  EXPECT_FALSE(edges[0].closed);
  EXPECT_FALSE(edges[1].closed);
  EXPECT_TRUE(edges[2].closed);
  for (const TrueEdge& edge : {edges[0], edges[1]}) {
    EXPECT_EQ(edge.object, 0);
    for (const Point p : edge.points) {
      EXPECT_FALSE(p.x > 30 && p.x < 40);
    }
  }
}

TEST(Truth, IsInsideTheFrameDenseAndKeepsItsObjects) {
  for (const std::string name : {"desk", "corridor"}) {
    const std::string spec = "sim:" + name + "?frames=30";
    std::set<int> first;
    for (const int index : {0, 29}) {
      std::set<int> objects;
      const auto frame = rendered(spec, index);
      ASSERT_GT(frame.edges.size(), 15U);
      for (const TrueEdge& edge : frame.edges) {
        objects.insert(edge.object);
        for (std::size_t i = 0; i < edge.points.size(); ++i) {
          const Point p = edge.points[i];
          EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x <= 381 && p.y <= 287);
          if (i > 0) {
            EXPECT_LE(std::hypot(p.x - edge.points[i - 1].x, p.y - edge.points[i - 1].y), 0.5001);
          }
        }
      }
      first = first.empty() ? objects : first;
      EXPECT_EQ(objects, first);
    }
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
  EXPECT_EQ(message("sim:magic"), "sim:magic: no such scene; there are desk, corridor");
  EXPECT_EQ(message("sim:desk?colour=1"),
            "sim:desk?colour=1: unknown key 'colour'; known are seed, frames, width, height, blur, "
            "sigma, column_sigma, row_sigma, dead_pixels");
  EXPECT_EQ(message("sim:desk?seed=1&frames=1.5"),
            "sim:desk?seed=1&frames=1.5: frames=1.5 should be a whole number from 1 to 1000000");
  EXPECT_EQ(message("sim:desk?sigma=loud"),
            "sim:desk?sigma=loud: sigma=loud should be a number from 0 to 5000");
  EXPECT_EQ(message("sim:desk?sigma=nan"),
            "sim:desk?sigma=nan: sigma=nan should be a number from 0 to 5000");
  EXPECT_EQ(message("sim:desk?sigma"), "sim:desk?sigma: sigma should be a number from 0 to 5000");
}

TEST(ParseScene, ReadsEveryKey) {
  const auto options = parse_scene(
      "sim:corridor?seed=3&frames=20&width=64&height=48&blur=0.5&sigma=20&column_sigma=2&"
      "row_sigma=3&dead_pixels=7");
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
  EXPECT_EQ(options->camera.dead_pixels, 7);
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
  options.name = "magic";
  EXPECT_EQ(message(options, 0), "sim:magic: no such scene; there are desk, corridor");
  EXPECT_EQ(message({}, 1), "sim:desk: there is no frame 1; frames are 0 to 0");
  EXPECT_EQ(message({}, -1), "sim:desk: there is no frame -1; frames are 0 to 0");
}

}  // namespace
}  // namespace thermedge::sim
