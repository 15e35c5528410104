// What the benchmarks do to frames.
#include "processing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/images.hpp"
#include "test_frames.hpp"

namespace thermedge::bench {
namespace {

Image<float> noise(double mean, double sigma, unsigned seed, int width = 120, int height = 90) {
  return test::noise_image<float>(width, height, mean, sigma, seed);
}

template <class F>
Image<float> drawn(int width, int height, F&& value) {
  Image<float> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = static_cast<float>(value(x, y));
    }
  }
  return image;
}

double ramp(double x, double y) { return 3 * x - 2 * y + 100; }

TEST(MovedByHalf, ShowsWhatLiesHalfAPixelOn) {
  const Image<float> moved = moved_by_half(drawn(20, 10, ramp));
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 19; ++x) {
      EXPECT_NEAR(moved(x, y), ramp(x + 0.5, y + 0.5), 1e-4);
    }
  }
}

TEST(Turned, ShowsWhatLiesUnderTheTurnedPixel) {
  const double angle = 0.2;
  const Image<float> result = turned(drawn(41, 31, ramp), angle);
  EXPECT_NEAR(result(20, 15), ramp(20, 15), 1e-4);
  EXPECT_NEAR(result(30, 15), ramp(20 + 10 * std::cos(angle), 15 + 10 * std::sin(angle)), 1e-3);
  EXPECT_NEAR(result(20, 20), ramp(20 - 5 * std::sin(angle), 15 + 5 * std::cos(angle)), 1e-3);
}

TEST(Enlarged, HasTwiceTheSidesAndTheSameSlope) {
  const Image<float> result = enlarged(drawn(20, 10, ramp));
  ASSERT_EQ(result.width(), 40);
  ASSERT_EQ(result.height(), 20);
  for (int y = 1; y < 19; ++y) {
    for (int x = 1; x < 39; ++x) {
      EXPECT_NEAR(result(x, y), ramp((x + 0.5) / 2 - 0.5, (y + 0.5) / 2 - 0.5), 1e-4);
    }
  }
}

TEST(Repeated, HasEachPixelFourTimes) {
  const Image<float> original = noise(50, 9, 2, 13, 7);
  const Image<float> result = repeated(original);
  ASSERT_EQ(result.width(), 26);
  ASSERT_EQ(result.height(), 14);
  for (int y = 0; y < 14; ++y) {
    for (int x = 0; x < 26; ++x) {
      EXPECT_EQ(result(x, y), original(x / 2, y / 2));
    }
  }
}

TEST(MedianOf9, TakesOffSpikesAndKeepsSteps) {
  Image<float> image = drawn(20, 12, [](int x, int) { return x < 10 ? 5.0 : 80.0; });
  image(4, 4) = 1000;
  image(15, 0) = -1000;
  const Image<float> result = median_of_9(image);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 20; ++x) {
      EXPECT_EQ(result(x, y), x < 10 ? 5.0F : 80.0F) << x << ", " << y;
    }
  }
}

TEST(Blurred, SpreadsAPointByItsSigma) {
  const Image<float> point = drawn(41, 41, [](int x, int y) { return x == 20 && y == 20 ? 1 : 0; });
  const Image<float> result = blurred(point, 1.5);
  double sum = 0;
  double along_x = 0;
  double along_y = 0;
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      sum += result(x, y);
      along_x += double{result(x, y)} * (x - 20) * (x - 20);
      along_y += double{result(x, y)} * (y - 20) * (y - 20);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_NEAR(std::sqrt(along_x), 1.5, 0.01);
  EXPECT_NEAR(std::sqrt(along_y), 1.5, 0.01);
}

TEST(InSteps, RoundsToMultiples) {
  const Image<float> original = noise(500, 40, 3);
  const Image<float> result = in_steps(original, 16);
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      EXPECT_EQ(std::remainder(result(x, y), 16), 0);
      EXPECT_LE(std::abs(result(x, y) - original(x, y)), 8);
    }
  }
}

double rms_difference(ImageView<const float> a, ImageView<const float> b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      sum += (a(x, y) - b(x, y)) * (a(x, y) - b(x, y));
    }
  }
  return std::sqrt(sum / static_cast<double>(a.width()) / a.height());
}

TEST(ThroughJpeg, KeepsFlatBlocksAndLosesMoreAtLowerQuality) {
  const Image<float> flat = drawn(24, 16, [](int, int) { return 77; });
  EXPECT_LE(rms_difference(through_jpeg(flat, 80), flat), 1);
  const Image<float> levels = noise(128, 12, 4, 100, 60);  // no multiples of 8
  const double fine = rms_difference(through_jpeg(levels, 100), levels);
  const double usual = rms_difference(through_jpeg(levels, 80), levels);
  const double coarse = rms_difference(through_jpeg(levels, 20), levels);
  EXPECT_LT(fine, 0.8);
  EXPECT_GT(usual, 3);  // steps of 4 to 49 levels
  EXPECT_LT(usual, 8);
  EXPECT_GT(coarse, usual + 2);
}

// At quality 50 the steps are those of the table: 12 for the coefficient (1, 1).
TEST(ThroughJpeg, RoundsACoefficientToTheStepOfTheTable) {
  const auto pattern = [](double height) {
    return drawn(8, 8, [=](int x, int y) {
      return 128 + height * std::cos(M_PI * (2 * x + 1) / 16) * std::cos(M_PI * (2 * y + 1) / 16);
    });
  };
  // A wave of height h has the coefficient 4 h.
  EXPECT_NEAR(through_jpeg(pattern(9.5), 50)(0, 0), pattern(9)(0, 0), 0.51);
  EXPECT_NEAR(through_jpeg(pattern(8.4), 50)(0, 0), pattern(9)(0, 0), 0.51);
  EXPECT_NEAR(through_jpeg(pattern(10.8), 50)(0, 0), pattern(12)(0, 0), 0.51);
}

TEST(ThroughJpeg, StaysWithinEightBits) {
  const Image<float> result = through_jpeg(noise(128, 200, 5, 64, 64), 30);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      EXPECT_GE(result(x, y), 0);
      EXPECT_LE(result(x, y), 255);
    }
  }
}

TEST(WithoutOutliers, ReplacesWhatIsFarFromItsNeighboursOnly) {
  const Image<std::uint16_t> counts = rounded(noise(2700, 8, 6));
  Image<std::uint16_t> spoilt = counts.clone();
  spoilt(40, 40) = 0;
  spoilt(60, 0) = 2700 + 100;
  const Image<std::uint16_t> result = without_outliers(spoilt, 8);
  EXPECT_NEAR(result(40, 40), 2700, 20);
  EXPECT_NEAR(result(60, 0), 2700, 20);
  int changed = 0;
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      changed += result(x, y) != counts(x, y) ? 1 : 0;
    }
  }
  EXPECT_LE(changed, 2);
}

TEST(Rounded, CutsOffAtTheEndsOf14Bits) {
  const Image<std::uint16_t> counts = rounded(drawn(3, 1, [](int x, int) {
    return x == 0 ? -3 : x == 1 ? 7.6 : 20000;
  }));
  EXPECT_EQ(counts(0, 0), 0);
  EXPECT_EQ(counts(1, 0), 8);
  EXPECT_EQ(counts(2, 0), 16383);
}

}  // namespace
}  // namespace thermedge::bench
