// Kernels of the oriented edges against plain versions.
#include "oriented_filter_simd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/images.hpp"
#include "support/sentinel_row.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;
using test::SentinelRow;

const std::vector<int> kCounts = {1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 32, 33, 70, 200};
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

// Of equal neighbours the pixel ahead of an edge is none; whole numbers are often equal.
TEST(OrientedKernels, RidgesOfEqualStrengthAreOnePixelWide) {
  constexpr int kCount = 400;
  Image<float> response(kCount + 2 * kMargin, 2 * kMargin + 1);
  const auto levels = noise_image<std::uint8_t>(response.width(), response.height(), 2, 0.8, 15);
  copy_pixels(levels.view(), response.view());
  const auto direction = directions(response.width(), response.height(), 16);
  std::vector<std::int32_t> expected;
  int ties = 0;
  for (int x = 0; x < kCount; ++x) {
    const int own = direction(x + kMargin, kMargin);
    if (own % 6 != 0 && own % 6 != 3) {
      continue;  // between pixels the share decides, and nothing is equal
    }
    const double at = response(x + kMargin, kMargin);
    const double ahead = across(response, x + kMargin, kMargin, own, 1);
    const double behind = across(response, x + kMargin, kMargin, own, -1);
    ties += at == ahead || at == behind ? 1 : 0;
    if (at > 1 && at >= ahead && at > behind) {
      expected.push_back(x);
    }
  }
  ASSERT_GT(ties, 20);
  for_each_simd_target([&](const std::string&) {
    std::vector<std::int32_t> places(kCount + 64);
    const int found = detail::find_ridges_row(response.row(kMargin) + kMargin, response.stride(),
                                              direction.row(kMargin) + kMargin, shares(), 1, kCount,
                                              places.data());
    places.resize(static_cast<std::size_t>(found));
    std::erase_if(places, [&](std::int32_t x) { return direction(x + kMargin, kMargin) % 3 != 0; });
    EXPECT_EQ(places, expected);
  });
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

// The same additions in the same order, so the same bits.
TEST(OrientedKernels, OddFiltersAreWeightedSumsOfDifferences) {
  const float weights[] = {0, 0.9F, 0.41F, 0.13F, 0.027F, 0.004F};
  const auto in = noise_image<float>(200 + 2 * kMargin, 2 * kMargin + 1, 3000, 40, 21);
  const float* centre = in.row(kMargin) + kMargin;
  for (const int count : kCounts) {
    for (const int radius : {0, 1, 2, 5}) {
      for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, in.stride()}) {
        for_each_simd_target([&](const std::string&) {
          SentinelRow<float> out(count, detail::kFilterSlack);
          detail::odd_filter_row(centre, step, weights, radius, count, out.data());
          for (int x = 0; x < count; ++x) {
            float sum = 0;
            for (int k = 1; k <= radius; ++k) {
              sum += weights[k] * (centre[x + k * step] - centre[x - k * step]);
            }
            ASSERT_EQ(out[x], sum) << x << " of " << count;
          }
          ASSERT_TRUE(out.intact());
        });
      }
    }
  }
}

TEST(OrientedKernels, MagnitudesAndProjections) {
  const auto gradients = noise_image<float>(200, 2, 0, 9, 22);
  const float* gx = gradients.row(0);
  const float* gy = gradients.row(1);
  for (const int count : kCounts) {
    for_each_simd_target([&](const std::string&) {
      SentinelRow<float> magnitude(count, detail::kFilterSlack);
      SentinelRow<float> projected(count, detail::kFilterSlack);
      detail::magnitude_row(gx, gy, count, magnitude.data());
      detail::project_row(gx, gy, -0.3F, 0.7F, count, projected.data());
      for (int x = 0; x < count; ++x) {
        const float squares = gx[x] * gx[x] + gy[x] * gy[x];
        ASSERT_EQ(magnitude[x], std::sqrt(squares)) << x << " of " << count;
        ASSERT_EQ(projected[x], -0.3F * gx[x] + 0.7F * gy[x]) << x << " of " << count;
      }
      ASSERT_TRUE(magnitude.intact() && projected.intact());
    });
  }
}

// Line after line over the same row, as the filter does it. Whole numbers make sums that are equal:
// the first direction of equal ones stays.
TEST(OrientedKernels, TheStrongestLineIsKept) {
  constexpr int kLines = 12;
  const float weights[] = {1, 0.75F, 0.5F, 0.25F};
  Image<float> in(200 + 2 * kMargin, 2 * kMargin + 1);
  const auto levels = noise_image<std::int32_t>(in.width(), in.height(), 100, 1.5, 23);
  for (int y = 0; y < in.height(); ++y) {
    std::transform(levels.row(y), levels.row(y) + in.width(), in.row(y),
                   [](std::int32_t v) { return static_cast<float>(v - 100); });
  }
  const float* centre = in.row(kMargin) + kMargin;
  const auto offset = [&](int line, int k) {
    return static_cast<std::ptrdiff_t>(std::lround(k * std::sin(line * kStep))) * in.stride() +
           std::lround(k * std::cos(line * kStep));
  };
  int ties = 0;
  for (const int count : kCounts) {
    for (const int radius : {0, 3}) {
      for_each_simd_target([&](const std::string&) {
        SentinelRow<float> response(count, detail::kFilterSlack);
        SentinelRow<std::int32_t> direction(count, detail::kFilterSlack);
        std::vector<float> largest(static_cast<std::size_t>(count), -1);
        std::vector<std::int32_t> whose(largest.size());
        for (int line = 0; line < kLines; ++line) {
          const std::ptrdiff_t offsets[] = {0, offset(line, 1), offset(line, 2), offset(line, 3)};
          detail::keep_stronger_row(centre, offsets, weights, radius, line, kLines, count,
                                    response.data(), direction.data());
          for (int x = 0; x < count; ++x) {
            float sum = weights[0] * centre[x];
            for (int k = 1; k <= radius; ++k) {
              sum += weights[k] * (centre[x + offsets[k]] + centre[x - offsets[k]]);
            }
            float& before = largest[static_cast<std::size_t>(x)];
            ties += std::abs(sum) == before ? 1 : 0;
            if (std::abs(sum) > before) {
              before = std::abs(sum);
              whose[static_cast<std::size_t>(x)] = sum < 0 ? line + kLines : line;
            }
          }
        }
        for (int x = 0; x < count; ++x) {
          ASSERT_EQ(response[x], largest[static_cast<std::size_t>(x)]) << x << " of " << count;
          ASSERT_EQ(direction[x], whose[static_cast<std::size_t>(x)]) << x << " of " << count;
        }
        ASSERT_TRUE(response.intact() && direction.intact());
      });
    }
  }
  EXPECT_GT(ties, 100);
}

}  // namespace
}  // namespace thermedge
