#include "thermedge/stages/validity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "support/images.hpp"
#include "support/strided_image.hpp"

namespace thermedge {
namespace {

using test::noise_image;
using test::same_pixels;
using test::StridedImage;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

struct Found {
  Image<std::uint8_t> valid;
  Image<std::uint16_t> counts;
  InvalidPixels invalid;

  [[nodiscard]] int holes() const {
    int number = 0;
    for (int y = 0; y < valid.height(); ++y) {
      number +=
          static_cast<int>(std::count(valid.row(y), valid.row(y) + valid.width(), std::uint8_t{0}));
    }
    return number;
  }
};

Found find(ImageView<const std::uint16_t> frame) {
  Found found{Image<std::uint8_t>(frame.width(), frame.height()),
              Image<std::uint16_t>(frame.width(), frame.height()),
              {}};
  copy_pixels(frame, found.counts.view());
  fill_pixels(found.valid.view(), std::uint8_t{1});
  InvalidFinder().run(found.counts, found.valid, found.invalid);
  return found;
}

// Noise with a slanted step through it.
Image<std::uint16_t> scene(unsigned seed, double sigma = 8) {
  auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 3000, sigma, seed);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(frame(x, y) + (2 * x + y > 200 ? 100 : 0));
    }
  }
  return frame;
}

template <class F>
void for_each_pixel(Image<std::uint16_t>& frame, F&& change) {
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      change(x, y, frame(x, y));
    }
  }
}

// The holes are the pixels of `is_invalid`, and all pixels within `reach` of one.
void expect_holes(const Found& found, int reach, const std::function<bool(int, int)>& is_invalid,
                  const std::string& what) {
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      bool expected = false;
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, kHeight - 1); ++v) {
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, kWidth - 1); ++u) {
          expected = expected || is_invalid(u, v);
        }
      }
      ASSERT_EQ(found.valid(x, y) == 0, expected) << what << " at " << x << ", " << y;
    }
  }
}

TEST(InvalidFinder, FindsNothingInNoiseOfAnyStrength) {
  for (const double sigma : {0.0, 0.2, 0.5, 1.0, 3.0, 8.0, 60.0, 900.0}) {
    const Found found = find(scene(1, sigma));
    EXPECT_EQ(found.holes(), 0) << sigma;
    EXPECT_EQ(found.invalid.dead_rows + found.invalid.dead_columns, 0) << sigma;
  }
}

TEST(InvalidFinder, FindsNothingInClippedNoise) {
  for (const double share_sigmas : {-2.0, -0.67, 0.0, 0.67, 1.5}) {
    for (const bool at_top : {false, true}) {
      auto frame = scene(2);
      const auto limit = static_cast<std::uint16_t>(3000 + 8 * share_sigmas);
      for_each_pixel(frame, [&](int, int, std::uint16_t& count) {
        count = at_top ? std::min(count, limit) : std::max(count, limit);
      });
      EXPECT_EQ(find(frame).holes(), 0) << share_sigmas << at_top;
    }
  }
}

TEST(InvalidFinder, FindsBlackCorners) {
  const auto is_corner = [](int x, int y) {
    return x + 2 * y < 40 || (kWidth - 1 - x) + y < 12 || x + 3 * (kHeight - 1 - y) < 50;
  };
  for (const int floor : {0, 700}) {
    auto frame = scene(3);
    for_each_pixel(frame, [&](int x, int y, std::uint16_t& count) {
      count = is_corner(x, y) ? static_cast<std::uint16_t>(floor) : count;
    });
    expect_holes(find(frame), 1, is_corner, "corner");
  }
}

TEST(InvalidFinder, LeavesSmallCornersAndThingsAlone) {
  auto frame = scene(4);
  for_each_pixel(frame, [&](int x, int y, std::uint16_t& count) {
    const bool is_corner = x + y < 10;                   // 55 px
    const bool is_thing = std::hypot(x - 85, y) < 30.5;  // less than half of the side
    if (is_corner || is_thing) {
      count = 0;
    }
  });
  EXPECT_EQ(find(frame).holes(), 0);
}

// A skyline goes up and down; a corner that undistortion leaves does not.
TEST(InvalidFinder, LeavesAreasWithARoughOutlineAlone) {
  auto frame = scene(5);
  for_each_pixel(frame, [&](int x, int y, std::uint16_t& count) {
    if (y < 30 + 12 * (x / 10 % 2)) {
      count = 0;
    }
  });
  EXPECT_EQ(find(frame).holes(), 0);
}

// Hot things, round, within the picture and cut off by its border: their outline is an edge.
TEST(InvalidFinder, KeepsSaturatedThings) {
  auto frame = scene(6);
  const auto add = [&](double x0, double y0, double radius) {
    for_each_pixel(frame, [&](int x, int y, std::uint16_t& count) {
      const double inside = radius - std::hypot(x - x0, y - y0);
      const double share = 0.5 * std::erfc(-inside / (0.8 * std::sqrt(2.0)));
      count = static_cast<std::uint16_t>(std::min(count + 40000 * share, 16383.0));
    });
  };
  add(60, 60, 25);
  add(159, 20, 30);
  EXPECT_EQ(find(frame).holes(), 0);
}

TEST(InvalidFinder, FindsBarsAndTelemetryOnEverySide) {
  for (int thick = 1; thick <= 20; thick += thick < 4 ? 1 : 8) {
    for (int side = 0; side < 4; ++side) {
      const auto is_bar = [&](int x, int y) {
        const int distance[] = {y, kHeight - 1 - y, x, kWidth - 1 - x};
        return distance[side] < thick;
      };
      for (const int bar : {0, 3900, 65535}) {
        const auto value = static_cast<std::uint16_t>(bar);
        auto frame = scene(7);
        for_each_pixel(frame, [&](int x, int y, std::uint16_t& count) {
          count = is_bar(x, y) ? value : count;
        });
        const std::string what = std::to_string(thick) + " lines of " + std::to_string(value) +
                                 " at side " + std::to_string(side);
        expect_holes(find(frame), 1, is_bar, what);
      }
      if (thick > 4) {
        continue;
      }
      auto frame = scene(8);
      unsigned state = 1;
      for_each_pixel(frame, [&](int x, int y, std::uint16_t& count) {
        state = 1664525 * state + 1013904223;
        const unsigned code = state >> 28 == 0 ? state >> 8 & 0xFFFF : state >> 28 & 1;
        count = is_bar(x, y) ? static_cast<std::uint16_t>(code) : count;
      });
      expect_holes(find(frame), 0, is_bar, "telemetry at side " + std::to_string(side));
    }
  }
}

TEST(InvalidFinder, TakesNoStepOfTheSceneNearTheBorderForTelemetry) {
  for (double place = 0; place < 5; place += 0.25) {
    auto frame = scene(9);
    for_each_pixel(frame, [&](int, int y, std::uint16_t& count) {
      const double share = 0.5 * std::erfc((y - place) / (0.7 * std::sqrt(2.0)));
      count = static_cast<std::uint16_t>(count + 3000 * share);
    });
    const Found found = find(frame);
    EXPECT_EQ(found.holes(), 0) << place;
    EXPECT_EQ(found.invalid.dead_rows, 0) << place;
  }
}

TEST(InvalidFinder, ReplacesDeadLinesWhereverTheyAre) {
  const auto clean = scene(10);
  for (const bool is_column : {false, true}) {
    const int lines = is_column ? kWidth : kHeight;
    for (int line = 0; line < lines; line += line < 8 || line >= lines - 9 ? 1 : 13) {
      for (const int value : {0, 3050, 16383, -900, 500}) {  // the last two: off by that much
        auto frame = clean.clone();
        for_each_pixel(frame, [&](int x, int y, std::uint16_t& count) {
          if ((is_column ? x : y) == line) {
            const int off = value == -900 || value == 500 ? count + value : value;
            count = static_cast<std::uint16_t>(off);
          }
        });
        const Found found = find(frame);
        const std::string what = std::string(is_column ? "column " : "row ") +
                                 std::to_string(line) + " of " + std::to_string(value);
        for (int y = 0; y < kHeight; ++y) {
          for (int x = 0; x < kWidth; ++x) {
            const int distance = std::min(is_column ? x : y, lines - 1 - (is_column ? x : y));
            if (found.valid(x, y) != 0) {
              ASSERT_NEAR(found.counts(x, y), clean(x, y), 160) << what;
            } else {
              ASSERT_LE(distance, 2) << what;  // at the border: holes
            }
          }
        }
        const int inside = std::min(line, lines - 1 - line);
        EXPECT_EQ(found.invalid.dead_rows + found.invalid.dead_columns > 0 || found.holes() > 0,
                  true)
            << what;
        EXPECT_EQ(found.holes() == 0, inside > 0) << what;
      }
    }
  }
}

TEST(InvalidFinder, ReplacesTheDeadPartOfALine) {
  auto frame = scene(11);
  const auto clean = frame.clone();
  fill_pixels(frame.view().crop(0, 50, 100, 2), std::uint16_t{0});
  const Found found = find(frame);
  EXPECT_EQ(found.holes(), 0);
  EXPECT_EQ(found.invalid.dead_rows, 2);
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_NEAR(found.counts(x, 50), clean(x, 50), x < 100 ? 150 : 0);
    EXPECT_NEAR(found.counts(x, 51), clean(x, 51), x < 100 ? 150 : 0);
  }
}

TEST(InvalidFinder, FindsDeadBlocks) {
  const std::pair<int, int> sizes[] = {{4, 4}, {5, 9}, {16, 7}};
  for (const auto& [width, height] : sizes) {
    for (const int dead : {0, 3050, 16383}) {
      for (int shift = 0; shift < 4; ++shift) {
        const auto value = static_cast<std::uint16_t>(dead);
        auto frame = scene(12);
        frame(1, 60) = 16383;  // so that 3050 is neither the smallest nor the largest
        frame(140, 3) = 0;
        const int left = 30 + shift;
        const int top = 41 + 2 * shift;
        fill_pixels(frame.view().crop(left, top, width, height), value);
        expect_holes(
            find(frame), 0,
            [&, width = width, height = height](int x, int y) {
              return x >= left && x < left + width && y >= top && y < top + height;
            },
            "block of " + std::to_string(value));
      }
    }
  }
}

TEST(InvalidFinder, LooksForNothingInDrawnPictures) {
  Image<std::uint16_t> frame(kWidth, kHeight);
  fill_pixels(frame.view(), std::uint16_t{0});
  fill_pixels(frame.view().crop(30, 20, 90, 80), std::uint16_t{200});
  fill_pixels(frame.view().crop(50, 40, 12, 30), std::uint16_t{90});
  const Found found = find(frame);
  EXPECT_EQ(found.holes(), 0);
  EXPECT_TRUE(same_pixels<std::uint16_t>(found.counts, frame));
}

TEST(InvalidFinder, LeavesSmallFramesAlone) {
  for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {15, 40}, {40, 15}, {16, 16}}) {
    Image<std::uint16_t> frame(width, height);
    fill_pixels(frame.view(), std::uint16_t{0});
    EXPECT_EQ(find(frame).holes(), 0);
  }
}

// With everything there is, in a frame with any stride.
TEST(InvalidFinder, TreatsMirroredAndTransposedFramesAlike) {
  auto frame = scene(13);
  for_each_pixel(frame, [&](int x, int y, std::uint16_t& count) {
    if (x + 2 * y < 40) {
      count = 0;
    }
  });
  fill_pixels(frame.view().crop(0, 50, 100, 1), std::uint16_t{0});
  fill_pixels(frame.view().crop(80, 0, 2, kHeight), std::uint16_t{16383});
  fill_pixels(frame.view().crop(120, 70, 6, 6), std::uint16_t{0});
  fill_pixels(frame.view().crop(0, kHeight - 2, kWidth, 2), std::uint16_t{7});
  const Found expected = find(frame);
  EXPECT_GT(expected.holes(), 0);
  EXPECT_EQ(expected.invalid.dead_rows, 1);
  EXPECT_EQ(expected.invalid.dead_columns, 2);
  for (const bool mirror : {false, true}) {
    for (const bool transpose : {false, true}) {
      const int width = transpose ? kHeight : kWidth;
      const int height = transpose ? kWidth : kHeight;
      const auto place = [&](int x, int y) {
        const int u = mirror ? kWidth - 1 - x : x;
        return transpose ? std::pair{y, u} : std::pair{u, y};
      };
      StridedImage<std::uint16_t> counts(width, height);
      StridedImage<std::uint8_t> valid(width, height);
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          const auto [u, v] = place(x, y);
          counts.view()(u, v) = frame(x, y);
          valid.view()(u, v) = 1;
        }
      }
      InvalidPixels invalid;
      InvalidFinder().run(counts.view(), valid.view(), invalid);
      EXPECT_TRUE(counts.intact());
      EXPECT_TRUE(valid.intact());
      EXPECT_EQ(transpose ? invalid.dead_columns : invalid.dead_rows, 1);
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          const auto [u, v] = place(x, y);
          ASSERT_EQ(valid.view()(u, v), expected.valid(x, y)) << x << ", " << y;
          ASSERT_EQ(counts.view()(u, v), expected.counts(x, y)) << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace thermedge
