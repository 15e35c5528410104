// Pixels that stand out of their eight neighbours.
#pragma once

#include <vector>

#include "highpass_simd.hpp"
#include "thermedge/stages/bad_pixels.hpp"

namespace thermedge::detail {

// Appends those of the pixels 1 .. width - 2 of the middle row, which is row `y` of the frame, that
// are more than `limit` (0 .. 65535) above the second largest or below the second smallest of their
// eight neighbours. Reads exactly `width` elements of each row, at least 3.
void append_outliers(const CountRows& rows, int width, int y, int limit,
                     std::vector<BadPixel>& outliers);

}  // namespace thermedge::detail
