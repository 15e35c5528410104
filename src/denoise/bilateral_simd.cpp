#include "bilateral_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bilateral_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::CappedTag<float, kBilateralSlack>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(F32()));

void bilateral_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                   float cut, int width, float* out) {
  const F32 d;
  const auto scale = hn::Set(d, 1 / (cut * cut));
  const auto one = hn::Set(d, 1.0F);
  for (int x = 0; x < width; x += kLanes) {
    const auto self = hn::LoadU(d, centre + x);
    auto sum = hn::Zero(d);
    auto total = one;
    const auto add = [&](const float* at, hn::Vec<F32> weight) {
      const auto difference = hn::LoadU(d, at) - self;
      const auto near = hn::Max(one - difference * difference * scale, hn::Zero(d));
      const auto squared = near * near;
      const auto used = weight * (squared * squared);
      sum = sum + used * difference;
      total = total + used;
    };
    for (int k = 1; k <= radius; ++k) {
      const auto weight = hn::Set(d, weights[k]);
      add(centre + x - k * step, weight);
      add(centre + x + k * step, weight);
    }
    hn::StoreU(self + sum / total, d, out + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(bilateral_row);

void bilateral_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                   float cut, int width, float* out) {
  THERMEDGE_SIMD_DISPATCH(bilateral_row)(centre, step, weights, radius, cut, width, out);
}

}  // namespace thermedge::detail
#endif
