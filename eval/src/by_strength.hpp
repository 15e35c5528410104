// Order of things that have a strength of 8 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace thermedge::eval {

// The indices of `strengths`, weakest first; equally strong ones keep their order (counting sort).
[[nodiscard]] inline std::vector<std::int32_t> weakest_first(
    const std::vector<std::uint8_t>& strengths) {
  std::array<std::size_t, 257> begins{};
  for (const std::uint8_t strength : strengths) {
    ++begins[strength + std::size_t{1}];
  }
  for (std::size_t i = 1; i < begins.size(); ++i) {
    begins[i] += begins[i - 1];
  }
  std::vector<std::int32_t> order(strengths.size());
  for (std::size_t i = 0; i < strengths.size(); ++i) {
    order[begins[strengths[i]]++] = static_cast<std::int32_t>(i);
  }
  return order;
}

}  // namespace thermedge::eval
