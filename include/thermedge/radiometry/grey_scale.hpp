// Counts, degrees and the 8-bit view.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

// Linear response of the paper's camera, degC per count (paper section 2.3).
inline constexpr double kDegcPerCount = 0.01;

struct GreyScaleOptions {
  double gain = 0.5;  // grey levels per count, > 0; 0.5 = 0.02 degC a level (paper Algorithm 1)

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<GreyScaleOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gain", o.gain, Bounds{1e-6, 1000}, "grey levels per count (0.5: 0.02 degC a level)");
}

// Median of the counts: the element of rank (n - 1) / 2, so it is a count that occurs.
// An empty frame gives 0. O(pixels), no allocation after the first call on a thread.
[[nodiscard]] int median_counts(ImageView<const std::uint16_t> frame);

// Algorithm 1: G = clamp(round((R - M) * gain + 127), 0, 255) with M the median of the frame, so
// one level is worth the same temperature in every frame. Halves round away from zero (the text
// gives no rule; it also writes I for M). `levels` has the frame's size.
// Errors: sizes differ; gain not finite or <= 0. Thread-safe.
[[nodiscard]] Status scale_to_8bit(ImageView<const std::uint16_t> frame,
                                   const GreyScaleOptions& options, ImageView<std::uint8_t> levels);

// Pixels whose counts Algorithm 1 cannot tell apart, because their levels would lie below 0 or
// above 255; parts of 1.
struct ClippedShares {
  double low = 0;
  double high = 0;

  [[nodiscard]] double both() const { return low + high; }
};

// Clipped shares from here on are much: up to it, about as large a share of the edge pixels lies
// where all is clipped. On recordings of an Optris PI450 and of a road, at gains from .01 to 2:
// with 1-2 % clipped .5 % of the edge pixels, with 3-5 % 4 %, with 5-8 % 7 %, with 30-50 % 19 %.
inline constexpr double kMuchClippedShare = 0.05;

// What scale_to_8bit clips, as shares of the pixels that are a measurement (nonzero in `valid`,
// which has the frame's size; empty: all); 0 where there are none. O(pixels). Thread-safe.
[[nodiscard]] ClippedShares clipped_shares(ImageView<const std::uint16_t> frame,
                                           const GreyScaleOptions& options,
                                           ImageView<const std::uint8_t> valid = {});

struct CountRange {
  int min = 0;  // counts
  int max = 0;  // counts
};
[[nodiscard]] CountRange count_range(ImageView<const std::uint16_t> frame);

// Range of a frame in degC (paper eqs. 3 and 4): (max - min) * degc_per_count.
[[nodiscard]] double range_degc(CountRange range, double degc_per_count = kDegcPerCount);

// Degrees per grey level when the range is spread over 2^bits levels (paper section 2.3.2):
// range_degc / (2^bits - 1).
[[nodiscard]] double degc_per_level(double range_degc, int bits = 8);

}  // namespace thermedge
