// Float values as 16-bit counts.
#include "thermedge/float_scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/images.hpp"

namespace thermedge {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Image<float> row_of(const std::vector<float>& values) {
  Image<float> image(static_cast<int>(values.size()), 1);
  std::copy(values.begin(), values.end(), image.row(0));
  return image;
}

FloatScale scale_of(const std::vector<float>& values) {
  return FloatScaleChooser().choose(row_of(values));
}

std::vector<int> counts_of(const std::vector<float>& values, const FloatScale& scale) {
  Image<std::uint16_t> counts(static_cast<int>(values.size()), 1);
  to_counts(row_of(values), scale, counts);
  return {counts.row(0), counts.row(0) + counts.width()};
}

TEST(FloatScale, LeavesWholeNumbersWithTheirSteps) {
  EXPECT_EQ(scale_of({0, 65535, kNan}), (FloatScale{1, 0}));
  EXPECT_EQ(scale_of({-1, 100}), (FloatScale{1, -32768})) << "int16";
  EXPECT_EQ(scale_of({-32768, 32767}), (FloatScale{1, -32768}));
  EXPECT_EQ(scale_of({100000, 165535}), (FloatScale{1, 100000})) << "within another span";
  EXPECT_EQ(scale_of({100000, 100535}), (FloatScale{1, 67500})) << "in the middle of it";
  EXPECT_NE(scale_of({100000, 165536}).counts_per_unit, 1) << "wider than 16 bits";
  EXPECT_EQ(counts_of({-2, 0, 5, kNan}, {1, -32768}), (std::vector{32766, 32768, 32773, 0}));
}

TEST(FloatScale, SpreadsOtherValuesByAPowerOfTwo) {
  for (const float span : {0.01F, 0.9F, 1.0F, 30.0F, 5000.0F}) {
    const FloatScale scale = scale_of({20.25F, 20.25F + span});
    const double counts = scale.counts_per_unit * static_cast<double>(span);
    EXPECT_GT(counts, 8191.9) << span;
    EXPECT_LE(counts, 16385) << span;
    EXPECT_EQ(std::exp2(std::round(std::log2(scale.counts_per_unit))), scale.counts_per_unit);
    EXPECT_NEAR(scale.to_count(20.25F + span / 2), 32768, 1);
    EXPECT_NEAR(scale.to_value(scale.to_count(20.3F)), 20.3, 1e-5);
  }
}

// Noise of 0.05 in the frame: a spot of 1500 does not take its steps from it.
TEST(FloatScale, LeavesTheNoiseItsStepsWhateverIsInView) {
  Image<float> values = test::noise_image<float>(100, 100, 20, 0.05, 1);
  const FloatScale plain = FloatScaleChooser().choose(values);
  for (int y = 0; y < 20; ++y) {
    std::fill_n(values.row(y), 20, 1500.5F);
  }
  const FloatScale hot = FloatScaleChooser().choose(values);
  EXPECT_GE(hot.counts_per_unit * 0.05, 7.5);
  EXPECT_LE(hot.counts_per_unit * 0.05, 17);
  EXPECT_NEAR(hot.to_count(20), 32768, 10);
  EXPECT_GT(plain.counts_per_unit, hot.counts_per_unit);
}

TEST(FloatScale, ClampsWhatLiesFarOutside) {
  const FloatScale scale{.counts_per_unit = 100, .offset = 0};
  EXPECT_EQ(counts_of({-1e30F, 1, 1e30F, std::numeric_limits<float>::infinity()}, scale),
            (std::vector{0, 100, 65535, 0}));
}

TEST(FloatScale, IsKeptFromFrameToFrameAsLongAsItSuits) {
  FloatScaleChooser chooser;
  const FloatScale first = chooser.choose(row_of({20.1F, 30.1F}));
  EXPECT_EQ(chooser.choose(row_of({20.6F, 33.0F}), first), first);
  EXPECT_NE(chooser.choose(row_of({20.1F, 90.1F}), first), first) << "beyond 16 bits";
  EXPECT_NE(chooser.choose(row_of({24.1F, 24.2F}), first), first) << "too coarse";
  EXPECT_NE(chooser.choose(row_of({-5, 900}), first), first) << "whole numbers keep their steps";
  EXPECT_EQ(chooser.choose(row_of({kNan, kNan}), first), first);
}

}  // namespace
}  // namespace thermedge
