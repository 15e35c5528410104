// Linear mapping of counts to 8-bit levels.
#pragma once

#include <cstdint>

namespace thermedge::detail {

// Count `anchor` becomes `base_level`, and each count more adds `gain`.
struct Scaling {
  int anchor;
  double base_level;
  double gain;
};

// levels[i] = clamp(round((counts[i] - anchor) * gain + base_level), 0, 255) in double precision,
// halves away from zero. Reads and writes exactly `width` elements.
void scale_row(const std::uint16_t* counts, int width, const Scaling& scaling,
               std::uint8_t* levels);

}  // namespace thermedge::detail
