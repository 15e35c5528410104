// The classical detectors against slow versions written straight from their definitions.
#include "thermedge/stages/classical.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "support/images.hpp"
#include "support/runners.hpp"

namespace thermedge {
namespace {

using Kernel = std::vector<std::vector<double>>;  // rows; its centre is at (rows / 2, columns / 2)

double replicated(const Image<float>& image, int x, int y) {
  return image(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1));
}

Image<double> correlate(const Image<float>& image, const Kernel& kernel, int centre) {
  Image<double> out(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      double sum = 0;
      for (int j = 0; j < static_cast<int>(kernel.size()); ++j) {
        for (int i = 0; i < static_cast<int>(kernel.size()); ++i) {
          sum += kernel[j][i] * replicated(image, x + i - centre, y + j - centre);
        }
      }
      out(x, y) = sum;
    }
  }
  return out;
}

Image<std::uint8_t> gradient_edges(const Image<float>& image, const Kernel& one,
                                   const Kernel& other, int centre, double factor, bool thinning) {
  const Image<double> a = correlate(image, one, centre);
  const Image<double> b = correlate(image, other, centre);
  Image<double> square(image.width(), image.height());
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      square(x, y) = a(x, y) * a(x, y) + b(x, y) * b(x, y);
      sum += square(x, y);
    }
  }
  const double threshold = factor * sum / static_cast<double>(image.size());
  const auto strong = [&](int x, int y) {
    return square.view().contains(x, y) && square(x, y) > threshold ? square(x, y) : 0;
  };
  Image<std::uint8_t> edges(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double s = strong(x, y);
      const bool peak = (s > strong(x - 1, y) && s > strong(x + 1, y)) ||
                        (s > strong(x, y - 1) && s > strong(x, y + 1));
      edges(x, y) = (thinning ? peak : s > 0) ? 255 : 0;
    }
  }
  return edges;
}

Image<std::uint8_t> slow_edges(const Image<float>& image, ClassicalMethod method, bool thinning) {
  switch (method) {
    case ClassicalMethod::kPrewitt:
      return gradient_edges(image, {{-1, 0, 1}, {-1, 0, 1}, {-1, 0, 1}},
                            {{-1, -1, -1}, {0, 0, 0}, {1, 1, 1}}, 1, 4, thinning);
    case ClassicalMethod::kSobel:
      return gradient_edges(image, {{-1, 0, 1}, {-2, 0, 2}, {-1, 0, 1}},
                            {{-1, -2, -1}, {0, 0, 0}, {1, 2, 1}}, 1, 4, thinning);
    default:
      return gradient_edges(image, {{1, 0}, {0, -1}}, {{0, 1}, {-1, 0}}, 0, 6, thinning);
  }
}

// Positive pixels of the response beside a negative one, above the threshold.
Image<std::uint8_t> slow_log(const Image<float>& image, double sigma, int side) {
  const int radius = side / 2;
  Kernel kernel(static_cast<std::size_t>(side),
                std::vector<double>(static_cast<std::size_t>(side)));
  double gauss_sum = 0, sum = 0;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const double square = x * x + y * y;
      const double gauss = std::exp(-square / (2 * sigma * sigma));
      gauss_sum += gauss;
      kernel[y + radius][x + radius] = (square - 2 * sigma * sigma) * gauss;
      sum += kernel[y + radius][x + radius];
    }
  }
  for (auto& row : kernel) {
    for (double& weight : row) {
      weight = (weight - sum / (side * side)) / gauss_sum / std::pow(sigma, 4);
    }
  }
  const Image<double> response = correlate(image, kernel, radius);
  double mean = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      mean += std::abs(response(x, y)) / static_cast<double>(image.size());
    }
  }
  Image<std::uint8_t> edges(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      bool crossing = false;
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        crossing =
            crossing || (response.view().contains(x + dx, y + dy) && response(x + dx, y + dy) < 0);
      }
      edges(x, y) = crossing && response(x, y) > 0.75 * mean ? 255 : 0;
    }
  }
  return edges;
}

// Whole levels, so that sums are exact in both versions.
Image<float> whole_levels(int width, int height, unsigned seed) {
  Image<float> image = test::noise_image<float>(width, height, 120, 40, seed);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = std::round(image(x, y)) + (x > width / 2 ? 60.0F : 0.0F);
    }
  }
  return image;
}

void expect_edges(const Image<float>& image, ClassicalMethod method,
                  const ClassicalOptions& options, const Image<std::uint8_t>& wanted) {
  test::GuardedImage<std::uint8_t> edges(image.width(), image.height());
  ASSERT_TRUE(ClassicalDetector(options).run(image, method, edges.view(), *make_runner(1)));
  EXPECT_TRUE(edges.intact());
  EXPECT_TRUE(test::same_pixels<std::uint8_t>(edges.view(), wanted.view()))
      << image.width() << "x" << image.height();
}

TEST(Classical, GradientsEqualTheDefinitionAtEverySmallSize) {
  for (int height = 1; height <= 12; ++height) {
    for (int width = 1; width <= 20; ++width) {
      const Image<float> image =
          whole_levels(width, height, static_cast<unsigned>(height * 100 + width));
      for (const bool thinning : {true, false}) {
        ClassicalOptions options;
        options.thinning = thinning;
        for (const auto method :
             {ClassicalMethod::kPrewitt, ClassicalMethod::kRoberts, ClassicalMethod::kSobel}) {
          expect_edges(image, method, options, slow_edges(image, method, thinning));
        }
      }
    }
  }
}

TEST(Classical, LogEqualsTheDefinitionForEveryKernel) {
  for (const int side : {3, 9, 13, 31}) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 40}, {17, 5}, {41, 33}}) {
      const Image<float> image = whole_levels(width, height, 5);
      ClassicalOptions options;
      options.log_kernel_px = side;
      expect_edges(image, ClassicalMethod::kLog, options, slow_log(image, 2, side));
    }
  }
  const Image<float> image = whole_levels(50, 40, 6);
  ClassicalOptions options;
  options.log_sigma_px = 1.2;
  expect_edges(image, ClassicalMethod::kLog, options, slow_log(image, 1.2, 9));
}

TEST(Classical, CannyIsTheOneOfTheDetectorBehindAGaussian) {
  const Image<float> image = whole_levels(60, 40, 7);
  const auto runner = make_runner(1);
  DenoiseOptions gaussian;
  gaussian.method = DenoiseMethod::kGaussian;
  gaussian.gaussian.sigma_px = 1.4142;
  Image<float> smooth(60, 40);
  ASSERT_TRUE(Denoiser(gaussian).run(image, 0, smooth, *runner));
  Canny canny{CannyOptions{}};
  const auto wanted = canny.run(smooth, *runner);
  ASSERT_TRUE(wanted);
  Image<std::uint8_t> edges(60, 40);
  ASSERT_TRUE(ClassicalDetector().run(image, ClassicalMethod::kCanny, edges, *runner));
  EXPECT_TRUE(test::same_pixels<std::uint8_t>(edges.view(), wanted->edges));
}

TEST(Classical, AGivenThresholdIsInLevelsPerPixel) {
  // A ramp of 5 levels a pixel: its magnitude is 5 for Prewitt and Sobel, wherever the kernel fits.
  Image<float> ramp(30, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      ramp(x, y) = static_cast<float>(5 * x);
    }
  }
  Image<std::uint8_t> edges(30, 20);
  for (const auto method : {ClassicalMethod::kPrewitt, ClassicalMethod::kSobel}) {
    ClassicalOptions options;
    options.thinning = false;
    // The kernels are normalised by the sum of their absolute weights, as in both programs.
    options.threshold = 4.9;
    ASSERT_TRUE(ClassicalDetector(options).run(ramp, method, edges, *make_runner(1)));
    EXPECT_EQ(edges(15, 10), 255);
    options.threshold = 5.1;
    ASSERT_TRUE(ClassicalDetector(options).run(ramp, method, edges, *make_runner(1)));
    EXPECT_EQ(edges(15, 10), 0);
  }
}

TEST(Classical, FlatFramesHaveNoEdges) {
  Image<float> flat(40, 30);
  fill_pixels(flat.view(), 200.0F);
  Image<std::uint8_t> edges(40, 30);
  for (const ClassicalName& known : kClassicalMethods) {
    ASSERT_TRUE(ClassicalDetector().run(flat, known.method, edges, *make_runner(1)));
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        ASSERT_EQ(edges(x, y), 0) << known.name << " " << x << "," << y;
      }
    }
  }
}

TEST(Classical, IsTheSameForEveryRunnerAndWhenReused) {
  ClassicalDetector reused;
  for (const ClassicalName& known : kClassicalMethods) {
    for (const auto& [width, height] : {std::pair{90, 70}, {33, 80}}) {
      const Image<float> image = whole_levels(width, height, 9);
      Image<std::uint8_t> wanted(width, height), edges(width, height);
      ASSERT_TRUE(ClassicalDetector().run(image, known.method, wanted, *make_runner(1)));
      for (const auto& runner : test::all_runners()) {
        ASSERT_TRUE(reused.run(image, known.method, edges, *runner));
        EXPECT_TRUE(test::same_pixels<std::uint8_t>(edges.view(), wanted.view())) << known.name;
      }
    }
  }
}

TEST(Classical, RefusesBadInput) {
  Image<float> image = whole_levels(20, 20, 1);
  Image<std::uint8_t> edges(20, 20), other(20, 21);
  const auto runner = make_runner(1);
  EXPECT_FALSE(ClassicalDetector().run(image, ClassicalMethod::kSobel, other, *runner));
  EXPECT_FALSE(ClassicalDetector().run(Image<float>(), ClassicalMethod::kSobel,
                                       ImageView<std::uint8_t>(), *runner));
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(),
                       std::numeric_limits<float>::infinity(), 2e9F};
  for (const ClassicalName& known : kClassicalMethods) {
    for (const float pixel : bad) {
      Image<float> broken = image.clone();
      broken(7, 7) = pixel;
      EXPECT_FALSE(ClassicalDetector().run(broken, known.method, edges, *runner)) << known.name;
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ClassicalOptions& options :
       {ClassicalOptions{.threshold = -1}, ClassicalOptions{.threshold = nan},
        ClassicalOptions{.log_sigma_px = 0}, ClassicalOptions{.log_sigma_px = nan},
        ClassicalOptions{.log_kernel_px = 8}, ClassicalOptions{.canny_sigma_px = -1},
        ClassicalOptions{.log_kernel_px = 999}}) {
    const Status status =
        ClassicalDetector(options).run(image, ClassicalMethod::kLog, edges, *runner);
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find("classical."), std::string::npos);
  }
}

}  // namespace
}  // namespace thermedge
