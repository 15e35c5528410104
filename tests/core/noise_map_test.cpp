// The map of the noise's level: where its nodes lie, and what is between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include "support/images.hpp"
#include "thermedge/noise_model.hpp"

namespace thermedge {
namespace {

using test::noise_image;

// Levels of .5 to 3 and more.
Image<float> random_nodes(int columns, int rows, unsigned seed) {
  auto nodes = noise_image<float>(columns, rows, 0, 1, seed);
  for (int y = 0; y < rows; ++y) {
    std::transform(nodes.row(y), nodes.row(y) + columns, nodes.row(y),
                   [](float value) { return 0.5F + std::abs(value); });
  }
  return nodes;
}

NoiseLevelMap map_of(ImageView<const float> nodes, int width, int height) {
  NoiseLevelMap map;
  map.set_nodes(nodes, width, height);
  return map;
}

// Place of a pixel between the nodes, whose outermost lie in the middle of the outermost blocks.
double place_of(int pixel, int pixels, int nodes) {
  const double first = (kNoiseBlockPx - 1) / 2.0;
  const double last = pixels - 1 - first;
  const double share = last > first ? (pixel - first) / (last - first) : 0;
  return std::clamp(share, 0.0, 1.0) * (nodes - 1);
}

double interpolated(ImageView<const float> nodes, double x, double y) {
  const int left = std::min(static_cast<int>(x), nodes.width() - 2);
  const int top = std::min(static_cast<int>(y), nodes.height() - 2);
  double sum = 0;
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      sum += (i == 0 ? left + 1 - x : x - left) * (j == 0 ? top + 1 - y : y - top) *
             static_cast<double>(nodes(left + i, top + j));
    }
  }
  return sum;
}

TEST(NoiseLevelMap, IsEvenUntilItIsToldOtherwise) {
  NoiseLevelMap map;
  EXPECT_TRUE(map.is_even());
  EXPECT_EQ(map.at(0, 0), 1);
  EXPECT_EQ(map.at(381, 287), 1);
  EXPECT_TRUE(map.nodes().empty());
  map.set_nodes(random_nodes(3, 4, 1), 40, 50);
  EXPECT_FALSE(map.is_even());
  map.set_even();
  EXPECT_TRUE(map.is_even());
  EXPECT_EQ(map.at(39, 49), 1);
  EXPECT_TRUE(map.nodes().empty());
}

TEST(NoiseLevelMap, KeepsTheNodesItIsGiven) {
  const auto nodes = random_nodes(5, 3, 2);
  const NoiseLevelMap map = map_of(nodes, 60, 30);
  EXPECT_TRUE(test::same_pixels<float>(map.nodes(), nodes));
}

// 9 px: the nodes of both blocks lie at 3.5 and 4.5.
TEST(NoiseLevelMap, HasItsOutermostNodesInTheMiddleOfTheOutermostBlocks) {
  Image<float> nodes(2, 2);
  nodes(0, 0) = 1;
  nodes(1, 0) = 2;
  nodes(0, 1) = 3;
  nodes(1, 1) = 4;
  const NoiseLevelMap map = map_of(nodes, 9, 9);
  for (const int x : {0, 1, 3}) {
    EXPECT_EQ(map.at(x, 0), 1);
    EXPECT_EQ(map.at(0, x), 1);
    EXPECT_EQ(map.at(8 - x, 0), 2);
    EXPECT_EQ(map.at(0, 8 - x), 3);
    EXPECT_EQ(map.at(8 - x, 8), 4);
  }
  EXPECT_DOUBLE_EQ(map.at(4, 0), 1.5);
  EXPECT_DOUBLE_EQ(map.at(4, 4), 2.5);
}

TEST(NoiseLevelMap, InterpolatesBetweenNodes) {
  for (const auto& [width, height] : {std::pair{10, 9}, {9, 40}, {17, 33}, {64, 41}, {100, 25}}) {
    for (const auto& [columns, rows] : {std::pair{2, 2}, {3, 5}, {7, 2}}) {
      const auto nodes = random_nodes(columns, rows, 3);
      const NoiseLevelMap map = map_of(nodes, width, height);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          ASSERT_NEAR(map.at(x, y),
                      interpolated(nodes, place_of(x, width, columns), place_of(y, height, rows)),
                      1e-6)
              << x << ", " << y << " of " << width << " x " << height;
        }
      }
    }
  }
}

TEST(NoiseLevelMap, GivesWholeRows) {
  constexpr int kWidth = 61;
  constexpr int kHeight = 37;
  const NoiseLevelMap map = map_of(random_nodes(4, 3, 4), kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    std::vector<float> row(kWidth + 1, -77.0F);
    map.row(y, row.data());
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(row[static_cast<std::size_t>(x)], static_cast<float>(map.at(x, y)));
    }
    ASSERT_EQ(row.back(), -77.0F);
  }
}

TEST(NoiseLevelMap, OfMirroredNodesIsMirrored) {
  for (const auto& [width, height] : {std::pair{60, 44}, {61, 45}}) {
    const auto nodes = random_nodes(6, 5, 5);
    Image<float> turned(6, 5);
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 6; ++x) {
        turned(x, y) = nodes(5 - x, 4 - y);
      }
    }
    const NoiseLevelMap map = map_of(nodes, width, height);
    const NoiseLevelMap other = map_of(turned, width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_NEAR(map.at(x, y), other.at(width - 1 - x, height - 1 - y), 1e-12);
      }
    }
  }
}

TEST(NoiseLevelMap, OfTransposedNodesIsTransposed) {
  const auto nodes = random_nodes(6, 3, 6);
  Image<float> turned(3, 6);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 6; ++x) {
      turned(y, x) = nodes(x, y);
    }
  }
  const NoiseLevelMap map = map_of(nodes, 50, 30);
  const NoiseLevelMap other = map_of(turned, 30, 50);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 50; ++x) {
      ASSERT_NEAR(map.at(x, y), other.at(y, x), 1e-12);
    }
  }
}

TEST(NoiseLevelMap, KeepsItsMemory) {
  NoiseLevelMap map;
  EXPECT_EQ(map.memory_bytes(), 0U);
  map.reserve(382, 288);
  EXPECT_TRUE(map.is_even());
  const std::size_t reserved = map.memory_bytes();
  EXPECT_GT(reserved, 0U);
  map.set_nodes(random_nodes(16, 12, 7), 382, 288);
  EXPECT_EQ(map.memory_bytes(), reserved);
  map.set_even();
  EXPECT_EQ(map.memory_bytes(), reserved);
  map.reserve(382, 288);
  map.set_nodes(random_nodes(49, 38, 8), 382, 288);  // a node for each block and one more
  EXPECT_EQ(map.memory_bytes(), reserved);
}

}  // namespace
}  // namespace thermedge
