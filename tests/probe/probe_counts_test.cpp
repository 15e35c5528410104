// Range, bits, histogram, clipping and stripe profiles against slow, obviously right versions.
#include "probe_counts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "support/images.hpp"
#include "thermedge/probe/probe.hpp"

namespace thermedge {
namespace {

using test::noise_image;

std::vector<int> sorted(ImageView<const std::uint16_t> frame) {
  std::vector<int> counts;
  for (int y = 0; y < frame.height(); ++y) {
    counts.insert(counts.end(), frame.row(y), frame.row(y) + frame.width());
  }
  std::sort(counts.begin(), counts.end());
  return counts;
}

// Algorithm 1 on a pixel, not clamped.
bool is_clipped(int count, int median, double gain) {
  const double level = std::round((count - median) * gain + 127);
  return level < 0 || level > 255;
}

TEST(ProbeCounts, AreThoseOfTheSortedPixels) {
  detail::SortedCounts counts;
  for (const double sigma : {0.0, 3.0, 300.0, 30000.0}) {
    for (const int width : {1, 2, 7, 101}) {
      const auto frame = noise_image<std::uint16_t>(width, 50, 20000, sigma, 5);
      const std::vector<int> expected = sorted(frame);
      counts.sort(frame);
      EXPECT_EQ(counts.min(), expected.front());
      EXPECT_EQ(counts.max(), expected.back());
      for (const double share : {0.0, 0.01, 0.5, 0.99, 1.0}) {
        const auto rank =
            static_cast<std::size_t>(share * static_cast<double>(expected.size() - 1));
        EXPECT_EQ(counts.quantile(share), expected[rank]) << share;
      }
    }
  }
}

TEST(ProbeCounts, ClippedIsWhatAlgorithm1Clips) {
  detail::SortedCounts counts;
  for (const double sigma : {0.0, 100.0, 400.0, 20000.0}) {
    const auto frame = noise_image<std::uint16_t>(60, 50, 9000, sigma, 2);
    const std::vector<int> values = sorted(frame);
    counts.sort(frame);
    const int median = values[(values.size() - 1) / 2];
    for (const double gain : {10.0, 1.0, 0.5, 0.2, 0.005}) {
      const auto clipped = std::count_if(
          values.begin(), values.end(), [&](int count) { return is_clipped(count, median, gain); });
      EXPECT_NEAR(counts.clipped_share(gain),
                  static_cast<double>(clipped) / static_cast<double>(values.size()), 1e-12)
          << "sigma " << sigma << ", gain " << gain;
    }
  }
}

TEST(ProbeCounts, HistogramHoldsEveryPixelOnce) {
  for (const double sigma : {0.0, 2.0, 80.0, 9000.0}) {
    RecordingProbe recording;
    auto frame = noise_image<std::uint16_t>(120, 90, 30000, sigma, 2);
    frame(3, 4) = 0;
    frame(5, 4) = 65535;
    ASSERT_TRUE(recording.add(frame));
    const CountHistogram histogram = recording.report().histogram;
    ASSERT_EQ(histogram.edges_counts.size(), histogram.pixels.size() + 1);
    EXPECT_LE(histogram.pixels.size(), 256U);
    EXPECT_EQ(std::accumulate(histogram.pixels.begin(), histogram.pixels.end(),
                              histogram.below + histogram.above),
              120 * 90);
    const std::vector<int> values = sorted(frame);
    for (std::size_t i = 0; i < histogram.pixels.size(); ++i) {
      const auto from = std::lower_bound(values.begin(), values.end(), histogram.edges_counts[i]);
      const auto to = std::lower_bound(values.begin(), values.end(), histogram.edges_counts[i + 1]);
      ASSERT_EQ(histogram.pixels[i], to - from) << "bin " << i;
    }
  }
}

TEST(ProbeCounts, RangeAndBits) {
  RecordingProbe recording;
  Image<std::uint16_t> frame(20, 10);
  fill_pixels(frame.view(), std::uint16_t{4000});
  frame(1, 1) = 3600;
  frame(2, 2) = 4800;
  ASSERT_TRUE(recording.add(frame));
  frame(3, 3) = 8000;
  ASSERT_TRUE(recording.add(frame));
  const auto report = recording.report();
  EXPECT_EQ(report.min_counts, 3600);
  EXPECT_EQ(report.max_counts, 8000);
  EXPECT_EQ(report.range_counts, (1200 + 4400) / 2.0);
  EXPECT_EQ(report.robust_range_counts, 0);
  EXPECT_EQ(report.used_bits, 13);       // 4096 <= 8000 < 8192
  EXPECT_EQ(report.unused_low_bits, 4);  // 3600 = 225 * 16, the others hold more
}

TEST(ProbeCounts, ProfilesShowPlantedStripes) {
  RecordingProbe recording;
  for (unsigned seed = 0; seed < 4; ++seed) {
    auto frame = noise_image<std::uint16_t>(100, 80, 3000, 4, seed);
    for (int y = 0; y < 80; ++y) {
      frame(30, y) += std::uint16_t{20};
    }
    for (int x = 0; x < 100; ++x) {
      frame(x, 50) += std::uint16_t{10};
    }
    ASSERT_TRUE(recording.add(frame));
  }
  const auto report = recording.report();
  for (std::size_t x = 1; x < 99; ++x) {
    // A column's neighbours see an eighth of it with the other sign.
    const double expected = x == 30 ? 20 : x >= 26 && x <= 34 ? -2.5 : 0;
    EXPECT_NEAR(report.column_profile_counts[x], expected, 1.2) << x;
  }
  EXPECT_NEAR(report.row_profile_counts[50], 10, 1.2);
  EXPECT_NEAR(report.row_profile_counts[20], 0, 1.2);
}

}  // namespace
}  // namespace thermedge
