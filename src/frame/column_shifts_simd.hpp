// Columns of a frame against each other: medians of neighbours' differences, and whole shifts.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::detail {

inline constexpr int kMedianSteps = 256;  // of the search for a median
inline constexpr int kLargestMedianUnit = 32767 / kMedianSteps;

// medians[x] = the median of counts(x + 1, y) - counts(x, y) over the rows that are a multiple of
// `row_step` away from the nearer end of the column, rounded to odd multiples of unit / 2 (rounded
// down) within kMedianSteps / 2 units (1 .. kLargestMedianUnit), for 0 <= x < width - 1. `counts`
// is a view of an image: up to a vector of 64 bytes after a row's end is read. `medians` has as
// many elements as a row's width and a vector more. At most 32767 rows are looked at.
void neighbour_medians(ImageView<const std::uint16_t> counts, int row_step, int unit,
                       std::int16_t* medians);

// counts(x, y) = counts(x, y) - down[x] + up[x], both within 0 .. 65535; a view of an image, of
// which up to a vector after a row's end is written. The arrays are as long as that.
void shift_columns(const std::uint16_t* down, const std::uint16_t* up,
                   ImageView<std::uint16_t> counts);

}  // namespace thermedge::detail
