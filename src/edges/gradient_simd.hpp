// Sobel gradients and their magnitude.
#pragma once

namespace thermedge::detail {

// Three rows of a picture with a border of one pixel: `above[x]`, `row[x]` and `below[x]` lie to
// the left of the pixel x of the result.
struct BorderedRows {
  const float* above;
  const float* row;
  const float* below;
};

// Sobel gradients (paper eq. 6) and magnitude sqrt(gx^2 + gy^2) (eq. 7) of `width` pixels. The sums
// are ordered such that flipping or transposing the picture flips or transposes the result bit by
// bit. Returns the largest magnitude, or infinity where one of them is infinite or NaN.
// Reads up to width + 2 and writes up to width elements, rounded up to a vector of 64 bytes.
[[nodiscard]] float sobel_row(const BorderedRows& rows, int width, float* gx, float* gy,
                              float* magnitude);

}  // namespace thermedge::detail
