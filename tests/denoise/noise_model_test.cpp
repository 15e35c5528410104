// Denoisers that are told more of the noise than its level: its spectrum, its map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "support/images.hpp"
#include "thermedge/noise_model.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 88;

Image<float> denoised(DenoiseMethod method, ImageView<const float> in, const NoiseModel& noise) {
  DenoiseOptions options;
  options.method = method;
  Image<float> out(in.width(), in.height());
  const Status status = Denoiser(options).run_measured(in, noise, out, *make_runner(1));
  EXPECT_TRUE(status) << status.error().message;
  return out;
}

NoiseModel noise_of(double level) {
  NoiseModel noise;
  noise.level_counts = level;
  return noise;
}

double deviation(ImageView<const float> image, int margin = 0) {
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (int y = margin; y < image.height() - margin; ++y) {
    for (int x = margin; x < image.width() - margin; ++x) {
      const double value = image(x, y);
      sum += value;
      squares += value * value;
      ++count;
    }
  }
  return std::sqrt(squares / count - sum / count * (sum / count));
}

// Noise whose neighbours were averaged 2 x 2, and what the transform sees of it: the averaging of
// neighbours lets cos^2(w / 2) of the power at a frequency w pass.
Image<float> smooth_noise(double sigma, unsigned seed) {
  const auto noise = test::noise_image<float>(kWidth + 1, kHeight + 1, 8000, sigma, seed);
  Image<float> smooth(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      smooth(x, y) = (noise(x, y) + noise(x + 1, y) + noise(x, y + 1) + noise(x + 1, y + 1)) / 4;
    }
  }
  return smooth;
}

NoiseModel smooth_model(double sigma) {
  NoiseModel noise = noise_of(sigma * 0.77);
  const auto passed = [](int u) { return std::pow(std::cos(u * std::numbers::pi / 16), 2); };
  for (int v = 0; v < kNoiseBlockPx; ++v) {
    for (int u = 0; u < kNoiseBlockPx; ++u) {
      noise.spectrum[static_cast<std::size_t>(kNoiseBlockPx * v + u)] =
          static_cast<float>(std::max(passed(u) * passed(v) / (0.77 * 0.77), 0.05));
    }
  }
  return noise;
}

TEST(ToldNoise, OfAWhiteSpectrumAndAnEvenMapIsThatOfTheLevelAlone) {
  Image<float> in = test::noise_image<float>(kWidth, kHeight, 8000, 8, 2);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kWidth / 2; x < kWidth; ++x) {
      in(x, y) += 50;
    }
  }
  for (const DenoiseMethod method :
       {DenoiseMethod::kGaussian, DenoiseMethod::kNlm, DenoiseMethod::kBm3d}) {
    DenoiseOptions options;
    options.method = method;
    Image<float> plain(kWidth, kHeight);
    ASSERT_TRUE(Denoiser(options).run(in, 8, plain, *make_runner(1)));
    EXPECT_TRUE(test::same_pixels<float>(denoised(method, in, noise_of(8)), plain));
  }
}

TEST(ToldNoise, OfALowPassSpectrumIsRemoved) {
  const Image<float> in = smooth_noise(8, 3);
  NoiseModel told = smooth_model(8);
  NoiseModel white = noise_of(told.level_counts);
  const double with = deviation(denoised(DenoiseMethod::kBm3d, in, told));
  const double without = deviation(denoised(DenoiseMethod::kBm3d, in, white));
  EXPECT_LT(with, 0.7 * without) << "of " << deviation(in);
}

// A faint pattern of high frequency is far above smooth noise, and below white noise of its level.
TEST(ToldNoise, OfALowPassSpectrumSparesHighFrequencies) {
  Image<float> in = smooth_noise(8, 4);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      in(x, y) += (x + y) % 2 == 0 ? 1.5F : -1.5F;
    }
  }
  const auto left = [&](const NoiseModel& noise) {
    const Image<float> out = denoised(DenoiseMethod::kBm3d, in, noise);
    double sum = 0;
    for (int y = 8; y < kHeight - 8; ++y) {
      for (int x = 8; x < kWidth - 8; ++x) {
        sum += ((x + y) % 2 == 0 ? 1 : -1) * static_cast<double>(out(x, y));
      }
    }
    return sum / ((kWidth - 16) * (kHeight - 16));
  };
  const NoiseModel told = smooth_model(8);
  EXPECT_GT(left(told), 1);
  EXPECT_LT(left(noise_of(told.level_counts)), 0.3);
}

// Noise that was averaged along the rows has nothing left at the high frequencies across.
TEST(ToldNoise, OfASpectrumAcrossIsNotThatOfOneDown) {
  const auto noise = test::noise_image<float>(kWidth + 3, kHeight, 8000, 8, 7);
  Image<float> in(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      in(x, y) = (noise(x, y) + noise(x + 1, y) + noise(x + 2, y) + noise(x + 3, y)) / 4;
    }
  }
  NoiseModel across = noise_of(4);
  NoiseModel down = noise_of(4);
  for (std::size_t v = 0; v < kNoiseBlockPx; ++v) {
    for (std::size_t u = 0; u < kNoiseBlockPx; ++u) {
      across.spectrum[kNoiseBlockPx * v + u] = u < 3 ? 2.5F : 0.1F;
      down.spectrum[kNoiseBlockPx * u + v] = u < 3 ? 2.5F : 0.1F;
    }
  }
  for (const bool wiener : {false, true}) {
    DenoiseOptions options;
    options.bm3d.wiener = wiener;
    const auto left = [&](const NoiseModel& told) {
      Image<float> out(kWidth, kHeight);
      EXPECT_TRUE(Denoiser(options).run_measured(in, told, out, *make_runner(1)));
      return deviation(out);
    };
    EXPECT_LT(left(across), 0.8 * left(down)) << (wiener ? "both stages" : "first stage");
  }
}

// The spectrum may differ between across and down.
TEST(ToldNoise, OfATransposedSpectrumTransposesTheResult) {
  const Image<float> in = test::noise_image<float>(48, 48, 8000, 8, 5);
  Image<float> transposed(48, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      transposed(y, x) = in(x, y);
    }
  }
  NoiseModel noise = noise_of(8);
  NoiseModel turned = noise_of(8);
  for (std::size_t v = 0; v < kNoiseBlockPx; ++v) {
    for (std::size_t u = 0; u < kNoiseBlockPx; ++u) {
      noise.spectrum[kNoiseBlockPx * v + u] = u < 3 ? 3.0F : 0.2F;
      turned.spectrum[kNoiseBlockPx * u + v] = u < 3 ? 3.0F : 0.2F;
    }
  }
  const Image<float> a = denoised(DenoiseMethod::kBm3d, in, noise);
  const Image<float> b = denoised(DenoiseMethod::kBm3d, transposed, turned);
  const Image<float> c = denoised(DenoiseMethod::kBm3d, transposed, noise);
  double right = 0;
  double wrong = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      right += std::abs(a(x, y) - b(y, x));
      wrong += std::abs(a(x, y) - c(y, x));
    }
  }
  // Which of two equally good blocks joins a group may differ.
  EXPECT_LT(right, 0.3 * wrong);
}

// A single block, whose slope is far below the threshold: its halves differ by 4 px of it, or not.
TEST(KeepSlopes, LeavesAGentleSlopeAcrossAndDown) {
  Image<float> slope(kNoiseBlockPx, kNoiseBlockPx);
  for (int y = 0; y < kNoiseBlockPx; ++y) {
    for (int x = 0; x < kNoiseBlockPx; ++x) {
      slope(x, y) = static_cast<float>(8000 + 0.5 * x - 0.25 * y);
    }
  }
  for (const bool keep_slopes : {false, true}) {
    DenoiseOptions options;
    options.bm3d.keep_slopes = keep_slopes;
    options.bm3d.wiener = false;
    Image<float> out(kNoiseBlockPx, kNoiseBlockPx);
    ASSERT_TRUE(Denoiser(options).run(slope, 8, out, *make_runner(1)));
    double across = 0;
    double down = 0;
    for (int y = 0; y < kNoiseBlockPx; ++y) {
      for (int x = 0; x < kNoiseBlockPx; ++x) {
        across += (x < 4 ? -1 : 1) * static_cast<double>(out(x, y)) / 32;
        down += (y < 4 ? -1 : 1) * static_cast<double>(out(x, y)) / 32;
      }
    }
    EXPECT_NEAR(across, keep_slopes ? 2 : 0, 0.01);
    EXPECT_NEAR(down, keep_slopes ? -1 : 0, 0.01);
  }
}

TEST(UnevenNoise, IsDenoisedAsTheEvenedFrame) {
  Image<float> nodes(4, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      nodes(x, y) = 0.5F + 0.5F * static_cast<float>(x + y);
    }
  }
  NoiseModel noise = noise_of(8);
  noise.map.set_nodes(nodes, kWidth, kHeight);
  Image<float> in = test::noise_image<float>(kWidth, kHeight, 0, 8, 6);
  double sum = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      in(x, y) = static_cast<float>(8000 + noise.map.at(x, y) * static_cast<double>(in(x, y)) +
                                    (x > 40 ? 60 : 0));
      sum += static_cast<double>(in(x, y));
    }
  }
  const double mean = sum / (kWidth * kHeight);
  Image<float> evened(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      evened(x, y) =
          static_cast<float>((static_cast<double>(in(x, y)) - mean) / noise.map.at(x, y));
    }
  }
  for (const DenoiseMethod method :
       {DenoiseMethod::kGaussian, DenoiseMethod::kNlm, DenoiseMethod::kBm3d}) {
    const Image<float> found = denoised(method, in, noise);
    const Image<float> expected = denoised(method, evened, noise_of(8));
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        ASSERT_NEAR(found(x, y), mean + static_cast<double>(expected(x, y)) * noise.map.at(x, y),
                    0.02)
            << x << ", " << y;
      }
    }
  }
}

TEST(UnevenNoise, LeavesAConstantFrameAsItIs) {
  Image<float> nodes(2, 2);
  nodes(0, 0) = nodes(0, 1) = 1;
  nodes(1, 0) = nodes(1, 1) = 3;
  NoiseModel noise = noise_of(8);
  noise.map.set_nodes(nodes, kWidth, kHeight);
  Image<float> in(kWidth, kHeight);
  fill_pixels(in.view(), 8000.0F);
  EXPECT_TRUE(test::same_pixels<float>(denoised(DenoiseMethod::kBm3d, in, noise), in));
}

}  // namespace
}  // namespace thermedge
