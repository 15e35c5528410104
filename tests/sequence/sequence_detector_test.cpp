// Simulated streams through all stages.
#include "thermedge/sequence/sequence_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "support/images.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

std::vector<sim::TrueFrame> frames_of(const std::string& spec) {
  auto renderer = sim::Renderer::create(*sim::parse_scene(spec));
  const auto runner = make_runner(2);
  std::vector<sim::TrueFrame> frames;
  for (int i = 0; i < renderer->options().frames; ++i) {
    frames.push_back(*renderer->render(i, *runner));
  }
  return frames;
}

Frame framed(const sim::TrueFrame& frame) {
  Frame out(frame.counts);
  out.stamp_ns = frame.stamp_ns;
  out.index = frame.index;
  return out;
}

SequenceDetector detector_of(int threads) {
  SequenceOptions options;
  options.detector.threads = threads;
  return *SequenceDetector::create(options);
}

TEST(SequenceDetector, MostOfAnEdgeKeepsItsIdentity) {
  const auto frames = frames_of("sim:desk?seed=1003&frames=16&width=240&height=180");
  SequenceDetector detector = detector_of(2);
  TrackedFrame result;
  for (const sim::TrueFrame& frame : frames) {
    ASSERT_TRUE(detector.process(framed(frame), result));
    EXPECT_TRUE(result.events.valid);
    EXPECT_EQ(result.motion.found, frame.index > 0);
    EXPECT_EQ(result.detection.index, frame.index);
  }
  double old = 0;
  double all = 0;
  for (std::size_t i = 0; i < result.tracks.edges.size(); ++i) {
    const auto points = static_cast<double>(result.detection.edges.edges[i].edgels.count);
    all += points;
    old += result.tracks.edges[i].age >= 10 ? points : 0;
  }
  EXPECT_GT(all, 500);
  EXPECT_GT(old / all, 0.8);
}

TEST(SequenceDetector, GivesTheSameBitsForEveryNumberOfThreads) {
  const auto frames = frames_of("sim:office?seed=1004&frames=6&width=200&height=150");
  SequenceDetector one = detector_of(1);
  SequenceDetector three = detector_of(3);
  TrackedFrame a;
  TrackedFrame b;
  for (const sim::TrueFrame& frame : frames) {
    ASSERT_TRUE(one.process(framed(frame), a));
    ASSERT_TRUE(three.process(framed(frame), b));
    EXPECT_EQ(a.motion.homography, b.motion.homography);
    EXPECT_EQ(a.tracks.track, b.tracks.track);
    EXPECT_EQ(a.tracks.last, b.tracks.last);
    EXPECT_EQ(a.tracks.smooth_x, b.tracks.smooth_x);
    EXPECT_EQ(a.tracks.smooth_y, b.tracks.smooth_y);
    EXPECT_EQ(a.events.bits, b.events.bits);
  }
}

TEST(SequenceDetector, IdentitiesLastThroughAShutter) {
  const auto frames = frames_of(
      "sim:corridor?seed=1005&frames=40&width=240&height=180&path=still&shutter_every=12&"
      "shutter_frames=10&shutter_jump=12");
  SequenceDetector detector = detector_of(2);
  TrackedFrame result;
  std::set<std::int64_t> before;
  int frozen = 0;
  int jumps = 0;
  double known = 0;
  double all = 0;
  for (const sim::TrueFrame& frame : frames) {
    ASSERT_TRUE(detector.process(framed(frame), result));
    const bool is_frozen = frame.shutter && frame.shutter->frozen;
    EXPECT_EQ(result.events.valid, !is_frozen) << frame.index;
    EXPECT_EQ(result.events.has(kFrozen), is_frozen) << frame.index;
    if (is_frozen) {
      ++frozen;
      EXPECT_EQ(result.detection.edges.kept, 0U);
      EXPECT_TRUE(result.tracks.track.empty());
      EXPECT_TRUE(result.tracks.ended.empty());
      continue;
    }
    const double jump = frame.shutter ? std::abs(frame.shutter->jump_counts) : 0;
    if (jump > 4) {
      EXPECT_TRUE(result.events.has(kOffsetJump)) << frame.index;
      ++jumps;
    } else if (jump < 2) {
      EXPECT_FALSE(result.events.has(kOffsetJump)) << frame.index;
    }
    for (const TrackedEdge& edge : result.tracks.edges) {
      if (frame.index < 12) {
        before.insert(edge.track);
      }
    }
    if (frame.index >= 30) {
      for (const TrackedEdge& edge : result.tracks.edges) {
        ++all;
        known += before.count(edge.track) != 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(frozen, 10);
  EXPECT_GT(jumps, 0);
  EXPECT_GT(known / all, 0.8);
}

TEST(SequenceDetector, AFrameOfAnotherSizeBeginsANewSequence) {
  const auto small = frames_of("sim:desk?seed=1006&frames=2&width=160&height=120");
  const auto large = frames_of("sim:desk?seed=1006&frames=2&width=200&height=150");
  SequenceDetector detector = detector_of(1);
  TrackedFrame result;
  ASSERT_TRUE(detector.process(framed(small[0]), result));
  const std::size_t born = result.tracks.born.size();
  ASSERT_GT(born, 0U);
  ASSERT_TRUE(detector.process(framed(large[0]), result));
  EXPECT_EQ(result.tracks.ended.size(), born);
  EXPECT_FALSE(result.motion.found);
  ASSERT_TRUE(detector.process(framed(large[1]), result));
  EXPECT_TRUE(result.motion.found);
}

TEST(SequenceDetector, AFrameThatFailsCountsAsLost) {
  const auto frames = frames_of("sim:desk?seed=1007&frames=3&width=160&height=120");
  SequenceDetector detector = detector_of(1);
  TrackedFrame result;
  ASSERT_TRUE(detector.process(framed(frames[0]), result));
  Frame wrong = framed(frames[1]);
  const Image<std::uint8_t> mask(10, 10);
  wrong.valid = mask.view();
  EXPECT_FALSE(detector.process(wrong, result));
  ASSERT_TRUE(detector.process(framed(frames[2]), result));
  EXPECT_TRUE(result.motion.found);
}

TEST(SequenceDetector, WrongOptionsAreErrorsThatNameThem) {
  SequenceOptions options;
  options.tracker.confirm_hits = 9;
  const auto detector = SequenceDetector::create(options);
  ASSERT_FALSE(detector);
  EXPECT_NE(detector.error().message.find("tracker.confirm_hits"), std::string::npos);
}

}  // namespace
}  // namespace thermedge
