// The parts of BM3D, block matching and block transforms, against plain versions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bm3d_group_simd.hpp"
#include "bm3d_match_simd.hpp"
#include "bm3d_reference.hpp"
#include "support/images.hpp"

namespace thermedge {
namespace {

using detail::BlockPosition;
using detail::BlockTransform;
using test::BlockValues;
using test::Matrix;

BlockValues random_block(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 10);
  BlockValues block;
  std::generate(block.begin(), block.end(), [&] { return static_cast<float>(normal(random)); });
  return block;
}

class Bm3dTransformTest : public testing::TestWithParam<BlockTransform> {
 protected:
  [[nodiscard]] static Matrix matrix() {
    return GetParam() == BlockTransform::kDct ? test::dct_matrix() : test::bior15_matrix();
  }
};

TEST_P(Bm3dTransformTest, IsItsMatrixAndItsInverseGoesBack) {
  test::for_each_simd_target([&](const std::string&) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      const BlockValues block = random_block(seed);
      std::array<float, detail::kBlockPx * detail::kBlockPx> values;
      std::copy(block.begin(), block.end(), values.begin());
      detail::transform_block(GetParam(), false, values.data());
      const BlockValues expected = test::transformed(matrix(), block);
      for (std::size_t i = 0; i < block.size(); ++i) {
        ASSERT_NEAR(values[i], expected[i], 1e-4) << "coefficient " << i;
      }
      detail::transform_block(GetParam(), true, values.data());
      for (std::size_t i = 0; i < block.size(); ++i) {
        ASSERT_NEAR(values[i], block[i], 1e-4) << "pixel " << i;
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Transforms, Bm3dTransformTest,
                         testing::Values(BlockTransform::kBior15, BlockTransform::kDct));

TEST(Bm3dTransformTest, DctKeepsEnergy) {
  const BlockValues block = random_block(9);
  std::array<float, detail::kBlockPx * detail::kBlockPx> values;
  std::copy(block.begin(), block.end(), values.begin());
  detail::transform_block(BlockTransform::kDct, false, values.data());
  double before = 0;
  double after = 0;
  for (std::size_t i = 0; i < block.size(); ++i) {
    before += block[i] * block[i];
    after += double{values[i]} * values[i];
  }
  EXPECT_NEAR(after / before, 1, 1e-6);
}

struct Guide {
  Guide(int width, int height, double levels_sigma, int radius)
      : levels(width, height), values(detail::MatchGuide::readable_width(width), height) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, levels_sigma);
    guide.resize(width, height, radius);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        levels(x, y) = static_cast<std::int16_t>(std::lrint(normal(random)));
        values(x, y) = 0.125F * levels(x, y);
      }
    }
    set();
  }
  // Anew for each SIMD target.
  void set() {
    for (int y = 0; y < values.height(); ++y) {
      guide.set_row(values.row(y), y);
    }
  }
  Image<std::int16_t> levels;
  Image<float> values;
  detail::MatchGuide guide;
};

std::vector<BlockPosition> positions(const detail::BlockGroup& group) {
  return {group.view().begin(), group.view().end()};
}

// Few levels make ties, many make sums at the largest distance and differences that wrap.
TEST(Bm3dMatchTest, FindsTheNearestBlocksOfEachRow) {
  for (const auto& size : {std::pair{8, 8}, {12, 44}, {96, 12}, {140, 28}, {156, 24}}) {
    const int width = size.first;
    const int height = size.second;
    for (const int radius : {4, 7, 16, 32}) {
      const bool with_adjacent = radius == 7;
      const detail::SearchPattern pattern(radius, with_adjacent);
      for (const double sigma : {0.0, 0.3, 4.0, 60.0, 9000.0}) {
        SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height) + ", radius " +
                     std::to_string(radius) + ", sigma " + std::to_string(sigma));
        Guide guide(width, height, sigma, radius);
        test::for_each_simd_target([&](const std::string&) {
          guide.set();
          detail::MatchScratch scratch;
          std::vector<detail::BlockGroup> groups(static_cast<std::size_t>(width / 4));
          for (int y = 0; y <= height - 8; y += 4) {
            const int largest = 1 << (y / 4 % 6);
            std::vector<int> columns(static_cast<std::size_t>((width - 8) / 4 + 1));
            std::iota(columns.begin(), columns.end(), 0);
            detail::match_row(guide.guide, pattern, {0, y, columns}, largest, scratch, groups);
            for (int i = 0; i < std::ssize(columns); i += i < 2 ? 1 : 3) {
              ASSERT_EQ(positions(groups[static_cast<std::size_t>(i)]),
                        test::matches(guide.levels, {4 * i, y}, radius, largest, with_adjacent))
                  << "block " << i << " of row " << y;
            }
          }
        });
      }
    }
  }
}

// Rows that neither follow each other nor begin at a whole cell, and blocks farther apart.
TEST(Bm3dMatchTest, FindsThemForAnyRow) {
  Guide guide(180, 40, 6, 12);
  const detail::SearchPattern pattern(12, false);
  detail::MatchScratch scratch;
  std::vector<detail::BlockGroup> groups(45);
  const auto expect_row = [&](int x, int y, const std::vector<int>& columns) {
    detail::match_row(guide.guide, pattern, {x, y, columns}, 16, scratch, groups);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      ASSERT_EQ(positions(groups[i]), test::matches(guide.levels, {x + 4 * columns[i], y}, 12, 16))
          << "column " << columns[i] << " of row " << y << " from " << x;
    }
  };
  expect_row(1, 3, {0, 1, 2, 5, 31, 32, 40});
  expect_row(1, 7, {0, 7, 42});  // longer than the row above
  expect_row(1, 11, {3, 33});
  expect_row(2, 15, {0, 33});
  expect_row(172, 32, {0});
  expect_row(0, 0, {43});
}

// Values far beyond what 16 bits hold, and half levels.
TEST(Bm3dMatchTest, QuantisesModulo65536ToTheNearestLevel) {
  Image<float> values(detail::MatchGuide::readable_width(8), 8);
  fill_pixels(values.view(), 0.0F);
  values(0, 3) = 8192.0F + 0.125F;  // 65536 + 1 levels
  values(1, 3) = -1e6F;             // -8000000 levels
  values(2, 3) = 3e9F;              // any, but no crash
  values(3, 3) = 0.1F;              // 0.8 levels
  values(4, 3) = -0.1F;
  test::for_each_simd_target([&](const std::string&) {
    detail::MatchGuide guide;
    guide.resize(8, 8, 16);
    for (int y = 0; y < 8; ++y) {
      guide.set_row(values.row(y), y);
    }
    const auto level = [&](int x) { return guide.phases()(guide.margin() + x / 4, 12 + x % 4); };
    EXPECT_EQ(level(0), 1);
    EXPECT_EQ(level(1), static_cast<std::int16_t>(-8000000 & 0xffff));
    EXPECT_EQ(level(3), 1);
    EXPECT_EQ(level(4), -1);
    EXPECT_EQ(level(5), 0);
  });
}

}  // namespace
}  // namespace thermedge
