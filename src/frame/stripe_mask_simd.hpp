// Rows of the picture in which the edges are found that stripes must not be measured across. All
// in whole numbers. Kernels read and write up to `count` elements rounded up to a vector of 64
// bytes of 32-bit numbers, so up to 15 elements after the last.
#pragma once

#include <cstddef>
#include <cstdint>

namespace thermedge::detail {

// sums[i] = 2 (the four pixels of square i of two rows) - 2 of_columns[i] - of_row.
void square_row(const std::uint16_t* upper, const std::uint16_t* lower,
                const std::int32_t* of_columns, std::int32_t of_row, int count, std::int32_t* sums);

// out[i] = [1 4 6 4 1] of the elements around centre[i] that are `step` apart. `out` is not the
// input.
void binomial_row(const std::int32_t* centre, std::ptrdiff_t step, int count, std::int32_t* out);

// out[i] = ahead[i] - behind[i], within +-most.
void clamped_difference_row(const std::int32_t* ahead, const std::int32_t* behind,
                            std::int32_t most, int count, std::int32_t* out);

// out[i] = before[i] + added[i] - dropped[i]; `out` may be `before`.
void slide_row(const std::int32_t* before, const std::int32_t* added, const std::int32_t* dropped,
               int count, std::int32_t* out);

// marks[i] |= |values[i]| > limit.
void mark_beyond_row(const std::int32_t* values, std::int32_t limit, int count,
                     std::uint8_t* marks);

// upright[i] = |gx| > limit, level[i] = |gy| > limit, by Sobel around centre[i].
void mark_gradients_row(const std::int32_t* centre, std::ptrdiff_t stride, std::int32_t limit,
                        int count, std::uint8_t* upright, std::uint8_t* level);

// Least distances that reach_row doesn't tell apart: of even and of odd pixels.
inline constexpr int kFarSquares = 5;

// reach[x] for the 2 count pixels of `count` squares: how far to the right the next pixel of a
// marked square is, 0 within one; 2 kFarSquares - 1 or more stands for all that is as far or
// farther. Behind the last square there are kFarSquares unmarked ones.
void reach_row(const std::uint8_t* marks, int count, std::uint16_t* reach);

// counts[x] = counts[x] - of_columns[x] - of_row, rounded, within 0 .. 65535. Reads and writes
// exactly `width` elements.
void subtract_offsets_row(const float* of_columns, float of_row, int width, std::uint16_t* counts);
// The same without offsets of columns.
void subtract_offset_row(float of_row, int width, std::uint16_t* counts);

}  // namespace thermedge::detail
