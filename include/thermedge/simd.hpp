// Which instruction set the kernels use. All give bit-identical results; the choice is for tests
// and for measuring.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "thermedge/result.hpp"

namespace thermedge {

// Names of the instruction sets that this library contains and this CPU runs, best first,
// e.g. {"AVX3", "AVX2", "SSE4", "SCALAR"}.
[[nodiscard]] std::vector<std::string> simd_targets();

// One of them; by default the best.
class SimdTarget {
 public:
  SimdTarget();
  // By name (case does not matter), or "auto" for the best. Fails with the list of targets where
  // the name is not among them. Thread-safe.
  [[nodiscard]] static Result<SimdTarget> named(std::string_view name);
  [[nodiscard]] std::string name() const;

 private:
  friend class SimdScope;
  explicit SimdTarget(std::size_t place) : place_(place) {}
  std::size_t place_;  // in simd_targets()
};

// While it lives, kernels called on this thread use one target; afterwards the one before. The
// runners of make_runner hand it on to the threads that they run tasks on.
class SimdScope {
 public:
  explicit SimdScope(SimdTarget target);
  SimdScope(const SimdScope&) = delete;
  SimdScope& operator=(const SimdScope&) = delete;
  ~SimdScope();

  // The target of this thread.
  [[nodiscard]] static SimdTarget current();

 private:
  SimdTarget before_;
};

}  // namespace thermedge
