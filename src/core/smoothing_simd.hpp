// Weighted sums of rows for Gaussian smoothing.
#pragma once

#include <cstddef>

namespace thermedge::detail {

inline constexpr int kPaperKernelRadius = 2;

// Elements of the widest vector. Rows shorter than this are written up to it; longer ones are not
// written past their end.
inline constexpr int kGaussianSlack = 16;

// One row of the 5x5 kernel of eq. 5:
//   out[x] = c + (sum of K(i, j) centre[x + i + j * stride] over |i|, |j| <= 2 - 159 c) / 159
// with c = centre[x]; written so, whole numbers that are constant stay exactly what they are.
// `wide` and `narrow` are scratch, each `width` + 4 long. `out` is not the input.
void paper_kernel_row(const float* centre, std::ptrdiff_t stride, int width, float* wide,
                      float* narrow, float* out);

// One row of a symmetric filter whose weights w(-radius) ... w(radius) have the sum 1:
//   out[x] = c + sum over k = 1 .. radius of w(k) ((centre[x - k step] - c) + (centre[x + k step] -
//   c))
// with c = centre[x]; written so, constants stay exactly what they are, and a large offset costs no
// precision. `out` is not the input.
void smooth_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                int width, float* out);

}  // namespace thermedge::detail
