// Inlining and unrolling for kernels that keep many vectors in registers.
#pragma once

#include "simd_config.hpp"
// After the targets were chosen.
#include <hwy/base.h>

// Under AddressSanitizer the functions stay apart and the loops stay loops: Clang takes minutes to
// optimise the checks of the long functions that they would make.
#if HWY_IS_ASAN
#define THERMEDGE_KERNEL_INLINE HWY_NOINLINE
#define THERMEDGE_KERNEL_UNROLL(factor)
#else
#define THERMEDGE_KERNEL_INLINE HWY_INLINE
#define THERMEDGE_KERNEL_UNROLL(factor) HWY_UNROLL(factor)
#endif
