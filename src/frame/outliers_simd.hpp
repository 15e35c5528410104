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

// Whether a block of 2x2 pixels, of the middle two of four rows, may be off by more than `limit`
// from all pixels around: false only where none is. Blocks that touch a border are left out.
[[nodiscard]] bool any_block_stands_out(const std::array<const std::uint16_t*, 4>& rows, int width,
                                        int limit);

}  // namespace thermedge::detail
