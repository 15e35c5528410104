#include "suppression_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "suppression_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void suppress_row(const GradientRow& row, int count, float low, float high, std::uint8_t* classes) {
  const hn::ScalableTag<float> d;
  const hn::Rebind<std::int32_t, decltype(d)> di;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const auto tan_22_5 = hn::Set(d, 0.41421356F);  // half of the width of a sector: sqrt(2) - 1
  const auto weak = hn::Set(di, kWeakEdge);
  const auto strong = hn::Set(di, kStrongEdge);
  for (int x = 0; x < count; x += lanes) {
    const float* centre = row.magnitude + x;
    const float* above = centre - row.stride;
    const float* below = centre + row.stride;
    const auto gx = hn::LoadU(d, row.gx + x);
    const auto gy = hn::LoadU(d, row.gy + x);
    const auto is_0 = hn::Abs(gy) < hn::Abs(gx) * tan_22_5;
    const auto is_90 = hn::Abs(gx) < hn::Abs(gy) * tan_22_5;
    const auto is_135 = hn::Xor(gx < hn::Zero(d), gy < hn::Zero(d));
    const auto choose = [&](auto at_0, auto at_45, auto at_90, auto at_135) {
      return hn::IfThenElse(is_0, at_0,
                            hn::IfThenElse(is_90, at_90, hn::IfThenElse(is_135, at_135, at_45)));
    };
    const auto before = choose(hn::LoadU(d, centre - 1), hn::LoadU(d, above - 1),
                               hn::LoadU(d, above), hn::LoadU(d, above + 1));
    const auto behind = choose(hn::LoadU(d, centre + 1), hn::LoadU(d, below + 1),
                               hn::LoadU(d, below), hn::LoadU(d, below - 1));
    const auto magnitude = hn::LoadU(d, centre);
    const auto is_ridge = hn::And(magnitude > before, magnitude >= behind);
    const auto is_weak = hn::And(is_ridge, magnitude > hn::Set(d, low));
    const auto is_strong = hn::RebindMask(di, magnitude > hn::Set(d, high));
    const auto result =
        hn::IfThenElseZero(hn::RebindMask(di, is_weak), hn::IfThenElse(is_strong, strong, weak));
    hn::StoreU(hn::DemoteTo(d8, result), d8, classes + x);
  }
}

void largest_row(const float* in, std::ptrdiff_t step, int taps, int count, float* out) {
  const hn::ScalableTag<float> d;
  for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(d))) {
    auto largest = hn::LoadU(d, in + x);
    for (int k = 1; k < taps; ++k) {
      largest = hn::Max(largest, hn::LoadU(d, in + x + k * step));
    }
    hn::StoreU(largest, d, out + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(suppress_row);
HWY_EXPORT(largest_row);

void suppress_row(const GradientRow& row, int count, float low, float high, std::uint8_t* classes) {
  THERMEDGE_SIMD_DISPATCH(suppress_row)(row, count, low, high, classes);
}

void largest_row(const float* in, std::ptrdiff_t step, int taps, int count, float* out) {
  THERMEDGE_SIMD_DISPATCH(largest_row)(in, step, taps, count, out);
}

}  // namespace thermedge::detail
#endif
