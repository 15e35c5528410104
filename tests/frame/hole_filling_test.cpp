#include "thermedge/stages/hole_filling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/drawing.hpp"
#include "support/images.hpp"

namespace thermedge {
namespace {

using test::GuardedImage;
using test::noise_image;
using test::random_map;
using test::same_pixels;

struct Grid {
  int width, height;
  std::vector<double> values, weights;
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

// Share of coarse pixel `i` that fine pixel `j` makes up.
double push_share(int i, int j, int length) {
  if (length == 1) {
    return 1;
  }
  if (length % 2 == 0) {
    return j / 2 == i ? 0.5 : 0;
  }
  return j == 2 * i ? 0.5 : std::abs(j - 2 * i) == 1 ? 0.25 : 0;
}

// Share of fine pixel `j` that comes from coarse pixel `i`; those outside stand in for themselves.
double pull_share(int i, int j, int length) {
  const int coarse = (length + 1) / 2;
  double share = 0;
  for (int k = -1; k <= coarse; ++k) {
    const double place = length % 2 == 0 ? 2 * k + 0.5 : 2.0 * k;
    if (std::clamp(k, 0, coarse - 1) == i) {
      share += std::max(0.0, 1 - std::abs(place - j) / 2);
    }
  }
  return share;
}

// Push and pull from the words of the header, in real numbers, every pixel against every other.
Grid filled(const Grid& fine) {
  if (fine.width == 1 && fine.height == 1) {
    return fine;
  }
  Grid coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
  for (int j = 0; j < coarse.height; ++j) {
    for (int i = 0; i < coarse.width; ++i) {
      double all = 0, weights = 0, values = 0;
      for (int y = 0; y < fine.height; ++y) {
        for (int x = 0; x < fine.width; ++x) {
          const double share = push_share(i, x, fine.width) * push_share(j, y, fine.height);
          all += share;
          weights += share * fine.weights[fine.at(x, y)];
          values += share * fine.weights[fine.at(x, y)] * fine.values[fine.at(x, y)];
        }
      }
      coarse.values.push_back(weights > 0 ? values / weights : 0);
      coarse.weights.push_back(weights / all);
    }
  }
  coarse = filled(coarse);
  Grid result = fine;
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      double rest = 0;
      for (int j = 0; j < coarse.height; ++j) {
        for (int i = 0; i < coarse.width; ++i) {
          rest += pull_share(i, x, fine.width) * pull_share(j, y, fine.height) *
                  coarse.values[coarse.at(i, j)];
        }
      }
      const double weight = fine.weights[fine.at(x, y)];
      result.values[fine.at(x, y)] = weight * fine.values[fine.at(x, y)] + (1 - weight) * rest;
    }
  }
  return result;
}

TEST(HoleFiller, AgreesWithPushAndPullInRealNumbers) {
  HoleFiller filler;
  for (const auto& [width, height] : {std::pair{1, 1},
                                      {1, 2},
                                      {2, 1},
                                      {1, 7},
                                      {9, 1},
                                      {2, 2},
                                      {3, 3},
                                      {4, 3},
                                      {5, 8},
                                      {12, 12},
                                      {13, 11},
                                      {17, 6},
                                      {24, 20}}) {
    for (const double holes : {0.0, 0.1, 0.6, 0.97}) {
      GuardedImage<std::uint16_t> frame(width, height, 60000);
      copy_pixels(noise_image<std::uint16_t>(width, height, 30000, 9000, 7).view(), frame.view());
      const auto bad = random_map(width, height, holes, 8);
      Image<std::uint8_t> valid(width, height);
      Grid expected{width, height, {}, {}};
      std::size_t measured = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          valid(x, y) = bad(x, y) != 0 ? 0 : 3;
          measured += valid(x, y) != 0 ? 1 : 0;
          expected.values.push_back(frame.view()(x, y));
          expected.weights.push_back(valid(x, y) != 0 ? 1 : 0);
        }
      }
      expected = filled(expected);
      filler.fill(frame.view(), valid);
      EXPECT_TRUE(frame.intact());
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const double value = measured == 0 ? 0 : expected.values[expected.at(x, y)];
          // Shares are rounded to 1/256, which weighs as much as the pixels differ.
          EXPECT_NEAR(frame.view()(x, y), value, valid(x, y) != 0 ? 0 : 400)
              << width << "x" << height << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(HoleFiller, FillsWithZeroWhereNothingWasMeasured) {
  for (const auto& [width, height] : {std::pair{1, 1}, {5, 1}, {6, 4}, {31, 17}}) {
    auto frame = noise_image<std::uint16_t>(width, height, 3000, 10, 1);
    Image<std::uint8_t> valid(width, height);
    fill_pixels(valid.view(), std::uint8_t{0});
    HoleFiller().fill(frame, valid);
    Image<std::uint16_t> zero(width, height);
    fill_pixels(zero.view(), std::uint16_t{0});
    EXPECT_TRUE(same_pixels<std::uint16_t>(frame, zero));
  }
}

TEST(HoleFiller, KeepsAConstantAndAPlaneInSmallHoles) {
  Image<std::uint16_t> frame(64, 48);
  Image<std::uint8_t> valid(64, 48);
  fill_pixels(valid.view(), std::uint8_t{1});
  fill_pixels(frame.view(), std::uint16_t{65535});
  fill_pixels(valid.view().crop(0, 0, 30, 20), std::uint8_t{0});
  fill_pixels(frame.view().crop(0, 0, 30, 20), std::uint16_t{0});
  HoleFiller filler;
  filler.fill(frame, valid);
  EXPECT_EQ(*std::min_element(frame.row(0), frame.row(0) + 64), 65535);
  fill_pixels(valid.view(), std::uint8_t{1});
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(3000 + 10 * x + 6 * y);
    }
  }
  for (const int x : {20, 21, 40, 41}) {
    valid(x, 30) = 0;
    frame(x, 30) = 0;
  }
  filler.fill(frame, valid);
  for (const int x : {20, 21, 40, 41}) {
    EXPECT_NEAR(frame(x, 30), 3000 + 10 * x + 6 * 30, 20);
  }
}

// Width and height of every kind, so that each level halves odd and even lengths.
TEST(HoleFiller, FillsMirroredAndTransposedFramesAlike) {
  for (const auto& [width, height] : {std::pair{38, 29}, {37, 24}, {48, 64}, {45, 31}}) {
    const auto frame = noise_image<std::uint16_t>(width, height, 3000, 300, 3);
    const auto bad = random_map(width, height, 0.7, 4);
    const auto fill = [&, width = width, height = height](bool mirror, bool transpose) {
      Image<std::uint16_t> counts(transpose ? height : width, transpose ? width : height);
      Image<std::uint8_t> valid(counts.width(), counts.height());
      const auto place = [&](int x, int y) {
        const int u = mirror ? width - 1 - x : x;
        return transpose ? std::pair{y, u} : std::pair{u, y};
      };
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const auto [u, v] = place(x, y);
          counts(u, v) = frame(x, y);
          valid(u, v) = bad(x, y) != 0 ? 0 : 1;
        }
      }
      HoleFiller().fill(counts, valid);
      Image<std::uint16_t> back(width, height);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const auto [u, v] = place(x, y);
          back(x, y) = counts(u, v);
        }
      }
      return back;
    };
    const auto expected = fill(false, false);
    EXPECT_TRUE(same_pixels<std::uint16_t>(fill(true, false), expected));
    EXPECT_TRUE(same_pixels<std::uint16_t>(fill(false, true), expected));
    EXPECT_TRUE(same_pixels<std::uint16_t>(fill(true, true), expected));
  }
}

// The filling beside measured pixels is not a streak of one noisy pixel.
TEST(HoleFiller, AveragesNoise) {
  auto frame = noise_image<std::uint16_t>(120, 90, 3000, 50, 5);
  Image<std::uint8_t> valid(120, 90);
  fill_pixels(valid.view(), std::uint8_t{1});
  fill_pixels(valid.view().crop(0, 0, 40, 90), std::uint8_t{0});
  HoleFiller().fill(frame, valid);
  double squares = 0;
  for (int y = 0; y < 90; ++y) {
    squares += (frame(36, y) - 3000.0) * (frame(36, y) - 3000.0);
  }
  EXPECT_LT(std::sqrt(squares / 90), 20);
}

}  // namespace
}  // namespace thermedge
