// A simulated recording of the PI450 has the figures that `probe` finds in a real one: 100 frames,
// hand-held indoors (tests/unit/probe_recordings_test.cpp).
#include <gtest/gtest.h>

#include "support/recordings.hpp"
#include "thermedge/probe/probe.hpp"

namespace thermedge::test {
namespace {

TEST(SimulatedPi450, HasTheNoiseStripesAndRangeOfARealOne) {
  RecordingProbe recording;
  for_each_frame("sim:office?camera=pi450&frames=40",
                 [&](const sim::TrueFrame& frame) { EXPECT_TRUE(recording.add(frame.counts)); });
  const RecordingReport report = recording.report();
  const auto within_a_tenth = [](double simulated, double real) {
    EXPECT_NEAR(simulated / real, 1, 0.1) << simulated << " for " << real;
  };
  within_a_tenth(report.sigma_counts, 5.68);
  within_a_tenth(report.temporal_sigma_counts.value_or(0), 4.58);
  within_a_tenth(report.robust_range_counts, 751);
  within_a_tenth(report.snr.value_or(0), 132);
  within_a_tenth(report.column_sigma_counts, 1.11);
  within_a_tenth(report.row_sigma_counts, 0.81);
}

}  // namespace
}  // namespace thermedge::test
