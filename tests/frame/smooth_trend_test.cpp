// Smooth trends of profiles: what is found of them, and what white noise and jumps make of them.
#include "smooth_trend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace thermedge {
namespace {

constexpr int kColumns = 382;
constexpr double kMiddle = 0.5 * (kColumns - 1);

std::vector<double> white(double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, deviation);
  std::vector<double> out(kColumns);
  std::generate(out.begin(), out.end(), [&] { return normal(random); });
  return out;
}

double dome(double x) { return 20 * std::exp(-std::pow((x - kMiddle) / kMiddle, 2)); }

TEST(RobustSlope, IsThatOfACubicWhateverAFewPointsSay) {
  const auto slope_at = [](double x) { return 0.1 + 0.3 * std::pow((x - kMiddle) / kMiddle, 3); };
  std::vector<detail::WeightedPoint> points;
  const std::vector<double> noise = white(0.02, 1);
  for (int x = 0; x < kColumns; x += 4) {
    const bool on_edge = (x + 60) % 100 < 12;
    points.push_back({1.0 * x, slope_at(x) + noise[static_cast<std::size_t>(x)] + on_edge * 5, 1});
  }
  std::vector<double> scratch;
  const detail::SmoothSlope found = detail::robust_slope(points, kMiddle, kMiddle, scratch);
  EXPECT_EQ(found.trend(kMiddle), 0);
  for (double x = 20; x < kColumns - 20; x += 20) {
    EXPECT_NEAR(found.trend(x + 1) - found.trend(x), slope_at(x + 0.5), 0.05) << x;
  }
}

TEST(RobustSlope, OfTooFewPointsIsNone) {
  std::vector<double> scratch;
  EXPECT_EQ(detail::robust_slope({}, 10, 10, scratch).trend(3), 0);
  const std::vector<detail::WeightedPoint> one = {{5, 2, 1}};
  EXPECT_EQ(detail::robust_slope(one, 10, 10, scratch).trend(3), 0);
}

TEST(TrendFit, OfADomeIsTheDome) {
  detail::TrendFit fit;
  fit.prepare(kColumns);
  std::vector<double> profile = white(0.3, 2);
  double mean = 0;
  for (int x = 0; x < kColumns; ++x) {
    profile[static_cast<std::size_t>(x)] += dome(x);
    mean += dome(x) / kColumns;
  }
  fit.fit(profile, std::vector<int>(kColumns, 0), 0.3, 4);
  for (int x = 0; x < kColumns; ++x) {
    EXPECT_NEAR(fit.trend()[static_cast<std::size_t>(x)], dome(x) - mean, 0.25) << x;
  }
}

TEST(TrendFit, OfWhiteStripesIsNoneWhateverTheirStrength) {
  detail::TrendFit fit;
  fit.prepare(kColumns);
  for (const double deviation : {0.3, 30.0}) {
    fit.fit(white(deviation, 3), std::vector<int>(kColumns, 0), deviation, 4);
    EXPECT_TRUE(
        std::all_of(fit.trend().begin(), fit.trend().end(), [](double t) { return t == 0; }));
  }
}

TEST(TrendFit, IsTheSameOnBothSidesOfAJump) {
  detail::TrendFit fit;
  fit.prepare(kColumns);
  std::vector<double> profile(kColumns);
  std::vector<int> segments(kColumns);
  for (int x = 0; x < kColumns; ++x) {
    const auto i = static_cast<std::size_t>(x);
    segments[i] = x < 130 ? 0 : 1;
    profile[i] = 0.02 * x + 50 * segments[i];
  }
  fit.fit(profile, segments, 0.1, 4);
  for (const int x : {20, 100, 200, 370}) {
    const auto i = static_cast<std::size_t>(x);
    EXPECT_NEAR(fit.trend()[i] - fit.trend()[i - 1], 0.02, 1e-4);
  }
  const auto lone = std::vector<int>{0, 1, 2, 3};  // nothing to tell a trend from
  fit.prepare(4);
  fit.fit(std::vector<double>{1, 2, 3, 4}, lone, 0.1, 4);
  EXPECT_EQ(fit.trend()[3], 0);
}

}  // namespace
}  // namespace thermedge
