// What cameras, their software and their users do to frames before an edge detector sees them.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::bench {

// Pixels beyond the border are those on it, everywhere here. Any thread.

// Moved by half a pixel in x and y, by linear interpolation: the mean of 2 x 2 pixels.
[[nodiscard]] Image<float> moved_by_half(ImageView<const float> image);
// Turned about the middle by linear interpolation.
[[nodiscard]] Image<float> turned(ImageView<const float> image, double angle_rad);
// Twice as wide and high: by linear interpolation, or each pixel four times.
[[nodiscard]] Image<float> enlarged(ImageView<const float> image);
[[nodiscard]] Image<float> repeated(ImageView<const float> image);

[[nodiscard]] Image<float> median_of_9(ImageView<const float> image);
[[nodiscard]] Image<float> blurred(ImageView<const float> image, double sigma_px);

[[nodiscard]] Image<float> in_steps(ImageView<const float> image, double step);

// Grey levels, rounded and cut off at 0 and 255, as a JPEG file of this quality (1..100) gives them
// back: cosine transforms of 8 x 8 pixels in steps of the table of the standard's annex K, as
// libjpeg scales it. The sides must be at least 8 pixels.
[[nodiscard]] Image<float> through_jpeg(ImageView<const float> levels, int quality);

// Counts that lie over 6 sigma from the median of the 3x3 around them are that median.
[[nodiscard]] Image<std::uint16_t> without_outliers(ImageView<const std::uint16_t> counts,
                                                    double sigma_counts);

[[nodiscard]] Image<float> as_float(ImageView<const std::uint16_t> counts);
// Cut off at 0 and 16383.
[[nodiscard]] Image<std::uint16_t> rounded(ImageView<const float> image);

}  // namespace thermedge::bench
