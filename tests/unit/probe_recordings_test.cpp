// The figures known of real recordings, within 10 %.
#include <gtest/gtest.h>

#include "support/images.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/probe.hpp"

namespace thermedge {
namespace {

RecordingReport probe(const std::string& part) {
  RecordingProbe recording;
  const auto source = io::open_files({(test::shared_directory() / part).string()}, {});
  io::Frame frame;
  for (;;) {
    const auto more = (*source)->next(frame);
    EXPECT_TRUE(more) << more.error().message;
    if (!more || !*more) {
      return recording.report();
    }
    EXPECT_TRUE(recording.add(frame.counts, frame.bits));
  }
}

void expect_within_a_tenth(double measured, double known) {
  EXPECT_NEAR(measured / known, 1, 0.1) << measured << " for " << known;
}

TEST(ProbeRecordings, HandHeldPi450) {
  THERMEDGE_NEEDS_SHARED("data/optris_pi450");
  const auto report = probe("data/optris_pi450");
  EXPECT_EQ(report.frames, 100);
  expect_within_a_tenth(report.sigma_counts, 5.8);
  expect_within_a_tenth(report.robust_range_counts, 744);
  expect_within_a_tenth(report.snr.value_or(0), 128);
  expect_within_a_tenth(report.clipped_share(0.5), 0.157);
  expect_within_a_tenth(report.clipped_share(0.2), 0.010);
  EXPECT_GT(report.offset_map_gain_8_frames.value_or(0), 0.9 * 0.08);
  EXPECT_LT(report.offset_map_gain_8_frames.value_or(1), 1.1 * 0.10);
  EXPECT_EQ(report.repeated_frames, 0);
  ASSERT_EQ(report.suggested.size(), 1U);
  EXPECT_EQ(report.suggested[0].name, "scale.gain");
  EXPECT_EQ(report.suggested[0].value, "0.2");
}

// Its noise is uneven: the flatter half of a whole frame has 8.4 counts.
TEST(ProbeRecordings, RoadCamera) {
  THERMEDGE_NEEDS_SHARED("data/fieldscale_road");
  const auto report = probe("data/fieldscale_road");
  EXPECT_EQ(report.frames, 10);
  expect_within_a_tenth(report.sigma_counts, 9.7);
  expect_within_a_tenth(report.robust_range_counts, 4686);
  expect_within_a_tenth(report.snr.value_or(0), 485);
  expect_within_a_tenth(report.offset_map_gain_8_frames.value_or(0), 0.15);
  EXPECT_LT(report.frame_sigma_counts, 9);
}

}  // namespace
}  // namespace thermedge
