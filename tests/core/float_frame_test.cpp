// Mirrored borders, units of noise and the range of a frame, against plain versions.
#include "float_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/images.hpp"
#include "support/sentinel_row.hpp"
#include "support/strided_image.hpp"

namespace thermedge::detail {
namespace {

using test::noise_image;
using test::SentinelRow;
using test::StridedImage;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kLargest = std::numeric_limits<float>::max();

// Walks from pixel 0 step by step; at an end the next step stays, then the walk turns around.
int walked(int index, int count) {
  int at = 0;
  int heading = index < 0 ? -1 : 1;
  for (int step = 0; step < std::abs(index); ++step) {
    if (at + heading < 0 || at + heading >= count) {
      heading = -heading;
    } else {
      at += heading;
    }
  }
  return at;
}

TEST(Mirrored, IsAWalkThatTurnsAtTheOuterEdges) {
  for (int count = 1; count <= 7; ++count) {
    for (int i = -40; i <= 40; ++i) {
      EXPECT_EQ(mirrored(i, count), walked(i, count)) << i << " of " << count;
    }
  }
}

TEST(MirroredRow, ContinuesARowToBothSidesFromAnyRow) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 4}, {2, 3}, {5, 1}, {17, 6}}) {
    StridedImage<float> frame(width, height);
    copy_pixels(noise_image<float>(width, height, 3000, 40, 51).view(), frame.view());
    for (const int margin : {0, 1, 3, 2 * width + 1}) {
      const int out_width = width + 2 * margin + 1;
      const NoiseUnits units{2900, 8};
      for (int y = -2 * height - 1; y <= 3 * height; ++y) {
        SentinelRow<float> counts(out_width);
        SentinelRow<float> values(out_width);
        mirrored_row(frame.view(), y, margin, out_width, counts.data());
        mirrored_row(frame.view(), units, y, margin, out_width, values.data());
        for (int i = 0; i < out_width; ++i) {
          const float pixel = frame.view()(walked(i - margin, width), walked(y, height));
          ASSERT_EQ(counts[i], pixel) << i << ", " << y;
          ASSERT_EQ(values[i], static_cast<float>((static_cast<double>(pixel) - 2900) / 8));
        }
        ASSERT_TRUE(counts.intact() && values.intact());
      }
    }
  }
}

TEST(NoiseUnits, GoBackToCounts) {
  const NoiseUnits units{1e6, 0.25};
  for (const float counts : {999'990.0F, 1e6F, 1'000'003.5F, -1e6F}) {
    EXPECT_EQ(units.to_counts(units.from_counts(counts)), counts);
  }
  EXPECT_EQ(units.from_counts(1'000'000.5F), 2);
  // An offset that is no float.
  EXPECT_EQ((NoiseUnits{16'777'216.5, 0.25}.from_counts(16'777'218)), 6);
}

TEST(NoiseUnits, StayFinite) {
  const NoiseUnits units{0.5 * static_cast<double>(kLargest), static_cast<double>(kLargest) / 4};
  EXPECT_EQ(units.to_counts(3), kLargest);
  EXPECT_EQ(units.to_counts(-7), -kLargest);
  EXPECT_EQ(units.to_counts(-2), 0);
}

TEST(CheckFinite, NamesTheFirstPixelInReadingOrder) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 5}, {40, 3}}) {
    for (const float bad : {kInfinity, -kInfinity, std::nanf("")}) {
      // What lies between the rows is none of the frame's.
      StridedImage<float> frame(width, height, std::nanf(""));
      fill_pixels(frame.view(), kLargest);
      EXPECT_TRUE(check_finite(frame.view()));
      for (int y = height - 1; y >= 0; --y) {
        for (int x = width - 1; x >= 0; --x) {
          frame.view()(x, y) = bad;
          const Status status = check_finite(frame.view());
          ASSERT_FALSE(status);
          EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
          ASSERT_TRUE(status.error().message.starts_with("frame: pixel (" + std::to_string(x) +
                                                         ", " + std::to_string(y) + ") is NaN"))
              << status.error().message;
        }
      }
    }
  }
}

TEST(FrameRange, IsTheMeanAndTheFarthestPixelFromIt) {
  for (int width = 1; width <= 35; ++width) {
    for (const int height : {1, 2, 5}) {
      StridedImage<float> frame(width, height, 1e30F);
      copy_pixels(noise_image<float>(width, height, -500, 40, 52).view(), frame.view());
      for (const float outlier : {-500.0F, -900.0F, 700.0F}) {
        frame.view()(width - 1, height / 2) = outlier;
        long double sum = 0;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            sum += frame.view()(x, y);
          }
        }
        const auto mean = static_cast<double>(sum / (width * height));
        double farthest = 0;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            farthest = std::max(farthest, std::abs(frame.view()(x, y) - mean));
          }
        }
        const FrameRange range = frame_range(frame.view());
        EXPECT_NEAR(range.mean, mean, 1e-10) << width << "x" << height;
        EXPECT_NEAR(range.deviation, farthest, 1e-10) << width << "x" << height;
      }
    }
  }
}

}  // namespace
}  // namespace thermedge::detail
