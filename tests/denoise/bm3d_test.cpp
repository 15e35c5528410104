// BM3D as a whole against the plain version.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "bm3d_reference.hpp"
#include "support/images.hpp"
#include "thermedge/options.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/stages/denoiser.hpp"

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

void expect_agreement(int width, int height, const detail::Bm3dSettings& settings) {
  const Image<float> in = step_image(width, height);
  Image<double> values(width, height);
  copy_pixels(ImageView<const float>(in), values.view());
  const Image<double> expected = test::ReferenceBm3d(values, settings).run();
  test::GuardedImage<float> out(width, height);
  detail::Bm3d(settings).run(in, {}, out.view(), *make_runner(1));
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
       {std::pair{8, 8}, {16, 8}, {8, 16}, {24, 24}, {40, 8}, {32, 48}, {64, 56}}) {
    for (const auto& profile : kBm3dProfiles) {
      Bm3dOptions options;
      options.profile = profile.value;
      if (profile.value != Bm3dProfile::kQuality || width * height < 1000) {
        expect_agreement(width, height, detail::bm3d_settings(options));
      }
    }
    Bm3dOptions options;
    options.wiener = false;
    expect_agreement(width, height, detail::bm3d_settings(options));
  }
}

TEST(Bm3dTest, AgreesWithThePlainVersionForOtherSettings) {
  for (const int step : {1, 2, 8}) {
    detail::Bm3dSettings settings;
    settings.step_px = step;
    settings.search_radius_px = 4 + step;
    settings.hard.largest_group = 32 / step;
    settings.wiener.largest_group = 2 * step;
    settings.options.lambda = 2;
    settings.options.kaiser_beta = 10.0 / step;
    expect_agreement(24, 32, settings);
  }
}

// Away from the middle lines of the frame: reference blocks on them have candidates that are mirror
// images of each other, of which one has to be the first.
TEST(Bm3dTest, MirroredFramesGiveMirroredResults) {
  constexpr int kWidth = 134;  // continued by a pixel to either side
  constexpr int kHeight = 96;
  constexpr int kReach = 24;  // of a group
  const Image<float> in = step_image(kWidth, kHeight);
  const auto runner = make_runner(1);
  Bm3dOptions options;
  options.wiener = false;
  Image<float> expected(kWidth, kHeight);
  detail::Bm3d(detail::bm3d_settings(options)).run(in, {}, expected, *runner);
  for (const auto& mirror : {std::pair{true, false}, {false, true}, {true, true}}) {
    const bool mirror_x = mirror.first;
    const bool mirror_y = mirror.second;
    const auto mirrored = [&](const Image<float>& image) {
      Image<float> out(kWidth, kHeight);
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          out(x, y) = image(mirror_x ? kWidth - 1 - x : x, mirror_y ? kHeight - 1 - y : y);
        }
      }
      return out;
    };
    Image<float> found(kWidth, kHeight);
    detail::Bm3d(detail::bm3d_settings(options)).run(mirrored(in), {}, found, *runner);
    const Image<float> back = mirrored(found);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (std::abs(2 * x - kWidth) > 2 * kReach && std::abs(2 * y - kHeight) > 2 * kReach) {
          ASSERT_NEAR(back(x, y), expected(x, y), 1e-4) << x << ", " << y;
        }
      }
    }
  }
}

// Also sizes at which no block ends at the last row and column.
TEST(Bm3dTest, CoversEveryPixelForEveryStep) {
  const auto runner = make_runner(1);
  for (const int step : {1, 2, 4, 8}) {
    detail::Bm3dSettings settings;
    settings.step_px = step;
    settings.hard.thinning = step == 4 ? detail::Thinning::kChessboard : detail::Thinning::kNone;
    settings.wiener.thinning = step == 4 ? detail::Thinning::kQuarter : detail::Thinning::kNone;
    settings.options.kaiser_beta = 10;
    for (int side = 8; side <= 25; ++side) {
      const Image<float> in = step_image(side, 33 - side);
      Image<float> out(side, 33 - side);
      detail::Bm3d(settings).run(in, {}, out, *runner);
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
