// Hysteresis against marks that spread until nothing changes.
#include "hysteresis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "support/images.hpp"
#include "support/strided_image.hpp"
#include "suppression_simd.hpp"

namespace thermedge::detail {
namespace {

using test::same_pixels;
using test::StridedImage;

// Gives each pixel with a class the largest label around it, again and again; then groups are
// judged label by label.
Image<std::uint8_t> expected_of(ImageView<const std::uint8_t> classes, std::size_t min_group_px) {
  const int width = classes.width();
  const int height = classes.height();
  Image<int> labels(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      labels(x, y) = classes(x, y) != kNoEdge ? y * width + x + 1 : 0;
    }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 1; y + 1 < height; ++y) {
      for (int x = 1; x + 1 < width; ++x) {
        int largest = labels(x, y);
        for (int i = 0; i < 9 && labels(x, y) != 0; ++i) {
          largest = std::max(largest, labels(x + i % 3 - 1, y + i / 3 - 1));
        }
        changed = changed || largest != labels(x, y);
        labels(x, y) = largest;
      }
    }
  }
  Image<std::uint8_t> kept(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::size_t members = 0;
      bool strong = false;
      for (int v = 0; v < height && labels(x, y) != 0; ++v) {
        for (int u = 0; u < width; ++u) {
          const bool member = labels(u, v) == labels(x, y);
          members += member ? 1 : 0;
          strong = strong || (member && classes(u, v) == kStrongEdge);
        }
      }
      kept(x, y) = strong && members >= min_group_px ? kKeptEdge : std::uint8_t{kNoEdge};
    }
  }
  return kept;
}

void expect_as_expected(StridedImage<std::uint8_t>& classes, std::size_t min_group_px,
                        std::vector<std::ptrdiff_t>& scratch) {
  const auto expected = expected_of(classes.view(), min_group_px);
  apply_hysteresis(classes.view(), min_group_px, scratch);
  ASSERT_TRUE(same_pixels<std::uint8_t>(classes.view(), expected)) << min_group_px;
  ASSERT_TRUE(classes.intact());
}

// 3^9 maps of 3 x 3 pixels inside a border.
TEST(Hysteresis, KeepsGroupsWithAStrongPixelOnAllSmallMaps) {
  std::vector<std::ptrdiff_t> scratch;
  for (int number = 0; number < 19683; ++number) {
    StridedImage<std::uint8_t> classes(5, 5);
    fill_pixels(classes.view(), std::uint8_t{kNoEdge});
    for (int i = 0, rest = number; i < 9; ++i, rest /= 3) {
      classes.view()(1 + i % 3, 1 + i / 3) = static_cast<std::uint8_t>(rest % 3);
    }
    const std::size_t min_group_px = static_cast<std::size_t>(number) % 5;
    ASSERT_NO_FATAL_FAILURE(expect_as_expected(classes, min_group_px, scratch)) << number;
  }
}

TEST(Hysteresis, KeepsThemOnLargerMapsOfAnyDensity) {
  std::mt19937 random(91);
  std::vector<std::ptrdiff_t> scratch;
  for (const auto& [width, height] : {std::pair{3, 3}, {3, 17}, {19, 3}, {24, 15}}) {
    for (const unsigned percent : {5U, 20U, 40U, 90U}) {
      for (const std::size_t min_group_px : {0U, 1U, 2U, 9U, 500U}) {
        StridedImage<std::uint8_t> classes(width, height);
        fill_pixels(classes.view(), std::uint8_t{kNoEdge});
        for (int y = 1; y + 1 < height; ++y) {
          for (int x = 1; x + 1 < width; ++x) {
            const bool is_edge = random() % 100 < percent;
            const bool strong = random() % 6 == 0;
            classes.view()(x, y) = !is_edge ? kNoEdge : strong ? kStrongEdge : kWeakEdge;
          }
        }
        ASSERT_NO_FATAL_FAILURE(expect_as_expected(classes, min_group_px, scratch));
      }
    }
  }
}

TEST(Hysteresis, TakesMapsWithoutAnInside) {
  std::vector<std::ptrdiff_t> scratch;
  for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {2, 2}, {9, 2}, {1, 9}}) {
    StridedImage<std::uint8_t> classes(width, height);
    fill_pixels(classes.view(), std::uint8_t{kNoEdge});
    ASSERT_NO_FATAL_FAILURE(expect_as_expected(classes, 1, scratch));
  }
}

TEST(FindPixel, IsTheFirstOfItsValueOrTheEnd) {
  std::vector<std::uint8_t> row = {2, 1, 0, 2, 1, 7};
  std::uint8_t* const begin = row.data();
  EXPECT_EQ(find_pixel(begin, begin + 6, 2), begin);
  EXPECT_EQ(find_pixel(begin + 1, begin + 6, 2), begin + 3);
  EXPECT_EQ(find_pixel(begin, begin + 5, 7), begin + 5);  // 7 lies behind
  EXPECT_EQ(find_pixel(begin, begin, 2), begin);
}

}  // namespace
}  // namespace thermedge::detail
