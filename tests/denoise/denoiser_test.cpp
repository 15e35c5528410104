// What all denoisers promise: errors, sizes, aliasing, identical bits, equivariance, quality.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "support/images.hpp"
#include "support/runners.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge {
namespace {

constexpr std::array kMethods = {DenoiseMethod::kNone, DenoiseMethod::kGaussian,
                                 DenoiseMethod::kNlm, DenoiseMethod::kBm3d};
constexpr std::array kNoiseMethods = {DenoiseMethod::kNlm, DenoiseMethod::kBm3d};

DenoiseOptions options_for(DenoiseMethod method) {
  DenoiseOptions options;
  options.method = method;
  return options;
}

// A bright disc and a slanted step in noise.
Image<float> scene(int width, int height, double sigma, unsigned seed = 1) {
  Image<float> image = test::noise_image<float>(width, height, 8000, sigma, seed);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool in_disc = (x - 15) * (x - 15) + (y - 12) * (y - 12) < 80;
      image(x, y) +=
          static_cast<float>((in_disc ? 10 * sigma : 0) + (2 * x > 3 * y ? 5 * sigma : 0));
    }
  }
  return image;
}

Image<float> denoised(const DenoiseOptions& options, ImageView<const float> in, double sigma,
                      ParallelRunner& runner) {
  Image<float> out(in.width(), in.height());
  const Status status = Denoiser(options).run(in, sigma, out, runner);
  EXPECT_TRUE(status) << status.error().message;
  return out;
}

TEST(DenoiseTest, NoneAndMeasuredSigmaZeroCopy) {
  const auto runner = make_runner(1);
  const Image<float> in = scene(31, 17, 5);
  EXPECT_TRUE(
      test::same_pixels<float>(denoised(options_for(DenoiseMethod::kNone), in, 5, *runner), in));
  for (const DenoiseMethod method : kNoiseMethods) {
    Image<float> out(in.width(), in.height());
    ASSERT_TRUE(Denoiser(options_for(method)).run_measured(in, 0, out, *runner));
    EXPECT_TRUE(test::same_pixels<float>(out, in));
    ASSERT_TRUE(Denoiser(options_for(method)).run_measured(in, 5, out, *runner));
    EXPECT_TRUE(test::same_pixels<float>(out, denoised(options_for(method), in, 5, *runner)));
    EXPECT_TRUE(test::same_pixels<float>(denoised(options_for(method), in, 1e-300, *runner), in));
  }
}

TEST(DenoiseTest, ErrorsNameWhatIsWrong) {
  const auto runner = make_runner(1);
  const auto message = [&](const DenoiseOptions& options, double sigma = 5, float bad = 1) {
    Image<float> image = scene(9, 8, 5);
    image(3, 7) = bad;
    const Status status = Denoiser(options).run(image, sigma, image, *runner);
    return status ? std::string("none") : status.error().message;
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos ? testing::AssertionSuccess()
                                                : testing::AssertionFailure() << text;
  };
  for (const DenoiseMethod method : kMethods) {
    EXPECT_TRUE(has(message(options_for(method), 5, std::nanf("")), "(3, 7)"));
    EXPECT_TRUE(has(message(options_for(method), 5, -HUGE_VALF), "(3, 7)"));
    EXPECT_EQ(message(options_for(method)), "none");
  }
  for (const DenoiseMethod method : kNoiseMethods) {
    for (const double sigma : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
      EXPECT_TRUE(has(message(options_for(method), sigma), "sigma"));
    }
  }
  DenoiseOptions options;
  options.nlm.patch_px = 4;
  EXPECT_TRUE(has(message(options), "denoise.nlm.patch_px = 4"));
  options = {};
  options.nlm.search_px = 20;
  EXPECT_TRUE(has(message(options), "denoise.nlm.search_px = 20"));
  options = {};
  options.bm3d.lambda = std::nan("");
  EXPECT_TRUE(has(message(options), "denoise.bm3d.lambda"));
  options = {};
  options.gaussian.sigma_px = 0.1;
  EXPECT_TRUE(has(message(options), "denoise.gaussian.sigma_px = 0.1"));

  Image<float> image = scene(9, 8, 5);
  Image<float> other(8, 9);
  Denoiser denoiser(DenoiseOptions{});
  EXPECT_FALSE(denoiser.run(image, 5, other, *runner));
  EXPECT_FALSE(denoiser.run(ImageView<const float>{}, 5, ImageView<float>{}, *runner));
  const Status small =
      denoiser.run(image.view().crop(0, 0, 7, 8), 5, image.view().crop(0, 0, 7, 8), *runner);
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().message, "frame of 7 x 8 pixels: bm3d needs 8 x 8 or more");
}

TEST(DenoiseTest, EverySmallSizeWorksInPlaceAndStaysInside) {
  const auto runner = make_runner(1);
  for (const DenoiseMethod method : kMethods) {
    Denoiser denoiser(options_for(method));
    const int least = method == DenoiseMethod::kBm3d ? 8 : 1;
    for (int height = least; height <= 20; ++height) {
      for (int width = least; width <= 20; ++width) {
        const Image<float> in = scene(width, height, 5);
        test::GuardedImage<float> separate(width, height);
        test::GuardedImage<float> in_place(width, height);
        copy_pixels(in.view(), ImageView<float>(in_place.view()));
        ASSERT_TRUE(denoiser.run(in, 5, separate.view(), *runner));
        ASSERT_TRUE(denoiser.run(in_place.view(), 5, in_place.view(), *runner));
        ASSERT_TRUE(test::same_pixels<float>(separate.view(), in_place.view()));
        ASSERT_TRUE(separate.intact() && in_place.intact()) << width << " x " << height;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            ASSERT_NEAR(separate.view()(x, y), in(x, y), 60) << width << " x " << height;
          }
        }
      }
    }
  }
}

TEST(DenoiseTest, SameBitsOnEveryTargetAndRunner) {
  DenoiseOptions gaussian = options_for(DenoiseMethod::kGaussian);
  gaussian.gaussian.sigma_px = 1.7;
  DenoiseOptions bm3d = options_for(DenoiseMethod::kBm3d);
  bm3d.bm3d.profile = Bm3dProfile::kQuality;
  DenoiseOptions fast = options_for(DenoiseMethod::kBm3d);
  fast.bm3d.profile = Bm3dProfile::kFastest;
  const Image<float> in = scene(145, 130, 5);  // more than a vector and a band
  for (const DenoiseOptions& options : {options_for(DenoiseMethod::kGaussian), gaussian,
                                        options_for(DenoiseMethod::kNlm), bm3d, fast}) {
    const Image<float> expected = denoised(options, in, 5, *make_runner(1));
    for (const auto& runner : test::all_runners()) {
      ASSERT_TRUE(test::same_pixels<float>(denoised(options, in, 5, *runner), expected));
    }
    test::for_each_simd_target([&](const std::string&) {
      ASSERT_TRUE(test::same_pixels<float>(denoised(options, in, 5, *make_runner(2)), expected));
    });
  }
}

TEST(DenoiseTest, OneObjectServesChangingSizes) {
  const auto runner = make_runner(1);
  for (const DenoiseMethod method : kMethods) {
    Denoiser denoiser(options_for(method));
    for (const auto& [width, height] : {std::pair{60, 50}, {9, 8}, {33, 64}, {60, 50}}) {
      const Image<float> in = scene(width, height, 5);
      Image<float> out(width, height);
      ASSERT_TRUE(denoiser.run(in, 5, out, *runner));
      ASSERT_TRUE(test::same_pixels<float>(out, denoised(options_for(method), in, 5, *runner)));
    }
  }
}

TEST(DenoiseTest, ConstantFramesStay) {
  const auto runner = make_runner(1);
  for (const DenoiseMethod method : kMethods) {
    Image<float> image(29, 21);
    fill_pixels(image.view(), 12345.0F);
    EXPECT_TRUE(test::same_pixels<float>(denoised(options_for(method), image, 5, *runner), image));
  }
}

// A power of two as gain and an offset that needs no rounding leave nothing but the rounding of the
// mean to differ.
TEST(DenoiseTest, FollowsGainAndOffset) {
  const auto runner = make_runner(1);
  constexpr double kSigma = 6;
  Image<float> in = scene(50, 40, kSigma);
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x) {
      in(x, y) = std::round(in(x, y));
    }
  }
  for (const DenoiseMethod method : kMethods) {
    const Image<float> expected = denoised(options_for(method), in, kSigma, *runner);
    for (const auto& [gain, offset] :
         {std::pair{1.0F, -7000.0F}, {1.0F, 8000.0F}, {0.0625F, 0.0F}, {128.0F, 1024.0F}}) {
      Image<float> changed(in.width(), in.height());
      for (int y = 0; y < in.height(); ++y) {
        for (int x = 0; x < in.width(); ++x) {
          changed(x, y) = gain * in(x, y) + offset;
        }
      }
      const Image<float> out = denoised(options_for(method), changed, gain * kSigma, *runner);
      for (int y = 0; y < in.height(); ++y) {
        for (int x = 0; x < in.width(); ++x) {
          ASSERT_NEAR((out(x, y) - offset) / gain, expected(x, y), 0.003 * kSigma)
              << "method " << static_cast<int>(method) << ", gain " << gain;
        }
      }
    }
  }
}

TEST(DenoiseTest, ExtremeRangesStayFinite) {
  const auto runner = make_runner(1);
  for (const DenoiseMethod method : kMethods) {
    for (const float outlier : {1e12F, -1e36F}) {
      for (const double sigma : {1e-3, 1.0, 1e6, 1e300}) {
        Image<float> in = scene(30, 25, 5);
        in(20, 9) = outlier;
        const Image<float> out = denoised(options_for(method), in, sigma, *runner);
        for (int y = 0; y < in.height(); ++y) {
          for (int x = 0; x < in.width(); ++x) {
            ASSERT_TRUE(std::isfinite(out(x, y)))
                << x << ", " << y << ", outlier " << outlier << ", sigma " << sigma;
          }
        }
      }
    }
  }
}

// Instrumented builds take minutes for these pictures and have nothing to add to their quality.
#ifdef THERMEDGE_SANITIZED
constexpr bool kInstrumented = true;
#else
constexpr bool kInstrumented = false;
#endif

Image<float> read_counts(const std::string& part) {
  const Result<io::SourceFrame> frame =
      io::read_picture((test::shared_directory() / "data/denoise" / part).string());
  EXPECT_TRUE(frame) << frame.error().message;
  Image<float> image(frame->counts.width(), frame->counts.height());
  copy_pixels(frame->counts.view(), image.view());
  return image;
}

// Mean peak signal-to-noise ratio over the three photographs, dB; noisy ones hold 16 v + 8000.
double mean_psnr(const DenoiseOptions& options, int sigma, ParallelRunner& runner) {
  double sum = 0;
  for (const std::string name : {"b100007", "b107072", "b134049"}) {
    const Image<float> clean = read_counts("clean/" + name + ".png");
    const Image<float> noisy = read_counts("noisy/" + name + "_s" + std::to_string(sigma) + ".png");
    const Image<float> out = denoised(options, noisy, 16.0 * sigma, runner);
    double squares = 0;
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) {
        squares += std::pow((out(x, y) - 8000) / 16 - clean(x, y), 2);
      }
    }
    sum += 10 * std::log10(255.0 * 255.0 * static_cast<double>(out.size()) / squares);
  }
  return sum / 3;
}

struct Quality {
  int sigma;
  double nlm_db;   // scikit-image 31.95, 27.06, 24.28; OpenCV 31.28, 26.36, 23.33
  double bm3d_db;  // the reference implementation (IPOL)
};
constexpr std::array kQuality = {Quality{10, 31.95, 33.190}, Quality{25, 27.06, 28.541},
                                 Quality{50, 24.15, 25.720}};

TEST(DenoiseTest, NlmReachesThePublishedImplementations) {
  THERMEDGE_NEEDS_SHARED("data/denoise");
  if (kInstrumented) {
    GTEST_SKIP() << "quality is measured on plain builds";
  }
  const auto runner = make_runner(2);
  for (const Quality& quality : kQuality) {
    const double psnr = mean_psnr(options_for(DenoiseMethod::kNlm), quality.sigma, *runner);
    EXPECT_GT(psnr, quality.nlm_db) << "sigma " << quality.sigma;
  }
}

// Balanced within 0.1 dB, fast within 0.15 dB and fastest within 0.2 dB of it on the mean.
TEST(DenoiseTest, Bm3dReachesTheReferenceImplementation) {
  THERMEDGE_NEEDS_SHARED("data/denoise");
  if (kInstrumented) {
    GTEST_SKIP() << "quality is measured on plain builds";
  }
  const auto runner = make_runner(2);
  for (const auto& [profile, allowed_db] : {std::pair{Bm3dProfile::kQuality, 0.01},
                                            {Bm3dProfile::kBalanced, 0.1},
                                            {Bm3dProfile::kFast, 0.15},
                                            {Bm3dProfile::kFastest, 0.2}}) {
    DenoiseOptions options;
    options.bm3d.profile = profile;
    double sum = 0;
    for (const Quality& quality : kQuality) {
      sum += mean_psnr(options, quality.sigma, *runner) - quality.bm3d_db;
    }
    EXPECT_GT(sum / kQuality.size(), -allowed_db) << "profile " << static_cast<int>(profile);
  }
}

}  // namespace
}  // namespace thermedge
