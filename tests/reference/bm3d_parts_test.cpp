// The parts of BM3D, block matching and block transforms, against plain versions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "reference/bm3d_reference.hpp"
#include "simd/bm3d_group.hpp"
#include "simd/bm3d_match.hpp"
#include "support/images.hpp"

namespace thermedge {
namespace {

using detail::BlockPosition;
using detail::BlockTransform;
using detail::SearchWindow;
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

Image<std::int16_t> random_levels(int width, int height, double sigma) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, sigma);
  Image<std::int16_t> levels(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      levels(x, y) = static_cast<std::int16_t>(std::lrint(normal(random)));
    }
  }
  return levels;
}

Image<std::int16_t> transposed(const Image<std::int16_t>& image) {
  Image<std::int16_t> out(image.height(), image.width());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      out(y, x) = image(x, y);
    }
  }
  return out;
}

// Few levels make ties, many make sums that stop at 65535 and differences that wrap.
TEST(Bm3dMatchTest, FindsTheNearestBlocksInOrder) {
  detail::MatchScratch scratch;
  for (const double sigma : {0.0, 0.3, 4.0, 60.0, 9000.0}) {
    const Image<std::int16_t> levels = random_levels(80, 77, sigma);
    const Image<std::int16_t> other = transposed(levels);
    test::for_each_simd_target([&](const std::string&) {
      for (const int width : {1, 2, 3, 7, 8, 9, 15, 17, 31, 32, 33, 36, 37, 65}) {
        for (const int height : {1, 2, 5, 9, 33, 65}) {
          // To the last block of the picture, so that loads past its columns would show.
          const SearchWindow window = {73 - width, 70 - height, width, height};
          const BlockPosition reference = {window.x + width * 2 / 3, window.y + height / 2};
          for (int count = 1; count <= std::min(32, width * height); count = count * 3 / 2 + 1) {
            std::array<BlockPosition, detail::kLargestGroup> group;
            detail::match_blocks({levels, other}, reference, window, count, scratch, group.data());
            const auto expected = test::matches(levels, reference, window, count);
            ASSERT_TRUE(std::equal(expected.begin(), expected.end(), group.begin()))
                << width << " x " << height << ", " << count << ", sigma " << sigma;
          }
        }
      }
    });
  }
}

// A single pixel that differs by 253 to 260 levels: those of 255 and more tie.
TEST(Bm3dMatchTest, LetsNoPixelCountMoreThan255Levels) {
  Image<std::int16_t> levels(8 * 9, 8);
  fill_pixels(levels.view(), std::int16_t{100});
  for (int block = 1; block < 9; ++block) {
    levels(8 * block + 3, 5) = static_cast<std::int16_t>(100 + 261 - block);
  }
  const Image<std::int16_t> other = transposed(levels);
  const SearchWindow window = {0, 0, 8 * 8 + 1, 1};
  detail::MatchScratch scratch;
  test::for_each_simd_target([&](const std::string&) {
    std::array<BlockPosition, detail::kLargestGroup> group;
    detail::match_blocks({levels, other}, {0, 0}, window, 32, scratch, group.data());
    const auto expected = test::matches(levels, {0, 0}, window, 32);
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), group.begin()));
  });
}

}  // namespace
}  // namespace thermedge
