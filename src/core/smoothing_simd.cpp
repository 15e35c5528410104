#include "smoothing_simd.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "smoothing_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F32 = hn::CappedTag<float, 16>;
using Floats = hn::Vec<F32>;

// Calls process(x) for vectors that cover `width`; the last one ends there, and may repeat pixels
// of the one before.
template <class Process>
HWY_INLINE void for_each_vector(int width, const Process& process) {
  const int lanes = static_cast<int>(hn::Lanes(F32()));
  for (int x = 0; x < width; x += lanes) {
    process(std::max(std::min(x, width - lanes), 0));
  }
}

// The pixels i to the left and to the right.
HWY_INLINE Floats both(const float* p, std::ptrdiff_t i) {
  return hn::LoadU(F32(), p - i) + hn::LoadU(F32(), p + i);
}

// K = w w' / 2 + t t' - 1.5 at the centre, with w = (2 4 5 4 2) and t = (0 1 2 1 0).
void paper_kernel_row(const float* centre, std::ptrdiff_t stride, int width, float* wide,
                      float* narrow, float* out) {
  const F32 d;
  constexpr int kReach = kPaperKernelRadius;
  const auto two = hn::Set(d, 2);
  const auto four = hn::Set(d, 4);
  const auto five = hn::Set(d, 5);
  for_each_vector(width + 2 * kReach, [&](int x) HWY_ATTR {
    const float* p = centre - kReach + x;
    const Floats c = hn::LoadU(d, p);
    const Floats near = both(p, stride);
    hn::StoreU((two * both(p, 2 * stride) + four * near) + five * c, d, wide + x);
    hn::StoreU(near + two * c, d, narrow + x);
  });
  for_each_vector(width, [&](int x) HWY_ATTR {
    const Floats c = hn::LoadU(d, centre + x);
    const float* w = wide + kReach + x;
    const float* t = narrow + kReach + x;
    const Floats by_w = (both(w, 2) + two * both(w, 1)) + hn::Set(d, 2.5F) * hn::LoadU(d, w);
    const Floats by_t = both(t, 1) + two * hn::LoadU(d, t);
    const Floats excess = (by_w + by_t) - hn::Set(d, 160.5F) * c;
    hn::StoreU(c + hn::Set(d, 1.0F / 159) * excess, d, out + x);
  });
}

void smooth_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                int width, float* out) {
  const F32 d;
  for_each_vector(width, [&](int x) HWY_ATTR {
    const Floats c = hn::LoadU(d, centre + x);
    Floats sum = hn::Zero(d);
    for (int k = 1; k <= radius; ++k) {
      const Floats before = hn::LoadU(d, centre + x - k * step);
      const Floats behind = hn::LoadU(d, centre + x + k * step);
      sum = sum + hn::Set(d, weights[k]) * ((before - c) + (behind - c));
    }
    hn::StoreU(c + sum, d, out + x);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(paper_kernel_row);
HWY_EXPORT(smooth_row);

void paper_kernel_row(const float* centre, std::ptrdiff_t stride, int width, float* wide,
                      float* narrow, float* out) {
  THERMEDGE_SIMD_DISPATCH(paper_kernel_row)(centre, stride, width, wide, narrow, out);
}

void smooth_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                int width, float* out) {
  THERMEDGE_SIMD_DISPATCH(smooth_row)(centre, step, weights, radius, width, out);
}

}  // namespace thermedge::detail
#endif
