// Kernels on rows of counts against plain loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "highpass_simd.hpp"
#include "outliers_simd.hpp"
#include "support/images.hpp"
#include "support/sentinel_row.hpp"

namespace thermedge {

void PrintTo(const BadPixel& pixel, std::ostream* out) {
  *out << "(" << pixel.x << ", " << pixel.y << ")";
}

namespace {

using test::for_each_simd_target;
using test::noise_image;
using test::SentinelRow;

// What a kernel may write behind `count` elements: up to a whole number of 64-byte vectors.
template <class T>
int slack(int count) {
  constexpr int kLanes = 64 / static_cast<int>(sizeof(T));
  return (count + kLanes - 1) / kLanes * kLanes - count;
}

std::uint16_t saturated(int value) { return static_cast<std::uint16_t>(std::min(value, 65535)); }

TEST(CountKernels, ResidualsAndSlopes) {
  for (int width = 3; width <= 80; width += width < 40 ? 1 : 7) {
    for (const double sigma : {20.0, 30000.0}) {  // the second saturates
      const auto counts = noise_image<std::uint16_t>(width, 3, 30000, sigma, 31);
      const detail::CountRows rows{counts.row(0), counts.row(1), counts.row(2)};
      for_each_simd_target([&](const std::string&) {
        SentinelRow<std::uint16_t> residual(width - 2, slack<std::uint16_t>(width - 2));
        SentinelRow<std::uint16_t> slope(width - 2, slack<std::uint16_t>(width - 2));
        detail::highpass_row(rows, width, residual.data(), slope.data());
        for (int x = 0; x < width - 2; ++x) {
          constexpr int kSecond[] = {1, -2, 1};
          constexpr int kSmooth[] = {1, 2, 1};
          constexpr int kFirst[] = {-1, 0, 1};
          int high = 0;
          int gx = 0;
          int gy = 0;
          for (int j = 0; j < 3; ++j) {
            for (int i = 0; i < 3; ++i) {
              high += kSecond[i] * kSecond[j] * counts(x + i, j);
              gx += kFirst[i] * kSmooth[j] * counts(x + i, j);
              gy += kSmooth[i] * kFirst[j] * counts(x + i, j);
            }
          }
          ASSERT_EQ(residual[x], saturated(std::abs(high))) << x << " of " << width;
          ASSERT_EQ(slope[x], saturated(std::abs(gx) + std::abs(gy))) << x << " of " << width;
        }
        ASSERT_TRUE(residual.intact() && slope.intact());
      });
    }
  }
}

// Every value stands for the interval of one count around it; the median halves the whole.
double plain_median(std::vector<std::int32_t> column) {
  std::sort(column.begin(), column.end());
  const std::int32_t middle = column[column.size() - 1 - column.size() / 2];
  const auto begin = std::lower_bound(column.begin(), column.end(), middle);
  const auto end = std::upper_bound(column.begin(), column.end(), middle);
  const auto below = static_cast<double>(begin - column.begin());
  return middle - 0.5 +
         (0.5 * static_cast<double>(column.size()) - below) / static_cast<double>(end - begin);
}

TEST(CountKernels, MediansOfColumns) {
  constexpr int kLargest = 1 << 18;
  for (const int height : {1, 2, 3, 8, 31, 100}) {
    for (const int width : {1, 2, 15, 16, 17, 33, 70}) {
      for (const double sigma : {0.7, 50.0, 90000.0}) {
        auto table = noise_image<std::int32_t>(width, height, 100000, sigma, 33);
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            table(x, y) = std::clamp(table(x, y) - 100000, -kLargest, kLargest);
          }
        }
        table(0, 0) = -kLargest;
        table(width - 1, height - 1) = kLargest;
        for_each_simd_target([&](const std::string&) {
          SentinelRow<float> medians(width, slack<float>(width));
          detail::column_medians(table, medians.data());
          for (int x = 0; x < width; ++x) {
            std::vector<std::int32_t> column;
            for (int y = 0; y < height; ++y) {
              column.push_back(table(x, y));
            }
            const double expected = plain_median(column);
            // Three roundings: the share within the integer (below 1), and two additions.
            ASSERT_NEAR(medians[x], expected, 0x1p-24 * (1 + 2 * std::abs(expected) + 1))
                << x << " of " << width << "x" << height;
          }
          ASSERT_TRUE(medians.intact());
        });
      }
    }
  }
}

TEST(CountKernels, OutliersStandOutOfAllNeighboursButOne) {
  std::size_t found = 0;
  for (int width = 3; width <= 80; width += width < 40 ? 1 : 7) {
    for (const int limit : {0, 5, 30, 65535}) {
      const auto counts = noise_image<std::uint16_t>(width, 3, 40000, limit == 5 ? 4 : 20000, 35);
      std::vector<BadPixel> expected = {{-1, -1}};  // is left alone
      for (int x = 1; x + 1 < width; ++x) {
        std::vector<int> around;
        for (int j = 0; j < 3; ++j) {
          for (int i = -1; i <= 1; ++i) {
            if (i != 0 || j != 1) {
              around.push_back(counts(x + i, j));
            }
          }
        }
        std::sort(around.begin(), around.end());
        if (counts(x, 1) - around[6] > limit || around[1] - counts(x, 1) > limit) {
          expected.push_back({x, 7});
        }
      }
      found += expected.size() - 1;
      for_each_simd_target([&](const std::string&) {
        std::vector<BadPixel> outliers = {{-1, -1}};
        // Exactly as long as the row: a sanitizer sees a read behind it.
        const std::vector<std::uint16_t> above(counts.row(0), counts.row(0) + width);
        const std::vector<std::uint16_t> row(counts.row(1), counts.row(1) + width);
        const std::vector<std::uint16_t> below(counts.row(2), counts.row(2) + width);
        detail::append_outliers({above.data(), row.data(), below.data()}, width, 7, limit,
                                outliers);
        EXPECT_EQ(outliers, expected) << width << ", limit " << limit;
      });
    }
  }
  EXPECT_GT(found, 300U);
}

}  // namespace
}  // namespace thermedge
