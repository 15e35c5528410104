#include "noise_block_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise_block_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Outside the target namespaces: one definition for all of them.
#ifndef THERMEDGE_SIMD_NOISE_BLOCK_ONCE
#define THERMEDGE_SIMD_NOISE_BLOCK_ONCE
namespace thermedge::detail {

inline constexpr int kSide = kNoiseBlockPx;
inline constexpr int kScaleBits = 11;

// Row u: the first half of the cosine of frequency u, times 2^kScaleBits; the second half mirrors
// it, with the other sign for odd u. Rounded values of sqrt(1/8) and cos(k pi / 16) / 2.
inline constexpr std::int32_t kCosines[kSide][kSide / 2] = {
    {724, 724, 724, 724},     {1004, 851, 569, 200},  {946, 392, -392, -946},
    {851, -200, -1004, -569}, {724, -724, -724, 724}, {569, -1004, 200, 851},
    {392, -946, 946, -392},   {200, -569, 851, -1004}};

// The same for all frequencies of a pixel, times the scale of the result.
struct CosinesOfPixels {
  constexpr CosinesOfPixels() {
    constexpr double kScale = 1.0 / (1 << (2 * kScaleBits));
    for (int x = 0; x < kSide; ++x) {
      for (int u = 0; u < kSide; ++u) {
        const bool is_mirrored = x >= kSide / 2;
        const int cosine = kCosines[u][is_mirrored ? kSide - 1 - x : x];
        values[x][u] = kScale * (is_mirrored && u % 2 != 0 ? -cosine : cosine);
      }
    }
  }
  alignas(64) double values[kSide][kSide]{};
};
inline constexpr CosinesOfPixels kCosinesOfPixels;

}  // namespace thermedge::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Ints = hn::CappedTag<std::int32_t, kSide>;
using Doubles = hn::CappedTag<double, kSide>;

// Along the columns, which fits 32 bits: frequency v of column x to out[v][x].
HWY_INLINE void transform_columns(const std::uint16_t* block, std::ptrdiff_t stride,
                                  std::int32_t (*out)[kSide]) {
  const Ints d;
  const hn::Rebind<std::uint16_t, Ints> d16;
  for (int x = 0; x < kSide; x += static_cast<int>(hn::Lanes(d))) {
    hn::Vec<Ints> sums[kSide / 2];
    hn::Vec<Ints> differences[kSide / 2];
    for (int y = 0; y < kSide / 2; ++y) {
      const auto upper = hn::PromoteTo(d, hn::LoadU(d16, block + y * stride + x));
      const auto lower = hn::PromoteTo(d, hn::LoadU(d16, block + (kSide - 1 - y) * stride + x));
      sums[y] = upper + lower;
      differences[y] = upper - lower;
    }
    for (int v = 0; v < kSide; ++v) {
      const auto* half = v % 2 == 0 ? sums : differences;
      auto sum = hn::Zero(d);
      for (int y = 0; y < kSide / 2; ++y) {
        sum = sum + hn::Set(d, kCosines[v][y]) * half[y];
      }
      hn::Store(sum, d, out[v] + x);
    }
  }
}

void noise_block(const std::uint16_t* block, std::ptrdiff_t stride,
                 std::array<float, kNoiseBlockPx * kNoiseBlockPx>& out) {
  HWY_ALIGN std::int32_t columns[kSide][kSide];
  transform_columns(block, stride, columns);
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; u += static_cast<int>(hn::Lanes(d))) {
      auto sum = hn::Zero(d);
      for (int x = 0; x < kSide; ++x) {
        sum = sum + hn::Set(d, static_cast<double>(columns[v][x])) *
                        hn::Load(d, kCosinesOfPixels.values[x] + u);
      }
      hn::StoreU(hn::DemoteTo(df, sum), df, out.data() + v * kSide + u);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(noise_block);

void noise_block(const std::uint16_t* block, std::ptrdiff_t stride,
                 std::array<float, kNoiseBlockPx * kNoiseBlockPx>& out) {
  THERMEDGE_SIMD_DISPATCH(noise_block)(block, stride, out);
}

}  // namespace thermedge::detail
#endif
