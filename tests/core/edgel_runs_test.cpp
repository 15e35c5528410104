// Samples across edgels, their tangents and sums of weighted values, against plain versions. To the
// bit: the order of the operations is part of the promise.
#include "edgel_runs_simd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/images.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;

double bilinear(ImageView<const std::uint16_t> frame, double x, double y) {
  if (!(x >= 0 && y >= 0 && x < frame.width() - 1 && y < frame.height() - 1)) {
    return std::nan("");
  }
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const auto along = [&](int row) {
    const double first = frame(left, row);
    return first + (x - left) * (frame(left + 1, row) - first);
  };
  const double upper = along(top);
  return upper + (y - top) * (along(top + 1) - upper);
}

// Both NaN, or the same bits.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(EdgelKernels, DifferencesAreThoseOfBilinearSamples) {
  for (const auto& [width, height] : {std::pair{1, 9}, {9, 1}, {2, 2}, {40, 30}}) {
    const auto frame = noise_image<std::uint16_t>(width, height, 30000, 20000, 21);
    for (const int count : {0, 1, 7, 8, 9, 17, detail::kMostEdgels}) {
      // Some of them outside, some exactly on the last column.
      const auto x = noise_image<float>(count + 1, 1, width / 2.0, width / 4.0, 22);
      auto y = noise_image<float>(count + 1, 1, height / 2.0, height / 4.0, 23);
      y(0, 0) = static_cast<float>(height - 1);
      const auto nx = noise_image<float>(count + 1, 1, 0, 0.7, 24);
      const auto ny = noise_image<float>(count + 1, 1, 0, 0.7, 25);
      for_each_simd_target([&](const std::string&) {
        for (const double distance : {0.0, 1.5, 16.0}) {
          std::vector<double> out(static_cast<std::size_t>(count) + 1, -1);
          detail::differences_across(frame, {x.row(0), y.row(0), nx.row(0), ny.row(0), count},
                                     distance, out.data());
          for (int i = 0; i < count; ++i) {
            const double dx = distance * nx(i, 0);
            const double dy = distance * ny(i, 0);
            const double expected = bilinear(frame, x(i, 0) + dx, y(i, 0) + dy) -
                                    bilinear(frame, x(i, 0) - dx, y(i, 0) - dy);
            ASSERT_TRUE(same(out[static_cast<std::size_t>(i)], expected)) << i;
          }
          EXPECT_EQ(out.back(), -1);
        }
      });
    }
  }
}

TEST(EdgelKernels, TangentsAreCentralDifferencesOfTheSmoothedCurve) {
  constexpr int kReach = detail::kTangentReach;
  for (const int count : {1, 7, 8, 9, 33}) {
    const auto curve = noise_image<float>(count + 2 * kReach, 1, 100, 30, 26);
    for_each_simd_target([&](const std::string&) {
      std::vector<double> out(static_cast<std::size_t>(count) + 1, -1);
      detail::tangents(curve.row(0) + kReach, count, out.data());
      for (int i = 0; i < count; ++i) {
        double expected = 0;
        for (int k = 1; k <= kReach; ++k) {
          const double ahead = curve(i + kReach + k, 0);
          expected += detail::kTangentWeights[k - 1] * (ahead - curve(i + kReach - k, 0));
        }
        ASSERT_EQ(out[static_cast<std::size_t>(i)], expected);
      }
      EXPECT_EQ(out.back(), -1);
    });
  }
}

TEST(EdgelKernels, SumsGoFromTheLastTapToTheFirst) {
  constexpr int kTaps = 13;
  const auto weights = noise_image<double>(kTaps, 1, 0, 1, 27);
  for (const int count : {1, 7, 8, 9, 33}) {
    const auto values = noise_image<double>(count + kTaps - 1, 1, 100, 30, 28);
    for_each_simd_target([&](const std::string&) {
      std::vector<double> out(static_cast<std::size_t>(count) + 1, -1);
      detail::backward_sums(values.row(0), weights.row(0), kTaps, count, out.data());
      for (int i = 0; i < count; ++i) {
        double expected = 0;
        for (int k = kTaps - 1; k >= 0; --k) {
          expected += weights(k, 0) * values(i + k, 0);
        }
        ASSERT_EQ(out[static_cast<std::size_t>(i)], expected);
      }
      EXPECT_EQ(out.back(), -1);
    });
  }
}

}  // namespace
}  // namespace thermedge
