#include "grey_scale_simd.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grey_scale_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// One vector of pixels. Double precision, because single precision puts products such as
// 3 * (1 / 3) on the wrong side of a half.
template <class D64>
void scale_vector(D64 d64, const std::uint16_t* counts, const Scaling& scaling,
                  std::uint8_t* levels) {
  const hn::Rebind<std::int32_t, D64> d32;
  const hn::Rebind<std::uint16_t, D64> d16;
  const hn::Rebind<std::uint8_t, D64> d8;
  const auto deviation = hn::PromoteTo(d32, hn::LoadU(d16, counts)) - hn::Set(d32, scaling.anchor);
  const auto level =
      hn::PromoteTo(d64, deviation) * hn::Set(d64, scaling.gain) + hn::Set(d64, scaling.base_level);
  const auto clamped = hn::Min(hn::Max(level, hn::Zero(d64)), hn::Set(d64, 255.0));
  // Not floor(clamped + 0.5): that sum rounds, and the largest value below 0.5 would become 1.
  const auto whole = hn::Floor(clamped);
  const auto up = hn::IfThenElseZero(clamped - whole >= hn::Set(d64, 0.5), hn::Set(d64, 1.0));
  hn::StoreU(hn::DemoteTo(d8, hn::DemoteTo(d32, whole + up)), d8, levels);
}

void scale_row(const std::uint16_t* counts, int width, const Scaling& scaling,
               std::uint8_t* levels) {
  const hn::ScalableTag<double> d64;
  const auto lanes = static_cast<int>(hn::Lanes(d64));
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    scale_vector(d64, counts + x, scaling, levels + x);
  }
  if (x < width) {
    std::uint16_t last_counts[HWY_MAX_BYTES / sizeof(double)] = {};
    std::uint8_t last_levels[HWY_MAX_BYTES / sizeof(double)];
    std::copy(counts + x, counts + width, last_counts);
    scale_vector(d64, last_counts, scaling, last_levels);
    std::copy_n(last_levels, width - x, levels + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(scale_row);

void scale_row(const std::uint16_t* counts, int width, const Scaling& scaling,
               std::uint8_t* levels) {
  THERMEDGE_SIMD_DISPATCH(scale_row)(counts, width, scaling, levels);
}

}  // namespace thermedge::detail
#endif
