// Quantiles of the counts of a frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::detail {

// For each of the ascending `shares` (0..1) the count of rank floor(share * (n - 1)), so each is a
// count that occurs. The frame has pixels. O(pixels), no allocation after the first call on a
// thread.
template <std::size_t N>
std::array<int, N> count_quantiles(ImageView<const std::uint16_t> frame,
                                   const std::array<double, N>& shares) {
  constexpr std::size_t kCountValues = std::numeric_limits<std::uint16_t>::max() + std::size_t{1};
  thread_local std::vector<std::uint32_t> histogram;
  histogram.assign(kCountValues, 0);
  for (int y = 0; y < frame.height(); ++y) {
    const std::uint16_t* row = frame.row(y);
    for (int x = 0; x < frame.width(); ++x) {
      ++histogram[row[x]];
    }
  }
  std::array<int, N> quantiles{};
  std::size_t counts = 0;
  std::size_t below = histogram[0];  // pixels of at most `counts`
  for (std::size_t i = 0; i < N; ++i) {
    const auto rank = static_cast<std::size_t>(shares[i] * static_cast<double>(frame.size() - 1));
    while (below <= rank) {
      below += histogram[++counts];
    }
    quantiles[i] = static_cast<int>(counts);
  }
  return quantiles;
}

}  // namespace thermedge::detail
