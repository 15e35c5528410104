// The figures known of real recordings, within 10 %.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/images.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/probe/probe.hpp"

namespace thermedge {
namespace {

std::vector<Image<std::uint16_t>> frames_of(const std::string& part) {
  std::vector<Image<std::uint16_t>> frames;
  const auto source = io::open_files({(test::shared_directory() / part).string()}, {});
  io::SourceFrame frame;
  for (;;) {
    const auto more = (*source)->next(frame);
    EXPECT_TRUE(more) << more.error().message;
    if (!more || !*more) {
      return frames;
    }
    frames.push_back(frame.counts.clone());
  }
}

RecordingReport probe(const std::vector<Image<std::uint16_t>>& frames) {
  RecordingProbe recording;
  for (const Image<std::uint16_t>& frame : frames) {
    EXPECT_TRUE(recording.add(frame));
  }
  return recording.report();
}

// [1 -2 1] x [1 -2 1] / 6.
std::vector<double> residual(ImageView<const std::uint16_t> frame) {
  constexpr int kKernel[] = {1, -2, 1};
  std::vector<double> values;
  for (int y = 1; y < frame.height() - 1; ++y) {
    for (int x = 1; x < frame.width() - 1; ++x) {
      int sum = 0;
      for (int k = 0; k < 9; ++k) {
        sum += kKernel[k % 3] * kKernel[k / 3] * frame(x + k % 3 - 1, y + k / 3 - 1);
      }
      values.push_back(sum / 6.0);
    }
  }
  return values;
}

double median_magnitude(std::vector<double> values) {
  std::transform(values.begin(), values.end(), values.begin(),
                 [](double v) { return std::abs(v); });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// By how much a map learned from the first 8 frames lowers the sigma of the last frame.
double gain_of_a_map(const std::vector<Image<std::uint16_t>>& frames) {
  const std::vector<double> before = residual(frames.back());
  const double clip = 4 * 1.4826 * median_magnitude(before);
  std::vector<double> after = before;
  for (std::size_t i = 0; i < 8; ++i) {
    const std::vector<double> learned = residual(frames[i]);
    for (std::size_t k = 0; k < after.size(); ++k) {
      after[k] -= std::clamp(learned[k], -clip, clip) / 8;
    }
  }
  return 1 - median_magnitude(after) / median_magnitude(before);
}

void expect_within_a_tenth(double measured, double known) {
  EXPECT_NEAR(measured / known, 1, 0.1) << measured << " for " << known;
}

TEST(ProbeRecordings, HandHeldPi450) {
  THERMEDGE_NEEDS_SHARED("data/optris_pi450");
  const auto frames = frames_of("data/optris_pi450");
  const auto report = probe(frames);
  EXPECT_EQ(report.frames, 100);
  expect_within_a_tenth(report.sigma_counts, 5.8);
  expect_within_a_tenth(report.pixel_sigma_counts, 5.8);
  EXPECT_EQ(report.noise_kind, NoiseKind::kWhite);
  expect_within_a_tenth(report.robust_range_counts, 744);
  expect_within_a_tenth(report.snr.value_or(0), 128);
  expect_within_a_tenth(report.clipped_share(0.5), 0.157);
  expect_within_a_tenth(report.clipped_share(0.2), 0.010);
  EXPECT_GT(report.offset_map_gain_8_frames.value_or(0), 0.9 * 0.08);
  EXPECT_LT(report.offset_map_gain_8_frames.value_or(1), 1.1 * 0.10);
  EXPECT_NEAR(report.offset_map_gain_8_frames.value_or(0), gain_of_a_map(frames), 0.04);
  EXPECT_EQ(report.repeated_frames, 0);
  EXPECT_TRUE(report.suggested.empty());
  const auto for_paper = suggest_options(report, Preset::kPaper);
  ASSERT_EQ(for_paper.size(), 1U);
  EXPECT_EQ(for_paper[0].name, "grey_scale.gain");
  EXPECT_EQ(for_paper[0].value, "0.2");
}

// Its noise is uneven: the flatter half of a whole frame has 8.4 counts.
TEST(ProbeRecordings, RoadCamera) {
  THERMEDGE_NEEDS_SHARED("data/fieldscale_road");
  const auto frames = frames_of("data/fieldscale_road");
  const auto report = probe(frames);
  EXPECT_EQ(report.frames, 10);
  expect_within_a_tenth(report.sigma_counts, 11.7);
  expect_within_a_tenth(report.pixel_sigma_counts, 9.7);
  EXPECT_EQ(report.noise_kind, NoiseKind::kPartSmooth);
  expect_within_a_tenth(report.robust_range_counts, 4686);
  expect_within_a_tenth(report.snr.value_or(0), 405);
  EXPECT_NEAR(report.offset_map_gain_8_frames.value_or(0), gain_of_a_map(frames), 0.04);
  EXPECT_LT(report.frame_sigma_counts, 9);
}

}  // namespace
}  // namespace thermedge
