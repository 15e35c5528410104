// Samples along and across a run of edgels, in double precision.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::detail {

inline constexpr int kMostEdgels = 64;

// Positions and normals.
struct EdgelRun {
  const float* x;
  const float* y;
  const float* nx;
  const float* ny;
  int count;  // 0 .. kMostEdgels
};

// out[i] = counts `distance_px` ahead along the normal of edgel i less those as far behind it, both
// bilinear; NaN where one of them has not four pixels of the frame around it. Reads and writes
// exactly `count` elements.
void differences_across(ImageView<const std::uint16_t> frame, const EdgelRun& edgels,
                        double distance_px, double* out);

// Half the width of the kernel below.
inline constexpr int kTangentReach = 9;

// out[i] = derivative of a coordinate along a curve, times a constant: the central difference of
// the curve smoothed by the binomial weights of order 16 (sigma 2), both in one odd kernel. Reads
// kTangentReach elements to either side of the `count`.
void tangents(const float* coordinate, int count, double* out);

// Weights of that kernel of the elements 1, 2, ... ahead; those behind have the negative.
inline constexpr double kTangentWeights[kTangentReach] = {4862, 7072, 6188, 3808, 1700,
                                                          544,  119,  16,   1};

// out[i] = sum of weights[k] values[i + k] over the `taps` weights, added from the last to the
// first. Reads count + taps - 1 values, writes exactly `count`.
void backward_sums(const double* values, const double* weights, int taps, int count, double* out);

}  // namespace thermedge::detail
