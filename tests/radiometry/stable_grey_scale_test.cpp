// The stable view: still where the scene is still, following where it drifts, jumping at cuts.
#include "thermedge/radiometry/stable_grey_scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/images.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/radiometry/grey_scale.hpp"

namespace thermedge {
namespace {

// A scene of `range` counts around `middle`, with noise.
Image<std::uint16_t> scene(double middle, unsigned seed, double range = 400) {
  Image<std::uint16_t> frame = test::noise_image<std::uint16_t>(64, 48, middle, 6, seed);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(
          std::clamp(frame(x, y) + range * (x - 31.5) / 64, 0.0, 65535.0));
    }
  }
  return frame;
}

class Sequence {
 public:
  explicit Sequence(const StableGreyScaleOptions& options) : view_(options) {}
  explicit Sequence(double gain = 0.2) : Sequence(StableGreyScaleOptions{.gain = gain}) {}
  GreyScaleState show(const Image<std::uint16_t>& frame) {
    levels_.resize(frame.width(), frame.height());
    const auto state = view_.run(frame, levels_);
    EXPECT_TRUE(state);
    expect_levels(frame, *state);
    return *state;
  }
  [[nodiscard]] const Image<std::uint8_t>& levels() const { return levels_; }

 private:
  // The levels are what gain and offset say, and the shares what is outside.
  void expect_levels(const Image<std::uint16_t>& frame, const GreyScaleState& state) const {
    // A level that is 0 or 255, or a sum that is a half, but for rounding may fall to either side.
    constexpr double kRounding = 1e-9;
    std::size_t low = 0, high = 0, undecided = 0;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const double level = frame(x, y) * state.gain + state.offset;
        low += level < -kRounding ? 1 : 0;
        high += level > 255 + kRounding ? 1 : 0;
        undecided += std::abs(level) <= kRounding || std::abs(level - 255) <= kRounding ? 1 : 0;
        ASSERT_NEAR(levels_(x, y), std::clamp(level, 0.0, 255.0), 0.5 + kRounding);
      }
    }
    const auto pixels = static_cast<double>(frame.size());
    const double tolerance = (static_cast<double>(undecided) + 0.5) / pixels;
    EXPECT_NEAR(state.clipped_low_share, static_cast<double>(low) / pixels, tolerance);
    EXPECT_NEAR(state.clipped_high_share, static_cast<double>(high) / pixels, tolerance);
  }

  StableGreyScale view_;
  Image<std::uint8_t> levels_;
};

TEST(StableGreyScale, BeginsAsAlgorithm1) {
  const Image<std::uint16_t> frame = scene(3000, 1);
  Sequence sequence;
  const GreyScaleState state = sequence.show(frame);
  EXPECT_EQ(state.event, GreyScaleEvent::kStart);
  EXPECT_EQ(state.gain, 0.2);
  Image<std::uint8_t> wanted(64, 48);
  ASSERT_TRUE(scale_to_8bit(frame, {.gain = 0.2}, wanted));
  EXPECT_TRUE(test::same_pixels<std::uint8_t>(sequence.levels().view(), wanted.view()));
}

TEST(StableGreyScale, StaysPutWithinTheDeadBand) {
  Sequence sequence;
  const GreyScaleState first = sequence.show(scene(3000, 1));
  for (unsigned i = 2; i < 30; ++i) {
    // +-150 counts are 30 levels.
    const GreyScaleState state = sequence.show(scene(3000 + 150 * std::sin(i), i));
    EXPECT_EQ(state.offset, first.offset);
    EXPECT_EQ(state.event, GreyScaleEvent::kNone);
  }
}

TEST(StableGreyScale, FollowsADriftByNoMoreThanTheSlewLimit) {
  for (const double direction : {1.0, -1.0}) {
    Sequence sequence;
    GreyScaleState before = sequence.show(scene(30000, 1));
    const double start = before.offset;
    for (unsigned i = 1; i < 200; ++i) {
      const GreyScaleState state = sequence.show(scene(30000 + direction * 4.0 * i, i));
      EXPECT_LE(std::abs(state.offset - before.offset), 1 + 1e-9);
      EXPECT_EQ(state.event, GreyScaleEvent::kNone);
      before = state;
    }
    // 796 counts are 159 levels, of which the dead band takes 32.
    EXPECT_NEAR(start - before.offset, direction * (159 - 32), 2);
  }
}

TEST(StableGreyScale, MovesNoFartherThanTheEdgeOfTheDeadBand) {
  Sequence sequence;
  const double start = sequence.show(scene(3000, 1)).offset;
  double end = start;
  for (unsigned i = 2; i < 40; ++i) {
    end = sequence.show(scene(3000 + 200, i)).offset;  // 40 levels: 8 beyond the band
  }
  EXPECT_NEAR(start - end, 8, 0.5);
}

TEST(StableGreyScale, JumpsOnceAtASceneCut) {
  Sequence sequence;
  sequence.show(scene(3000, 1));
  int events = 0;
  for (unsigned i = 0; i < 20; ++i) {
    const GreyScaleState state = sequence.show(scene(9000, i));
    events += state.event == GreyScaleEvent::kSceneCut ? 1 : 0;
    EXPECT_EQ(state.event == GreyScaleEvent::kSceneCut, i == 2) << i;  // the third clipped frame
    if (i >= 2) {
      EXPECT_LT(state.clipped_low_share + state.clipped_high_share, 0.01);
    }
  }
  EXPECT_EQ(events, 1);
}

TEST(StableGreyScale, LetsAFlashPass) {
  Sequence sequence;
  const double offset = sequence.show(scene(3000, 1)).offset;
  for (unsigned i = 0; i < 30; ++i) {
    const bool flash = i % 10 < 2;
    const GreyScaleState state = sequence.show(scene(flash ? 9000 : 3000, i));
    EXPECT_EQ(state.event, GreyScaleEvent::kNone);
    EXPECT_EQ(state.offset, offset);
  }
}

TEST(StableGreyScale, DoesNotJumpWhereThatWouldNotHelp) {
  // The scene has four times the range of the view: clipped wherever the view lies.
  Sequence sequence;
  sequence.show(scene(20000, 1, 5000));
  for (unsigned i = 2; i < 20; ++i) {
    EXPECT_EQ(sequence.show(scene(20000, i, 5000)).event, GreyScaleEvent::kNone);
  }
}

TEST(StableGreyScale, ChoosesTheGainFromTheNoise) {
  Sequence sequence(0);
  const double gain = sequence.show(scene(3000, 1)).gain;
  EXPECT_NEAR(gain, 2 / 6.0, 0.04);
  EXPECT_EQ(sequence.show(scene(3000, 2)).gain, gain);
  Image<std::uint16_t> flat(32, 32);
  fill_pixels(flat.view(), std::uint16_t{100});
  EXPECT_EQ(Sequence(0).show(flat).gain, 1);
}

TEST(StableGreyScale, ChoosesTheGainFromTheRange) {
  Sequence sequence(0);
  const GreyScaleState state = sequence.show(scene(20000, 1, 5000));
  EXPECT_NEAR(state.gain * 5000, 0.8 * 255, 5);
  EXPECT_EQ(state.clipped_low_share + state.clipped_high_share, 0);
  // As much room below the range as above it.
  EXPECT_NEAR(20000 * state.gain + state.offset, 127, 1);
}

// A scene in which a disc of `counts` covers a growing share of the frame.
Image<std::uint16_t> approach(double radius_px, double counts, unsigned seed) {
  Image<std::uint16_t> frame = scene(2700, seed);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (std::hypot(x - 31.5, y - 23.5) < radius_px) {
        frame(x, y) = static_cast<std::uint16_t>(frame(x, y) + counts);
      }
    }
  }
  return frame;
}

struct Clipping {
  int longest = 0;  // frames in a row with more than 5 % clipped
  int cuts = 0;
  double last_gain = 0;
};

Clipping clipping_of_approach(Sequence& sequence, double px_per_frame, double counts) {
  Clipping clipping;
  int now = 0;
  for (unsigned i = 0; i < 60; ++i) {
    const GreyScaleState state = sequence.show(approach(px_per_frame * i, counts, i));
    now = state.clipped_low_share + state.clipped_high_share > 0.05 ? now + 1 : 0;
    clipping.longest = std::max(clipping.longest, now);
    clipping.cuts += state.event == GreyScaleEvent::kSceneCut ? 1 : 0;
    clipping.last_gain = state.gain;
  }
  return clipping;
}

TEST(StableGreyScale, FollowsAnApproachToAHotThing) {
  for (const double px_per_frame : {0.2, 0.5, 1.0, 3.0, 10.0}) {
    for (const double counts : {500.0, 1000.0, 4000.0, 20000.0, 60000.0}) {
      Sequence sequence(0);
      const Clipping clipping = clipping_of_approach(sequence, px_per_frame, counts);
      EXPECT_LE(clipping.longest, 2) << px_per_frame << " px a frame, " << counts << " counts";
    }
  }
}

TEST(StableGreyScale, FollowsASlowApproachWithoutAJump) {
  Sequence sequence(0);
  const Clipping clipping = clipping_of_approach(sequence, 0.2, 1000);
  EXPECT_EQ(clipping.longest, 0);
  EXPECT_EQ(clipping.cuts, 0);
}

TEST(StableGreyScale, MovesAGivenGainOnly) {
  // The hot disc and the rest fit into 255 levels side by side, but not around the median.
  Sequence sequence(0.2);
  const Clipping clipping = clipping_of_approach(sequence, 0.5, 700);
  EXPECT_LE(clipping.longest, 2);
  EXPECT_EQ(clipping.last_gain, 0.2);
}

TEST(StableGreyScale, GivesTheGainBack) {
  Sequence sequence(0);
  const double gain = sequence.show(scene(2700, 1)).gain;
  const double lower = clipping_of_approach(sequence, 1, 4000).last_gain;
  EXPECT_LT(lower, gain / 3);
  double before = lower;
  for (unsigned i = 0; i < 300; ++i) {
    const GreyScaleState state = sequence.show(scene(2700, i));
    EXPECT_LE(state.gain,
              std::max(1.0201 * before, state.event == GreyScaleEvent::kSceneCut ? 1.0 : 0.0));
    before = state.gain;
  }
  EXPECT_GT(before, 0.6 * gain);
}

TEST(StableGreyScale, TakesExtremeFrames) {
  for (const auto value : {std::uint16_t{0}, std::uint16_t{65535}}) {
    Image<std::uint16_t> flat(9, 7);
    fill_pixels(flat.view(), value);
    Sequence sequence;
    const GreyScaleState state = sequence.show(flat);
    EXPECT_EQ(state.clipped_low_share + state.clipped_high_share, 0);
    EXPECT_EQ(sequence.levels()(4, 3), 127);
    sequence.show(scene(3000, 1));  // another size and content
  }
}

TEST(StableGreyScale, RefusesBadInputAndStaysAsItWas) {
  StableGreyScale view;
  Image<std::uint8_t> levels(64, 48), other(10, 10);
  EXPECT_FALSE(view.run(scene(3000, 1), other));
  EXPECT_FALSE(view.run(ImageView<const std::uint16_t>(), ImageView<std::uint8_t>()));
  const auto state = view.run(scene(3000, 1), levels);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->event, GreyScaleEvent::kStart);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  StableGreyScaleOptions bad[6];
  bad[0].gain = -1;
  bad[1].gain = nan;
  bad[2].dead_band_levels = 128;
  bad[3].slew_levels = nan;
  bad[4].cut_clipped_share = 2;
  bad[5].cut_frames = 0;
  for (const StableGreyScaleOptions& options : bad) {
    const auto refused = StableGreyScale(options).run(scene(3000, 1), levels);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("stable_grey_scale."), std::string::npos);
  }
}

TEST(StableGreyScale, IsStillOnARealRecording) {
  THERMEDGE_NEEDS_SHARED("data/optris_pi450");
  const auto source =
      io::open_files({(test::shared_directory() / "data/optris_pi450").string()}, {});
  ASSERT_TRUE(source);
  StableGreyScale view;
  io::SourceFrame frame;
  Image<std::uint8_t> levels;
  double before = 0, change = 0, algorithm1_change = 0, clipped = 0;
  int median = 0, frames = 0;
  while ((*source)->next(frame).value_or(false)) {
    levels.resize(frame.counts.width(), frame.counts.height());
    const auto state = view.run(frame.counts, levels);
    ASSERT_TRUE(state);
    const int now = median_counts(frame.counts);
    if (frames > 0) {
      change += std::abs(state->offset - before);
      algorithm1_change += 0.5 * std::abs(now - median);
    }
    clipped += state->clipped_low_share + state->clipped_high_share;
    before = state->offset;
    median = now;
    ++frames;
  }
  ASSERT_GT(frames, 50);
  EXPECT_LE(change / (frames - 1), 0.05);
  EXPECT_LT(clipped / frames, 0.015);
  EXPECT_GT(algorithm1_change / (frames - 1), 0.4);
  RecordProperty("change_levels", std::to_string(change / (frames - 1)));
  RecordProperty("algorithm1_change_levels", std::to_string(algorithm1_change / (frames - 1)));
  RecordProperty("clipped_share", std::to_string(clipped / frames));
}

}  // namespace
}  // namespace thermedge
