// What is done to a frame before anything looks for edges in it.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/float_scale.hpp"
#include "thermedge/frame.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/noise_model.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/stages/bad_pixels.hpp"
#include "thermedge/stages/hole_filling.hpp"
#include "thermedge/stages/noise.hpp"
#include "thermedge/stages/noise_model_estimator.hpp"
#include "thermedge/stages/stripes.hpp"
#include "thermedge/stages/validity.hpp"

namespace thermedge {

// What was found about a frame on the way to its corrected counts.
struct Corrections {
  InvalidPixels invalid;
  NoiseEstimate noise;     // of the pixels, by a high-pass, and of stripes
  NoiseModel noise_model;  // at the scale of edges; of the pixels where it was not asked for
  std::vector<BadPixel> bad_pixels;  // that were replaced
  StripeOffsets stripes;             // that were removed; empty where they were left alone
  // count = (value - offset) * counts_per_unit, of a float frame; 1 and 0 of others.
  double counts_per_unit = 1;
  double offset = 0;
};

// Frame -> corrected counts: float values become counts, pixels that are no measurement, given or
// found (InvalidFinder), are filled smoothly (HoleFiller), noise is measured, bad pixels are
// replaced, stripes removed.
//
// Float frames are scaled by FloatScaleChooser. Stages that look at integers see the rounded
// counts; copy_corrected gives denoisers and filters what rounding left out, too.
//
// The one front end of detector, `thermedge denoise`, sheets and benchmarks. One object per thread;
// allocates on the first frame of a size only. The same result for every ParallelRunner and SIMD
// target.
class Preprocessor {
 public:
  // `model_noise`: measure the whole noise model, not the noise of the pixels alone.
  Preprocessor(const BadPixelOptions& bad_pixels, const StripeOptions& stripes,
               const ValidityOptions& validity, bool model_noise)
      : bad_pixel_options_(bad_pixels),
        stripe_options_(stripes),
        validity_options_(validity),
        model_noise_(model_noise) {}

  // The corrected counts, valid until the next run. `frame` is not empty.
  ImageView<const std::uint16_t> run(const Frame& frame, ParallelRunner& runner,
                                     Corrections& corrections);

  // The corrected counts of the last frame, of a float frame with the fractions that rounding left
  // out. `out` has the size of the frame.
  void copy_corrected(ImageView<float> out) const;

  // Nonzero where the last frame was a measurement; empty where it was everywhere.
  [[nodiscard]] ImageView<const std::uint8_t> valid() const { return valid_view_; }

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(noise_estimator_, model_estimator_, stripe_finder_, invalid_finder_,
                             hole_filler_, scale_chooser_, corrected_, fractions_, valid_);
  }

 private:
  void measure_noise(ParallelRunner& runner, Corrections& corrections);
  void load(const Frame& frame, Corrections& corrections);
  void load_values(ImageView<const float> values, Corrections& corrections);
  void forget_fractions(const std::vector<BadPixel>& replaced);
  void note_validity(const Frame& frame, InvalidPixels& invalid);
  void fill_invalid(InvalidPixels& invalid);
  [[nodiscard]] std::int64_t count_invalid() const;

  BadPixelOptions bad_pixel_options_;
  StripeOptions stripe_options_;
  ValidityOptions validity_options_;
  bool model_noise_;
  InvalidFinder invalid_finder_;
  NoiseEstimator noise_estimator_;
  NoiseModelEstimator model_estimator_;
  StripeFinder stripe_finder_;
  HoleFiller hole_filler_;
  FloatScaleChooser scale_chooser_;
  Image<std::uint16_t> corrected_;
  Image<float> fractions_;  // of a float frame: exact count less the rounded one
  Image<std::uint8_t> valid_;
  ImageView<const std::uint8_t> valid_view_;
};

}  // namespace thermedge
