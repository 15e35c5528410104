#include "simd/gaussian.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/gaussian.cpp"
#include "simd/config.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::CappedTag<float, 16>;
using Floats = hn::Vec<F32>;

// The four pixels at (+-i, +-j).
HWY_INLINE Floats corners(const float* p, std::ptrdiff_t i, std::ptrdiff_t j) {
  const F32 d;
  return (hn::LoadU(d, p - j - i) + hn::LoadU(d, p - j + i)) +
         (hn::LoadU(d, p + j - i) + hn::LoadU(d, p + j + i));
}

// The four pixels at (+-i, 0) and (0, +-j).
HWY_INLINE Floats cross(const float* p, std::ptrdiff_t i, std::ptrdiff_t j) {
  const F32 d;
  return (hn::LoadU(d, p - i) + hn::LoadU(d, p + i)) + (hn::LoadU(d, p - j) + hn::LoadU(d, p + j));
}

void paper_kernel_row(const float* centre, std::ptrdiff_t stride, int width, float* out) {
  const F32 d;
  const auto weigh = [d](float weight, Floats sum) HWY_ATTR { return hn::Set(d, weight) * sum; };
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const float* p = centre + x;
    Floats sum = weigh(15, hn::LoadU(d, p));
    sum = sum + weigh(12, cross(p, 1, stride));
    sum = sum + weigh(9, corners(p, 1, stride));
    sum = sum + weigh(5, cross(p, 2, 2 * stride));
    sum = sum + weigh(4, corners(p, 2, stride) + corners(p, 1, 2 * stride));
    sum = sum + weigh(2, corners(p, 2, 2 * stride));
    hn::StoreU(sum / hn::Set(d, 159), d, out + x);
  }
}

void smooth_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                int width, float* out) {
  const F32 d;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const Floats c = hn::LoadU(d, centre + x);
    Floats sum = hn::Zero(d);
    for (int k = 1; k <= radius; ++k) {
      const Floats before = hn::LoadU(d, centre + x - k * step);
      const Floats behind = hn::LoadU(d, centre + x + k * step);
      sum = sum + hn::Set(d, weights[k]) * ((before - c) + (behind - c));
    }
    hn::StoreU(c + sum, d, out + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(paper_kernel_row);
HWY_EXPORT(smooth_row);

void paper_kernel_row(const float* centre, std::ptrdiff_t stride, int width, float* out) {
  HWY_DYNAMIC_DISPATCH(paper_kernel_row)(centre, stride, width, out);
}

void smooth_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                int width, float* out) {
  HWY_DYNAMIC_DISPATCH(smooth_row)(centre, step, weights, radius, width, out);
}

}  // namespace thermedge::detail
#endif
