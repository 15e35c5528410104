#include "bm3d_sums_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bm3d_sums_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bm3d_match_simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Rows of an image end with a vector of this size to spare.
using F32 = hn::CappedTag<float, 16>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(F32()));

void add_row(const float* more, int width, float* sums) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    hn::StoreU(hn::LoadU(d, sums + x) + hn::LoadU(d, more + x), d, sums + x);
  }
}

void spread_row(const float* profile, const float* in, std::ptrdiff_t step, int width, float* out) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    auto sum = hn::Zero(d);
    for (int i = 0; i < kBlockPx; ++i) {
      sum = sum + hn::Set(d, profile[i]) * hn::LoadU(d, in + x - i * step);
    }
    hn::StoreU(sum, d, out + x);
  }
}

void divide_row(const float* sums, int width, float* values) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    hn::StoreU(hn::LoadU(d, sums + x) / hn::LoadU(d, values + x), d, values + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(add_row);
HWY_EXPORT(spread_row);
HWY_EXPORT(divide_row);

void add_row(const float* more, int width, float* sums) {
  THERMEDGE_SIMD_DISPATCH(add_row)(more, width, sums);
}

void spread_row(const float* profile, const float* in, std::ptrdiff_t step, int width, float* out) {
  THERMEDGE_SIMD_DISPATCH(spread_row)(profile, in, step, width, out);
}

void divide_row(const float* sums, int width, float* values) {
  THERMEDGE_SIMD_DISPATCH(divide_row)(sums, width, values);
}

}  // namespace thermedge::detail
#endif
