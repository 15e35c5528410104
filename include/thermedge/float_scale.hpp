// How the values of a float frame become 16-bit counts.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge {

// count = (value - offset) * counts_per_unit, rounded, and clamped to 0..65535.
struct FloatScale {
  double counts_per_unit = 1;
  double offset = 0;

  [[nodiscard]] double to_count(float value) const {
    return (static_cast<double>(value) - offset) * counts_per_unit;
  }
  [[nodiscard]] double to_value(double count) const { return count / counts_per_unit + offset; }

  friend bool operator==(const FloatScale&, const FloatScale&) = default;
};

// Chooses the scale of a frame by its finite pixels. Whole numbers from 0 to 65535 are counts
// already; whole numbers within any other span of 65535 keep their steps and are only shifted. Of
// other values the 0.1st to 99.9th percentile is spread over 8192 to 16384 counts by a power of
// two, with room for as much again on both sides. Where something very hot in view would leave the
// noise less than 8 counts, the noise gets 8 to 16 counts instead and what lies far from the median
// is clamped. One object per thread; it keeps its scratch memory.
class FloatScaleChooser {
 public:
  [[nodiscard]] FloatScale choose(ImageView<const float> values);
  // `before` where it still suits these values, else a new one: frames of a sequence, each of which
  // is a little different, keep one scale.
  [[nodiscard]] FloatScale choose(ImageView<const float> values, const FloatScale& before);

  [[nodiscard]] std::size_t memory_bytes() const { return sample_.capacity() * sizeof(float); }

 private:
  struct Spread {
    double low = 0, high = 0;      // percentiles of values, least and greatest of whole numbers
    double median = 0, sigma = 0;  // of other values
    bool is_whole = true;
    bool is_empty = true;
  };
  [[nodiscard]] Spread measure(ImageView<const float> values);
  [[nodiscard]] double noise_of(ImageView<const float> values);

  std::vector<float> sample_;
};

// Rounds all pixels to counts; those that are not finite become 0. Equal sizes.
void to_counts(ImageView<const float> values, const FloatScale& scale,
               ImageView<std::uint16_t> counts);

}  // namespace thermedge
