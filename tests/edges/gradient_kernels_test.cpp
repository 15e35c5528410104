// Gradients and their suppression against plain loops: the same operations in the same order, so
// the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "gradient_simd.hpp"
#include "support/images.hpp"
#include "support/sentinel_row.hpp"
#include "suppression_simd.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;
using test::SentinelRow;

const std::vector<int> kCounts = {1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 32, 33, 70, 200};
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// What a kernel may write behind `count` elements: up to a whole number of vectors of 16.
int slack(int count) { return (count + 15) / 16 * 16 - count; }

TEST(GradientKernels, SobelGradientsAndTheLargest) {
  for (const int count : kCounts) {
    for (const float odd : {0.0F, kInfinity, std::nanf("")}) {
      auto in = noise_image<float>(count + 2, 3, 100, 30, 44);
      in(count / 2 + 1, 0) += odd;
      const detail::BorderedRows rows{in.row(0), in.row(1), in.row(2)};
      for_each_simd_target([&](const std::string&) {
        SentinelRow<float> gx(count, slack(count));
        SentinelRow<float> gy(count, slack(count));
        SentinelRow<float> magnitude(count, slack(count));
        const float largest =
            detail::sobel_row(rows, count, gx.data(), gy.data(), magnitude.data());
        float expected = 0;
        for (int x = 0; x < count; ++x) {
          const float side = (in(x + 2, 0) - in(x, 0)) + (in(x + 2, 2) - in(x, 2));
          const float middle = in(x + 2, 1) - in(x, 1);
          const float dx = side + (middle + middle);
          const float end = (in(x, 2) - in(x, 0)) + (in(x + 2, 2) - in(x + 2, 0));
          const float centre = in(x + 1, 2) - in(x + 1, 0);
          const float dy = end + (centre + centre);
          const float length = std::sqrt(dx * dx + dy * dy);
          if (odd == 0) {
            ASSERT_EQ(gx[x], dx) << x << " of " << count;
            ASSERT_EQ(gy[x], dy) << x << " of " << count;
            ASSERT_EQ(magnitude[x], length) << x << " of " << count;
          }
          expected = std::max(expected, std::isfinite(length) ? length : kInfinity);
        }
        EXPECT_EQ(largest, expected) << count;
        ASSERT_TRUE(gx.intact() && gy.intact() && magnitude.intact());
      });
    }
  }
}

// Directions by their angle; whole gradients, none of which lies on the border of a sector, and
// magnitudes of few values, so that many are equal.
TEST(GradientKernels, SuppressionKeepsRidges) {
  constexpr float kLow = 3;
  constexpr float kHigh = 5;
  const auto random = noise_image<std::uint8_t>(202, 5, 100, 4, 45);
  const auto levels = noise_image<std::uint8_t>(202, 3, 4, 1.5, 46);
  Image<float> gradients(202, 2);
  Image<float> magnitude(202, 3);
  for (int x = 0; x < 202; ++x) {
    gradients(x, 0) = static_cast<float>(random(x, 0) - 100);
    gradients(x, 1) = static_cast<float>(random(x, 1) - 100);
  }
  copy_pixels(levels.view(), magnitude.view());
  for (const int count : {1, 2, 3, 15, 16, 17, 33, 70, 184}) {
    for_each_simd_target([&](const std::string&) {
      SentinelRow<std::uint8_t> classes(count, slack(count));
      detail::suppress_row(
          {gradients.row(0) + 1, gradients.row(1) + 1, magnitude.row(1) + 1, magnitude.stride()},
          count, kLow, kHigh, classes.data());
      for (int x = 0; x < count; ++x) {
        const double degrees =
            57.29577951308232 * std::atan2(gradients(x + 1, 1), gradients(x + 1, 0));
        const int sector = static_cast<int>(std::lround(degrees / 45) + 4) % 4;
        constexpr int kDx[] = {1, 1, 0, -1};
        constexpr int kDy[] = {0, 1, 1, 1};
        const float at = magnitude(x + 1, 1);
        const float before = magnitude(x + 1 - kDx[sector], 1 - kDy[sector]);
        const float behind = magnitude(x + 1 + kDx[sector], 1 + kDy[sector]);
        const bool ridge = at > before && at >= behind && at > kLow;
        const int expected = !ridge       ? detail::kNoEdge
                             : at > kHigh ? detail::kStrongEdge
                                          : detail::kWeakEdge;
        if (gradients(x + 1, 0) != 0 || gradients(x + 1, 1) != 0) {
          ASSERT_EQ(classes[x], expected) << x << " of " << count << ", " << degrees << " degrees";
        }
      }
      ASSERT_TRUE(classes.intact());
    });
  }
}

}  // namespace
}  // namespace thermedge
