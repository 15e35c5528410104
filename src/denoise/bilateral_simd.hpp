// Rows of a one-dimensional bilateral filter.
#pragma once

#include <cstddef>

namespace thermedge::detail {

inline constexpr int kBilateralSlack = 16;  // elements that may be read and written after the last

// out[x] = c + sum over |k| = 1 .. radius of w (v - c) / (1 + sum of w), where c = centre[x], v =
// centre[x + k step], w = weights[|k|] max(1 - (v - c)^2 / cut^2, 0)^4. `out` is not the input.
void bilateral_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                   float cut, int width, float* out);

}  // namespace thermedge::detail
