// Non-uniformity correction of single frames: pixels that are stuck or far off.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge {

struct NucOptions {
  bool dead_pixels = true;  // replace dead pixels by the median of their good neighbours
  // How far a pixel must lie outside the range of its eight neighbours to count as dead, in units of
  // sigma; > 0. The optics spread any real point over several pixels, so 6 spares real hot spots.
  double dead_pixel_sigmas = 6;
};

struct DeadPixel {
  int x = 0;
  int y = 0;
  friend bool operator==(const DeadPixel&, const DeadPixel&) = default;
};

// Finds dead pixels (also pairs that touch) and replaces them in place by the median of the good
// pixels of their 3x3 (where none is good: 5x5) neighbourhood. Returns them in row order, in
// `dead`, which is cleared first. `sigma_counts` as measured; below 1 count it is taken as 1.
void correct_dead_pixels(ImageView<std::uint16_t> frame, double sigma_counts,
                         const NucOptions& options, std::vector<DeadPixel>& dead);

}  // namespace thermedge
