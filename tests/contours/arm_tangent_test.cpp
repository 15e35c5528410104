// Tangents of arms, and the order in which a window is searched.
#include "arm_tangent.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "pixel_window.hpp"
#include "support/drawing.hpp"

namespace thermedge::detail {
namespace {

double direction(Vector v) { return std::atan2(v.y, v.x); }

// The slope at 0 of the parabola (degree 2) or line (degree 1) that fits values[k] over k best, by
// the normal equations.
double fitted_slope(const std::vector<double>& values, std::size_t degree) {
  std::array<std::array<double, 4>, 3> rows{};
  for (std::size_t k = 0; k < values.size(); ++k) {
    for (std::size_t i = 0; i <= degree; ++i) {
      for (std::size_t j = 0; j <= degree; ++j) {
        rows[i][j] += std::pow(k, i + j);
      }
      rows[i][3] += std::pow(k, i) * values[k];
    }
  }
  for (std::size_t pivot = 0; pivot <= degree; ++pivot) {
    for (std::size_t i = 0; i <= degree; ++i) {
      const double factor = rows[i][pivot] / rows[pivot][pivot];
      for (std::size_t j = 0; i != pivot && j < 4; ++j) {
        rows[i][j] -= factor * rows[pivot][j];
      }
    }
  }
  return rows[1][3] / rows[1][1];
}

TEST(ArmTangent, IsThatOfTheBestParabolaAndOfALineWhereShort) {
  std::mt19937 random(81);
  for (std::size_t length = 1; length <= 30; ++length) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<Pixel> arm{{0, 0}};
      while (arm.size() <= length) {
        arm.push_back({arm.back().x + 1, arm.back().y + static_cast<int>(random() % 3) - 1});
      }
      std::vector<double> x, y;
      for (const Pixel at : arm) {
        x.push_back(at.x);
        y.push_back(at.y);
      }
      const std::size_t degree = length <= 4 ? 1 : 2;
      const Vector expected{fitted_slope(x, degree), fitted_slope(y, degree)};
      const Vector found = tangent(length, [&](std::size_t k) { return arm[k]; });
      EXPECT_NEAR(direction(found), direction(expected), 1e-9) << length;
    }
  }
}

TEST(ArmTangent, OfAParabolaIsItsDerivativeAtTheCorner) {
  for (const int slope : {-3, 0, 2}) {
    const auto parabola = [&](std::size_t k) {
      const int u = static_cast<int>(k);
      return Pixel{2 * u, slope * u + u * u};
    };
    for (const std::size_t length : {5U, 6U, 11U}) {
      EXPECT_NEAR(direction(tangent(length, parabola)), std::atan2(slope, 2), 1e-12);
    }
  }
}

TEST(ArmTangent, OfAnArmThatStandsStillIsNone) {
  const Vector none = tangent(9, [](std::size_t) { return Pixel{0, 0}; });
  EXPECT_EQ(dot(none, none), 0);
  const Vector of_nothing = tangent(0, [](std::size_t) { return Pixel{0, 0}; });
  EXPECT_EQ(dot(of_nothing, of_nothing), 0);
  EXPECT_EQ(cross({2, 3}, {5, 7}), -1);
}

TEST(PixelWindow, ListsEachPixelThatIsWantedOnceNearestFirst) {
  const std::vector<Pixel> of_one = {{0, 0},   {-1, 0}, {0, -1}, {0, 1}, {1, 0},
                                     {-1, -1}, {-1, 1}, {1, -1}, {1, 1}};
  std::vector<Pixel> offsets{{99, 99}};  // of an earlier window
  list_offsets(
      1, [](Pixel) { return true; }, offsets);
  EXPECT_EQ(offsets, of_one);
  for (int reach = 0; reach <= 6; ++reach) {
    const auto in_circle = [&](Pixel at) { return at.x * at.x + at.y * at.y <= reach * reach; };
    list_offsets(reach, in_circle, offsets);
    std::set<std::tuple<int, int, int>> expected;  // sorted by distance, column and row
    for (int y = -9; y <= 9; ++y) {
      for (int x = -9; x <= 9; ++x) {
        if (in_circle({x, y})) {
          expected.emplace(x * x + y * y, x, y);
        }
      }
    }
    ASSERT_EQ(offsets.size(), expected.size()) << reach;
    auto next = offsets.begin();
    for (const auto& [squared, x, y] : expected) {
      EXPECT_EQ(*next++, (Pixel{x, y})) << reach;
    }
  }
}

}  // namespace
}  // namespace thermedge::detail
