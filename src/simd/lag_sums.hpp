// Sums of differences between the columns of a frame.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::detail {

inline constexpr int kMostLagRows = 16;
// So that the sum over kMostLagRows stays within 16 bits.
inline constexpr int kLargestLagDifference = 2047;

// For 0 <= x < width - lag, over the rows (at most kMostLagRows) of `counts` in which the two
// pixels differ by no more than `limit` (at most kLargestLagDifference) and reach(x, y / 2) > lag:
//   sums[x] = sum of counts(x + lag, y) - counts(x, y), numbers[x] = how many rows these are.
// Reads and writes up to a vector of 64 bytes behind the last element.
void lag_sums(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach, int lag,
              int limit, std::int16_t* sums, std::int16_t* numbers);

}  // namespace thermedge::detail
