#include "bm3d_group_simd.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bm3d_group_simd.cpp"
#include "simd_config.hpp"
#include "simd_dispatch.hpp"
#include "simd_inline.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bm3d_transform-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace thermedge::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Coefficients are independent of each other, so they may sit in vectors of any width.
using F32 = hn::CappedTag<float, 16>;
using Floats = hn::Vec<F32>;
constexpr int kCoefficients = kBlockPx * kBlockPx;

// Coefficients of all blocks of a group, block by block.
struct alignas(64) Spectra {
  float* block(std::size_t index) { return values + index * kCoefficients; }
  float values[kLargestGroup * kCoefficients];
};

// Walsh-Hadamard transform of kSize vectors, not scaled: twice it multiplies by kSize.
template <int kSize>
THERMEDGE_KERNEL_INLINE void walsh_hadamard(Floats* v) {
  if constexpr (kSize > 1) {
    constexpr int kHalf = kSize / 2;
    THERMEDGE_KERNEL_UNROLL(16)
    for (int i = 0; i < kHalf; ++i) {
      const Floats a = v[i];
      const Floats b = v[i + kHalf];
      v[i] = a + b;
      v[i + kHalf] = a - b;
    }
    walsh_hadamard<kHalf>(v);
    walsh_hadamard<kHalf>(v + kHalf);
  }
}

template <int kSize>
THERMEDGE_KERNEL_INLINE void load_all(const float* coefficients, Floats* v) {
  THERMEDGE_KERNEL_UNROLL(32)
  for (int i = 0; i < kSize; ++i) {
    v[i] = hn::Load(F32(), coefficients + i * kCoefficients);
  }
  walsh_hadamard<kSize>(v);
}

template <int kSize>
THERMEDGE_KERNEL_INLINE void store_all(Floats* v, float* coefficients) {
  walsh_hadamard<kSize>(v);
  const Floats scale = hn::Set(F32(), 1.0F / kSize);
  THERMEDGE_KERNEL_UNROLL(32)
  for (int i = 0; i < kSize; ++i) {
    hn::Store(v[i] * scale, F32(), coefficients + i * kCoefficients);
  }
}

template <class Transform>
void transform_group(ImageView<const float> image, std::span<const BlockPosition> group,
                     Spectra& spectra) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    Block block;
    load_block(image.row(group[i].y) + group[i].x, image.stride(), block);
    forward_2d<Transform>(block);
    store_block(block, spectra.block(i), kBlockPx);
  }
}

// Transforms back and adds the blocks up.
template <class Transform>
void aggregate(Spectra& spectra, std::span<const BlockPosition> group, float weight,
               const BlockWindow& window, const Accumulator& accumulator) {
  const Row d;
  const auto weight_of_all = hn::Set(d, weight);
  Block scaled_window;
  load_block(window, kBlockPx, scaled_window);
  for (auto& part : scaled_window.part) {
    for (auto& row : part) {
      row = row * weight_of_all;
    }
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    Block block;
    load_block(spectra.block(i), kBlockPx, block);
    inverse_2d<Transform>(block);
    const int y = group[i].y - accumulator.first_row;
    float* sums = accumulator.sums.row(y) + group[i].x;
    Block sum;
    load_block(sums, accumulator.sums.stride(), sum);
    for (std::size_t p = 0; p < kRowParts; ++p) {
      THERMEDGE_KERNEL_UNROLL(8)
      for (int row = 0; row < 8; ++row) {
        sum.part[p][row] = sum.part[p][row] + block.part[p][row] * scaled_window.part[p][row];
      }
    }
    store_block(sum, sums, accumulator.sums.stride());
    accumulator.weights(group[i].x, y) += weight;
  }
}

// Returns the number of coefficients kept.
template <int kSize>
int shrink_hard(Spectra& spectra, const HardThresholds& thresholds) {
  const F32 d;
  const Floats scale = hn::Set(d, std::sqrt(static_cast<float>(kSize)));
  std::size_t kept = 0;
  for (int c = 0; c < kCoefficients; c += static_cast<int>(hn::Lanes(d))) {
    Floats v[kSize];
    const Floats threshold = hn::LoadU(d, thresholds.all + c) * scale;
    load_all<kSize>(spectra.values + c, v);
    const Floats mean = v[0];
    THERMEDGE_KERNEL_UNROLL(32)
    for (int i = 0; i < kSize; ++i) {
      const auto large = hn::Abs(v[i]) > threshold;
      kept += hn::CountTrue(d, large);
      v[i] = hn::IfThenElseZero(large, v[i]);
    }
    const auto always = hn::LoadU(d, thresholds.of_mean + c) == hn::Zero(d);
    kept += hn::CountTrue(d, hn::AndNot(hn::Abs(mean) > threshold, always));
    v[0] = hn::IfThenElse(always, mean, v[0]);
    store_all<kSize>(v, spectra.values + c);
  }
  return static_cast<int>(kept);
}

// The sum of `values` by halves: the same tree for every vector width.
inline float tree_sum(float* values) {
  for (int half = kCoefficients / 2; half > 0; half /= 2) {
    for (int i = 0; i < half; ++i) {
      values[i] += values[i + half];
    }
  }
  return values[0];
}

// Returns the sum of the squared factors.
template <int kSize>
float shrink_wiener(Spectra& noisy, const Spectra& basic, const BlockCoefficients& variances) {
  const F32 d;
  const Floats blocks = hn::Set(d, static_cast<float>(kSize));
  HWY_ALIGN float energy[kCoefficients];
  for (int c = 0; c < kCoefficients; c += static_cast<int>(hn::Lanes(d))) {
    const Floats noise = hn::LoadU(d, variances + c) * blocks;
    Floats factor[kSize];
    load_all<kSize>(basic.values + c, factor);
    THERMEDGE_KERNEL_UNROLL(32)
    for (int i = 0; i < kSize; ++i) {
      const Floats signal = factor[i] * factor[i];
      factor[i] = signal / (signal + noise);
    }
    if (c == 0) {
      factor[0] = hn::IfThenElse(hn::FirstN(d, 1), hn::Set(d, 1.0F), factor[0]);
    }
    Floats v[kSize];
    load_all<kSize>(noisy.values + c, v);
    Floats squares = hn::Zero(d);
    THERMEDGE_KERNEL_UNROLL(32)
    for (int i = 0; i < kSize; ++i) {
      squares = squares + factor[i] * factor[i];
      v[i] = v[i] * factor[i];
    }
    hn::Store(squares, d, energy + c);
    store_all<kSize>(v, noisy.values + c);
  }
  return tree_sum(energy);
}

void filter_hard(ImageView<const float> noisy, std::span<const BlockPosition> group,
                 const HardThresholds& thresholds, const BlockWindow& window,
                 const Accumulator& accumulator) {
  Spectra spectra;
  transform_group<Bior15>(noisy, group, spectra);
  int kept = 1;
  switch (group.size()) {
    case 1:
      kept = shrink_hard<1>(spectra, thresholds);
      break;
    case 2:
      kept = shrink_hard<2>(spectra, thresholds);
      break;
    case 4:
      kept = shrink_hard<4>(spectra, thresholds);
      break;
    case 8:
      kept = shrink_hard<8>(spectra, thresholds);
      break;
    case 16:
      kept = shrink_hard<16>(spectra, thresholds);
      break;
    default:
      kept = shrink_hard<32>(spectra, thresholds);
      break;
  }
  aggregate<Bior15>(spectra, group, 1.0F / static_cast<float>(kept), window, accumulator);
}

void filter_wiener(ImageView<const float> noisy, ImageView<const float> basic,
                   std::span<const BlockPosition> group, const BlockCoefficients& variances,
                   const BlockWindow& window, const Accumulator& accumulator) {
  Spectra spectra;
  Spectra guide;
  transform_group<Dct>(noisy, group, spectra);
  transform_group<Dct>(basic, group, guide);
  float energy = 1;
  switch (group.size()) {
    case 1:
      energy = shrink_wiener<1>(spectra, guide, variances);
      break;
    case 2:
      energy = shrink_wiener<2>(spectra, guide, variances);
      break;
    case 4:
      energy = shrink_wiener<4>(spectra, guide, variances);
      break;
    case 8:
      energy = shrink_wiener<8>(spectra, guide, variances);
      break;
    case 16:
      energy = shrink_wiener<16>(spectra, guide, variances);
      break;
    default:
      energy = shrink_wiener<32>(spectra, guide, variances);
      break;
  }
  aggregate<Dct>(spectra, group, 1.0F / energy, window, accumulator);
}

template <class Transform>
void transform_one(bool inverse, float* coefficients) {
  Block block;
  load_block(coefficients, kBlockPx, block);
  inverse ? inverse_2d<Transform>(block) : forward_2d<Transform>(block);
  store_block(block, coefficients, kBlockPx);
}

void transform_block(BlockTransform transform, bool inverse, float* block) {
  transform == BlockTransform::kDct ? transform_one<Dct>(inverse, block)
                                    : transform_one<Bior15>(inverse, block);
}

}  // namespace HWY_NAMESPACE
}  // namespace thermedge::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace thermedge::detail {

HWY_EXPORT(filter_hard);
HWY_EXPORT(filter_wiener);
HWY_EXPORT(transform_block);

void filter_hard(ImageView<const float> noisy, std::span<const BlockPosition> group,
                 const HardThresholds& thresholds, const BlockWindow& window,
                 const Accumulator& accumulator) {
  THERMEDGE_SIMD_DISPATCH(filter_hard)(noisy, group, thresholds, window, accumulator);
}

void filter_wiener(ImageView<const float> noisy, ImageView<const float> basic,
                   std::span<const BlockPosition> group, const BlockCoefficients& variances,
                   const BlockWindow& window, const Accumulator& accumulator) {
  THERMEDGE_SIMD_DISPATCH(filter_wiener)(noisy, basic, group, variances, window, accumulator);
}

void transform_block(BlockTransform transform, bool inverse, float* block) {
  THERMEDGE_SIMD_DISPATCH(transform_block)(transform, inverse, block);
}

}  // namespace thermedge::detail
#endif
