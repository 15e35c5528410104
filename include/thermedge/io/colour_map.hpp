// The colours of quantities in all pictures.
#pragma once

#include "thermedge/io/write.hpp"

namespace thermedge::io {

// The colour map "plasma" (S. van der Walt, N. Smith 2015, CC0): dark blue (0) over purple and
// orange to yellow (1). Equal steps look equally large, and lightness rises steadily, so it also
// reads in grey and for the colour-blind. `share` is clamped; every channel is within 5 levels of
// the original. Thread-safe.
[[nodiscard]] Rgb plasma(double share);

}  // namespace thermedge::io
