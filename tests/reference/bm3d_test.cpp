// BM3D as a whole against the plain version.
#include <gtest/gtest.h>

#include <utility>

#include "reference/bm3d_reference.hpp"
#include "support/images.hpp"
#include "thermedge/denoise.hpp"
#include "thermedge/parallel.hpp"

namespace thermedge {
namespace {

// A step in noise of sigma 1 whose values are what the library sees: floats less their mean.
Image<float> step_image(int width, int height) {
  Image<float> image = test::noise_image<float>(width, height, 0, 1, 29);
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) += (x + y / 2) % 16 < 8 ? 3.0F : -3.0F;
      sum += image(x, y);
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) -= static_cast<float>(sum / (width * height));
    }
  }
  return image;
}

void expect_agreement(int width, int height, const Bm3dOptions& bm3d) {
  DenoiseOptions options;
  options.bm3d = bm3d;
  const Image<float> in = step_image(width, height);
  Image<double> values(width, height);
  copy_pixels(ImageView<const float>(in), values.view());
  const Image<double> expected = test::ReferenceBm3d(values, bm3d).run();
  test::GuardedImage<float> out(width, height);
  ASSERT_TRUE(Denoiser(options).run(in, 1, out.view(), *make_runner(1)));
  ASSERT_TRUE(out.intact());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      ASSERT_NEAR(out.view()(x, y), expected(x, y), 2e-4)
          << x << ", " << y << " of " << width << " x " << height;
    }
  }
}

TEST(Bm3dTest, AgreesWithThePlainVersionOnSmallSizes) {
  for (const auto& [width, height] :
       {std::pair{8, 8}, {12, 8}, {8, 12}, {20, 20}, {40, 8}, {32, 48}, {64, 60}}) {
    Bm3dOptions options;
    options.wiener = false;
    expect_agreement(width, height, options);
    options.wiener = true;
    expect_agreement(width, height, options);
  }
}

TEST(Bm3dTest, AgreesWithThePlainVersionForOtherOptions) {
  for (const int step : {1, 2, 8}) {
    Bm3dOptions options;
    options.step_px = step;
    options.search_radius_px = 4 + step;
    options.group_hard = 32 / step;
    options.group_wiener = 2 * step;
    options.lambda = 2;
    options.kaiser_beta = 10.0 / step;
    expect_agreement(24, 32, options);
  }
}

// Also sizes at which no block ends at the last row and column.
TEST(Bm3dTest, CoversEveryPixelForEveryStep) {
  const auto runner = make_runner(1);
  for (const int step : {1, 2, 4, 8}) {
    DenoiseOptions options;
    options.bm3d.step_px = step;
    options.bm3d.kaiser_beta = 10;
    for (int side = 8; side <= 25; ++side) {
      const Image<float> in = step_image(side, 33 - side);
      Image<float> out(side, 33 - side);
      ASSERT_TRUE(Denoiser(options).run(in, 1, out, *runner));
      for (int y = 0; y < out.height(); ++y) {
        for (int x = 0; x < out.width(); ++x) {
          ASSERT_NEAR(out(x, y), in(x, y), 6) << "step " << step << ", side " << side;
        }
      }
    }
  }
}

}  // namespace
}  // namespace thermedge
