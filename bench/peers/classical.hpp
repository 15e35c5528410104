// Prewitt, Roberts, Sobel, LoG and Canny of this library, as MATLAB has them.
#pragma once

#include "../value_or_exit.hpp"
#include "thermedge/stages/classical.hpp"

namespace thermedge::bench {

// `threshold` as ClassicalOptions has it, of Canny as CannyOptions::high_threshold; 0: automatic.
inline void classical(ImageView<const std::uint8_t> levels, ClassicalMethod method,
                      double threshold, ImageView<std::uint8_t> map) {
  ClassicalOptions options;
  (method == ClassicalMethod::kCanny ? options.canny.high_threshold : options.threshold) =
      threshold;
  Image<float> values(levels.width(), levels.height());
  copy_pixels(levels, values.view());
  value_or_exit(ClassicalDetector(options).run(values, method, map, *make_runner(1)));
}

}  // namespace thermedge::bench
