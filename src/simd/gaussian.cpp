#include "simd/gaussian.hpp"

#include <algorithm>

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

void paper_kernel_row(const float* centre, std::ptrdiff_t stride, int width, float* near,
                      float* far, float* out) {
  const F32 d;
  constexpr int kReach = kPaperKernelRadius;
  for_each_vector(width + 2 * kReach, [&](int x) HWY_ATTR {
    hn::StoreU(both(centre - kReach + x, stride), d, near + x);
    hn::StoreU(both(centre - kReach + x, 2 * stride), d, far + x);
  });
  const auto weigh = [d](int weight, Floats sum) HWY_ATTR {
    return hn::Set(d, static_cast<float>(weight) / 159) * sum;
  };
  for_each_vector(width, [&](int x) HWY_ATTR {
    const float* p0 = centre + x;
    const float* p1 = near + kReach + x;
    const float* p2 = far + kReach + x;
    const Floats c = hn::LoadU(d, p0);
    const Floats four = hn::Set(d, 4) * c;
    const Floats knights = both(p1, 2) + both(p2, 1);
    Floats sum = weigh(12, (both(p0, 1) + hn::LoadU(d, p1)) - four);
    sum = sum + weigh(9, both(p1, 1) - four);
    sum = sum + weigh(5, (both(p0, 2) + hn::LoadU(d, p2)) - four);
    sum = sum + weigh(4, knights - (four + four));
    sum = sum + weigh(2, both(p2, 2) - four);
    hn::StoreU(c + sum, d, out + x);
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

void paper_kernel_row(const float* centre, std::ptrdiff_t stride, int width, float* near,
                      float* far, float* out) {
  HWY_DYNAMIC_DISPATCH(paper_kernel_row)(centre, stride, width, near, far, out);
}

void smooth_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                int width, float* out) {
  HWY_DYNAMIC_DISPATCH(smooth_row)(centre, step, weights, radius, width, out);
}

}  // namespace thermedge::detail
#endif
