// Non-uniformity correction of single frames: pixels that are stuck or far off.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct BadPixelOptions {
  bool replace = true;  // replace dead pixels by the median of their good neighbours
  // How far a pixel must lie outside the range of its neighbours to count as dead, in units of the
  // noise, > 0. Smaller finds weaker ones and, below about 4, takes noise for dead pixels.
  double threshold_sigmas = 6;

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<BadPixelOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("replace", o.replace, Bounds{0, 1}, "replace dead pixels by their neighbours' median");
  v("threshold_sigmas", o.threshold_sigmas, Bounds{1, 1000},
    "a pixel this far outside its neighbours' range is dead, in units of the noise");
}

struct BadPixelTuning {
  // How far a real point may stand out of its neighbours, in units of how far these stand out of
  // the pixels around them: what optics with a blur of 0.7 px and more allow. A larger one misses
  // dead pixels beside edges, a smaller one takes points of the scene for dead.
  int optics_ratio = 2;
  // The same for a block of 2x2 pixels and the 12 around it. A point midway between the four,
  // blurred by 0.7 px, is exp(-0.5 / 0.98) = .60 high on them and exp(-2.5 / 0.98) = .078 on the
  // nearest of the 12, so that the four stand out of these by 6.7 times what these stand out of the
  // rest; anywhere else between the pixels, by less.
  int block_optics_ratio = 8;
  double least_sigma_counts = 1;  // noise assumed where less is measured: counts are whole numbers
  int smallest_side_px = 5;       // frames with a shorter side are left alone: no 5x5 neighbourhood
};

struct BadPixel {
  int x = 0;
  int y = 0;
  friend bool operator==(const BadPixel&, const BadPixel&) = default;
};

// Finds dead pixels and replaces them in place by the median of the good pixels of their 3x3 (where
// none is good: 5x5) neighbourhood. Returns them in row order in `dead`, which is cleared first.
// A pixel is dead where it lies `threshold_sigmas` outside the range of its eight neighbours, of
// which the most extreme one is left out, because dead pixels come in pairs; and where it lies
// farther outside than optics allow: these spread a real point over its neighbours, so it can't
// stand out of them by more than optics_ratio times what they stand out of the pixels around them
// (blur of 0.7 px and more). So a dead pixel beside a strong edge is found only when it is off by
// twice the contrast. Blocks of 2x2 pixels are dead where all four are off to the same side, by the
// same rule with block_optics_ratio: resampling by half a pixel makes such blocks of dead pixels,
// each a quarter off. `sigma_counts` as measured; at least least_sigma_counts. Frames under
// smallest_side_px a side are left as they are. Thread-safe. Cost: about 0.1 ms for 382x288.
void replace_bad_pixels(ImageView<std::uint16_t> frame, double sigma_counts,
                        const BadPixelOptions& options, std::vector<BadPixel>& dead,
                        const BadPixelTuning& tuning = {});

}  // namespace thermedge
