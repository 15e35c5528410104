// Second differences of counts, and medians over the columns of a table.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::detail {

struct CountRows {
  const std::uint16_t* above;
  const std::uint16_t* row;
  const std::uint16_t* below;
};

// For pixels 1 .. width - 2 of the middle row, at index 0 of the outputs, both saturated at 65535:
// residual = |[1 -2 1] x [1 -2 1]| (6 times the noise; zero on planes, columns and rows),
// slope = |gx| + |gy| by Sobel. For white Gaussian noise the two are independent at a pixel.
// Reads up to width and writes up to width - 2 elements, rounded up to a vector of 64 bytes.
void highpass_row(const CountRows& rows, int width, std::uint16_t* residual, std::uint16_t* slope);

// Median over the rows of each column of `table`, interpolated within the integer on which it falls
// (which stands for the interval from -0.5 to +0.5 around it). Values within +-2^18.
// Writes width elements, rounded up to a vector of 64 bytes.
void column_medians(ImageView<const std::int32_t> table, float* medians);

}  // namespace thermedge::detail
