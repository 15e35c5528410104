// The mask of edges for the stripes, its kernels, and selection by rank, against plain versions.
#include "stripe_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "order_statistics.hpp"
#include "stripe_mask_simd.hpp"
#include "support/images.hpp"
#include "transpose.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;

const std::vector<int> kSizes = {1, 2, 3, 15, 16, 17, 31, 33, 70};

Image<std::int32_t> noise(int width, int height, unsigned seed) {
  return noise_image<std::int32_t>(width, height, 9000, 3000, seed);
}

TEST(StripeMaskKernels, SquaresAreSumsOfFourLessTheOffsets) {
  for (const int count : kSizes) {
    const auto counts = noise_image<std::uint16_t>(2 * count, 2, 40000, 20000, 1);
    const auto of_columns = noise(count, 1, 2);
    for_each_simd_target([&](const std::string&) {
      Image<std::int32_t> sums(count, 1);
      detail::square_row(counts.row(0), counts.row(1), of_columns.row(0), -7, count, sums.row(0));
      for (int i = 0; i < count; ++i) {
        const int four =
            counts(2 * i, 0) + counts(2 * i + 1, 0) + counts(2 * i, 1) + counts(2 * i + 1, 1);
        ASSERT_EQ(sums(i, 0), 2 * four - 2 * of_columns(i, 0) + 7);
      }
    });
  }
}

TEST(StripeMaskKernels, RowsOfSums) {
  for (const int count : kSizes) {
    const auto in = noise(count + 4, 5, 3);
    for_each_simd_target([&](const std::string&) {
      Image<std::int32_t> down(count, 1);
      Image<std::int32_t> across(count, 1);
      Image<std::int32_t> clamped(count, 1);
      Image<std::int32_t> slid(count, 1);
      detail::binomial_row(in.row(2), in.stride(), count, down.row(0));
      detail::binomial_row(in.row(2) + 2, 1, count, across.row(0));
      detail::clamped_difference_row(in.row(0), in.row(1), 2500, count, clamped.row(0));
      detail::slide_row(in.row(0), in.row(1), in.row(2), count, slid.row(0));
      for (int i = 0; i < count; ++i) {
        ASSERT_EQ(down(i, 0), in(i, 0) + 4 * in(i, 1) + 6 * in(i, 2) + 4 * in(i, 3) + in(i, 4));
        ASSERT_EQ(across(i, 0),
                  in(i, 2) + 4 * in(i + 1, 2) + 6 * in(i + 2, 2) + 4 * in(i + 3, 2) + in(i + 4, 2));
        ASSERT_EQ(clamped(i, 0), std::clamp(in(i, 0) - in(i, 1), -2500, 2500));
        ASSERT_EQ(slid(i, 0), in(i, 0) + in(i, 1) - in(i, 2));
      }
    });
  }
}

TEST(StripeMaskKernels, MarksAreWhereTheLimitIsExceeded) {
  for (const int count : kSizes) {
    const auto in = noise(count + 2, 3, 4);
    const int limit = std::abs(in(1, 1));  // exactly reached
    const auto before = noise_image<std::uint8_t>(count, 1, 0.3, 0.5, 5);
    for_each_simd_target([&](const std::string&) {
      auto marks = before.clone();
      Image<std::uint8_t> upright(count, 1);
      Image<std::uint8_t> level(count, 1);
      detail::mark_beyond_row(in.row(1) + 1, limit, count, marks.row(0));
      detail::mark_gradients_row(in.row(1) + 1, in.stride(), limit, count, upright.row(0),
                                 level.row(0));
      for (int i = 0; i < count; ++i) {
        ASSERT_EQ(marks(i, 0), before(i, 0) | (std::abs(in(i + 1, 1)) > limit ? 1 : 0));
        int gx = 0;
        int gy = 0;
        for (int k = -1; k <= 1; ++k) {
          gx += (2 - std::abs(k)) * (in(i + 2, 1 + k) - in(i, 1 + k));
          gy += (2 - std::abs(k)) * (in(i + 1 + k, 2) - in(i + 1 + k, 0));
        }
        ASSERT_EQ(upright(i, 0), std::abs(gx) > limit ? 1 : 0);
        ASSERT_EQ(level(i, 0), std::abs(gy) > limit ? 1 : 0);
      }
    });
  }
}

TEST(StripeMaskKernels, ReachIsTheDistanceToTheNextMark) {
  for (const int count : kSizes) {
    Image<std::uint8_t> marks(count + detail::kFarSquares, 1);
    fill_pixels(marks.view(), std::uint8_t{0});
    const auto random = noise_image<std::uint8_t>(count, 1, 0, 0.4, 6);
    copy_pixels(random.view(), marks.view().crop(0, 0, count, 1));
    for_each_simd_target([&](const std::string&) {
      Image<std::uint16_t> reach(2 * count, 1);
      detail::reach_row(marks.row(0), count, reach.row(0));
      int distance = 1000;
      for (int x = 2 * count - 1; x >= 0; --x) {
        distance = marks(x / 2, 0) != 0 ? 0 : distance + 1;
        if (distance < 2 * detail::kFarSquares - 1) {
          ASSERT_EQ(reach(x, 0), distance);
        } else {
          ASSERT_GE(reach(x, 0), 2 * detail::kFarSquares - 1);
        }
      }
    });
  }
}

TEST(StripeMaskKernels, OffsetsAreSubtractedRoundedAndClamped) {
  for (const int width : kSizes) {
    auto counts = noise_image<std::uint16_t>(width, 1, 300, 200, 7);
    counts(0, 0) = 65535;
    const auto offsets = noise_image<float>(width, 1, 0, 100, 8);
    for_each_simd_target([&](const std::string&) {
      test::GuardedImage<std::uint16_t> both(width, 1);
      test::GuardedImage<std::uint16_t> one(width, 1);
      copy_pixels(counts.view(), both.view());
      copy_pixels(counts.view(), one.view());
      detail::subtract_offsets_row(offsets.row(0), -2.3F, width, both.view().row(0));
      detail::subtract_offset_row(-2.3F, width, one.view().row(0));
      for (int x = 0; x < width; ++x) {
        const auto rounded = [](float value) {
          return static_cast<int>(std::clamp(value, 0.0F, 65535.0F) + 0.5F);
        };
        const auto count = static_cast<float>(counts(x, 0));
        ASSERT_EQ(both.view()(x, 0), rounded(count - offsets(x, 0) + 2.3F));
        ASSERT_EQ(one.view()(x, 0), rounded(count + 2.3F));
      }
      EXPECT_TRUE(both.intact());
      EXPECT_TRUE(one.intact());
    });
  }
}

// All edges of the mask, as `reach` tells them: 0 there.
TEST(StripeMask, IsTransposedWhereTheFrameIs) {
  for (const bool with_long : {false, true}) {
    for (const auto& [width, height] : {std::pair{64, 64}, {97, 64}, {82, 101}}) {
      auto frame = noise_image<std::uint16_t>(width, height, 3000, 10, 9);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          frame(x, y) = static_cast<std::uint16_t>(frame(x, y) + (x > 30 ? 12 : 0) +
                                                   (y > 40 && x < 20 ? 90 : 0));
        }
      }
      Image<std::uint16_t> turned(height, width);
      detail::transpose<std::uint16_t>(frame.view(), turned.view());
      const std::vector<double> of_columns(static_cast<std::size_t>(width), 0.2);
      const std::vector<double> of_rows(static_cast<std::size_t>(height), -0.4);
      const auto down_of = [&](ImageView<const std::uint16_t> in, bool transposed) {
        detail::StripeMask mask;
        mask.prepare(in.width(), in.height());
        mask.find(in, transposed ? of_rows : of_columns, transposed ? of_columns : of_rows, 10, 5,
                  with_long);
        Image<std::uint16_t> reach(transposed ? in.width() : in.height(),
                                   ((transposed ? in.height() : in.width()) + 1) / 2);
        transposed ? mask.reach_right(reach) : mask.reach_down(reach);
        return reach;
      };
      const auto reach = down_of(frame, false);
      EXPECT_TRUE(test::same_pixels<std::uint16_t>(reach.view(), down_of(turned, true).view()));
      EXPECT_TRUE(std::any_of(reach.row(5), reach.row(5) + height, [](int r) { return r == 0; }));
    }
  }
}

TEST(NthValue, IsThatOfTheSortedSample) {
  for (const int size : {1, 2, 16, 17, 100, 1000}) {
    for (const double spread : {0.0, 1.0, 300.0}) {  // with many equal ones, and few
      const auto row = noise_image<std::int32_t>(size, 1, 0, spread, 10);
      std::vector<std::int32_t> sorted(row.row(0), row.row(0) + size);
      std::sort(sorted.begin(), sorted.end());
      for (const int n : {0, size / 5, size / 2, size - 1}) {
        std::vector<std::int32_t> values(row.row(0), row.row(0) + size);
        EXPECT_EQ(detail::nth_value(std::span(values), static_cast<std::size_t>(n)),
                  sorted[static_cast<std::size_t>(n)]);
        std::sort(values.begin(), values.end());
        EXPECT_EQ(values, sorted);
      }
    }
  }
}

TEST(NthValue, OfSortedAndOfEqualValues) {
  std::vector<double> values(5000);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<double>(i / 2);
  }
  EXPECT_EQ(detail::nth_value(std::span(values), 1234), 617);
  std::fill(values.begin(), values.end(), 3.5);
  EXPECT_EQ(detail::nth_value(std::span(values), 4999), 3.5);
}

}  // namespace
}  // namespace thermedge
