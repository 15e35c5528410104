#include "extent_simd.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "extent_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The last vector of a long row repeats pixels of the one before.
Extent extent_of(const float* row, int width) {
  const hn::CappedTag<float, 16> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  Extent extent{row[0], row[0], true};
  const auto largest = hn::Set(d, std::numeric_limits<float>::max());
  if (width < lanes) {
    for (int x = 0; x < width; ++x) {
      extent.low = std::min(extent.low, row[x]);
      extent.high = std::max(extent.high, row[x]);
      extent.finite = extent.finite && std::abs(row[x]) <= std::numeric_limits<float>::max();
    }
    return extent;
  }
  auto low = hn::LoadU(d, row);
  auto high = low;
  auto finite = hn::Abs(low) <= largest;
  for (int x = lanes; x < width; x += lanes) {
    const auto pixels = hn::LoadU(d, row + std::min(x, width - lanes));
    low = hn::Min(low, pixels);
    high = hn::Max(high, pixels);
    finite = hn::And(finite, hn::Abs(pixels) <= largest);
  }
  extent.low = hn::GetLane(hn::MinOfLanes(d, low));
  extent.high = hn::GetLane(hn::MaxOfLanes(d, high));
  extent.finite = hn::AllTrue(d, finite);
  return extent;
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(extent_of);

Extent extent_of(const float* row, int width) {
  return THERMEDGE_SIMD_DISPATCH(extent_of)(row, width);
}

}  // namespace thermedge::detail
#endif
