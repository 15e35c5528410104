// Responses of oriented kernels.
#pragma once

#include <cstddef>
#include <cstdint>

namespace thermedge::detail {

inline constexpr int kOrientedSlack = 16;  // elements that may be read and written behind the last

// out[x] = sum over k = 1 .. radius of weights[k] (centre[x + k step] - centre[x - k step]).
void odd_filter_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                    int width, float* out);

// out[x] = sqrt(gx[x]^2 + gy[x]^2).
void magnitude_row(const float* gx, const float* gy, int width, float* out);

// out[x] = a gx[x] + b gy[x].
void project_row(const float* gx, const float* gy, float a, float b, int width, float* out);

// Sums along a line of pixels: weights[0] centre[x] + sum over k of weights[k] (centre[x +
// offsets[k]] + centre[x - offsets[k]]). Where its size is above strength[x], that becomes the size
// and direction[x] becomes `index`, or index + reverse where the sum is negative.
void keep_stronger_row(const float* centre, const std::ptrdiff_t* offsets, const float* weights,
                       int radius, int index, int reverse, int width, float* strength,
                       std::int32_t* direction);

}  // namespace thermedge::detail
