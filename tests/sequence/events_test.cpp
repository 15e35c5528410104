// Events of streams that are made with them.
#include "thermedge/sequence/events.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <random>

#include "support/images.hpp"

namespace thermedge {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr double kSigma = 5;

// A bright square on a dark ground, with new noise for each seed.
Image<std::uint16_t> scene(unsigned seed, double sigma = kSigma) {
  Image<std::uint16_t> frame = test::noise_image<std::uint16_t>(kWidth, kHeight, 3000, sigma, seed);
  for (int y = 40; y < 80; ++y) {
    for (int x = 50; x < 110; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(frame.view()(x, y) + 200);
    }
  }
  return frame;
}

Frame framed(const Image<std::uint16_t>& image, std::optional<std::int64_t> stamp_ms = {}) {
  Frame frame(image);
  if (stamp_ms) {
    frame.stamp_ns = *stamp_ms * 1'000'000;
  }
  return frame;
}

TEST(EventFinder, FindsNothingInAnOrdinaryStream) {
  EventFinder finder;
  for (unsigned i = 0; i < 40; ++i) {
    const FrameEvents events = finder.look(framed(scene(i), 12 * i), i > 0 ? kSigma : 0);
    EXPECT_EQ(events.bits, 0U) << i;
    EXPECT_TRUE(events.valid);
    EXPECT_EQ(events.gap, 1);
    EXPECT_FALSE(events.since_shutter_s);
  }
}

TEST(EventFinder, TellsFrozenFromNewFrames) {
  EventFinder finder;
  const Image<std::uint16_t> frozen = scene(1);
  EXPECT_TRUE(finder.look(framed(frozen, 0), 0).valid);
  for (int i = 1; i < 5; ++i) {
    const FrameEvents events = finder.look(framed(frozen, 12 * i), kSigma);
    EXPECT_EQ(events.bits, kFrozen);
    EXPECT_FALSE(events.valid);
  }
  const FrameEvents after = finder.look(framed(scene(2), 60), kSigma);
  EXPECT_TRUE(after.valid);
  EXPECT_NEAR(after.since_shutter_s.value(), 0.012, 1e-9);
}

TEST(EventFinder, TellsFramesThatAreFrozenButForALittleNoise) {
  EventFinder finder;
  const Image<std::uint16_t> frozen = scene(1);
  finder.look(framed(frozen), 0);
  Image<std::uint16_t> near(kWidth, kHeight);
  copy_pixels(frozen.view(), near.view());
  std::mt19937 random(9);
  std::normal_distribution<double> little(0, 0.2 * kSigma);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      near(x, y) = static_cast<std::uint16_t>(std::lround(near.view()(x, y) + little(random)));
    }
  }
  const FrameEvents events = finder.look(framed(near), kSigma);
  EXPECT_EQ(events.bits, kNearFrozen);
  EXPECT_FALSE(events.valid);
  EXPECT_TRUE(finder.look(framed(scene(3)), kSigma).valid);
}

TEST(EventFinder, TakesAPictureThatTurnsFlatForAShutter) {
  EventFinder finder;
  finder.look(framed(scene(1)), 0);
  finder.look(framed(scene(2)), kSigma);
  const auto flat = test::noise_image<std::uint16_t>(kWidth, kHeight, 2900, kSigma, 3);
  const FrameEvents events = finder.look(framed(flat), kSigma);
  EXPECT_TRUE(events.has(kShutter));
  EXPECT_FALSE(events.valid);
}

TEST(EventFinder, AWallThatWasFlatFromTheBeginningIsNoShutter) {
  EventFinder finder;
  for (unsigned i = 0; i < 5; ++i) {
    const auto wall = test::noise_image<std::uint16_t>(kWidth, kHeight, 2900, kSigma, i);
    EXPECT_TRUE(finder.look(framed(wall), i > 0 ? kSigma : 0).valid);
  }
}

TEST(EventFinder, BelievesTheSource) {
  EventFinder finder;
  const Image<std::uint16_t> image = scene(1);
  Frame frame(image);
  frame.flags = kFrameShutter;
  EXPECT_EQ(finder.look(frame, kSigma).bits, kShutter);
  const Image<std::uint16_t> next = scene(2);
  Frame after_loss(next);
  after_loss.flags = kFrameAfterLoss;
  const FrameEvents events = finder.look(after_loss, kSigma);
  EXPECT_EQ(events.bits, kDropped);
  EXPECT_TRUE(events.valid);
  EXPECT_EQ(events.gap, 2);
}

TEST(EventFinder, CountsTheFramesThatAreMissingBetweenStamps) {
  EventFinder finder;
  std::int64_t ms = 0;
  for (unsigned i = 0; i < 10; ++i) {
    EXPECT_EQ(finder.look(framed(scene(i), ms += 20), kSigma).bits, 0U);
  }
  const FrameEvents events = finder.look(framed(scene(20), ms += 60), kSigma);
  EXPECT_EQ(events.bits, kDropped);
  EXPECT_NEAR(events.gap, 3, 1e-9);
  EXPECT_EQ(finder.look(framed(scene(21), ms += 25), kSigma).bits, 0U) << "jitter";
  EXPECT_EQ(finder.look(framed(scene(22), ms - 500), kSigma).gap, 1) << "a clock that was set";
}

TEST(EventFinder, FlagsClippedFrames) {
  EventFinder finder;
  Image<std::uint16_t> image = scene(1);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x) {
      image(x, y) = 16383;
    }
  }
  const FrameEvents events = finder.look(framed(image), kSigma);
  EXPECT_EQ(events.bits, kClipped);
  EXPECT_TRUE(events.valid);
}

Motion with_offset(double offset, int parts) {
  Motion motion;
  motion.found = true;
  motion.inliers = 0.9;
  motion.offset_counts = offset;
  motion.offset_sigma_counts = 0.1;
  motion.offset_parts = parts;
  return motion;
}

TEST(EventFinder, AJumpOfTheLevelIsSeenAllOverThePicture) {
  EventFinder finder;
  const auto events_of = [&](const Motion& motion) {
    FrameEvents events;
    finder.look_at_motion(motion, false, kSigma, events);
    return events.bits;
  };
  EXPECT_EQ(events_of(with_offset(8, 16)), kOffsetJump);
  EXPECT_EQ(events_of(with_offset(-8, 12)), kOffsetJump);
  EXPECT_EQ(events_of(with_offset(8, 11)), 0U) << "something bright came into view";
  EXPECT_EQ(events_of(with_offset(1, 16)), 0U);
  Motion unsure = with_offset(8, 16);
  unsure.offset_sigma_counts = 2;
  EXPECT_EQ(events_of(unsure), 0U);
}

TEST(EventFinder, ThreeFramesWithoutAMotionAreACut) {
  EventFinder finder;
  const auto bits = [&](const Motion& motion, bool is_first) {
    FrameEvents events;
    finder.look_at_motion(motion, is_first, kSigma, events);
    return events.bits;
  };
  EXPECT_EQ(bits({}, true), 0U);
  EXPECT_EQ(bits({}, false), 0U);
  EXPECT_EQ(bits(with_offset(0, 0), false), 0U);
  EXPECT_EQ(bits({}, false), 0U);
  EXPECT_EQ(bits({}, false), 0U);
  EXPECT_EQ(bits({}, false), kCut);
  EXPECT_EQ(bits({}, false), 0U);
}

TEST(EventFinder, TakesFramesOfAFewPixels) {
  EventFinder finder;
  for (const unsigned seed : {1U, 2U}) {
    const auto tiny = test::noise_image<std::uint16_t>(2, 1, 3000, kSigma, seed);
    EXPECT_EQ(finder.look(Frame(tiny), kSigma).bits, 0U);
  }
}

TEST(EventFinder, LooksAtLevelsAndFloatsAlike) {
  EventFinder finder;
  const auto values = test::noise_image<float>(kWidth, kHeight, 21, 0.05, 1);
  EXPECT_TRUE(finder.look(Frame(values), 0).valid);
  EXPECT_EQ(finder.look(Frame(values), 0.05).bits, kFrozen);
  const auto levels = test::noise_image<std::uint8_t>(kWidth, kHeight, 120, 4, 1);
  EXPECT_TRUE(finder.look(Frame(levels), 0).valid);
  EXPECT_EQ(finder.look(Frame(levels), 4).bits, kFrozen);
}

}  // namespace
}  // namespace thermedge
