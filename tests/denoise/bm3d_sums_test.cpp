// Sums of the aggregation of BM3D against plain loops: the same operations in the same order, so
// the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bm3d_sums_simd.hpp"
#include "support/images.hpp"
#include "support/sentinel_row.hpp"

namespace thermedge {
namespace {

using test::for_each_simd_target;
using test::noise_image;
using test::SentinelRow;

const std::vector<int> kCounts = {1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 32, 33, 70, 200};
constexpr int kMargin = 8;

// What a kernel may write behind `count` elements: up to a whole number of vectors of 16.
int slack(int count) { return (count + 15) / 16 * 16 - count; }

TEST(Bm3dSums, SumsOfTheAggregation) {
  const float profile[] = {0.1F, 0.3F, 0.8F, 1, 1, 0.7F, 0.2F, 0.05F};
  const auto in = noise_image<float>(200 + 2 * kMargin, 2 * kMargin + 1, 30, 7, 47);
  const float* centre = in.row(kMargin) + kMargin;
  const float* more = in.row(0);
  for (const int count : kCounts) {
    for_each_simd_target([&](const std::string&) {
      for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, in.stride()}) {
        SentinelRow<float> spread(count, slack(count));
        detail::spread_row(profile, centre, step, count, spread.data());
        for (int x = 0; x < count; ++x) {
          float sum = 0;
          for (int i = 0; i < 8; ++i) {
            sum += profile[i] * centre[x - i * step];
          }
          ASSERT_EQ(spread[x], sum) << x << " of " << count;
        }
        ASSERT_TRUE(spread.intact());
      }
      SentinelRow<float> sums(count, slack(count), 3);
      SentinelRow<float> quotients(count, slack(count), 7);
      detail::add_row(more, count, sums.data());
      detail::divide_row(centre, count, quotients.data());
      for (int x = 0; x < count; ++x) {
        ASSERT_EQ(sums[x], 3 + more[x]) << x << " of " << count;
        ASSERT_EQ(quotients[x], centre[x] / 7) << x << " of " << count;
      }
      ASSERT_TRUE(sums.intact() && quotients.intact());
    });
  }
}

}  // namespace
}  // namespace thermedge
