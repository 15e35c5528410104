// Sums of differences between the columns of a frame.
#pragma once

#include <array>
#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::detail {

inline constexpr std::array kLags = {1, 2, 3, 4, 6, 8};
inline constexpr int kLargestLag = kLags.back();
inline constexpr int kLargestLagDifference = 2047;

// Rows over which differences up to `limit` (1 .. kLargestLagDifference) can be added up within 16
// bits; even.
[[nodiscard]] constexpr int most_lag_rows(int limit) { return 32767 / limit / 2 * 2; }

// For each lag kLags[i] and 0 <= x < width - lag, over the rows (at most most_lag_rows) of `counts`
// in which the two pixels differ by no more than `limit` and reach(x, y / 2) (at most 32767) > lag:
//   sums(x, i) = sum of counts(x + lag, y) - counts(x, y), numbers(x, i) = how many rows these are.
// What the outputs hold at larger x means nothing. Both are kLags.size() rows. All are views of
// images: what lies after the last element, up to a vector of 64 bytes, is read and written.
void lag_sums(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach,
              int limit, ImageView<std::int16_t> sums, ImageView<std::int16_t> numbers);

}  // namespace thermedge::detail
