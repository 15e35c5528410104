// Level, spectrum and map of noise, against noise whose truth is known.
#include "thermedge/stages/noise_model_estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "support/images.hpp"
#include "support/noise_kinds.hpp"

namespace thermedge {
namespace {

using test::noise_image;
using test::picture;
using test::rounded;
using test::WhiteNoise;

constexpr int kWidth = 384;  // whole blocks: enlarged noise is another one at odd places
constexpr int kHeight = 288;
constexpr double kPixelSigma = 123;  // what is told where there are too few blocks

NoiseModel measured(ImageView<const std::uint16_t> frame,
                    ImageView<const std::uint8_t> valid = {}) {
  NoiseModel model;
  NoiseModelEstimator().measure(frame, valid, kPixelSigma, model);
  return model;
}

WhiteNoise around_8000(double sigma, unsigned seed) { return {8000, sigma, seed}; }

Image<double> white(double sigma, unsigned seed) {
  return around_8000(sigma, seed).image(kWidth, kHeight);
}

// The orthonormal transform as its definition has it: of each coefficient the mean square over
// blocks side by side. What the estimator has to find where there is nothing but noise.
class PlainSpectrum {
 public:
  explicit PlainSpectrum(ImageView<const double> noise) {
    std::array<std::array<double, kSide>, kSide> cosines{};
    for (int u = 0; u < kSide; ++u) {
      for (int i = 0; i < kSide; ++i) {
        cosines[at(u)][at(i)] = std::sqrt((u == 0 ? 1.0 : 2.0) / kSide) *
                                std::cos((2 * i + 1) * u * std::numbers::pi / (2 * kSide));
      }
    }
    int blocks = 0;
    for (int top = 0; top + kSide <= noise.height(); top += kSide) {
      for (int left = 0; left + kSide <= noise.width(); left += kSide) {
        ++blocks;
        std::array<std::array<double, kSide>, kSide> rows{};
        for (int j = 0; j < kSide; ++j) {
          for (int u = 0; u < kSide; ++u) {
            for (int i = 0; i < kSide; ++i) {
              rows[at(j)][at(u)] += cosines[at(u)][at(i)] * noise(left + i, top + j);
            }
          }
        }
        for (int v = 0; v < kSide; ++v) {
          for (int u = 0; u < kSide; ++u) {
            double sum = 0;
            for (int j = 0; j < kSide; ++j) {
              sum += cosines[at(v)][at(j)] * rows[at(j)][at(u)];
            }
            variances_[at(v)][at(u)] += sum * sum;
          }
        }
      }
    }
    for (auto& row : variances_) {
      for (double& variance : row) {
        variance /= blocks;
      }
    }
  }

  [[nodiscard]] double variance(int u, int v) const { return variances_[at(v)][at(u)]; }
  [[nodiscard]] double level() const {
    double sum = 0;
    for (const auto& [u, v] : {std::pair{1, 1}, {1, 2}, {2, 1}, {2, 2}, {1, 3}, {3, 1}}) {
      sum += variance(u, v);
    }
    return std::sqrt(sum / 6);
  }

 private:
  static constexpr int kSide = kNoiseBlockPx;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::array<std::array<double, kSide>, kSide> variances_{};  // [v][u]
};

double uneven_share(const NoiseLevelMap& map) {
  const auto nodes = map.nodes();
  int uneven = 0;
  for (int y = 0; y < nodes.height(); ++y) {
    uneven += static_cast<int>(
        std::count_if(nodes.row(y), nodes.row(y) + nodes.width(), [](float v) { return v != 1; }));
  }
  return map.is_even() ? 0 : uneven / static_cast<double>(nodes.size());
}

// At every node the level is near the true one, and most nodes are on that of the frame.
void expect_nearly_even(const NoiseModel& model, double true_level) {
  EXPECT_LE(uneven_share(model.map), 0.5);
  for (int y = 0; y < model.map.nodes().height(); ++y) {
    for (int x = 0; x < model.map.nodes().width(); ++x) {
      EXPECT_NEAR(model.level_counts * static_cast<double>(model.map.nodes()(x, y)) / true_level, 1,
                  0.17);
    }
  }
}

// `make(seed)` is noise around 8000 counts. Medians over 200 blocks are off by 10 % (standard
// deviation), so the level of a frame is by some percent and the means over all frames by less.
template <class F>
void expect_truth(F&& make) {
  constexpr unsigned kFrames = 10;
  double level = 0;
  std::array<double, kNoiseBlockPx * kNoiseBlockPx> spectrum{};
  double true_level = 0;
  std::array<double, kNoiseBlockPx * kNoiseBlockPx> true_spectrum{};
  for (unsigned seed = 0; seed < kFrames; ++seed) {
    const Image<double> noise = make(1000 + seed);
    const PlainSpectrum truth(noise);
    const NoiseModel model = measured(rounded(noise));
    EXPECT_NEAR(model.level_counts / truth.level(), 1, 0.15) << "frame " << seed;
    expect_nearly_even(model, truth.level());
    level += model.level_counts / kFrames;
    true_level += truth.level() / kFrames;
    for (int v = 1; v < kNoiseBlockPx; ++v) {
      for (int u = 1; u < kNoiseBlockPx; ++u) {
        const auto at = static_cast<std::size_t>(kNoiseBlockPx * v + u);
        spectrum[at] += static_cast<double>(model.spectrum[at]) / kFrames;
        true_spectrum[at] += truth.variance(u, v) / (truth.level() * truth.level() * kFrames);
      }
    }
  }
  EXPECT_NEAR(level / true_level, 1, 0.05);
  for (int v = 1; v < kNoiseBlockPx; ++v) {
    for (int u = 1; u < kNoiseBlockPx; ++u) {
      const auto at = static_cast<std::size_t>(kNoiseBlockPx * v + u);
      // .05 is the least variance that is believed.
      EXPECT_NEAR(spectrum[at], true_spectrum[at], 0.06 + 0.25 * true_spectrum[at])
          << "frequency " << u << ", " << v;
    }
  }
}

TEST(NoiseModelEstimator, FindsTheLevelOfWhiteNoise) {
  for (const double sigma : {1.0, 8.0, 100.0}) {
    SCOPED_TRACE(sigma);
    expect_truth([&](unsigned seed) { return white(sigma, seed); });
  }
}

TEST(NoiseModelEstimator, FindsTheLevelOfNoiseThatWasResampled) {
  expect_truth(
      [](unsigned seed) { return test::resampled(kWidth, kHeight, around_8000(8, seed)); });
}

TEST(NoiseModelEstimator, FindsTheLevelOfNoiseThatWasEnlarged) {
  expect_truth(
      [](unsigned seed) { return test::enlarged_twice(kWidth, kHeight, around_8000(8, seed)); });
}

TEST(NoiseModelEstimator, FindsTheLevelOfNoiseAfterAGaussian) {
  expect_truth(
      [](unsigned seed) { return test::after_gaussian(kWidth, kHeight, around_8000(8, seed)); });
}

// The frequency 0 cannot be measured: it goes on as the two before it say, by 1.3 at most.
TEST(NoiseModelEstimator, ContinuesTheSpectrumToTheFrequencyZero) {
  for (const auto& noise :
       {test::enlarged_twice(kWidth, kHeight, around_8000(8, 34)), white(8, 34)}) {
    const NoiseModel model = measured(rounded(noise));
    const auto at = [&](std::size_t u, std::size_t v) {
      return static_cast<double>(model.spectrum[kNoiseBlockPx * v + u]);
    };
    for (std::size_t i = 1; i < kNoiseBlockPx; ++i) {
      EXPECT_NEAR(at(i, 0), at(i, 1) * std::clamp(std::sqrt(at(i, 1) / at(i, 2)), 1.0, 1.3), 1e-5);
      EXPECT_NEAR(at(0, i), at(1, i) * std::clamp(std::sqrt(at(1, i) / at(2, i)), 1.0, 1.3), 1e-5);
    }
    EXPECT_NEAR(at(0, 0), std::sqrt(at(1, 0) * at(0, 1)), 1e-5);
  }
}

// Blurred squares, 120 counts high in noise of 8: 20 % of the pixels are within 3 px of a flank.
TEST(NoiseModelEstimator, IsNotMovedByStrongEdges) {
  auto noise = white(8, 41);
  const double before = measured(rounded(noise)).level_counts;
  int near_edges = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto inside = [](int at, int period) {
        return period / 4.0 - std::abs(at % period - period / 2.0);
      };
      const double depth = std::min(inside(x, 90), inside(y, 96));
      noise(x, y) += 120 / (1 + std::exp(-depth / 0.8));
      near_edges += std::abs(depth) <= 4 ? 1 : 0;
    }
  }
  ASSERT_GT(near_edges, kWidth * kHeight / 6);
  const NoiseModel model = measured(rounded(noise));
  EXPECT_NEAR(model.level_counts / before, 1, 0.1);
  expect_nearly_even(model, 8);
}

TEST(NoiseModelEstimator, DoesNotSeeOffsetsOfColumnsAndRows) {
  const auto noise = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 8, 42);
  const auto offsets = noise_image<std::uint16_t>(kWidth, 2, 100, 30, 43);
  Image<std::uint16_t> striped(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      striped(x, y) = static_cast<std::uint16_t>(noise(x, y) + offsets(x, 0) + offsets(y, 1));
    }
  }
  const NoiseModel expected = measured(noise);
  const NoiseModel model = measured(striped);
  EXPECT_NEAR(model.level_counts, expected.level_counts, 0.01);
  for (std::size_t i = 0; i < model.spectrum.size(); ++i) {
    EXPECT_NEAR(model.spectrum[i], expected.spectrum[i], 0.02F);
  }
}

Image<double> uneven(double left_sigma, double right_sigma, unsigned seed) {
  const auto unit = noise_image<double>(kWidth, kHeight, 0, 1, seed);
  return picture(kWidth, kHeight, [&](int x, int y) {
    return 8000 + (x < kWidth / 2 ? left_sigma : right_sigma) * unit(x, y);
  });
}

TEST(NoiseModelEstimator, MapsNoiseThatDiffersBetweenTheHalves) {
  const NoiseModel model = measured(rounded(uneven(4, 14, 51)));
  ASSERT_FALSE(model.map.is_even());
  const auto level = [&](int x, int y) { return model.level_counts * model.map.at(x, y); };
  // Changes of up to 1.13 are taken for none.
  for (const int y : {10, 100, 144, 200, 280}) {
    for (const int x : {5, 60, 130}) {
      EXPECT_NEAR(level(x, y) / 4, 1, 0.25) << x << ", " << y;
      EXPECT_NEAR(level(kWidth - 1 - x, y) / 14, 1, 0.25) << x << ", " << y;
    }
    EXPECT_GT(level(kWidth / 2, y), 4.5);
    EXPECT_LT(level(kWidth / 2, y), 13.5);
  }
}

TEST(NoiseModelEstimator, TakesWhiteNoiseForNearlyEven) {
  double share = 0;
  constexpr unsigned kFrames = 8;
  for (unsigned seed = 60; seed < 60 + kFrames; ++seed) {
    const NoiseModel model = measured(rounded(white(8, seed)));
    expect_nearly_even(model, 8);
    share += uneven_share(model.map) / kFrames;
  }
  EXPECT_LE(share, 0.05);
}

// Half of the frame is no measurement and has ten times the noise.
TEST(NoiseModelEstimator, LeavesOutInvalidBlocks) {
  const auto frame = rounded(uneven(80, 8, 71));
  Image<std::uint8_t> valid(kWidth, kHeight);
  fill_pixels(valid.view(), std::uint8_t{1});
  for (int y = 0; y < kHeight; ++y) {
    // One pixel of each block is enough.
    for (int x = 0; x < kWidth / 2; x += 3) {
      valid(x, y) = y % 3 == 0 ? 0 : 1;
    }
  }
  const NoiseModel model = measured(frame, valid);
  EXPECT_NEAR(model.level_counts, 8, 0.5);
  EXPECT_NEAR(model.map.at(kWidth - 50, 100), 1, 0.15);
  EXPECT_EQ(model.map.at(20, 100), 1) << "unknown: as the frame";
  const NoiseModel all = measured(frame);
  EXPECT_GT(all.map.at(20, 100), 2 * all.map.at(kWidth - 50, 100));
}

TEST(NoiseModelEstimator, LeavesOutClippedAreas) {
  for (const std::uint16_t clipped : {std::uint16_t{0}, std::uint16_t{16383}}) {
    auto frame = rounded(white(8, 72));
    fill_pixels(frame.view().crop(0, 0, kWidth, 180), clipped);
    const NoiseModel model = measured(frame);
    EXPECT_NEAR(model.level_counts, 8, 0.6) << clipped;
    EXPECT_EQ(model.map.at(190, 60), 1);
  }
}

// A constant area between other counts was measured so: there is no noise.
TEST(NoiseModelEstimator, CountsConstantAreasThatAreNotClipped) {
  auto frame = rounded(white(8, 73));
  fill_pixels(frame.view().crop(0, 0, kWidth, 180), std::uint16_t{8000});
  EXPECT_EQ(measured(frame).level_counts, 0);
}

// 64 blocks are the fewest: 8 x 8 of them.
TEST(NoiseModelEstimator, FallsBackOnThePixelsWhereThereAreTooFewBlocks) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {7, 300}, {300, 7}, {8, 8}, {9, 17}, {56, 64}, {64, 56}, {8, 500}}) {
    const auto frame = noise_image<std::uint16_t>(width, height, 8000, 8, 81);
    const NoiseModel model = measured(frame);
    EXPECT_EQ(model.level_counts, kPixelSigma) << width << " x " << height;
    EXPECT_EQ(model.spectrum, white_spectrum());
    EXPECT_TRUE(model.map.is_even());
  }
  const NoiseModel enough = measured(noise_image<std::uint16_t>(57, 58, 8000, 8, 81));
  EXPECT_NEAR(enough.level_counts, 8, 2) << "blocks may overlap";
  Image<std::uint8_t> valid(64, 64);
  fill_pixels(valid.view(), std::uint8_t{1});
  valid(20, 20) = 0;
  EXPECT_EQ(measured(noise_image<std::uint16_t>(64, 64, 8000, 8, 81), valid).level_counts,
            kPixelSigma);
}

TEST(NoiseModelEstimator, ForgetsTheFrameBefore) {
  NoiseModel model;
  NoiseModelEstimator estimator;
  estimator.measure(rounded(uneven(4, 14, 51)), {}, kPixelSigma, model);
  ASSERT_FALSE(model.map.is_even());
  estimator.measure(noise_image<std::uint16_t>(20, 20, 8000, 8, 82), {}, 7, model);
  EXPECT_EQ(model.level_counts, 7);
  EXPECT_EQ(model.spectrum, white_spectrum());
  EXPECT_TRUE(model.map.is_even());
  estimator.measure(rounded(white(8, 83)), {}, kPixelSigma, model);
  EXPECT_EQ(model.level_counts, measured(rounded(white(8, 83))).level_counts);
}

enum class Turn { kMirrorX, kMirrorY, kTranspose };

Image<std::uint16_t> turned(ImageView<const std::uint16_t> in, Turn turn) {
  const bool swaps = turn == Turn::kTranspose;
  Image<std::uint16_t> out(swaps ? in.height() : in.width(), swaps ? in.width() : in.height());
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x) {
      const std::uint16_t value = in(x, y);
      if (swaps) {
        out(y, x) = value;
      } else if (turn == Turn::kMirrorX) {
        out(in.width() - 1 - x, y) = value;
      } else {
        out(x, in.height() - 1 - y) = value;
      }
    }
  }
  return out;
}

TEST(NoiseModelEstimator, IsMirroredAndTransposedWithTheFrame) {
  // Sides that are no multiples of 8 and noise that is not the same across and down.
  auto noise = uneven(4, 14, 91);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x + 1 < kWidth; ++x) {
      noise(x, y) = (noise(x, y) + noise(x + 1, y)) / 2;
    }
  }
  const auto whole = rounded(noise);
  const auto frame = whole.view().crop(1, 0, 381, 285);
  const NoiseModel model = measured(frame);
  ASSERT_FALSE(model.map.is_even());
  const auto nodes = model.map.nodes();
  for (const Turn turn : {Turn::kMirrorX, Turn::kMirrorY, Turn::kTranspose}) {
    const NoiseModel other = measured(turned(frame, turn));
    EXPECT_EQ(other.level_counts, model.level_counts);
    ASSERT_FALSE(other.map.is_even());
    for (std::size_t v = 0; v < kNoiseBlockPx; ++v) {
      for (std::size_t u = 0; u < kNoiseBlockPx; ++u) {
        ASSERT_EQ(turn == Turn::kTranspose ? other.spectrum[kNoiseBlockPx * u + v]
                                           : other.spectrum[kNoiseBlockPx * v + u],
                  model.spectrum[kNoiseBlockPx * v + u]);
      }
    }
    for (int y = 0; y < nodes.height(); ++y) {
      for (int x = 0; x < nodes.width(); ++x) {
        const float there = turn == Turn::kTranspose ? other.map.nodes()(y, x)
                            : turn == Turn::kMirrorX ? other.map.nodes()(nodes.width() - 1 - x, y)
                                                     : other.map.nodes()(x, nodes.height() - 1 - y);
        ASSERT_EQ(there, nodes(x, y)) << x << ", " << y;
      }
    }
  }
}

// One frame may be the same by chance.
TEST(NoiseModelEstimator, FindsTheSameLevelInTransposedFrames) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const auto frame = noise_image<std::uint16_t>(150, 100, 8000, 8, 200 + seed);
    EXPECT_EQ(measured(turned(frame, Turn::kTranspose)).level_counts, measured(frame).level_counts);
  }
}

TEST(NoiseModelEstimator, FindsNoneInAConstantFrame) {
  Image<std::uint16_t> frame(kWidth, kHeight);
  fill_pixels(frame.view(), std::uint16_t{8000});
  // All of it is clipped, as it were.
  EXPECT_EQ(measured(frame).level_counts, kPixelSigma);
  frame(0, 0) = 0;
  frame(1, 0) = 16383;
  EXPECT_EQ(measured(frame).level_counts, 0);
}

}  // namespace
}  // namespace thermedge
