#include "gradient_simd.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gradient_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The kernel [1 2 1] of three differences.
template <class V>
V smoothed(V first, V middle, V last) {
  return (first + last) + (middle + middle);
}

float sobel_row(const BorderedRows& rows, int width, float* gx, float* gy, float* magnitude) {
  const hn::ScalableTag<float> d;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const auto finite = hn::Set(d, std::numeric_limits<float>::max());
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  auto largest = hn::Zero(d);
  for (int x = 0; x < width; x += lanes) {
    const auto north_west = hn::LoadU(d, rows.above + x);
    const auto north = hn::LoadU(d, rows.above + x + 1);
    const auto north_east = hn::LoadU(d, rows.above + x + 2);
    const auto west = hn::LoadU(d, rows.row + x);
    const auto east = hn::LoadU(d, rows.row + x + 2);
    const auto south_west = hn::LoadU(d, rows.below + x);
    const auto south = hn::LoadU(d, rows.below + x + 1);
    const auto south_east = hn::LoadU(d, rows.below + x + 2);
    const auto dx = smoothed(north_east - north_west, east - west, south_east - south_west);
    const auto dy = smoothed(south_west - north_west, south - north, south_east - north_east);
    const auto length = hn::Sqrt(dx * dx + dy * dy);
    hn::StoreU(dx, d, gx + x);
    hn::StoreU(dy, d, gy + x);
    hn::StoreU(length, d, magnitude + x);
    const auto checked = hn::IfThenElse(length <= finite, length, infinity);
    const auto inside = hn::FirstN(d, static_cast<std::size_t>(width - x));
    largest = hn::Max(largest, hn::IfThenElseZero(inside, checked));
  }
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(sobel_row);

float sobel_row(const BorderedRows& rows, int width, float* gx, float* gy, float* magnitude) {
  return THERMEDGE_SIMD_DISPATCH(sobel_row)(rows, width, gx, gy, magnitude);
}

}  // namespace thermedge::detail
#endif
