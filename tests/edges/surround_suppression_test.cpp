// What strong edges leave around them is no edge: the largest responses, ripple, sharpness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "support/images.hpp"
#include "support/sentinel_row.hpp"
#include "suppression_simd.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;
using test::SentinelRow;

constexpr int kVector = 16;  // floats in 64 bytes
const std::vector<int> kCounts = {1, 2, 3, 7, 15, 16, 17, 31, 33, 70, 129};

TEST(LargestRow, AlongARowIsTheLargestElement) {
  for (const int count : kCounts) {
    for (const int taps : {1, 2, 5, 21}) {
      const auto in = noise_image<float>(count + taps + kVector, 1, 0, 1, 31);
      for_each_simd_target([&](const std::string&) {
        SentinelRow<float> out(count, (kVector - count % kVector) % kVector);
        detail::largest_row(in.row(0), 1, taps, count, out.data());
        for (int i = 0; i < count; ++i) {
          ASSERT_EQ(out[i], *std::max_element(in.row(0) + i, in.row(0) + i + taps))
              << i << " of " << count << ", " << taps << " taps";
        }
        ASSERT_TRUE(out.intact());
      });
    }
  }
}

TEST(LargestRow, AlongColumnsIsTheLargestElement) {
  for (const int count : kCounts) {
    for (const int taps : {1, 2, 5, 21}) {
      const auto in = noise_image<float>(count + kVector, taps, 0, 1, 32);
      for_each_simd_target([&](const std::string&) {
        SentinelRow<float> out(count, (kVector - count % kVector) % kVector);
        detail::largest_row(in.row(0), in.stride(), taps, count, out.data());
        for (int i = 0; i < count; ++i) {
          float largest = in(i, 0);
          for (int k = 1; k < taps; ++k) {
            largest = std::max(largest, in(i, k));
          }
          ASSERT_EQ(out[i], largest) << i << " of " << count << ", " << taps << " taps";
        }
        ASSERT_TRUE(out.intact());
      });
    }
  }
}

// Steps along columns, blurred by the optics; counts in units of the noise.
struct Step {
  double at_px;
  double height;
};

Image<float> steps(const std::vector<Step>& all) {
  Image<float> frame(120, 60);
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      double value = 3000;
      for (const Step& step : all) {
        value += step.height / 2 * std::erf((x - step.at_px) / std::numbers::sqrt2);
      }
      frame(x, y) = static_cast<float>(value);
    }
  }
  return frame;
}

struct At {
  float response = 0;
  float suppressed = 0;  // 0: no edge
};

At at(const Image<float>& frame, int x, int y, const OrientedFilterTuning& tuning = {}) {
  // Without the fine derivative, which looks at the same pixels again.
  OrientedFilterOptions options;
  options.fine_px = 0;
  OrientedFilterBank filter(options, tuning);
  const auto found = filter.run(frame, 1, 0, *make_runner(1));
  EXPECT_TRUE(found) << found.error().message;
  return {found->response(x, y), found->edges(x, y) != 0 ? found->suppressed_response(x, y) : 0};
}

OrientedFilterTuning without_ripple() {
  OrientedFilterTuning tuning;
  tuning.ripple_share = 0;
  return tuning;
}

// Responses of 1 and 100 times as much: over / sqrt(1 + (.04 m)^2).
TEST(Ripple, OfAStrongEdgeSuppressesAWeakOneBesideItInProportion) {
  for (const double strong : {50.0, 200.0}) {
    const auto frame = steps({{50, strong}, {58, strong / 50}});
    const At plain = at(frame, 58, 30, without_ripple());
    const At found = at(frame, 58, 30);
    const At edge = at(frame, 50, 30);
    ASSERT_GT(plain.suppressed, 0.1F);
    const double ripple = OrientedFilterTuning{}.ripple_share * static_cast<double>(edge.response);
    const double expected = static_cast<double>(plain.suppressed) / std::sqrt(1 + ripple * ripple);
    EXPECT_NEAR(found.suppressed, expected > 0.1 ? expected : 0, 1e-3 * expected);
    EXPECT_LT(found.suppressed, 0.7F * plain.suppressed);
  }
}

TEST(Ripple, LeavesAnEdgeFarAwayAsItIs) {
  const auto lone = steps({{90, 2}});
  const auto beside = steps({{50, 200}, {90, 2}});
  const At expected = at(lone, 90, 30);
  const At found = at(beside, 90, 30);
  ASSERT_GT(expected.suppressed, 0.1F);
  EXPECT_NEAR(found.suppressed, expected.suppressed, 1e-3F);
}

// The square around a pixel reaches 10 px to each side.
TEST(Ripple, ReachesAsFarAsTuned) {
  for (const int reach : {4, 10}) {
    OrientedFilterTuning tuning;
    tuning.ripple_reach_px = reach;
    const auto frame = steps({{50, 200}, {59, 4}});
    const float plain = at(frame, 59, 30, without_ripple()).suppressed;
    const float found = at(frame, 59, 30, tuning).suppressed;
    ASSERT_GT(plain, 0.1F);
    EXPECT_EQ(found < 0.9F * plain, reach == 10) << found << " of " << plain;
  }
}

TEST(Ripple, IsTheSameOnAllSides) {
  const auto frame = steps({{50, 200}, {58, 4}});
  Image<float> mirrored(frame.width(), frame.height());
  Image<float> transposed(frame.height(), frame.width());
  Image<float> turned(frame.height(), frame.width());
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      mirrored(frame.width() - 1 - x, y) = frame(x, y);
      transposed(y, x) = frame(x, y);
      turned(y, frame.width() - 1 - x) = frame(x, y);
    }
  }
  const float expected = at(frame, 58, 30).suppressed;
  ASSERT_GT(expected, 0.1F);
  EXPECT_NEAR(at(mirrored, frame.width() - 1 - 58, 30).suppressed, expected, 1e-3F);
  EXPECT_NEAR(at(transposed, 30, 58).suppressed, expected, 1e-3F);
  EXPECT_NEAR(at(turned, 30, frame.width() - 1 - 58).suppressed, expected, 1e-3F);
}

// A strong edge is compared with itself: its response is bounded by 1 / share.
TEST(Ripple, OfAnEdgeItselfMakesACeiling) {
  const At weak = at(steps({{50, 2000}}), 50, 30);
  const At strong = at(steps({{50, 20000}}), 50, 30);
  EXPECT_GT(strong.suppressed, weak.suppressed);
  EXPECT_LT(strong.suppressed, 1 / OrientedFilterTuning{}.ripple_share);
  EXPECT_GT(strong.suppressed, 0.8 / OrientedFilterTuning{}.ripple_share);
}

// A step of 3 on a slope of as much per pixel as gives `share` of its response.
TEST(Sharpness, BelowTheLeastIsNoEdge) {
  const auto on_slope = [](double slope) {
    Image<float> frame = steps({{60, 10}});
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        frame(x, y) += static_cast<float>(slope * x);
      }
    }
    return frame;
  };
  OrientedFilterTuning any = without_ripple();
  any.least_sharpness = 0;
  for (const double slope : {0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
    const auto frame = on_slope(slope);
    const At all = at(frame, 60, 30, any);
    ASSERT_GT(all.suppressed, 0.1F) << slope;
    const bool is_sharp = all.suppressed >= 0.4F * all.response;
    EXPECT_EQ(at(frame, 60, 30, without_ripple()).suppressed, is_sharp ? all.suppressed : 0.0F)
        << slope;
    EXPECT_TRUE(slope != 0 || is_sharp);
    EXPECT_TRUE(slope != 20 || !is_sharp);
  }
}

}  // namespace
}  // namespace thermedge
