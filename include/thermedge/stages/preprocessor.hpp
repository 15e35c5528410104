// What is done to a frame before anything looks for edges in it.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/stages/bad_pixels.hpp"
#include "thermedge/stages/stripes.hpp"

namespace thermedge {

// Replaces dead pixels, then removes stripes, as the options say. One object per thread; allocates
// on the first frame of a size only.
class Preprocessor {
 public:
  explicit Preprocessor(const BadPixelOptions& options) : options_(options) {}

  // The corrected frame, valid until the next run. `sigma_counts` as NoiseEstimator measured it.
  ImageView<const std::uint16_t> run(ImageView<const std::uint16_t> frame, double sigma_counts,
                                     ParallelRunner& runner);

  // Of the last frame; without stripes, or where they are left alone, the offsets are empty.
  [[nodiscard]] const std::vector<BadPixel>& bad_pixels() const { return bad_pixels_; }
  [[nodiscard]] const StripeOffsets& stripes() const { return stripes_; }

 private:
  BadPixelOptions options_;
  StripeFinder finder_;
  Image<std::uint16_t> corrected_;
  std::vector<BadPixel> bad_pixels_;
  StripeOffsets stripes_;
};

}  // namespace thermedge
