// Gaussian smoothing against plain sums in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "float_frame.hpp"
#include "support/images.hpp"
#include "support/runners.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge {
namespace {

// The kernel of eq. 5, as printed in the paper.
constexpr int kPaperKernel[5][5] = {
    {2, 4, 5, 4, 2}, {4, 9, 12, 9, 4}, {5, 12, 15, 12, 5}, {4, 9, 12, 9, 4}, {2, 4, 5, 4, 2}};

float mirrored_pixel(ImageView<const float> image, int x, int y) {
  return image(detail::mirrored(x, image.width()), detail::mirrored(y, image.height()));
}

Image<float> paper_kernel_reference(ImageView<const float> in) {
  Image<float> out(in.width(), in.height());
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x) {
      std::int64_t sum = 0;
      for (int j = -2; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i) {
          sum += kPaperKernel[j + 2][i + 2] *
                 static_cast<std::int64_t>(mirrored_pixel(in, x + i, y + j));
        }
      }
      out(x, y) = static_cast<float>(sum) / 159.0F;
    }
  }
  return out;
}

Image<double> gaussian_reference(ImageView<const float> in, double sigma) {
  const int radius = static_cast<int>(std::ceil(4 * sigma));
  const auto weight = [&](int distance) {
    return std::exp(-distance * distance / (2 * sigma * sigma));
  };
  double total = 0;
  for (int i = -radius; i <= radius; ++i) {
    total += weight(i);
  }
  Image<double> out(in.width(), in.height());
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x) {
      double sum = 0;
      for (int j = -radius; j <= radius; ++j) {
        for (int i = -radius; i <= radius; ++i) {
          sum += weight(i) * weight(j) * mirrored_pixel(in, x + i, y + j);
        }
      }
      out(x, y) = sum / (total * total);
    }
  }
  return out;
}

Image<float> counts_image(int width, int height, unsigned seed) {
  const Image<std::uint16_t> counts =
      test::noise_image<std::uint16_t>(width, height, 40000, 20000, seed);
  Image<float> image(width, height);
  copy_pixels(counts.view(), image.view());
  return image;
}

Denoiser gaussian(double sigma_px) {
  DenoiseOptions options;
  options.method = DenoiseMethod::kGaussian;
  options.gaussian.sigma_px = sigma_px;
  return Denoiser(options);
}

TEST(GaussianTest, MirrorsAboutTheOuterEdge) {
  const int expected[] = {1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1};
  for (int i = -5; i <= 7; ++i) {
    EXPECT_EQ(detail::mirrored(i, 3), expected[i + 5]) << i;
  }
  EXPECT_EQ(detail::mirrored(-9, 1), 0);
}

TEST(GaussianTest, PaperKernelIsThatOfThePaperForAllSmallSizes) {
  const auto runner = make_runner(1);
  Denoiser denoiser = gaussian(0);
  test::for_each_simd_target([&](const std::string&) {
    for (int height = 1; height <= 20; ++height) {
      for (int width : {1, 2, 3, 4, 5, 7, 8, 9, 12, 15, 16, 17, 20, 31, 32, 33, 64, 65}) {
        const Image<float> in = counts_image(width, height, static_cast<unsigned>(width * height));
        test::GuardedImage<float> out(width, height);
        ASSERT_TRUE(denoiser.run(in, 1, out.view(), *runner));
        const Image<float> expected = paper_kernel_reference(in);
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            ASSERT_NEAR(out.view()(x, y), expected(x, y), 0.01) << "of counts up to 65535";
          }
        }
        ASSERT_TRUE(out.intact()) << width << " x " << height;
      }
    }
  });
}

TEST(GaussianTest, AnySigmaAgreesWithTheDoubleSum) {
  const auto runner = make_runner(1);
  for (const double sigma : {0.3, 0.7, 1.0, 2.5, 6.0}) {
    Denoiser denoiser = gaussian(sigma);
    for (int height : {1, 2, 3, 7, 19}) {
      for (int width : {1, 2, 5, 8, 16, 17, 33}) {
        const Image<float> in = counts_image(width, height, 5);
        const Image<double> expected = gaussian_reference(in, sigma);
        test::GuardedImage<float> out(width, height);
        ASSERT_TRUE(denoiser.run(in, 1, out.view(), *runner));
        ASSERT_TRUE(out.intact());
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            ASSERT_NEAR(out.view()(x, y), expected(x, y), 0.02)
                << "sigma " << sigma << ", " << width << " x " << height;
          }
        }
      }
    }
  }
}

// A frame that needs less is blurred less, down to not at all.
TEST(GaussianTest, BlursByTheBurdenOfTheNoise) {
  DenoiseOptions options;
  options.method = DenoiseMethod::kGaussian;
  options.gaussian.sigma_px = 2;
  Denoiser denoiser(options);
  const auto in = test::noise_image<float>(40, 30, 1000, 50, 5);
  const auto runner = make_runner(1);
  for (const double burden : {0.0, 0.3, 0.5, 1.0}) {
    Image<float> out(in.width(), in.height());
    NoiseModel noise;
    noise.level_counts = 50;
    ASSERT_TRUE(denoiser.run_measured(in, noise, out, *runner, burden));
    const auto expected = gaussian_reference(in, std::max(2 * burden, 0.1));
    for (int y = 0; y < in.height(); ++y) {
      for (int x = 0; x < in.width(); ++x) {
        ASSERT_NEAR(out(x, y), expected(x, y), 0.02) << burden << " at " << x << ", " << y;
      }
    }
  }
}

TEST(GaussianTest, ImpulseResponseIsTheNormalDensity) {
  constexpr double kSigma = 3;
  Image<float> in(61, 61);
  fill_pixels(in.view(), 0.0F);
  in(30, 30) = 1e6F;
  Image<float> out(61, 61);
  ASSERT_TRUE(gaussian(kSigma).run(in, 1, out, *make_runner(1)));
  for (int i = 0; i <= 8; ++i) {
    const double density =
        std::exp(-i * i / (2 * kSigma * kSigma)) / (2 * std::numbers::pi * kSigma * kSigma);
    EXPECT_NEAR(out(30 + i, 30), 1e6 * density, 1e6 * density * 1e-3 + 1) << i;
    EXPECT_EQ(out(30 + i, 30), out(30 - i, 30)) << i;
    EXPECT_EQ(out(30, 30 + i), out(30, 30 - i)) << i;
  }
}

TEST(GaussianTest, KeepsConstantsAndOffsetsExactly) {
  const auto runner = make_runner(1);
  for (const double sigma : {0.0, 0.8, 4.0}) {
    Denoiser denoiser = gaussian(sigma);
    Image<float> image(23, 17);
    fill_pixels(image.view(), 8191.0F);
    ASSERT_TRUE(denoiser.run(image, 1, image, *runner));
    for (int y = 0; y < 17; ++y) {
      for (int x = 0; x < 23; ++x) {
        ASSERT_EQ(image(x, y), 8191.0F) << "sigma " << sigma;
      }
    }
  }
}

}  // namespace
}  // namespace thermedge
