// Which instruction set the kernels use. All give bit-identical results; the choice is for tests
// and for measuring.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "thermedge/result.hpp"

namespace thermedge {

// Names of the targets that this program contains and this CPU runs, best first,
// e.g. {"AVX3", "AVX2", "SSE4", "SCALAR"}.
[[nodiscard]] std::vector<std::string> simd_targets();

// Selects a target for the whole process by name (case does not matter), or "auto" for the best.
// Fails with the list of targets where the name is not among them.
// Not thread-safe: call it while no stage runs.
[[nodiscard]] Status set_simd_target(std::string_view name);

// Name of the target in use.
[[nodiscard]] std::string simd_target();

}  // namespace thermedge
