// Collaborative filtering of one group of blocks for BM3D.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bm3d_match_simd.hpp"
#include "thermedge/image.hpp"

namespace thermedge::detail {

// Where filtered blocks are added up: for each pixel, the sum of weight * window * value; for each
// top left corner of a block, the sum of weights. Row 0 is row `first_row` of the frame.
struct Accumulator {
  ImageView<float> sums;
  ImageView<float> weights;
  int first_row = 0;
};

// Weights of a block's pixels in the aggregation, row by row.
using BlockWindow = float[kBlockPx * kBlockPx];

// A number for each coefficient of a block, in the order in which transform_block leaves them.
using BlockCoefficients = float[kBlockPx * kBlockPx];

// `of_mean` is 0 for the coefficients of a group's mean that are always kept; its mean is one.
struct HardThresholds {
  BlockCoefficients all;
  BlockCoefficients of_mean;
};

// Stage 1 in units of the noise: 2-D bior1.5 wavelet of each block, Walsh-Hadamard transform along
// the group, coefficients not above their threshold set to 0, and back. The mean of the group is
// always kept, so an offset of the frame passes unchanged. Weight: 1 / number of coefficients kept.
// The size of the group is a power of two up to kLargestGroup.
void filter_hard(ImageView<const float> noisy, std::span<const BlockPosition> group,
                 const HardThresholds& thresholds, const BlockWindow& window,
                 const Accumulator& accumulator);

// Stage 2: 2-D DCT, Walsh-Hadamard transform, coefficients times e^2 / (e^2 + v) where e is the
// coefficient of the estimate `basic` and v the noise's variance (the group's mean times 1), and
// back. Weight: 1 / sum of the squared factors.
void filter_wiener(ImageView<const float> noisy, ImageView<const float> basic,
                   std::span<const BlockPosition> group, const BlockCoefficients& variances,
                   const BlockWindow& window, const Accumulator& accumulator);

enum class BlockTransform { kBior15, kDct };

// The 2-D transform of one block, or its inverse, in place; for tests. Coefficients come
// transposed: those of one horizontal frequency are consecutive.
void transform_block(BlockTransform transform, bool inverse, float* block);

}  // namespace thermedge::detail
