// Random numbers that are the same on every machine: a hash of (seed, stream, index), and normal
// deviates built from + - * / and sqrt alone.
#pragma once

#include <cstdint>

namespace thermedge::sim {

// Natural logarithm of x > 0 to about 1e-13, from operations that IEEE 754 rounds alike everywhere.
[[nodiscard]] double exact_log(double x);

// A source of numbers that are found by index, so that pixels can be drawn in any order.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream);

  [[nodiscard]] std::uint64_t bits(std::uint64_t index) const;
  // In (0, 1).
  [[nodiscard]] double uniform(std::uint64_t index) const;
  [[nodiscard]] double uniform(std::uint64_t index, double low, double high) const;
  // Mean 0, standard deviation 1; Marsaglia's polar method.
  [[nodiscard]] double normal(std::uint64_t index) const;

 private:
  std::uint64_t key_;
};

}  // namespace thermedge::sim
