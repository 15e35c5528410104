// Which Highway targets are generated. Included before any Highway header by every kernel file, so
// that all of them agree. SSSE3 is left out: every CPU that has it and still matters has SSE4.
#pragma once

#define HWY_DISABLED_TARGETS HWY_SSSE3
