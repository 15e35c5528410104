// Calls the version of a kernel for the instruction set that this thread has chosen.
#pragma once

#include <cstddef>

namespace thermedge::detail {

// Index of this thread's instruction set in Highway's dispatch tables.
[[nodiscard]] std::size_t simd_table_index();

}  // namespace thermedge::detail

// In place of HWY_DYNAMIC_DISPATCH, whose choice belongs to the whole process.
#define THERMEDGE_SIMD_DISPATCH(kernel) \
  (HWY_DISPATCH_TABLE(kernel)[::thermedge::detail::simd_table_index()])
