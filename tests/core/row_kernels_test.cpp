// Extents and smoothing of rows against plain loops: the same operations in the same order, so the
// same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "extent_simd.hpp"
#include "smoothing_simd.hpp"
#include "support/images.hpp"
#include "support/sentinel_row.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;
using test::SentinelRow;

const std::vector<int> kCounts = {1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 32, 33, 70, 200};
constexpr int kMargin = 8;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(RowKernels, ExtentsAndPixelsThatAreNotFinite) {
  for (const int width : kCounts) {
    const auto image = noise_image<float>(width, 1, -20, 100, 41);
    const std::vector<float> row(image.row(0), image.row(0) + width);
    for_each_simd_target([&](const std::string&) {
      const detail::Extent extent = detail::extent_of(row.data(), width);
      EXPECT_EQ(extent.low, *std::min_element(row.begin(), row.end()));
      EXPECT_EQ(extent.high, *std::max_element(row.begin(), row.end()));
      EXPECT_TRUE(extent.finite);
      for (std::size_t x = 0; x < row.size(); ++x) {
        for (const float bad : {std::nanf(""), kInfinity, -kInfinity}) {
          auto broken = row;
          broken[x] = bad;
          EXPECT_FALSE(detail::extent_of(broken.data(), width).finite) << x << " of " << width;
        }
        auto extreme = row;
        extreme[x] = -std::numeric_limits<float>::max();
        EXPECT_TRUE(detail::extent_of(extreme.data(), width).finite);
        EXPECT_EQ(detail::extent_of(extreme.data(), width).low, extreme[x]) << x << " of " << width;
      }
    });
  }
}

TEST(RowKernels, SmoothingIsTheWeightedSumOfDifferences) {
  const float weights[] = {0.4F, 0.2F, 0.07F, 0.03F};
  const auto in = noise_image<float>(200 + 2 * kMargin, 2 * kMargin + 1, 3000, 40, 42);
  const float* centre = in.row(kMargin) + kMargin;
  for (const int count : kCounts) {
    for (const int radius : {0, 1, 3}) {
      for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, in.stride()}) {
        for_each_simd_target([&](const std::string&) {
          SentinelRow<float> out(count, std::max(detail::kGaussianSlack - count, 0));
          detail::smooth_row(centre, step, weights, radius, count, out.data());
          for (int x = 0; x < count; ++x) {
            float sum = 0;
            for (int k = 1; k <= radius; ++k) {
              sum += weights[k] *
                     ((centre[x - k * step] - centre[x]) + (centre[x + k * step] - centre[x]));
            }
            ASSERT_EQ(out[x], centre[x] + sum) << x << " of " << count;
          }
          ASSERT_TRUE(out.intact());
        });
      }
    }
  }
}

// Whole numbers up to 2^14: the sum of the kernel is exact, and 1 / 159, the product with it and
// the last addition are each rounded once.
TEST(RowKernels, ThePapersKernelIsRoundedThreeTimes) {
  constexpr int kKernel[5][5] = {
      {2, 4, 5, 4, 2}, {4, 9, 12, 9, 4}, {5, 12, 15, 12, 5}, {4, 9, 12, 9, 4}, {2, 4, 5, 4, 2}};
  const auto counts = noise_image<std::uint16_t>(200 + 2 * kMargin, 5, 8000, 2000, 43);
  Image<float> in(counts.width(), counts.height());
  copy_pixels(counts.view(), in.view());
  const float* centre = in.row(2) + kMargin;
  for (const int count : kCounts) {
    for_each_simd_target([&](const std::string&) {
      std::vector<float> wide(static_cast<std::size_t>(count) + 4 + detail::kGaussianSlack);
      std::vector<float> narrow(wide.size());
      SentinelRow<float> out(count, std::max(detail::kGaussianSlack - count, 0));
      detail::paper_kernel_row(centre, in.stride(), count, wide.data(), narrow.data(), out.data());
      for (int x = 0; x < count; ++x) {
        double sum = 0;
        for (int j = -2; j <= 2; ++j) {
          for (int i = -2; i <= 2; ++i) {
            sum += kKernel[j + 2][i + 2] * static_cast<double>(centre[x + i + j * in.stride()]);
          }
        }
        const double expected = sum / 159;
        const double change = std::abs(expected - static_cast<double>(centre[x]));
        ASSERT_NEAR(out[x], expected, 0x1.01p-24 * (expected + 2 * change)) << x << " of " << count;
      }
      ASSERT_TRUE(out.intact());
    });
  }
}

}  // namespace
}  // namespace thermedge
