// Non-maximum suppression of gradient magnitudes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace thermedge::detail {

// What a pixel is before hysteresis has decided.
enum PixelClass : std::uint8_t { kNoEdge = 0, kWeakEdge = 1, kStrongEdge = 2 };

// The pixel 1 of a row of gradients; the pixels around it in `magnitude` are `stride` apart.
struct GradientRow {
  const float* gx;
  const float* gy;
  const float* magnitude;
  std::ptrdiff_t stride;
};

// Classifies `count` pixels. The direction of the gradient is rounded to 0, 45, 90 or 135 degrees
// (paper eq. 8); a pixel whose magnitude is not > that of the neighbour before it and >= that of
// the neighbour behind it, in reading order, is no edge; the others are weak above `low` and strong
// above `high`. Reads and writes up to `count` elements rounded up to a vector of 64 bytes.
void suppress_row(const GradientRow& row, int count, float low, float high, std::uint8_t* classes);

// out[i] = largest of the `taps` values in[i + k step], 0 <= k < taps. Reads and writes up to
// `count` elements rounded up to a vector of 64 bytes.
void largest_row(const float* in, std::ptrdiff_t step, int taps, int count, float* out);

}  // namespace thermedge::detail
