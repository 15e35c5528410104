// Which Highway targets are generated. Included before any Highway header by every kernel file, so
// that all of them agree. SSSE3 is left out: every CPU that has it and still matters has SSE4.
// Targets with vectors of unknown length are left out because kernels keep vectors in arrays; ARM
// has NEON.
#pragma once

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
