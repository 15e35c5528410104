#include "thermedge/stages/noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/images.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;
using test::shared_directory;

constexpr int kWidth = 382;
constexpr int kHeight = 288;

struct Scene {
  double sigma = 5;
  double contrast_sigmas = 20;     // of the edges
  double edge_share = 0;           // of the pixels nearer than 2 px to an edge
  double column_sigma_sigmas = 0;  // stripes in units of sigma
  double row_sigma_sigmas = 0;
  unsigned seed = 1;
};

// Discs with blurred outlines (1 px), added one after the other until they cover the share wanted.
Image<double> discs(const Scene& scene, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Image<double> counts(kWidth, kHeight);
  fill_pixels(counts.view(), 20000.0);
  Image<std::uint8_t> near_edge(kWidth, kHeight);
  fill_pixels(near_edge.view(), std::uint8_t{0});
  int covered = 0;
  while (covered < scene.edge_share * kWidth * kHeight) {
    const double x0 = uniform(random) * kWidth;
    const double y0 = uniform(random) * kHeight;
    const double radius = 5 + 40 * uniform(random);
    const double step = (uniform(random) < 0.5 ? -1 : 1) * scene.contrast_sigmas * scene.sigma;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double inside = radius - std::hypot(x - x0, y - y0);
        if (inside > -6) {
          counts(x, y) += step / 2 * std::erfc(-inside / std::numbers::sqrt2);
        }
        if (std::abs(inside) < 2 && near_edge(x, y) == 0) {
          near_edge(x, y) = 1;
          ++covered;
        }
      }
    }
  }
  return counts;
}

Image<std::uint16_t> render(const Scene& scene) {
  std::mt19937 random(scene.seed);
  std::normal_distribution<double> normal(0, scene.sigma);
  const Image<double> clean = discs(scene, random);
  std::vector<double> columns(kWidth), rows(kHeight);
  std::generate(columns.begin(), columns.end(),
                [&] { return normal(random) * scene.column_sigma_sigmas; });
  std::generate(rows.begin(), rows.end(), [&] { return normal(random) * scene.row_sigma_sigmas; });
  Image<std::uint16_t> frame(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double stripes =
          columns[static_cast<std::size_t>(x)] + rows[static_cast<std::size_t>(y)];
      frame(x, y) = static_cast<std::uint16_t>(std::lround(clean(x, y) + stripes + normal(random)));
    }
  }
  return frame;
}

TEST(Noise, TuningSaysHowSmallAFrameMayBe) {
  const auto frame = noise_image<std::uint16_t>(40, 30, 3000, 6, 1);
  EXPECT_GT(NoiseEstimator().measure(frame).sigma_counts, 3);
  EXPECT_EQ(NoiseEstimator({.smallest_side_px = 31}).measure(frame).sigma_counts, 0);
}

TEST(Noise, IsMeasuredOnPureNoise) {
  NoiseEstimator estimator;
  double sum = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 3000, 6, seed);
    const double ratio = estimator.measure(frame).sigma_counts / 6;
    EXPECT_NEAR(ratio, 1, 0.025);
    sum += ratio;
  }
  EXPECT_NEAR(sum / 20, 1, 0.006);
  for (const double sigma : {1.0, 2.0, 20.0, 100.0, 1000.0}) {
    const auto frame = noise_image<std::uint16_t>(kWidth, kHeight, 20000, sigma, 3);
    EXPECT_NEAR(estimator.measure(frame).sigma_counts / sigma, 1, 0.02) << sigma;
  }
  const auto faint = noise_image<std::uint16_t>(kWidth, kHeight, 3000, 0.5, 3);
  EXPECT_NEAR(estimator.measure(faint).sigma_counts, 0.5, 0.1);
}

TEST(Noise, IsNotDisturbedByEdgesAndStripes) {
  NoiseEstimator estimator;
  for (const double sigma : {2.0, 10.0, 100.0}) {
    for (const double contrast : {5.0, 60.0}) {
      for (const double share : {0.1, 0.3}) {
        const Scene scene{sigma, contrast, share, 1.0 / 3, 1.0 / 3, 2};
        const NoiseEstimate noise = estimator.measure(render(scene));
        SCOPED_TRACE("sigma " + std::to_string(sigma) + ", edges of " + std::to_string(contrast) +
                     " sigma on " + std::to_string(share));
        EXPECT_NEAR(noise.sigma_counts / sigma, 1, 0.025);
        EXPECT_NEAR(noise.column_sigma_counts / sigma, 1.0 / 3, 0.12);
        EXPECT_NEAR(noise.row_sigma_counts / sigma, 1.0 / 3, 0.12);
      }
    }
  }
}

TEST(Noise, TellsColumnsFromRows) {
  NoiseEstimator estimator;
  const NoiseEstimate columns = estimator.measure(render({5, 20, 0.1, 1, 0, 1}));
  EXPECT_NEAR(columns.column_sigma_counts, 5, 0.7);
  EXPECT_LT(columns.row_sigma_counts, 0.5);
  EXPECT_NEAR(columns.sigma_counts, 5, 0.13);
  const NoiseEstimate rows = estimator.measure(render({5, 20, 0.1, 0, 1, 1}));
  EXPECT_LT(rows.column_sigma_counts, 0.5);
  EXPECT_NEAR(rows.row_sigma_counts, 5, 0.7);
  EXPECT_NEAR(rows.sigma_counts, 5, 0.13);
}

TEST(Noise, IsNotDisturbedByDeadPixels) {
  NoiseEstimator estimator;
  Image<std::uint16_t> frame = render({5, 20, 0.1, 0, 0, 1});
  std::mt19937 random(1);
  for (int i = 0; i < kWidth * kHeight / 200; ++i) {
    frame(static_cast<int>(random() % kWidth), static_cast<int>(random() % kHeight)) =
        i % 2 == 0 ? 0 : 65535;
  }
  EXPECT_NEAR(estimator.measure(frame).sigma_counts, 5, 0.13);
}

TEST(Noise, IsZeroWhereThereIsNone) {
  NoiseEstimator estimator;
  const auto expect_zero = [&](ImageView<const std::uint16_t> frame) {
    const NoiseEstimate noise = estimator.measure(frame);
    EXPECT_EQ(noise.sigma_counts, 0);
    EXPECT_EQ(noise.column_sigma_counts, 0);
    EXPECT_EQ(noise.row_sigma_counts, 0);
  };
  Image<std::uint16_t> frame(40, 30);
  fill_pixels(frame.view(), std::uint16_t{3000});
  expect_zero(frame);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(1000 + 30 * x + 17 * y);
    }
  }
  expect_zero(frame);
  frame.resize(7, 100);
  expect_zero(noise_image<std::uint16_t>(7, 100, 3000, 100, 1));
  expect_zero(noise_image<std::uint16_t>(100, 7, 3000, 100, 1));
  expect_zero({});
  expect_zero(render({0, 0, 0, 0, 0, 1}));
}

TEST(Noise, OfAPlaneRoundedToCountsIsBelowTheRounding) {
  Image<std::uint16_t> frame(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(std::lround(3000 + 0.317 * x + 0.173 * y));
    }
  }
  NoiseEstimator estimator;
  EXPECT_LT(estimator.measure(frame).sigma_counts, 0.29);
}

// Few pixels tell the noise badly, but on average it is right.
TEST(Noise, OfSmallFramesIsRightOnAverage) {
  NoiseEstimator estimator;
  for (const auto& [width, height] : {std::pair{8, 8}, {8, 40}, {40, 8}, {17, 9}, {40, 40}}) {
    constexpr unsigned kFrames = 400;
    double sum = 0;
    for (unsigned seed = 0; seed < kFrames; ++seed) {
      sum +=
          estimator.measure(noise_image<std::uint16_t>(width, height, 3000, 12, seed)).sigma_counts;
    }
    EXPECT_NEAR(sum / kFrames / 12, 1, 0.02) << width << "x" << height;
  }
}

// Sizes around vectors, in the middle of other pixels; one estimator for all.
TEST(Noise, IsTheSameOnEveryTarget) {
  NoiseEstimator estimator;
  for (int width = 8; width <= 70; width += width < 40 ? 1 : 9) {
    for (const int height : {8, 9, 17, 40}) {
      SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
      const auto buffer =
          noise_image<std::uint16_t>(width + 9, height + 9, 3000, 12, static_cast<unsigned>(width));
      const auto part = buffer.view().crop(4, 4, width, height);
      const Image<std::uint16_t> alone = [&] {
        Image<std::uint16_t> copy(width, height);
        copy_pixels(part, copy.view());
        return copy;
      }();
      const NoiseEstimate expected = NoiseEstimator().measure(alone);
      for_each_simd_target([&](const std::string&) {
        const NoiseEstimate noise = estimator.measure(part);
        EXPECT_EQ(noise.sigma_counts, expected.sigma_counts);
        EXPECT_EQ(noise.column_sigma_counts, expected.column_sigma_counts);
        EXPECT_EQ(noise.row_sigma_counts, expected.row_sigma_counts);
      });
    }
  }
}

TEST(Noise, OfTransposedFramesIsTheSameWithColumnsAndRowsExchanged) {
  const Image<std::uint16_t> frame = render({5, 20, 0.1, 1, 0.5, 1});
  Image<std::uint16_t> square(288, 288), transposed(288, 288);
  copy_pixels(frame.view().crop(0, 0, 288, 288), square.view());
  for (int y = 0; y < 288; ++y) {
    for (int x = 0; x < 288; ++x) {
      transposed(y, x) = square(x, y);
    }
  }
  NoiseEstimator estimator;
  const NoiseEstimate noise = estimator.measure(square);
  const NoiseEstimate other = estimator.measure(transposed);
  EXPECT_NEAR(other.sigma_counts, noise.sigma_counts, 0.1);
  EXPECT_NEAR(other.column_sigma_counts, noise.row_sigma_counts, 0.02);
  EXPECT_NEAR(other.row_sigma_counts, noise.column_sigma_counts, 0.02);
}

double mean_sigma_of(const std::string& directory) {
  NoiseEstimator estimator;
  double sum = 0;
  int frames = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(shared_directory() / "data" / directory)) {
    if (entry.path().extension() == ".png") {
      const auto frame = io::read_picture(entry.path().string());
      EXPECT_TRUE(frame);
      sum += frame ? estimator.measure(frame->counts).sigma_counts : 0;
      ++frames;
    }
  }
  return sum / frames;
}

TEST(Noise, OfTheOptrisRecordingIsKnown) {
  THERMEDGE_NEEDS_SHARED("data/optris_pi450");
  EXPECT_NEAR(mean_sigma_of("optris_pi450"), 5.8, 0.4);
}

// Noise of this camera differs over the frame; the flat half is the quieter one.
TEST(Noise, OfTheRoadRecordingIsKnown) {
  THERMEDGE_NEEDS_SHARED("data/fieldscale_road");
  EXPECT_NEAR(mean_sigma_of("fieldscale_road"), 9, 1);
}

}  // namespace
}  // namespace thermedge
