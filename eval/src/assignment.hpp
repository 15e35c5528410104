// Best one-to-one assignment of rows to columns where few pairs are possible.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace thermedge::eval {

struct PossiblePair {
  std::int32_t row = 0, column = 0;
  double gain = 0;  // above 0
};

// The column of each row, -1: none, such that the sum of the gains is largest. `pairs`: in the
// order of their rows, each pair once. Thread-safe. Successive shortest paths (Jonker & Volgenant
// 1987) on the pairs that there are.
[[nodiscard]] std::vector<std::int32_t> best_assignment(const std::vector<PossiblePair>& pairs,
                                                        std::size_t rows, std::size_t columns);

}  // namespace thermedge::eval
