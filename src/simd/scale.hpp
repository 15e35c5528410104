// Linear mapping of counts to 8-bit levels.
#pragma once

#include <cstdint>

namespace thermedge::detail {

// levels[i] = clamp(round((counts[i] - centre) * gain + 127), 0, 255) in double precision, halves
// away from zero. Reads and writes exactly `width` elements.
void scale_row(const std::uint16_t* counts, int width, int centre, double gain,
               std::uint8_t* levels);

}  // namespace thermedge::detail
