// Frames with less noise: counts in, counts out.
#pragma once

#include <cstdint>

#include "thermedge/frame.hpp"
#include "thermedge/image.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/bad_pixels.hpp"
#include "thermedge/stages/denoiser.hpp"
#include "thermedge/stages/preprocessor.hpp"
#include "thermedge/stages/stripes.hpp"
#include "thermedge/stages/validity.hpp"

namespace thermedge {

// The defaults give the best picture, where a detector's give the best edges: BM3D with its quality
// profile, told the noise as it is, and nothing after it. Stripes stay: a picture of them is true.
struct FrameDenoiserOptions {
  ValidityOptions validity;
  BadPixelOptions bad_pixels;
  StripeOptions stripes;
  DenoiseOptions denoise;

  FrameDenoiserOptions() { denoise.bm3d.profile = Bm3dProfile::kQuality; }

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<FrameDenoiserOptions> O, class V>
void visit_options(O& o, V&& v) {
  v.group("validity", o.validity);
  v.group("bad_pixels", o.bad_pixels);
  v.group("stripes", o.stripes);
  v.group("denoise", o.denoise);
}

// The detector's front end and its denoiser, with other defaults. One object per thread; allocates
// on the first frame of a size only. Bit-identical for every ParallelRunner and SIMD target.
class FrameDenoiser {
 public:
  explicit FrameDenoiser(const FrameDenoiserOptions& options = {});

  // Counts rounded to whole ones, valid until the next run. Errors: an option out of range; an
  // empty frame; out of memory.
  [[nodiscard]] Result<ImageView<const std::uint16_t>> run(const Frame& frame,
                                                           ParallelRunner& runner);

  // The same without rounding and in the unit of the frame, into `out` of its size: what a float
  // frame becomes.
  void copy_values(ImageView<float> out) const;

  // Noise, bad pixels and stripes of the last frame.
  [[nodiscard]] const Corrections& corrections() const { return corrections_; }

 private:
  FrameDenoiserOptions options_;
  Preprocessor preprocessor_;
  Denoiser denoiser_;
  Corrections corrections_;
  Image<float> working_;
  Image<std::uint16_t> counts_;
};

}  // namespace thermedge
