#include "thermedge/radiometry/grey_scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/images.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::GuardedImage;
using test::noise_image;

Image<std::uint16_t> frame_of(int width, int height, const std::vector<int>& counts) {
  Image<std::uint16_t> frame(width, height);
  for (int i = 0; i < width * height; ++i) {
    frame(i % width, i / width) = static_cast<std::uint16_t>(counts[static_cast<std::size_t>(i)]);
  }
  return frame;
}

// Algorithm 1 as it is written, pixel by pixel; std::round takes halves away from zero.
int reference_level(int counts, int median, double gain) {
  return static_cast<int>(std::clamp(std::round((counts - median) * gain + 127.0), 0.0, 255.0));
}

TEST(Median, IsTheElementOfLowerMiddleRank) {
  EXPECT_EQ(median_counts(frame_of(1, 1, {7})), 7);
  EXPECT_EQ(median_counts(frame_of(2, 1, {9, 3})), 3);
  EXPECT_EQ(median_counts(frame_of(3, 1, {65535, 0, 5})), 5);
  EXPECT_EQ(median_counts(frame_of(2, 2, {4, 1, 2, 3})), 2);
  EXPECT_EQ(median_counts(frame_of(2, 2, {0, 0, 65535, 65535})), 0);
  EXPECT_EQ(median_counts(frame_of(3, 1, {65535, 65535, 0})), 65535);
  EXPECT_EQ(median_counts({}), 0);
}

TEST(Median, AgreesWithSorting) {
  for (int width = 1; width <= 20; ++width) {
    const auto frame =
        noise_image<std::uint16_t>(width, 7, 1000, 300, static_cast<unsigned>(width));
    std::vector<std::uint16_t> sorted;
    for (int y = 0; y < 7; ++y) {
      sorted.insert(sorted.end(), frame.row(y), frame.row(y) + width);
    }
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(median_counts(frame), sorted[(sorted.size() - 1) / 2]);
  }
}

// Against the formula before it is clamped, at gains whose limits fall on counts and between them.
TEST(ClippedShares, AreThePixelsWhoseLevelsLieOutside) {
  const auto frame = noise_image<std::uint16_t>(61, 47, 3000, 300, 7);
  const int median = median_counts(frame);
  for (const double gain : {0.5, 0.2, 1.0 / 3.0, 0.25, 1.0, 2.5, 0.01}) {
    double low = 0;
    double high = 0;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const double level = std::round((frame(x, y) - median) * gain + 127.0);
        low += level < 0 ? 1 : 0;
        high += level > 255 ? 1 : 0;
      }
    }
    const ClippedShares clipped = clipped_shares(frame, {.gain = gain});
    EXPECT_EQ(clipped.low, low / (61 * 47)) << gain;
    EXPECT_EQ(clipped.high, high / (61 * 47)) << gain;
  }
  EXPECT_EQ(clipped_shares({}, {}).both(), 0);
}

// At the default gain 254 counts below the median are level 0, 255 of them too (halves are rounded
// away from zero), and 256 above are level 255.
TEST(ClippedShares, CountTheLevelsAtTheEndsAsSeen) {
  EXPECT_EQ(clipped_shares(frame_of(4, 1, {1000 - 254, 1000, 1000, 1256}), {}).both(), 0);
  const ClippedShares clipped = clipped_shares(frame_of(4, 1, {1000 - 255, 1000, 1000, 1257}), {});
  EXPECT_EQ(clipped.low, 0.25);
  EXPECT_EQ(clipped.high, 0.25);
}

TEST(ClippedShares, AreThoseOfValidPixels) {
  const auto frame = frame_of(4, 1, {0, 1000, 1000, 9000});
  Image<std::uint8_t> valid(4, 1);
  fill_pixels(valid.view(), std::uint8_t{1});
  valid(0, 0) = 0;
  const ClippedShares clipped = clipped_shares(frame, {}, valid);
  EXPECT_EQ(clipped.low, 0);
  EXPECT_EQ(clipped.high, 1.0 / 3);
  fill_pixels(valid.view(), std::uint8_t{0});
  EXPECT_EQ(clipped_shares(frame, {}, valid).both(), 0) << "no pixel";
}

TEST(Scale, EqualsTheFormulaForEveryCount) {
  for_each_simd_target([](const std::string&) {
    for (const int median : {0, 1, 127, 3000, 32768, 65534, 65535}) {
      for (const double gain : {0.5, 0.2, 1.0 / 3.0, 0.013, 1.0, 254.5}) {
        // Every count once; two rows of the median on top of the lower half make it the median.
        Image<std::uint16_t> frame(65536, 3);
        fill_pixels(frame.view(), static_cast<std::uint16_t>(median));
        for (int x = 0; x < 65536; ++x) {
          frame(x, 1) = static_cast<std::uint16_t>(x);
        }
        Image<std::uint8_t> levels(65536, 3);
        ASSERT_TRUE(scale_to_8bit(frame, {gain}, levels));
        for (int x = 0; x < 65536; ++x) {
          ASSERT_EQ(levels(x, 1), reference_level(x, median, gain))
              << "count " << x << ", median " << median << ", gain " << gain;
        }
      }
    }
  });
}

TEST(Scale, RoundsHalvesAwayFromZeroAndClips) {
  Image<std::uint8_t> levels(5, 1);
  ASSERT_TRUE(scale_to_8bit(frame_of(5, 1, {1000, 1001, 999, 0, 65535}), {0.5}, levels));
  EXPECT_EQ(levels(0, 0), 127);
  EXPECT_EQ(levels(1, 0), 128);  // 127.5
  EXPECT_EQ(levels(2, 0), 127);  // 126.5
  EXPECT_EQ(levels(3, 0), 0);
  EXPECT_EQ(levels(4, 0), 255);
}

TEST(Scale, WritesEveryPixelOfSmallFramesAndNoneOutside) {
  for_each_simd_target([](const std::string&) {
    for (int width = 1; width <= 40; ++width) {
      for (int height = 1; height <= 3; ++height) {
        const auto frame = noise_image<std::uint16_t>(width + 3, height, 5000, 200, 3);
        const ImageView<const std::uint16_t> part = frame.view().crop(3, 0, width, height);
        GuardedImage<std::uint8_t> levels(width, height);
        ASSERT_TRUE(scale_to_8bit(part, {0.5}, levels.view()));
        ASSERT_TRUE(levels.intact()) << width << "x" << height;
        const int median = median_counts(part);
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            ASSERT_EQ(levels.view()(x, y), reference_level(part(x, y), median, 0.5));
          }
        }
      }
    }
  });
}

TEST(Scale, SameTemperatureStepIsTheSameLevelStepInEveryFrame) {
  Image<std::uint8_t> cold(3, 1), warm(3, 1);
  ASSERT_TRUE(scale_to_8bit(frame_of(3, 1, {1000, 1020, 980}), {0.5}, cold));
  ASSERT_TRUE(scale_to_8bit(frame_of(3, 1, {9000, 9020, 8980}), {0.5}, warm));
  EXPECT_TRUE(test::same_pixels<std::uint8_t>(cold, warm));
}

TEST(Scale, RefusesWhatItCannotDo) {
  const auto frame = noise_image<std::uint16_t>(4, 4, 1000, 10, 1);
  Image<std::uint8_t> levels(4, 4), other(4, 5);
  const Status size = scale_to_8bit(frame, {0.5}, other);
  ASSERT_FALSE(size);
  EXPECT_NE(size.error().message.find("4x5"), std::string::npos);
  for (const double gain : {0.0, -0.5, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()}) {
    const Status status = scale_to_8bit(frame, {gain}, levels);
    ASSERT_FALSE(status) << gain;
    EXPECT_NE(status.error().message.find("scale.gain"), std::string::npos);
  }
  EXPECT_TRUE(scale_to_8bit({}, {0.5}, {}));
}

// Paper, section 2.3: a scene of 11.25 degC and one of 1.32 degC.
TEST(Range, GivesThePapersFigures) {
  EXPECT_DOUBLE_EQ(range_degc({2875, 4000}), 11.25);
  EXPECT_DOUBLE_EQ(range_degc({3000, 3132}), 1.32);
  EXPECT_NEAR(degc_per_level(11.25), 0.0441, 5e-5);
  EXPECT_NEAR(degc_per_level(1.32), 0.00518, 5e-6);
  EXPECT_DOUBLE_EQ(degc_per_level(163.83, 14), 0.01);
  EXPECT_DOUBLE_EQ(range_degc({0, 255}, 0.1), 25.5);
}

TEST(Range, FindsTheExtremes) {
  const CountRange range = count_range(frame_of(2, 2, {500, 65535, 3, 9}));
  EXPECT_EQ(range.min, 3);
  EXPECT_EQ(range.max, 65535);
  EXPECT_EQ(count_range({}).max, 0);
}

}  // namespace
}  // namespace thermedge
