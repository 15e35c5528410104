// Responses of oriented kernels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge::detail {

inline constexpr int kFilterSlack = 16;  // elements that may be read and written after the last
inline constexpr int kLargestTurn = kEdgeDirections / 8;  // 45 degrees: directions that agree

// out[x] = sum over k = 1 .. radius of weights[k] (centre[x + k step] - centre[x - k step]).
void odd_filter_row(const float* centre, std::ptrdiff_t step, const float* weights, int radius,
                    int width, float* out);

// out[x] = sqrt(gx[x]^2 + gy[x]^2).
void magnitude_row(const float* gx, const float* gy, int width, float* out);

// out[x] = a gx[x] + b gy[x].
void project_row(const float* gx, const float* gy, float a, float b, int width, float* out);

// Sums along a line of pixels: weights[0] centre[x] + sum over k of weights[k] (centre[x +
// offsets[k]] + centre[x - offsets[k]]). Where its size is above response[x], that becomes the size
// and direction[x] becomes `index`, or index + reverse where the sum is negative. With index 0,
// which comes first, it is so everywhere, whatever response and direction held.
void keep_stronger_row(const float* centre, const std::ptrdiff_t* offsets, const float* weights,
                       int radius, int index, int reverse, int width, float* response,
                       std::int32_t* direction);

// Directions of edges are 0 .. kEdgeDirections - 1, in steps of 15 degrees; those kEdgeOrientations
// apart have their sides swapped. The share of the diagonal neighbour by how far a direction is off
// an axis: 0, 15, 30, 45 degrees.
using DiagonalShares = std::array<float, 4>;

// Writes to `places`, in ascending order, those x of 0 .. count - 1 at which response[x] > low is
// not less than the response one pixel ahead across the edge and more than that behind, between two
// neighbours each. Rows of response are `stride` apart. Returns how many. Writes up to a vector
// after the last.
[[nodiscard]] int find_ridges_row(const float* response, std::ptrdiff_t stride,
                                  const std::int32_t* direction, const DiagonalShares& shares,
                                  float low, int count, std::int32_t* places);

// out[i] = the response at places[i] less half of the least sum of both sides, over `sides` pairs
// of them, side k of a direction at +-offsets[kEdgeDirections k + direction]. A side whose
// direction is off by more than 45 degrees counts as 0. `places` and `out` are read and written up
// to a vector after the last.
void suppressed_responses_at(const float* response, const std::int32_t* direction,
                             const std::int32_t* offsets, int sides, const std::int32_t* places,
                             int count, float* out);

}  // namespace thermedge::detail
