// Frames of nothing but noise have the kind of noise that they are named for.
#include "noise_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "support/images.hpp"
#include "test_frames.hpp"

namespace thermedge::bench {
namespace {

using Counts = ImageView<const std::uint16_t>;

struct Moments {
  double mean = 0, sigma = 0;
};

// Of the pixels of a part of the frame.
Moments moments(Counts counts) {
  double sum = 0;
  double squares = 0;
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      sum += counts(x, y);
      squares += double(counts(x, y)) * counts(x, y);
    }
  }
  const double n = double(counts.width()) * counts.height();
  return {sum / n, std::sqrt(squares / n - sum * sum / n / n)};
}

// Of neighbours dx apart, after the mean of the frame.
double correlation(Counts counts, int dx) {
  const Moments of = moments(counts);
  double sum = 0;
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x + dx < counts.width(); ++x) {
      sum += (counts(x, y) - of.mean) * (counts(x + dx, y) - of.mean);
    }
  }
  return sum / (counts.width() - dx) / counts.height() / (of.sigma * of.sigma);
}

double spread_of_column_means(Counts counts) {
  double sum = 0;
  double squares = 0;
  for (int x = 0; x < counts.width(); ++x) {
    const double mean = moments(counts.crop(x, 0, 1, counts.height())).mean;
    sum += mean;
    squares += mean * mean;
  }
  const double n = counts.width();
  return std::sqrt(squares / n - sum * sum / n / n);
}

Counts part(Counts counts, double from, double to) {
  const auto left = static_cast<int>(from * counts.width());
  return counts.crop(left, 0, static_cast<int>(to * counts.width()) - left, counts.height());
}

class NoiseFrames : public testing::TestWithParam<NoiseKind> {};

TEST_P(NoiseFrames, AreTheSameForASeedAndDifferForAnother) {
  const auto frame = GetParam().make(5);
  EXPECT_EQ(frame.width(), 382);
  EXPECT_EQ(frame.height(), 288);
  EXPECT_TRUE(test::same_pixels<std::uint16_t>(frame, GetParam().make(5)));
  EXPECT_FALSE(test::same_pixels<std::uint16_t>(frame, GetParam().make(6)));
}

INSTANTIATE_TEST_SUITE_P(OfKinds, NoiseFrames, testing::ValuesIn(kNoiseKinds),
                         [](const auto& test) { return "kind" + std::to_string(test.index); });

TEST(NoiseFrame, WhiteNoiseIsUncorrelated) {
  const auto frame = noise_frames::white(1);
  EXPECT_NEAR(moments(frame).sigma, 8, 0.1);
  EXPECT_NEAR(correlation(frame, 1), 0, 0.02);
}

// Linear interpolation half-way leaves a correlation of 1/2 and a quarter of the variance.
TEST(NoiseFrame, InterpolatedNoiseIsCorrelated) {
  const auto frame = noise_frames::moved_by_half_a_pixel(1);
  EXPECT_NEAR(moments(frame).sigma, 4, 0.1);
  EXPECT_NEAR(correlation(frame, 1), 0.5, 0.02);
  EXPECT_NEAR(correlation(frame, 2), 0, 0.02);
  EXPECT_GT(correlation(noise_frames::enlarged_twice(1), 1), 0.7);
  EXPECT_NEAR(correlation(noise_frames::every_pixel_four_times(1), 1), 0.5, 0.02);
}

// exp(-1 / (4 s^2)) for a Gaussian of s px: .60 at .7 px, a little less for its samples.
TEST(NoiseFrame, FilteredNoiseIsCorrelated) {
  EXPECT_NEAR(correlation(noise_frames::after_gaussian(1), 1), 0.6, 0.03);
  EXPECT_GT(correlation(noise_frames::after_median(1), 1), 0.4);
}

TEST(NoiseFrame, TurnedNoiseIsSmoothInSomePlacesOnly) {
  const auto frame = noise_frames::turned_by_half_a_degree(1);
  // Where the grids meet, next to nothing is interpolated.
  EXPECT_NEAR(moments(Counts(frame).crop(186, 139, 10, 10)).sigma, 8, 1.5);
  EXPECT_LT(moments(frame).sigma, 7);
}

TEST(NoiseFrame, JpegHasEightBits) {
  const auto frame = noise_frames::after_jpeg(1);
  for (int y = 0; y < frame.height(); ++y) {
    EXPECT_LE(*std::max_element(frame.row(y), frame.row(y) + frame.width()), 255);
  }
  EXPECT_NEAR(moments(frame).sigma, 127.5 / 2.3, 4);
}

TEST(NoiseFrame, ThreeQuartersAreClipped) {
  const auto frame = noise_frames::clipped(1);
  int highest = 0;
  int at_highest = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      at_highest = frame(x, y) == highest ? at_highest + 1 : frame(x, y) > highest ? 1 : at_highest;
      highest = std::max<int>(highest, frame(x, y));
    }
  }
  EXPECT_NEAR(at_highest / (382.0 * 288), 0.75, 0.03);
}

TEST(NoiseFrame, UnevenNoiseHasItsLevels) {
  const auto slope = noise_frames::uneven(1);
  EXPECT_NEAR(moments(part(slope, 0, 0.03)).sigma, 4.1, 0.2);
  EXPECT_NEAR(moments(part(slope, 0.485, 0.515)).sigma, 8, 0.4);
  EXPECT_NEAR(moments(part(slope, 0.97, 1)).sigma, 15.7, 0.6);
  const auto halves = noise_frames::two_levels(1);
  EXPECT_NEAR(moments(part(halves, 0, 0.5)).sigma, 4, 0.1);
  EXPECT_NEAR(moments(part(halves, 0.5, 1)).sigma, 14, 0.3);
}

// The variance of a Poisson variable is its mean.
TEST(NoiseFrame, PhotonsHaveTheVarianceOfTheirMean) {
  const auto frame = noise_frames::photons(1);
  EXPECT_NEAR(moments(part(frame, 0, 0.01)).mean, 4, 0.3);
  EXPECT_NEAR(moments(part(frame, 0.997, 1)).mean, 400, 6);
  for (const int x : {0, 190, 381}) {
    const Moments of = moments(Counts(frame).crop(x, 0, 1, 288));
    EXPECT_NEAR(of.sigma * of.sigma / of.mean, 1, 0.3) << x;
  }
}

TEST(NoiseFrame, CoarseStepsAreTwoSigma) {
  const auto frame = noise_frames::coarse_steps(1);
  std::set<int> values;
  for (int y = 0; y < frame.height(); ++y) {
    values.insert(frame.row(y), frame.row(y) + frame.width());
  }
  EXPECT_GE(values.size(), 4U);
  for (const int value : values) {
    EXPECT_EQ(value % 16, 0);
  }
}

TEST(NoiseFrame, SmallNoiseLiesOnASlope) {
  const auto frame = noise_frames::below_a_count(1);
  EXPECT_NEAR(moments(part(frame, 0.99, 1)).mean - moments(part(frame, 0, 0.01)).mean, 12, 0.3);
  EXPECT_LT(moments(part(frame, 0, 0.01)).sigma, 0.6);
}

TEST(NoiseFrame, FixedPatternStaysFromFrameToFrame) {
  const auto one = noise_frames::fixed_pattern(1);
  const auto other = noise_frames::fixed_pattern(2);
  const Moments a = moments(one);
  double both = 0;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) {
      both += (one(x, y) - a.mean) * (other(x, y) - a.mean);
    }
  }
  EXPECT_NEAR(both / (382.0 * 288) / (a.sigma * a.sigma), 0.5, 0.1);
}

TEST(NoiseFrame, StripesAreAsStrongAsTheirNameSays) {
  EXPECT_NEAR(spread_of_column_means(noise_frames::stripes_of_one_sigma(1)), 8, 1);
  EXPECT_NEAR(spread_of_column_means(noise_frames::stripes_of_three_sigma(1)), 24, 3);
}

TEST(NoiseFrame, HeavyTailsAreOnePixelIn200OnBothSidesAlike) {
  const auto frame = noise_frames::heavy_tails(1);
  int above = 0;
  int below = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      above += frame(x, y) > kMiddleCounts + 48 ? 1 : 0;
      below += frame(x, y) < kMiddleCounts - 48 ? 1 : 0;
    }
  }
  EXPECT_NEAR(above / (382.0 * 288), 0.0025, 0.0006);
  EXPECT_NEAR(below / (382.0 * 288), 0.0025, 0.0006);
}

TEST(NoiseFrame, DomeStandsInTheMiddleOfTheVignette) {
  const Image<std::uint16_t> frame = noise_frames::dome_and_vignette(1);
  const double middle = moments(Counts(frame).crop(171, 124, 40, 40)).mean;
  const double corner = moments(Counts(frame).crop(0, 0, 40, 40)).mean;
  // 40 (1 - e^-r) + 2.5 r sigma, where r is about 1.5 in that corner.
  EXPECT_NEAR(middle - corner, 8 * (40 * (0.97 - 0.22) + 2.5 * 1.5), 30);
}

}  // namespace
}  // namespace thermedge::bench
