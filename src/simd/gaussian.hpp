// Weighted sums of rows for Gaussian smoothing.
#pragma once

#include <cstddef>

namespace thermedge::detail {

inline constexpr int kPaperKernelRadius = 2;

// One row of the 5x5 kernel of eq. 5:
//   out[x] = sum of K(i, j) centre[x + i + j * stride] / 159 over |i|, |j| <= 2.
// Exact but for the division where pixels are integers below 2^16. Works on whole vectors of up to
// 64 bytes: reads and writes that far past the last element.
void paper_kernel_row(const float* centre, std::ptrdiff_t stride, int width, float* out);

// One row of a symmetric filter whose weights w(-radius) ... w(radius) have the sum 1:
//   out[x] = c + sum over k = 1 .. radius of w(k) ((centre[x - k step] - c) + (centre[x + k step] -
//   c))
// with c = centre[x]; written so, constants stay exactly what they are, and a large offset costs no
// precision. Vectors as above.
void smooth_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                int width, float* out);

}  // namespace thermedge::detail
