#include "thermedge/stages/bad_pixels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/images.hpp"

namespace thermedge {

void PrintTo(const BadPixel& pixel, std::ostream* out) {
  *out << "(" << pixel.x << ", " << pixel.y << ")";
}

namespace {

using test::for_each_simd_target;
using test::GuardedImage;
using test::noise_image;

constexpr double kSigma = 5;

Image<std::uint16_t> noise(int width, int height, unsigned seed) {
  return noise_image<std::uint16_t>(width, height, 3000, kSigma, seed);
}

std::vector<BadPixel> correct(ImageView<std::uint16_t> frame, const BadPixelOptions& options = {}) {
  std::vector<BadPixel> dead = {{99, 99}};
  replace_bad_pixels(frame, kSigma, options, dead);
  return dead;
}

// The rule of the header, written from its words: all pixels, sorted lists, no shortcuts.
std::vector<BadPixel> reference_bad_pixels(ImageView<const std::uint16_t> frame, double sigma,
                                           double sigmas) {
  std::vector<BadPixel> dead;
  const double limit = std::floor(std::max(sigma, 1.0) * sigmas);
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      std::vector<int> near, far;
      for (int j = -2; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i) {
          const int distance = std::max(std::abs(i), std::abs(j));
          if (distance > 0 && frame.contains(x + i, y + j)) {
            (distance == 1 ? near : far).push_back(frame(x + i, y + j));
          }
        }
      }
      std::sort(near.begin(), near.end());
      std::sort(far.begin(), far.end());
      const int around = (far[(far.size() - 1) / 2] + far[far.size() / 2]) / 2;
      const int high = near[near.size() - 2];
      const int low = near[1];
      const int contrast = near.size() == 8 ? 0 : far.back() - far.front();
      if (frame(x, y) - high > limit + 2 * std::max(high - around, contrast) ||
          low - frame(x, y) > limit + 2 * std::max(around - low, contrast)) {
        dead.push_back({x, y});
      }
    }
  }
  for (int y = 0; y + 1 < frame.height(); ++y) {
    for (int x = 0; x + 1 < frame.width(); ++x) {
      std::array<std::vector<int>, 3> by_distance;  // of the block, the 12 around, and those around
      for (int j = -2; j <= 3; ++j) {
        for (int i = -2; i <= 3; ++i) {
          const auto distance = static_cast<std::size_t>(std::max({-i, i - 1, -j, j - 1, 0}));
          if (frame.contains(x + i, y + j)) {
            by_distance[distance].push_back(frame(x + i, y + j));
          }
        }
      }
      for (std::vector<int>& values : by_distance) {
        std::sort(values.begin(), values.end());
      }
      const auto& [block, near, far] = by_distance;
      const int around = (far[(far.size() - 1) / 2] + far[far.size() / 2]) / 2;
      const int contrast = near.size() == 12 ? 0 : far.back() - far.front();
      if (block.front() - near.back() > limit + 8 * std::max(near.back() - around, contrast) ||
          near.front() - block.back() > limit + 8 * std::max(around - near.front(), contrast)) {
        for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
          dead.push_back({x + i, y + j});
        }
      }
    }
  }
  std::sort(dead.begin(), dead.end(), [](const BadPixel& a, const BadPixel& b) {
    return std::pair(a.y, a.x) < std::pair(b.y, b.x);
  });
  dead.erase(std::unique(dead.begin(), dead.end()), dead.end());
  return dead;
}

TEST(DeadPixelsReference, AgreesOnSmallSizesAndTargets) {
  for_each_simd_target([](const std::string&) {
    for (int width = 5; width <= 70; width += width < 40 ? 1 : 5) {
      for (const int height : {5, 6, 9}) {
        GuardedImage<std::uint16_t> frame(width, height, 60000);
        const auto seed = static_cast<unsigned>(100 * width + height);
        std::mt19937 random(seed);
        copy_pixels(ImageView<const std::uint16_t>(noise(width, height, seed)), frame.view());
        for (int i = 0; i < width * height / 20; ++i) {
          const int x = static_cast<int>(random() % static_cast<unsigned>(width));
          const int y = static_cast<int>(random() % static_cast<unsigned>(height));
          const int side = random() % 4 == 0 && x + 1 < width && y + 1 < height ? 2 : 1;
          const auto value = static_cast<std::uint16_t>(random() % 65536);
          fill_pixels(frame.view().crop(x, y, side, side), value);
        }
        const auto expected = reference_bad_pixels(frame.view(), kSigma, 6);
        EXPECT_EQ(correct(frame.view()), expected) << width << "x" << height;
        EXPECT_TRUE(frame.intact());
      }
    }
  });
}

void expect_corrected(const std::vector<BadPixel>& places, const std::vector<int>& values) {
  Image<std::uint16_t> frame = noise(40, 30, 8);
  for (std::size_t i = 0; i < places.size(); ++i) {
    frame(places[i].x, places[i].y) = static_cast<std::uint16_t>(values[i % values.size()]);
  }
  EXPECT_EQ(correct(frame), places);
  for (const BadPixel& place : places) {
    EXPECT_NEAR(frame(place.x, place.y), 3000, 3 * kSigma);
  }
}

TEST(DeadPixels, FindsSinglePixels) {
  expect_corrected({{20, 10}}, {65535});
  expect_corrected({{20, 10}}, {0});
  expect_corrected({{20, 10}}, {3000 + 70});
  expect_corrected({{3, 3}, {30, 10}, {7, 20}}, {0, 65535, 3100});
}

TEST(DeadPixels, FindsThemOnTheBorderAndInCorners) {
  expect_corrected({{0, 0}, {15, 0}, {39, 0}, {0, 15}, {39, 15}, {0, 29}, {15, 29}, {39, 29}},
                   {65535, 0});
}

TEST(DeadPixels, FindsPairsThatTouch) {
  for (const int other : {65535, 0}) {
    expect_corrected({{20, 10}, {21, 10}}, {65535, other});
    expect_corrected({{20, 10}, {20, 11}}, {65535, other});
    expect_corrected({{20, 10}, {21, 11}}, {0, other});
    expect_corrected({{21, 10}, {20, 11}}, {0, other});
    expect_corrected({{0, 0}, {1, 0}}, {0, other});
    expect_corrected({{39, 28}, {39, 29}}, {65535, other});
    expect_corrected({{0, 10}, {0, 11}}, {65535, other});
  }
}

// What resampling by half a pixel makes of a single dead pixel.
TEST(DeadPixels, FindsBlocksOfFour) {
  for (const int value : {3000 - 750, 3000 + 3300, 3000 + 200}) {
    expect_corrected({{20, 10}, {21, 10}, {20, 11}, {21, 11}}, {value});
  }
  for (const int value : {0, 65535}) {  // on the border
    expect_corrected({{0, 10}, {1, 10}, {0, 11}, {1, 11}}, {value});
    expect_corrected({{38, 28}, {39, 28}, {38, 29}, {39, 29}}, {value});
  }
}

TEST(DeadPixels, TakesTheMedianOfGoodNeighbours) {
  Image<std::uint16_t> frame(7, 7);
  fill_pixels(frame.view(), std::uint16_t{500});
  frame(3, 3) = 9000;
  frame(4, 3) = 9000;
  const std::uint16_t around[] = {491, 492, 493, 494, 506, 507, 508};
  const BadPixel places[] = {{2, 2}, {3, 2}, {4, 2}, {2, 3}, {2, 4}, {3, 4}, {4, 4}};
  for (int i = 0; i < 7; ++i) {
    frame(places[i].x, places[i].y) = around[i];
  }
  EXPECT_EQ(correct(frame).size(), 2U);
  EXPECT_EQ(frame(3, 3), 494);
}

TEST(DeadPixels, TakesNoNoiseForDeadPixels) {
  std::size_t found = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    Image<std::uint16_t> frame = noise(382, 288, seed);
    found += correct(frame).size();
  }
  EXPECT_LE(found, 1U);
}

// Points of every strength and place within the pixel, blurred by optics, are part of the scene.
TEST(DeadPixels, SparesSmallHotObjects) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int repeat = 0; repeat < 3000; ++repeat) {
    const double blur_px = repeat % 3 == 0 ? 0.75 : 0.75 + uniform(random);
    const double height = 20 * std::pow(1000, uniform(random)) * (uniform(random) < 0.5 ? -1 : 1);
    const bool is_between_four = repeat % 2 == 0;
    const double x0 = is_between_four ? 0.5 + repeat % 20 : uniform(random) * 20;
    const double y0 = is_between_four ? 0.5 + repeat / 20 % 20 : uniform(random) * 20;
    Image<std::uint16_t> frame =
        noise_image<std::uint16_t>(21, 21, 30000, kSigma, static_cast<unsigned>(repeat));
    for (int y = 0; y < 21; ++y) {
      for (int x = 0; x < 21; ++x) {
        const double squared = (x - x0) * (x - x0) + (y - y0) * (y - y0);
        const double hot = height * std::exp(-squared / (2 * blur_px * blur_px));
        frame(x, y) = static_cast<std::uint16_t>(std::lround(frame(x, y) + hot));
      }
    }
    EXPECT_TRUE(correct(frame).empty())
        << height << " counts at " << x0 << ", " << y0 << ", blur " << blur_px;
  }
}

TEST(DeadPixels, ChangesNothingElse) {
  Image<std::uint16_t> frame = noise(60, 40, 4);
  frame(10, 10) = 0;
  const Image<std::uint16_t> before = frame.clone();
  ASSERT_EQ(correct(frame).size(), 1U);
  frame(10, 10) = 0;
  EXPECT_TRUE(test::same_pixels<std::uint16_t>(frame, before));
}

TEST(DeadPixels, LeavesTinyFramesAlone) {
  for (int width = 0; width <= 6; ++width) {
    for (int height = 0; height <= 4; ++height) {
      Image<std::uint16_t> frame(width, height);
      if (!frame.empty()) {
        frame(width / 2, height / 2) = 65535;
      }
      EXPECT_TRUE(correct(frame).empty());
    }
  }
}

TEST(DeadPixels, ObeysItsOptions) {
  Image<std::uint16_t> frame(20, 20);
  fill_pixels(frame.view(), std::uint16_t{1000});
  frame(10, 10) = 1030;
  EXPECT_TRUE(correct(frame).empty()) << "6 sigma is not more than 6 sigma";
  BadPixelOptions options;
  options.threshold_sigmas = 5.9;
  EXPECT_EQ(correct(frame, options).size(), 1U);
  std::vector<BadPixel> dead;
  frame(10, 10) = 1006;
  replace_bad_pixels(frame, 0, {}, dead);  // sigma is taken as 1
  EXPECT_TRUE(dead.empty());
  frame(10, 10) = 1007;
  replace_bad_pixels(frame, 0, {}, dead);
  EXPECT_EQ(dead.size(), 1U);
}

}  // namespace
}  // namespace thermedge
