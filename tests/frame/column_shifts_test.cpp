// Medians of the differences between columns and shifts of columns, against plain versions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "column_shifts_simd.hpp"
#include "support/images.hpp"

namespace thermedge {
namespace {

constexpr std::size_t kVector = 64;

std::vector<int> differences_at(ImageView<const std::uint16_t> counts, int row_step, int x) {
  std::vector<int> out;
  for (int y = 0; y < counts.height(); ++y) {
    if (std::min(y, counts.height() - 1 - y) % row_step == 0) {
      out.push_back(std::clamp(counts(x + 1, y) - counts(x, y), -32767, 32767));
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(ColumnShifts, MediansAreThoseOfTheDifferencesToHalfAUnit) {
  for (const int width : {2, 15, 33, 70}) {
    for (const int height : {1, 2, 8, 33, 64}) {
      for (const int unit : {1, 6, detail::kLargestMedianUnit}) {
        const auto counts = test::noise_image<std::uint16_t>(width, height, 30000, 20.0 * unit, 3);
        test::for_each_simd_target([&](const std::string&) {
          std::vector<std::int16_t> medians(static_cast<std::size_t>(width) + kVector);
          detail::neighbour_medians(counts, 4, unit, medians.data());
          for (int x = 0; x + 1 < width; ++x) {
            const auto sorted = differences_at(counts, 4, x);
            const int middle = sorted[sorted.size() / 2];
            const int found = medians[static_cast<std::size_t>(x)];
            ASSERT_LE(found - unit / 2, middle);
            ASSERT_GT(found - unit / 2 + unit, middle);
          }
        });
      }
    }
  }
}

TEST(ColumnShifts, MediansBeyondTheirRangeAreItsEnds) {
  Image<std::uint16_t> counts(3, 10);
  for (int y = 0; y < 10; ++y) {
    counts(0, y) = 0;
    counts(1, y) = 65535;
    counts(2, y) = 0;
  }
  test::for_each_simd_target([&](const std::string&) {
    std::vector<std::int16_t> medians(3 + kVector);
    detail::neighbour_medians(counts, 1, 10, medians.data());
    EXPECT_EQ(medians[0], (detail::kMedianSteps / 2 - 1) * 10 + 5);
    EXPECT_EQ(medians[1], -detail::kMedianSteps / 2 * 10 + 5);
  });
}

TEST(ColumnShifts, AreWithinTheRangeOfCounts) {
  for (const int width : {1, 16, 33, 70}) {
    const auto before = test::noise_image<std::uint16_t>(width, 3, 30000, 40000, 4);
    std::vector<std::uint16_t> down(static_cast<std::size_t>(width) + kVector);
    std::vector<std::uint16_t> up(down.size());
    for (std::size_t x = 0; x < down.size(); ++x) {
      (x % 2 == 0 ? down : up)[x] = static_cast<std::uint16_t>(x * 701);
    }
    test::for_each_simd_target([&](const std::string&) {
      auto counts = before.clone();
      detail::shift_columns(down.data(), up.data(), counts.view());
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < width; ++x) {
          const auto i = static_cast<std::size_t>(x);
          const int lowered = std::max(before(x, y) - down[i], 0);
          ASSERT_EQ(counts(x, y), std::min(lowered + up[i], 65535));
        }
      }
    });
  }
}

}  // namespace
}  // namespace thermedge
