// The bilateral filter behind a denoiser against its formula, pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bilateral.hpp"
#include "bilateral_simd.hpp"
#include "float_frame.hpp"
#include "support/images.hpp"
#include "support/runners.hpp"
#include "support/sentinel_row.hpp"
#include "support/strided_image.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;

// The formula of the header in single precision, which gives the same bits.
float plain_pixel(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                  float cut) {
  const float scale = 1 / (cut * cut);
  float sum = 0;
  float total = 1;
  for (int k = 1; k <= radius; ++k) {
    for (const int sign : {-1, 1}) {
      const float difference = centre[sign * k * step] - *centre;
      const float near = std::max(1 - difference * difference * scale, 0.0F);
      const float used = weights[k] * ((near * near) * (near * near));
      sum += used * difference;
      total += used;
    }
  }
  return *centre + sum / total;
}

TEST(BilateralKernel, IsTheFormulaToTheBit) {
  constexpr int kMargin = 8;
  const float weights[] = {1, 0.88F, 0.61F, 0.32F, 0.14F};
  const auto in = noise_image<float>(200 + 2 * kMargin, 2 * kMargin + 1, 3000, 20, 1);
  const float* centre = in.row(kMargin) + kMargin;
  for (const int count : {1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 33, 70, 200}) {
    for (const int radius : {0, 1, 4}) {
      for (const float cut : {3.0F, 40.0F, 1000.0F}) {
        for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, in.stride()}) {
          for_each_simd_target([&](const std::string&) {
            test::SentinelRow<float> out(count, detail::kBilateralSlack);
            detail::bilateral_row(centre, step, weights, radius, cut, count, out.data());
            for (int x = 0; x < count; ++x) {
              ASSERT_EQ(out[x], plain_pixel(centre + x, step, weights, radius, cut)) << x;
            }
            ASSERT_TRUE(out.intact());
          });
        }
      }
    }
  }
}

constexpr double kLargest = 140;  // pixel of the frames below

// The filter in double precision, along rows, then along columns, with mirrored borders.
struct PlainBilateral {
  PlainBilateral(double space_px, double range)
      : radius(static_cast<int>(std::ceil(1.6 * space_px))), cut(std::sqrt(8.0) * range) {
    for (int k = 0; k <= radius; ++k) {
      weights.push_back(std::exp(-0.5 * k * k / (space_px * space_px)));
      weight_sum += k > 0 ? 2 * weights.back() : 0;
    }
  }

  [[nodiscard]] Image<double> pass(const Image<double>& in, bool along_rows) const {
    Image<double> out(in.width(), in.height());
    for (int y = 0; y < in.height(); ++y) {
      for (int x = 0; x < in.width(); ++x) {
        double sum = 0;
        double total = 0;
        for (int k = -radius; k <= radius; ++k) {
          const double value = in(detail::mirrored(along_rows ? x + k : x, in.width()),
                                  detail::mirrored(along_rows ? y : y + k, in.height()));
          const double share = std::abs(value - in(x, y)) / cut;
          const double weight = share < 1 ? weights[static_cast<std::size_t>(std::abs(k))] *
                                                std::pow(1 - share * share, 4)
                                          : 0;
          sum += weight * value;
          total += weight;
        }
        out(x, y) = sum / total;
      }
    }
    return out;
  }

  // What single precision makes of it, with the unit rounding u, the largest pixel A and the sum S
  // of the weights around a pixel. Pixels that count differ by `cut` at most. In a pass the last
  // addition is off by u A. The bracket 1 - d^2 / cut^2 is off by 4 u, its fourth power by 19 u;
  // so are numerator and denominator by 20 u S (of `cut`, or of 1), and the quotient by twice that.
  // The second pass hands on the error of the first: a change of a pixel by e changes the weighted
  // difference by e at most and its weight by 1.9 e / cut, both for this pixel and those around it:
  // 1 + 5.8 S times e. A frame of one row or column is changed by one pass only.
  [[nodiscard]] double allowed_error(int width, int height) const {
    const double pass = 0x1p-24 * (kLargest + (40 * weight_sum + 4) * cut);
    return std::min(width, height) == 1 ? pass : pass * (2 + 5.8 * weight_sum);
  }

  int radius;
  double cut;
  std::vector<double> weights;
  double weight_sum = 0;
};

// Errors as a share of what is allowed; the largest over all pixels.
double largest_error(ImageView<const float> found, const Image<double>& expected, double allowed) {
  double largest = 0;
  for (int y = 0; y < found.height(); ++y) {
    for (int x = 0; x < found.width(); ++x) {
      largest =
          std::max(largest, std::abs(static_cast<double>(found(x, y)) - expected(x, y)) / allowed);
    }
  }
  return largest;
}

test::StridedImage<float> noisy_step(int width, int height, unsigned seed) {
  const auto noise = noise_image<float>(width, height, 80, 4, seed);
  test::StridedImage<float> frame(width, height, std::nanf(""));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      frame.view()(x, y) = noise(x, y) + (x + 2 * y > width ? 30.0F : 0.0F);
    }
  }
  return frame;
}

TEST(BilateralFilter, IsTheFormulaAlongRowsThenColumnsForAllSmallSizes) {
  const auto runners = test::all_runners();
  std::size_t next = 0;
  double tightest = 0;
  for (const double space_px : {1.0, 2.0, 3.3}) {
    for (const double range : {1.5, 12.0}) {
      const PlainBilateral plain(space_px, range);
      detail::BilateralFilter filter({range, space_px});
      for (int height = 1; height <= 12; ++height) {
        for (int width = 1; width <= 19; ++width) {
          const auto in = noisy_step(width, height, static_cast<unsigned>(20 * width + height));
          Image<double> expected(width, height);
          copy_pixels(in.view(), expected.view());
          expected = plain.pass(plain.pass(expected, true), false);
          for_each_simd_target([&](const std::string&) {
            ParallelRunner& runner = *runners[next++ % runners.size()];
            test::StridedImage<float> out(width, height);
            filter.run(in.view(), range, out.view(), runner);
            const double error =
                largest_error(out.view(), expected, plain.allowed_error(width, height));
            ASSERT_LE(error, 1) << width << "x" << height << ", " << space_px << " px, " << range;
            ASSERT_TRUE(out.intact());
            tightest = std::max(tightest, error);
          });
        }
      }
    }
  }
  RecordProperty("largest_error", std::to_string(tightest));
  EXPECT_GT(tightest, 0.01);
}

TEST(BilateralFilter, IsTheSameAcrossVectorsAndTasksAndInPlace) {
  const PlainBilateral plain(2, 6);
  const auto in = noisy_step(53, 37, 3);
  Image<double> expected(53, 37);
  copy_pixels(in.view(), expected.view());
  expected = plain.pass(plain.pass(expected, true), false);
  detail::BilateralFilter filter({6, 2});
  test::StridedImage<float> first(53, 37);
  filter.run(in.view(), 6, first.view(), *make_runner(1));
  EXPECT_LE(largest_error(first.view(), expected, plain.allowed_error(53, 37)), 1);
  for (const auto& runner : test::all_runners()) {
    for_each_simd_target([&](const std::string&) {
      auto in_place = in;
      filter.run(in_place.view(), 6, in_place.view(), *runner);
      EXPECT_TRUE(test::same_pixels<float>(in_place.view(), first.view()));
    });
  }
}

}  // namespace
}  // namespace thermedge
