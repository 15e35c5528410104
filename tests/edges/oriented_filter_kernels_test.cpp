// Kernels of the oriented edges against plain versions.
#include "oriented_filter_simd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/images.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;

constexpr int kMargin = 12;
constexpr double kStep = std::numbers::pi / 12;

Image<std::int32_t> directions(int width, int height, unsigned seed) {
  auto image = noise_image<std::int32_t>(width, height, 1000, 300, seed);
  for (int y = 0; y < height; ++y) {
    std::transform(image.row(y), image.row(y) + width, image.row(y), [](int v) { return v % 24; });
  }
  return image;
}

detail::DiagonalShares shares() {
  detail::DiagonalShares shares{};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i] = static_cast<float>(std::tan(static_cast<double>(i) * kStep));
  }
  return shares;
}

// Strength one pixel from (x, y) along `sign` times the normal, between the two neighbours there,
// from the angles alone.
double across(const Image<float>& response, int x, int y, int direction, int sign) {
  const double angle = direction % 12 * kStep;
  const double nx = -std::sin(angle);
  const double ny = std::cos(angle);
  const double longer = std::max(std::abs(nx), std::abs(ny));
  const double dx = sign * nx / longer;
  const double dy = sign * ny / longer;
  const auto toward_axis = [](double v) { return std::abs(v) > 1 - 1e-9 ? std::lround(v) : 0; };
  const auto away = [](double v) { return v < -1e-9 ? -1 : v > 1e-9 ? 1 : 0; };
  const bool diagonal = std::abs(std::abs(nx) - std::abs(ny)) < 1e-9;
  const double share = std::min(std::abs(dx), std::abs(dy));
  const double side = diagonal
                          ? 0
                          : static_cast<double>(response(x + static_cast<int>(toward_axis(dx)),
                                                         y + static_cast<int>(toward_axis(dy))));
  const double corner = response(x + away(dx), y + away(dy));
  return diagonal ? corner : side + share * (corner - side);
}

TEST(OrientedKernels, RidgesAreNotBelowWhatLiesAcross) {
  for (const int count : {1, 2, 15, 16, 17, 33, 200}) {
    const auto response = noise_image<float>(count + 2 * kMargin, 2 * kMargin + 1, 3, 1, 11);
    const auto direction = directions(count + 2 * kMargin, 2 * kMargin + 1, 12);
    std::vector<std::int32_t> expected;
    for (int x = 0; x < count; ++x) {
      const double at = response(x + kMargin, kMargin);
      const int own = direction(x + kMargin, kMargin);
      if (at > 3 && at >= across(response, x + kMargin, kMargin, own, 1) &&
          at > across(response, x + kMargin, kMargin, own, -1)) {
        expected.push_back(x);
      }
    }
    for_each_simd_target([&](const std::string&) {
      std::vector<std::int32_t> places(static_cast<std::size_t>(count) + 64);
      const int found = detail::find_ridges_row(response.row(kMargin) + kMargin, response.stride(),
                                                direction.row(kMargin) + kMargin, shares(), 3,
                                                count, places.data());
      places.resize(static_cast<std::size_t>(found));
      EXPECT_EQ(places, expected);
    });
  }
}

TEST(OrientedKernels, ProminenceIsOverTheLowerPairOfSides) {
  constexpr int kWidth = 120;
  constexpr int kHalf = 8;
  const auto response = noise_image<float>(kWidth, 2 * kHalf + 1, 3, 1, 13);
  const auto direction = directions(kWidth, 2 * kHalf + 1, 14);
  std::vector<std::int32_t> offsets;
  for (const int distance : {4, kHalf}) {
    for (int i = 0; i < 24; ++i) {
      const auto dx = static_cast<int>(std::lround(-distance * std::sin(i * kStep)));
      const auto dy = static_cast<int>(std::lround(distance * std::cos(i * kStep)));
      offsets.push_back(static_cast<std::int32_t>(dy * response.stride()) + dx);
    }
  }
  const float* row = response.row(kHalf);
  const std::int32_t* directions = direction.row(kHalf);
  const auto at = [&](int own, std::ptrdiff_t place) {
    const int turn = std::abs(directions[place] - directions[own]);
    return std::min(turn, 24 - turn) <= 3 ? row[place] : 0.0F;
  };
  for (const int sides : {1, 2}) {
    for (const int count : {1, 15, 16, 17, 50}) {
      std::vector<std::int32_t> places(static_cast<std::size_t>(count) + 16, kHalf);
      for (int i = 0; i < count; ++i) {
        places[static_cast<std::size_t>(i)] = kHalf + 2 * i;
      }
      for_each_simd_target([&](const std::string&) {
        std::vector<float> out(places.size());
        detail::suppressed_responses_at(row, directions, offsets.data(), sides, places.data(),
                                        count, out.data());
        for (int i = 0; i < count; ++i) {
          const int place = kHalf + 2 * i;
          float least = 1e9F;
          for (int side = 0; side < sides; ++side) {
            const int offset = offsets[static_cast<std::size_t>(24 * side + directions[place])];
            least = std::min(least, at(place, place + offset) + at(place, place - offset));
          }
          ASSERT_EQ(out[static_cast<std::size_t>(i)], row[place] - 0.5F * least);
        }
      });
    }
  }
}

}  // namespace
}  // namespace thermedge
