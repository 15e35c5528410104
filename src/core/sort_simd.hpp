// Sorting of short lists of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace thermedge::detail {

// Up to so many values are sorted by counting for each how many come before it, which takes no
// branch that depends on them; the work grows with the square of their number.
inline constexpr std::size_t kFewValues = 64;

// Sorts up to kFewValues values, ascending; none is NaN.
void sort_few(std::span<double> values);

// Any number of them.
inline void sort_values(std::span<double> values) {
  values.size() <= kFewValues ? sort_few(values) : std::sort(values.begin(), values.end());
}

}  // namespace thermedge::detail
