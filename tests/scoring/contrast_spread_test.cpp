// The spread of contrasts along curves, on noise whose spread is known.
#include "contrast_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/images.hpp"

namespace thermedge {
namespace {

using test::noise_image;

constexpr int kWidth = 382;
constexpr int kHeight = 288;

NoiseModel noise_of(double level) {
  NoiseModel noise;
  noise.level_counts = level;
  return noise;
}

// A straight curve of so many edgels; all normals alike.
Edgels curve(std::size_t count, double nx, double ny) {
  Edgels edgels;
  edgels.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    edgels.x[i] = edgels.y[i] = 100;
    edgels.nx[i] = static_cast<float>(nx);
    edgels.ny[i] = static_cast<float>(ny);
  }
  return edgels;
}

class Spread {
 public:
  Spread(ImageView<const std::uint16_t> frame, const NoiseModel& noise,
         ImageView<const std::uint8_t> busy = {})
      : spread_(SignificanceTuning{}.spread, SignificanceTuning{}.slopes,
                SignificanceTuning{}.contrast) {
    Image<std::uint8_t> none(frame.width(), frame.height());
    fill_pixels(none.view(), std::uint8_t{0});
    spread_.prepare(frame.width(), frame.height());
    spread_.measure(frame, busy.empty() ? none.view() : busy, noise, *make_runner(1));
  }

  // Variance of the mean contrast times the number of edgels.
  [[nodiscard]] double of_edgels(std::size_t count, double normal_deg,
                                 const NoiseLevelMap& map = {}) const {
    const double angle = normal_deg * std::numbers::pi / 180;
    const Edgels edgels = curve(count, std::cos(angle), std::sin(angle));
    return static_cast<double>(count) *
           spread_.variance(edgels, {0, static_cast<std::uint32_t>(count)}, map);
  }

 private:
  detail::ContrastSpread spread_;
};

const std::vector<std::size_t> kLengths = {8, 16, 32, 64, 128};
constexpr double kAlongColumns = 0;  // degrees of the normal
constexpr double kAlongRows = 90;

// Along an axis the contrast from 1.5 to 4.5 px less the slope from 4 to 16 px is a weighted sum of
// the differences of pixels that are so far away on either side.
constexpr double kWhite = 2 * (1 / 64.0 + 1 / 16.0 + 1 / 16.0 + 1 / 4.0 + 1 / 64.0 + 1 / 16.0);

TEST(ContrastSpread, OfWhiteNoiseIsTheSameForEveryLengthAndCourse) {
  for (const double normal : {kAlongColumns, kAlongRows, 30.0, 60.0, 120.0, 150.0}) {
    for (const std::size_t length : kLengths) {
      double mean = 0;
      for (const unsigned seed : {0U, 1U, 2U}) {
        const double sigma = 2 * std::pow(5, seed);
        const auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 8000, sigma, 20 + seed);
        mean += Spread(frame, noise_of(sigma)).of_edgels(length, normal) / 3;
      }
      EXPECT_NEAR(mean, kWhite, 0.1) << length << " edgels, normal at " << normal << " degrees";
    }
  }
}

TEST(ContrastSpread, DoesNotSeeWhatIsTheSameAcross) {
  auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 8, 6);
  const Spread before(frame, noise_of(8));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(frame(x, y) + 5 * y);
    }
  }
  const Spread after(frame, noise_of(8));
  for (const std::size_t length : kLengths) {
    EXPECT_NEAR(after.of_edgels(length, kAlongColumns), before.of_edgels(length, kAlongColumns),
                1e-9);
    // A slope that goes on is no contrast either.
    EXPECT_NEAR(after.of_edgels(length, kAlongRows), before.of_edgels(length, kAlongRows), 1e-6);
  }
}

// Offsets of columns as strong as a half of the noise: along them the contrast is the same for any
// number of edgels, so its variance times that number doubles with it.
TEST(ContrastSpread, GrowsWithTheLengthWhereNoiseGoesOnAlongACurve) {
  auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 8, 7);
  const auto offsets = noise_image<std::uint16_t>(kWidth, 1, 100, 4, 8);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(frame(x, y) + offsets(x, 0));
    }
  }
  const Spread spread(frame, noise_of(8));
  for (std::size_t i = 1; i < kLengths.size(); ++i) {
    const double before = spread.of_edgels(kLengths[i - 1], kAlongColumns);
    const double after = spread.of_edgels(kLengths[i], kAlongColumns);
    EXPECT_GT(after, 1.2 * before) << kLengths[i];
    EXPECT_LE(after, 2 * before * (1 + 1e-9)) << kLengths[i];
    EXPECT_NEAR(spread.of_edgels(kLengths[i], kAlongRows), kWhite, 0.25);
  }
  EXPECT_GT(spread.of_edgels(128, kAlongColumns), 8 * kWhite);
}

TEST(ContrastSpread, LiesBetweenThoseOfTheLengthsAround) {
  auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 8, 7);
  for (int y = 1; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = static_cast<std::uint16_t>((frame(x, y) + 7 * frame(x, y - 1)) / 8);
    }
  }
  const Spread spread(frame, noise_of(3));
  const double at_16 = spread.of_edgels(16, kAlongColumns);
  const double at_32 = spread.of_edgels(32, kAlongColumns);
  ASSERT_GT(at_32, 1.1 * at_16);
  EXPECT_NEAR(spread.of_edgels(24, kAlongColumns), at_16 + std::log2(1.5) * (at_32 - at_16), 1e-9);
  EXPECT_NEAR(spread.of_edgels(3, kAlongColumns), spread.of_edgels(8, kAlongColumns), 1e-9);
  EXPECT_NEAR(spread.of_edgels(500, kAlongColumns), spread.of_edgels(128, kAlongColumns), 1e-9);
}

// The edgels of each orientation are a curve of their own.
TEST(ContrastSpread, OfABentCurveIsTheMeanOfItsParts) {
  auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 8, 7);
  for (int y = 1; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = static_cast<std::uint16_t>((frame(x, y) + 7 * frame(x, y - 1)) / 8);
    }
  }
  Image<std::uint8_t> busy(kWidth, kHeight);
  fill_pixels(busy.view(), std::uint8_t{0});
  const NoiseModel noise = noise_of(3);
  const SignificanceTuning tuning;
  detail::ContrastSpread spread(tuning.spread, tuning.slopes, tuning.contrast);
  spread.prepare(kWidth, kHeight);
  spread.measure(frame, busy, noise, *make_runner(1));
  Edgels bent = curve(80, 1, 0);
  for (std::size_t i = 0; i < 16; ++i) {
    bent.nx[i] = 0;
    bent.ny[i] = i % 2 == 0 ? 1.0F : -1.0F;  // which way they point makes no difference
  }
  const Spread parts(frame, noise);
  const double expected =
      (16 * parts.of_edgels(16, kAlongRows) + 64 * parts.of_edgels(64, kAlongColumns)) / (80 * 80);
  EXPECT_NEAR(spread.variance(bent, {0, 80}, {}), expected, 1e-12);
}

TEST(ContrastSpread, LeavesOutBusyPixels) {
  auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 8, 9);
  const auto loud = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 80, 10);
  Image<std::uint8_t> busy(kWidth, kHeight);
  fill_pixels(busy.view(), std::uint8_t{0});
  // Lines look 17 px to both sides.
  copy_pixels(loud.view().crop(0, 0, 200, kHeight), frame.view().crop(0, 0, 200, kHeight));
  fill_pixels(busy.view().crop(0, 0, 220, kHeight), std::uint8_t{1});
  EXPECT_NEAR(Spread(frame, noise_of(8), busy).of_edgels(16, kAlongRows), kWhite, 0.25);
  EXPECT_GT(Spread(frame, noise_of(8)).of_edgels(16, kAlongRows), 3);
}

TEST(ContrastSpread, OfTooFewSamplesIsThatOfWhiteNoise) {
  const auto frame = noise_image<std::uint16_t>(40, 40, 8000, 80, 11);
  const Spread spread(frame, noise_of(8));
  for (const std::size_t length : kLengths) {
    EXPECT_NEAR(spread.of_edgels(length, kAlongRows), kWhite, 0.01);
  }
}

TEST(ContrastSpread, IsInUnitsOfTheNoiseAtEachPlace) {
  Image<float> nodes(2, 2);
  nodes(0, 0) = nodes(0, 1) = 0.5F;
  nodes(1, 0) = nodes(1, 1) = 2;
  NoiseModel noise = noise_of(8);
  noise.map.set_nodes(nodes, kWidth, kHeight);
  auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 8, 12);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) =
          static_cast<std::uint16_t>(std::lround(8000 + noise.map.at(x, y) * (frame(x, y) - 8000)));
    }
  }
  const Spread spread(frame, noise);
  for (const double normal : {kAlongColumns, kAlongRows, 30.0}) {
    EXPECT_NEAR(spread.of_edgels(16, normal), kWhite, 0.25);
  }
  // All edgels of curve() lie at (100, 100).
  const double level = noise.map.at(100, 100);
  EXPECT_NEAR(spread.of_edgels(16, 0, noise.map), level * level * spread.of_edgels(16, 0), 1e-9);
}

// Sides are even, so that lines lie alike from both ends.
TEST(ContrastSpread, OfAMirroredOrTransposedFrameIsTheSame) {
  const auto frame = noise_image<std::uint16_t>(256, 256, 8000, 8, 13);
  Image<std::uint16_t> mirrored(256, 256);
  Image<std::uint16_t> transposed(256, 256);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      mirrored(255 - x, y) = frame(x, y);
      transposed(y, x) = frame(x, y);
    }
  }
  const Spread spread(frame, noise_of(8));
  const Spread of_mirrored(mirrored, noise_of(8));
  const Spread of_transposed(transposed, noise_of(8));
  for (const std::size_t length : kLengths) {
    for (const double normal : {kAlongColumns, kAlongRows, 30.0}) {
      EXPECT_NEAR(of_mirrored.of_edgels(length, normal), spread.of_edgels(length, normal), 0.02);
      EXPECT_NEAR(of_transposed.of_edgels(length, 90 - normal), spread.of_edgels(length, normal),
                  0.02);
    }
  }
}

}  // namespace
}  // namespace thermedge
