// The smooth background of a frame, and the line through points of which some lie far off.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "detrend.hpp"
#include "robust_line_fit.hpp"
#include "support/images.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge {
namespace {

TEST(RobustLine, IgnoresPointsThatLieFarOff) {
  std::vector<detail::WeightedPoint> points;
  for (int i = 0; i < 40; ++i) {
    const double near = i % 2 == 0 ? 0.01 : -0.01;
    points.push_back({1.0 * i, i % 5 == 0 ? 500.0 : 3 - 0.25 * i + near, 1});
  }
  std::vector<double> scratch;
  const detail::Line line = detail::robust_line(points, scratch);
  EXPECT_NEAR(line.level, 3, 0.05);
  EXPECT_NEAR(line.rise, -0.25, 0.002);
}

TEST(RobustLine, OfLessThanTwoPlacesIsFlat) {
  std::vector<double> scratch;
  EXPECT_EQ(detail::robust_line({}, scratch).at(7), 0);
  const std::vector<detail::WeightedPoint> one(3, {5, 2, 1});
  EXPECT_EQ(detail::robust_line(one, scratch).at(7), 0);
}

constexpr int kWidth = 191;
constexpr int kHeight = 147;

double bowl(int x, int y) {
  return 0.004 * (x - 90) * (x - 90) - 0.3 * x - 0.002 * (y - 20) * (y - 20) + 0.1 * y;
}

Image<float> bowl_with_objects() {
  Image<float> frame(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool in_object = (x > 30 && x < 70 && y > 20 && y < 120) || (x > 150 && y > 100);
      frame(x, y) = static_cast<float>(1000 + bowl(x, y) + (in_object ? 400 : 0));
    }
  }
  return frame;
}

TEST(Detrender, IsWhatChangesEvenlyFromSideToSide) {
  const Image<float> frame = bowl_with_objects();
  detail::Detrender detrend;
  detrend.measure(frame);
  Image<float> flat(kWidth, kHeight);
  detrend.subtract(frame, flat);
  const auto object_less = [&](int x, int y) { return flat(x, y) - flat(100, 60); };
  for (const auto& [x, y] : {std::pair{2, 3}, {100, 140}, {20, 130}, {140, 5}, {188, 90}}) {
    EXPECT_NEAR(object_less(x, y), 0, 2) << x << ' ' << y;  // of 60 counts from corner to corner
  }
  EXPECT_NEAR(object_less(50, 70), 400, 2);
}

TEST(Detrender, IsPutBackAsItWas) {
  const Image<float> frame = bowl_with_objects();
  detail::Detrender detrend;
  detrend.measure(frame);
  Image<float> there_and_back(kWidth, kHeight);
  detrend.subtract(frame, there_and_back);
  detrend.add(there_and_back);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_NEAR(there_and_back(x, y), frame(x, y), 1e-3);
    }
  }
}

TEST(Detrender, OfTinyFramesIsNone) {
  Image<float> frame(5, 3);
  fill_pixels(frame.view(), 7.0F);
  detail::Detrender detrend;
  detrend.measure(frame);
  detrend.subtract(frame, frame);
  EXPECT_EQ(frame(4, 2), 7);
}

// Of the steps that BM3D makes of a slope: the curvature along rows.
double terraces(ImageView<const float> frame) {
  double squares = 0;
  int count = 0;
  for (int y = 8; y < frame.height() - 8; ++y) {
    for (int x = 8; x < frame.width() - 8; ++x, ++count) {
      const double bend = frame(x + 4, y) - 2 * frame(x, y) + frame(x - 4, y);
      squares += bend * bend;
    }
  }
  return std::sqrt(squares / count);
}

TEST(Detrender, MakesDenoisersLeaveSlopesSmooth) {
  constexpr double kSigma = 10;
  Image<float> noisy = test::noise_image<float>(kWidth, kHeight, 1000, kSigma, 3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      noisy(x, y) += 0.8F * static_cast<float>(x);
    }
  }
  const auto left = [&](bool detrend) {
    DenoiseOptions options;
    options.detrend = detrend;
    Image<float> out(kWidth, kHeight);
    EXPECT_TRUE(Denoiser(options).run_measured(noisy, kSigma, out, *make_runner(1)));
    return terraces(out);
  };
  EXPECT_LT(left(true), 0.5 * left(false));
}

}  // namespace
}  // namespace thermedge
