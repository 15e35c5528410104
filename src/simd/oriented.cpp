#include "simd/oriented.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/oriented.cpp"
#include "simd/config.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::CappedTag<float, kOrientedSlack>;
using Floats = hn::Vec<F32>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(F32()));

void odd_filter_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                    int width, float* out) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    auto sum = hn::Zero(d);
    for (int k = 1; k <= radius; ++k) {
      const auto difference =
          hn::LoadU(d, centre + x + k * step) - hn::LoadU(d, centre + x - k * step);
      sum = sum + hn::Set(d, weights[k]) * difference;
    }
    hn::StoreU(sum, d, out + x);
  }
}

void magnitude_row(const float* gx, const float* gy, int width, float* out) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    const auto x_part = hn::LoadU(d, gx + x);
    const auto y_part = hn::LoadU(d, gy + x);
    hn::StoreU(hn::Sqrt(x_part * x_part + y_part * y_part), d, out + x);
  }
}

void project_row(const float* gx, const float* gy, float a, float b, int width, float* out) {
  const F32 d;
  for (int x = 0; x < width; x += kLanes) {
    hn::StoreU(hn::Set(d, a) * hn::LoadU(d, gx + x) + hn::Set(d, b) * hn::LoadU(d, gy + x), d,
               out + x);
  }
}

void keep_stronger_row(const float* centre, const std::ptrdiff_t* offsets, const float* weights,
                       int radius, int index, int reverse, int width, float* strength,
                       std::int32_t* direction) {
  const F32 d;
  const hn::RebindToSigned<F32> di;
  const auto self = hn::Set(di, index);
  const auto reversed = hn::Set(di, index + reverse);
  for (int x = 0; x < width; x += kLanes) {
    auto sum = hn::Set(d, weights[0]) * hn::LoadU(d, centre + x);
    for (int k = 1; k <= radius; ++k) {
      const auto both =
          hn::LoadU(d, centre + x + offsets[k]) + hn::LoadU(d, centre + x - offsets[k]);
      sum = sum + hn::Set(d, weights[k]) * both;
    }
    const auto size = hn::Abs(sum);
    const auto before = hn::LoadU(d, strength + x);
    const auto is_stronger = hn::RebindMask(di, size > before);
    hn::StoreU(hn::Max(size, before), d, strength + x);
    const auto signed_self = hn::IfThenElse(hn::RebindMask(di, sum < hn::Zero(d)), reversed, self);
    hn::StoreU(hn::IfThenElse(is_stronger, signed_self, hn::LoadU(di, direction + x)), di,
               direction + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(odd_filter_row);
HWY_EXPORT(magnitude_row);
HWY_EXPORT(project_row);
HWY_EXPORT(keep_stronger_row);

void odd_filter_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                    int width, float* out) {
  HWY_DYNAMIC_DISPATCH(odd_filter_row)(centre, step, weights, radius, width, out);
}

void magnitude_row(const float* gx, const float* gy, int width, float* out) {
  HWY_DYNAMIC_DISPATCH(magnitude_row)(gx, gy, width, out);
}

void project_row(const float* gx, const float* gy, float a, float b, int width, float* out) {
  HWY_DYNAMIC_DISPATCH(project_row)(gx, gy, a, b, width, out);
}

void keep_stronger_row(const float* centre, const std::ptrdiff_t* offsets, const float* weights,
                       int radius, int index, int reverse, int width, float* strength,
                       std::int32_t* direction) {
  HWY_DYNAMIC_DISPATCH(keep_stronger_row)
  (centre, offsets, weights, radius, index, reverse, width, strength, direction);
}

}  // namespace thermedge::detail
#endif
