// The motion of drawn pictures whose motion is known.
#include "thermedge/sequence/motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "support/images.hpp"

namespace thermedge {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kSigma = 5;

using Homography = std::array<double, 9>;

struct Place {
  double x, y;
};

Place mapped(const Homography& h, Place p) {
  const double scale = h[6] * p.x + h[7] * p.y + h[8];
  return {(h[0] * p.x + h[1] * p.y + h[2]) / scale, (h[3] * p.x + h[4] * p.y + h[5]) / scale};
}

Homography inverse(const Homography& h) {
  Homography out = {
      h[4] * h[8] - h[5] * h[7], h[2] * h[7] - h[1] * h[8], h[1] * h[5] - h[2] * h[4],
      h[5] * h[6] - h[3] * h[8], h[0] * h[8] - h[2] * h[6], h[2] * h[3] - h[0] * h[5],
      h[3] * h[7] - h[4] * h[6], h[1] * h[6] - h[0] * h[7], h[0] * h[4] - h[1] * h[3]};
  for (double& element : out) {
    element /= out[8] == 0 ? 1 : h[0] * h[4] - h[1] * h[3];
  }
  return out;
}

// Soft-edged discs at seeded places, as wide as the frame and a margin.
double scene(Place p) {
  static const std::vector<std::array<double, 4>> discs = [] {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0, 1);
    std::vector<std::array<double, 4>> made;
    for (int i = 0; i < 60; ++i) {
      made.push_back({-60 + (kWidth + 120) * share(random), -60 + (kHeight + 120) * share(random),
                      6 + 30 * share(random), -100 + 200 * share(random)});
    }
    return made;
  }();
  double counts = 3000;
  for (const auto& [x, y, radius, step] : discs) {
    counts += step / (1 + std::exp(std::hypot(p.x - x, p.y - y) - radius));
  }
  return counts;
}

// What is seen after the scene moved by `h`, `offset` counts brighter.
Image<std::uint16_t> moved_scene(const Homography& h, double offset, unsigned seed) {
  const Homography back = inverse(h);
  const Image<float> noise = test::noise_image<float>(kWidth, kHeight, 0, kSigma, seed);
  Image<std::uint16_t> frame(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double counts = scene(mapped(back, {1.0 * x, 1.0 * y})) + offset;
      frame(x, y) =
          static_cast<std::uint16_t>(std::lround(counts + static_cast<double>(noise.view()(x, y))));
    }
  }
  return frame;
}

constexpr Homography kStill = {1, 0, 0, 0, 1, 0, 0, 0, 1};

// Rms over the frame of the distance between where two maps put a point, px.
double error_px(const Motion& found, const Homography& truth) {
  double sum = 0;
  int count = 0;
  for (int y = 8; y < kHeight; y += 16) {
    for (int x = 8; x < kWidth; x += 16) {
      const Place true_place = mapped(truth, {1.0 * x, 1.0 * y});
      const Point place = found({static_cast<float>(x), static_cast<float>(y)});
      sum += std::pow(place.x - true_place.x, 2) + std::pow(place.y - true_place.y, 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(MotionEstimator, FindsShiftsTurnsAndPerspective) {
  const double turn = 0.03;
  const std::vector<Homography> motions = {
      kStill,
      {1, 0, 3.3, 0, 1, -2.1, 0, 0, 1},
      {1, 0, -30.4, 0, 1, 17.7, 0, 0, 1},
      {std::cos(turn), -std::sin(turn), 5, std::sin(turn), std::cos(turn), -6, 0, 0, 1},
      {1.02, 0, -3, 0, 1.02, -2, 0, 0, 1},
      {1, 0, 2, 0, 1, 1, 5e-5, -4e-5, 1}};
  for (const Homography& truth : motions) {
    MotionEstimator estimator;
    EXPECT_FALSE(estimator.update(moved_scene(kStill, 0, 1), kSigma).found);
    const Motion motion = estimator.update(moved_scene(truth, 0, 2), kSigma);
    ASSERT_TRUE(motion.found) << truth[2];
    EXPECT_LT(error_px(motion, truth), 0.12) << truth[2] << " " << truth[5];
    EXPECT_GT(motion.inliers, 0.75);
    EXPECT_GT(motion.sigma_px, 0.003);
    EXPECT_LT(motion.sigma_px, 0.1);
    EXPECT_NEAR(motion.offset_counts, 0, 0.5);
  }
}

TEST(MotionEstimator, ALevelThatJumpsIsNoMotion) {
  const Homography truth = {1, 0, 1.5, 0, 1, 0.5, 0, 0, 1};
  MotionEstimator estimator;
  estimator.update(moved_scene(kStill, 0, 1), kSigma);
  const Motion motion = estimator.update(moved_scene(truth, 40, 2), kSigma);
  EXPECT_LT(error_px(motion, truth), 0.12);
  EXPECT_NEAR(motion.offset_counts, 40, 0.5);
  EXPECT_LT(motion.offset_sigma_counts, 0.3);
  EXPECT_EQ(motion.offset_parts, 16);
}

TEST(MotionEstimator, FindsTheMotionOfMostWhereAPartMovesByItself) {
  MotionEstimator estimator;
  const Homography truth = {1, 0, 4, 0, 1, 0, 0, 0, 1};
  Image<std::uint16_t> second = moved_scene(truth, 0, 2);
  const Image<std::uint16_t> still = moved_scene(kStill, 0, 3);
  copy_pixels(still.view().crop(20, 20, 130, 110), second.view().crop(20, 20, 130, 110));
  estimator.update(moved_scene(kStill, 0, 1), kSigma);
  const Motion motion = estimator.update(second, kSigma);
  EXPECT_LT(error_px(motion, truth), 0.25);
  EXPECT_LT(motion.inliers, 0.95);
  EXPECT_LT(motion.offset_parts, 12);
}

TEST(MotionEstimator, TellsWhereThereIsNothingToCompare) {
  MotionEstimator estimator;
  const auto blank = test::noise_image<std::uint16_t>(kWidth, kHeight, 3000, kSigma, 1);
  estimator.update(blank, kSigma);
  const Motion motion =
      estimator.update(test::noise_image<std::uint16_t>(kWidth, kHeight, 3000, kSigma, 2), kSigma);
  EXPECT_FALSE(motion.found);
  EXPECT_EQ(motion.homography, kStill);
}

TEST(MotionEstimator, BeginsAnewWithAnotherSizeAndWhenItIsTold) {
  MotionEstimator estimator;
  const Image<std::uint16_t> frame = moved_scene(kStill, 0, 1);
  estimator.update(frame, kSigma);
  EXPECT_TRUE(estimator.update(frame, kSigma).found);
  EXPECT_FALSE(estimator.update(frame.view().crop(0, 0, 200, 200), kSigma).found);
  EXPECT_FALSE(estimator.update(frame, kSigma).found);
  EXPECT_TRUE(estimator.update(frame, kSigma).found);
  estimator.restart();
  EXPECT_FALSE(estimator.update(frame, kSigma).found);
  EXPECT_FALSE(estimator.update(frame.view().crop(0, 0, 20, 200), kSigma).found);
}

TEST(MotionEstimator, StartsFromTheLastMotionTimesTheGap) {
  // Further than the search for shifts reaches, in a picture that looks alike everywhere within it.
  MotionEstimator estimator;
  const auto shifted = [](double x) { return Homography{1, 0, x, 0, 1, 0, 0, 0, 1}; };
  estimator.update(moved_scene(shifted(0), 0, 1), kSigma);
  estimator.update(moved_scene(shifted(22), 0, 2), kSigma);
  const Motion motion = estimator.update(moved_scene(shifted(22 + 66), 0, 3), kSigma, 3);
  ASSERT_TRUE(motion.found);
  EXPECT_LT(error_px(motion, shifted(66)), 0.2);
}

TEST(MotionEstimator, HoldsNoMoreMemoryAfterTheSecondFrame) {
  MotionEstimator estimator;
  estimator.update(moved_scene(kStill, 0, 1), kSigma);
  estimator.update(moved_scene(kStill, 0, 2), kSigma);
  const std::size_t memory = estimator.memory_bytes();
  EXPECT_GT(memory, 100'000U);
  estimator.update(moved_scene({1, 0, 9, 0, 1, 0, 0, 0, 1}, 0, 3), kSigma);
  EXPECT_EQ(estimator.memory_bytes(), memory);
}

}  // namespace
}  // namespace thermedge
