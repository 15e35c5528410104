// The element of a given rank, for samples of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace thermedge::detail {

// Moves what `belongs` wants to the front; returns how many. Without branches on the values, which
// nothing could predict.
template <class T, class F>
std::size_t move_to_front(std::span<T> values, F&& belongs) {
  std::size_t count = 0;
  for (T& value : values) {
    const T moved = value;
    value = values[count];
    values[count] = moved;
    count += belongs(moved) ? 1 : 0;
  }
  return count;
}

template <class T>
T median_of_three(T a, T b, T c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// The value of rank `n` (0: the smallest), n < values.size(); no NaN. Reorders the values.
// Hoare's selection; where its pivots are bad, the standard library's, which has a bound.
template <class T>
T nth_value(std::span<T> values, std::size_t n) {
  constexpr int kMostRounds = 40;
  constexpr std::size_t kFew = 16;
  for (int round = 0; round < kMostRounds && values.size() > kFew; ++round) {
    const std::size_t size = values.size();
    const T pivot = median_of_three(values[size / 4], values[size / 2], values[size - size / 4]);
    const std::size_t less = move_to_front(values, [=](T value) { return value < pivot; });
    if (n < less) {
      values = values.first(less);
      continue;
    }
    values = values.subspan(less);
    n -= less;
    const std::size_t equal = move_to_front(values, [=](T value) { return !(pivot < value); });
    if (n < equal) {
      return pivot;
    }
    values = values.subspan(equal);
    n -= equal;
  }
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace thermedge::detail
