// Scenes in users' conditions: what each does to the picture and to the truth.
#include "scene_conditions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "processing.hpp"

namespace thermedge::bench {
namespace {

const SceneCondition& condition(Circumstance circumstance) {
  return *std::find_if(kSceneConditions.begin(), kSceneConditions.end(),
                       [&](const auto& one) { return one.circumstance == circumstance; });
}

std::size_t marked(ImageView<const std::uint8_t> map) {
  std::size_t count = 0;
  for (int y = 0; y < map.height(); ++y) {
    count += static_cast<std::size_t>(
        std::count_if(map.row(y), map.row(y) + map.width(), [](auto value) { return value != 0; }));
  }
  return count;
}

// Where the one map has edges and the other has none within 2 px.
std::size_t only_in(ImageView<const std::uint8_t> one, ImageView<const std::uint8_t> other) {
  const eval::CurveFrame pixels = eval::pixels_as_curves(other);
  const eval::NearestOnCurves near(pixels.curves, 2);
  std::size_t count = 0;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) {
      count += one(x, y) != 0 && !near.is_near({double(x), double(y)}) ? 1 : 0;
    }
  }
  return count;
}

TEST(SceneConditions, AskForLessThanTheyAccept) {
  for (const SceneCondition& one : kSceneConditions) {
    const TestFrame frame = scene_under(one, 3);
    const auto& asked = frame.truth.annotators.front();
    const auto& accepted = frame.truth.accepted.front();
    EXPECT_GT(marked(asked), 1000U) << one.name;
    EXPECT_GE(marked(accepted) + 50, marked(asked)) << one.name;
    EXPECT_LT(only_in(asked, accepted), marked(asked) / 50) << one.name;
    EXPECT_EQ(frame.bits, one.circumstance == Circumstance::kJpeg ? 8 : 16) << one.name;
  }
}

TEST(SceneConditions, MoreNoiseLeavesFewerEdgesToAskFor) {
  const TestFrame weak = scene_under(kSceneConditions[0], 3);
  const TestFrame strong = scene_under(kSceneConditions[1], 3);
  ASSERT_EQ(kSceneConditions[1].sigma_counts, 20);
  EXPECT_LT(marked(strong.truth.annotators.front()),
            0.9 * static_cast<double>(marked(weak.truth.annotators.front())));
}

TEST(SceneConditions, HotThingsChangeNothingElse) {
  const TestFrame plain = scene_under(condition(Circumstance::kNone), 4);
  const TestFrame hot = scene_under(condition(Circumstance::kHotThings), 4);
  std::size_t hot_pixels = 0;
  std::size_t changed = 0;
  for (int y = 0; y < 288; ++y) {
    for (int x = 0; x < 382; ++x) {
      changed += hot.counts(x, y) != plain.counts(x, y) ? 1 : 0;
      hot_pixels += hot.counts(x, y) > plain.counts(x, y) + 500 ? 1 : 0;
    }
  }
  EXPECT_GT(hot_pixels, 50U);
  EXPECT_LT(hot_pixels, 3300U);
  EXPECT_LT(changed, hot_pixels + 1200);  // and what the optics spread
  const std::size_t more = only_in(hot.truth.annotators.front(), plain.truth.annotators.front());
  EXPECT_GT(more, 20U);
  EXPECT_LT(more, 600U);
}

TEST(SceneConditions, WideScenesHaveFaintEdges) {
  SceneVariation faint;
  faint.faint_steps = true;
  double least = 1;
  std::size_t below = 0;
  std::size_t pieces = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const eval::Curve& curve : random_scene(seed, faint).edges.curves) {
      least = std::min(least, curve.contrast_counts);
      below += curve.contrast_counts < 0.02 ? 1 : 0;
      ++pieces;
    }
  }
  EXPECT_LT(least, 0.005);
  EXPECT_GT(below, pieces / 5);
}

TEST(SceneConditions, CornersAreBlackAndHaveNoTruthBesideThem) {
  std::size_t black = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TestFrame frame = scene_under(condition(Circumstance::kBlackCorners), seed);
    const auto is_black = [&](int x, int y) { return frame.counts(x, y) == 0; };
    for (int y = 3; y < 285; ++y) {
      for (int x = 3; x < 379; ++x) {
        const bool inside = is_black(x, y) && is_black(x - 1, y) && is_black(x + 1, y) &&
                            is_black(x, y - 1) && is_black(x, y + 1);
        if (!inside) {
          continue;  // among them single bad pixels
        }
        ++black;
        for (const int dx : {-2, 0, 2}) {
          for (const int dy : {-2, 0, 2}) {
            EXPECT_EQ(frame.truth.accepted.front()(x + dx, y + dy), 0) << x << ", " << y;
            EXPECT_EQ(frame.truth.annotators.front()(x + dx, y + dy), 0) << x << ", " << y;
          }
        }
      }
    }
  }
  EXPECT_GT(black, 1000U);
  EXPECT_LT(black, 3 * 382 * 288 / 5U);
}

TEST(SceneConditions, UnevenNoiseGrowsFromHalfToTwice) {
  const SceneCondition& uneven = condition(Circumstance::kUnevenNoise);
  EXPECT_NEAR(uneven_noise(0, 382), 0.5, 1e-12);
  EXPECT_NEAR(uneven_noise(381, 382), 2, 1e-12);
  // More of the edges that are asked for lie where there is less noise.
  std::size_t left_more = 0;
  std::size_t right_more = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const auto even = scene_under(condition(Circumstance::kNone), seed);
    const auto frame = scene_under(uneven, seed);
    const auto half = [](const TestFrame& of, int left) {
      return marked(of.truth.annotators.front().view().crop(left, 0, 191, 288));
    };
    left_more += half(frame, 0) > half(even, 0) ? 1 : 0;
    right_more += half(frame, 191) > half(even, 191) ? 1 : 0;
  }
  EXPECT_GE(left_more, 3U);
  EXPECT_EQ(right_more, 0U);
}

TEST(SceneConditions, MovedFramesAreTheMeansOfFourPixels) {
  const TestFrame plain = scene_under(condition(Circumstance::kNone), 2);
  const TestFrame moved = scene_under(condition(Circumstance::kHalfPixel), 2);
  for (int y = 0; y < 287; y += 7) {
    for (int x = 0; x < 381; x += 5) {
      const int sum = plain.counts(x, y) + plain.counts(x + 1, y) + plain.counts(x, y + 1) +
                      plain.counts(x + 1, y + 1);
      EXPECT_NEAR(moved.counts(x, y), sum / 4.0, 0.51);
    }
  }
}

TEST(SceneConditions, JpegShowsTheSceneInEightBits) {
  const SceneCondition& jpeg = condition(Circumstance::kJpeg);
  const TestFrame plain = scene_under(condition(Circumstance::kNone), 2);
  const TestFrame levels = scene_under(jpeg, 2);
  EXPECT_NEAR(pixel_sigma(jpeg), 8 * 255 / (1.3 * 130), 1e-9);
  const Image<float> smooth_counts = blurred(as_float(plain.counts), 3);
  const Image<float> smooth_levels = blurred(as_float(levels.counts), 3);
  double sum = 0;
  for (int y = 0; y < 288; ++y) {
    for (int x = 0; x < 382; ++x) {
      EXPECT_LE(levels.counts(x, y), 255);
      const double expected =
          (smooth_counts(x, y) - kMiddleCounts + 0.15 * 130) * pixel_sigma(jpeg) / 8;
      sum += std::abs(smooth_levels(x, y) - expected);
    }
  }
  EXPECT_LT(sum / (382 * 288), 6);  // bad pixels and what is cut off
}

TEST(SceneConditions, CoarseStepsAreTwoSigma) {
  const TestFrame frame = scene_under(condition(Circumstance::kCoarseSteps), 2);
  for (int y = 0; y < 288; ++y) {
    for (int x = 0; x < 382; ++x) {
      EXPECT_TRUE(frame.counts(x, y) % 16 == 0 || frame.counts(x, y) == 16383);
    }
  }
}

}  // namespace
}  // namespace thermedge::bench
