// 8 x 8 block transforms, for each SIMD target.
#if defined(THERMEDGE_SIMD_BM3D_TRANSFORM_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef THERMEDGE_SIMD_BM3D_TRANSFORM_INL_HPP
#undef THERMEDGE_SIMD_BM3D_TRANSFORM_INL_HPP
#else
#define THERMEDGE_SIMD_BM3D_TRANSFORM_INL_HPP
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <utility>

#include "simd_inline.hpp"

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Row = hn::CappedTag<float, 8>;
using RowVec = hn::Vec<Row>;
constexpr std::size_t kRowLanes = hn::MaxLanes(Row());
constexpr std::size_t kRowParts = 8 / kRowLanes;

// A block in registers: parts side by side, each 8 rows of a vector. A transform along the columns
// is one of 8 vectors, whatever their width, so every target does the same operations.
struct Block {
  RowVec part[kRowParts][8];
};

THERMEDGE_KERNEL_INLINE void load_block(const float* from, std::ptrdiff_t stride, Block& block) {
  THERMEDGE_KERNEL_UNROLL(8)
  for (int y = 0; y < 8; ++y) {
    for (std::size_t p = 0; p < kRowParts; ++p) {
      block.part[p][y] = hn::LoadU(Row(), from + y * stride + p * kRowLanes);
    }
  }
}

THERMEDGE_KERNEL_INLINE void store_block(const Block& block, float* to, std::ptrdiff_t stride) {
  THERMEDGE_KERNEL_UNROLL(8)
  for (int y = 0; y < 8; ++y) {
    for (std::size_t p = 0; p < kRowParts; ++p) {
      hn::StoreU(block.part[p][y], Row(), to + y * stride + p * kRowLanes);
    }
  }
}

#if HWY_TARGET == HWY_SCALAR

THERMEDGE_KERNEL_INLINE void transpose(Block& block) {
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < y; ++x) {
      std::swap(block.part[x][y], block.part[y][x]);
    }
  }
}

#else

// Transposes the 4 x 4 squares of four rows.
THERMEDGE_KERNEL_INLINE void transpose_squares(const RowVec* in, RowVec* out) {
  const Row d;
  const hn::Repartition<double, Row> d64;
  const auto low01 = hn::BitCast(d64, hn::InterleaveLower(d, in[0], in[1]));
  const auto high01 = hn::BitCast(d64, hn::InterleaveUpper(d, in[0], in[1]));
  const auto low23 = hn::BitCast(d64, hn::InterleaveLower(d, in[2], in[3]));
  const auto high23 = hn::BitCast(d64, hn::InterleaveUpper(d, in[2], in[3]));
  out[0] = hn::BitCast(d, hn::InterleaveLower(d64, low01, low23));
  out[1] = hn::BitCast(d, hn::InterleaveUpper(d64, low01, low23));
  out[2] = hn::BitCast(d, hn::InterleaveLower(d64, high01, high23));
  out[3] = hn::BitCast(d, hn::InterleaveUpper(d64, high01, high23));
}

THERMEDGE_KERNEL_INLINE void transpose(Block& block) {
  RowVec top[kRowParts][4];
  RowVec bottom[kRowParts][4];
  for (std::size_t p = 0; p < kRowParts; ++p) {
    transpose_squares(block.part[p], top[p]);
    transpose_squares(block.part[p] + 4, bottom[p]);
  }
  THERMEDGE_KERNEL_UNROLL(4)
  for (int i = 0; i < 4; ++i) {
    if constexpr (kRowParts == 1) {
      block.part[0][i] = hn::ConcatLowerLower(Row(), bottom[0][i], top[0][i]);
      block.part[0][i + 4] = hn::ConcatUpperUpper(Row(), bottom[0][i], top[0][i]);
    } else {
      block.part[0][i] = top[0][i];
      block.part[1][i] = bottom[0][i];
      block.part[0][i + 4] = top[1][i];
      block.part[1][i + 4] = bottom[1][i];
    }
  }
}

#endif

HWY_INLINE RowVec times(float factor, RowVec x) { return hn::Set(Row(), factor) * x; }

// The orthonormal DCT-II of 8 samples, even and odd frequencies apart:
//   X(k) = a(k) sum over n of x(n) cos(pi (2 n + 1) k / 16), a(0) = sqrt(1/8), else a(k) = 1/2.
struct Dct {
  static constexpr float kC1 = 0.490392640F;  // kCn = cos(n pi / 16) / 2
  static constexpr float kC2 = 0.461939766F;
  static constexpr float kC3 = 0.415734806F;
  static constexpr float kC4 = 0.353553391F;
  static constexpr float kC5 = 0.277785117F;
  static constexpr float kC6 = 0.191341716F;
  static constexpr float kC7 = 0.0975451610F;

  static THERMEDGE_KERNEL_INLINE void forward(RowVec* x) {
    const auto s0 = x[0] + x[7];
    const auto s1 = x[1] + x[6];
    const auto s2 = x[2] + x[5];
    const auto s3 = x[3] + x[4];
    const auto d0 = x[0] - x[7];
    const auto d1 = x[1] - x[6];
    const auto d2 = x[2] - x[5];
    const auto d3 = x[3] - x[4];
    const auto even = s0 + s3;
    const auto odd = s1 + s2;
    x[0] = times(kC4, even + odd);
    x[4] = times(kC4, even - odd);
    x[2] = times(kC2, s0 - s3) + times(kC6, s1 - s2);
    x[6] = times(kC6, s0 - s3) - times(kC2, s1 - s2);
    x[1] = (times(kC1, d0) + times(kC3, d1)) + (times(kC5, d2) + times(kC7, d3));
    x[3] = (times(kC3, d0) - times(kC7, d1)) - (times(kC1, d2) + times(kC5, d3));
    x[5] = (times(kC5, d0) - times(kC1, d1)) + (times(kC7, d2) + times(kC3, d3));
    x[7] = (times(kC7, d0) - times(kC5, d1)) + (times(kC3, d2) - times(kC1, d3));
  }

  static THERMEDGE_KERNEL_INLINE void inverse(RowVec* x) {
    const auto even = times(kC4, x[0] + x[4]);
    const auto odd = times(kC4, x[0] - x[4]);
    const auto even2 = times(kC2, x[2]) + times(kC6, x[6]);
    const auto odd2 = times(kC6, x[2]) - times(kC2, x[6]);
    const auto s0 = even + even2;
    const auto s3 = even - even2;
    const auto s1 = odd + odd2;
    const auto s2 = odd - odd2;
    const auto d0 = (times(kC1, x[1]) + times(kC3, x[3])) + (times(kC5, x[5]) + times(kC7, x[7]));
    const auto d1 = (times(kC3, x[1]) - times(kC7, x[3])) - (times(kC1, x[5]) + times(kC5, x[7]));
    const auto d2 = (times(kC5, x[1]) - times(kC1, x[3])) + (times(kC7, x[5]) + times(kC3, x[7]));
    const auto d3 = (times(kC7, x[1]) - times(kC5, x[3])) + (times(kC3, x[5]) - times(kC1, x[7]));
    x[0] = s0 + d0;
    x[7] = s0 - d0;
    x[1] = s1 + d1;
    x[6] = s1 - d1;
    x[2] = s2 + d2;
    x[5] = s2 - d2;
    x[3] = s3 + d3;
    x[4] = s3 - d3;
  }
};

// The biorthogonal spline wavelet 1.5 on 8 periodic samples, three levels. The low-pass filter is
//   (3 -3 -22 22 128 128 22 -22 -3 3) sqrt(2) / 256, the high-pass filter (1 -1) / sqrt(2).
// As lifting: the pair sums S(i) = x(2i) + x(2i+1) are corrected by the pair differences
// D(i) = x(2i) - x(2i+1): S(i) - 11/64 (D(i-1) - D(i+1)) + 3/128 (D(i-2) - D(i+2)). On 8 periodic
// samples D(i-2) = D(i+2), and at the levels of 4 and 2 samples the other term vanishes likewise,
// so these are Haar steps. Order: mean, level 3, level 2 (two), level 1 (four).
struct Bior15 {
  static constexpr float kC = 11.0F / 64.0F;
  static constexpr float kMean = 0.353553391F;    // 1 / sqrt(8)
  static constexpr float kLevel3 = 0.353553391F;  // 1 / sqrt(8)
  static constexpr float kLevel2 = 0.5F;
  static constexpr float kLevel1 = 0.707106781F;  // 1 / sqrt(2)

  static THERMEDGE_KERNEL_INLINE void forward(RowVec* x) {
    const auto d0 = x[0] - x[1];
    const auto d1 = x[2] - x[3];
    const auto d2 = x[4] - x[5];
    const auto d3 = x[6] - x[7];
    const auto s0 = x[0] + x[1];
    const auto s1 = x[2] + x[3];
    const auto s2 = x[4] + x[5];
    const auto s3 = x[6] + x[7];
    const auto u = d3 - d1;  // of pair 0; pair 2 has -u
    const auto v = d0 - d2;  // of pair 1; pair 3 has -v
    const auto correction = times(kC, u - v);
    const auto left = s0 + s1;
    const auto right = s2 + s3;
    x[0] = times(kMean, left + right);
    x[1] = times(kLevel3, (left - right) - times(2 * kC, u + v));
    x[2] = times(kLevel2, (s0 - s1) - correction);
    x[3] = times(kLevel2, (s2 - s3) + correction);
    x[4] = times(kLevel1, d0);
    x[5] = times(kLevel1, d1);
    x[6] = times(kLevel1, d2);
    x[7] = times(kLevel1, d3);
  }

  // Each step of `forward` undone; the halves of sums and differences sit in the factors.
  static THERMEDGE_KERNEL_INLINE void inverse(RowVec* x) {
    const auto d0 = times(0.5F / kLevel1, x[4]);
    const auto d1 = times(0.5F / kLevel1, x[5]);
    const auto d2 = times(0.5F / kLevel1, x[6]);
    const auto d3 = times(0.5F / kLevel1, x[7]);
    const auto u = d3 - d1;
    const auto v = d0 - d2;
    const auto correction = times(0.5F * kC, u - v);
    const auto mean = times(0.125F / kMean, x[0]);
    const auto half = times(0.125F / kLevel3, x[1]) + times(0.5F * kC, u + v);
    const auto left = mean + half;
    const auto right = mean - half;
    const auto left_half = times(0.25F / kLevel2, x[2]) + correction;
    const auto right_half = times(0.25F / kLevel2, x[3]) - correction;
    const auto s0 = left + left_half;
    const auto s1 = left - left_half;
    const auto s2 = right + right_half;
    const auto s3 = right - right_half;
    x[0] = s0 + d0;
    x[1] = s0 - d0;
    x[2] = s1 + d1;
    x[3] = s1 - d1;
    x[4] = s2 + d2;
    x[5] = s2 - d2;
    x[6] = s3 + d3;
    x[7] = s3 - d3;
  }
};

// Columns, transposition, rows: coefficients come out transposed.
template <class Transform>
THERMEDGE_KERNEL_INLINE void forward_2d(Block& block) {
  for (auto& part : block.part) {
    Transform::forward(part);
  }
  transpose(block);
  for (auto& part : block.part) {
    Transform::forward(part);
  }
}

template <class Transform>
THERMEDGE_KERNEL_INLINE void inverse_2d(Block& block) {
  for (auto& part : block.part) {
    Transform::inverse(part);
  }
  transpose(block);
  for (auto& part : block.part) {
    Transform::inverse(part);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#endif
