// Shared by the denoisers: mirrored borders and frames in units of their noise.
#pragma once

#include "thermedge/image.hpp"
#include "thermedge/noise_model.hpp"
#include "thermedge/result.hpp"

namespace thermedge::detail {

// The pixel of a row of `count` that stands for index `i` when the row is mirrored about the outer
// edges of its end pixels, again and again: ... 1 0 | 0 1 ... n-1 | n-1 n-2 ...
[[nodiscard]] constexpr int mirrored(int i, int count) {
  const int period = 2 * count;
  const int folded = (i % period + period) % period;
  return folded < count ? folded : period - 1 - folded;
}

// A frame in units of its noise, counts = offset + sigma * value: the noise is 1, and no precision
// is lost to a large offset.
struct NoiseUnits {
  double offset = 0;
  double sigma = 1;
  NoiseSpectrum spectrum = white_spectrum();

  [[nodiscard]] float from_counts(float counts) const {
    return static_cast<float>((counts - offset) / sigma);
  }
  [[nodiscard]] float to_counts(float value) const;
};

// Fails where a pixel is NaN or infinite, and names the first.
[[nodiscard]] Status check_finite(ImageView<const float> frame);

struct FrameRange {
  double mean = 0;
  double deviation = 0;  // largest distance of a pixel from the mean
};
[[nodiscard]] FrameRange frame_range(ImageView<const float> frame);

// Row `y` of `frame`, continued to both sides by mirroring: out[i] is pixel i - margin, for
// 0 <= i < out_width. `y` may lie outside the frame.
void mirrored_row(ImageView<const float> frame, int y, int margin, int out_width, float* out);

// The same in `units`.
void mirrored_row(ImageView<const float> frame, const NoiseUnits& units, int y, int margin,
                  int out_width, float* out);

}  // namespace thermedge::detail
