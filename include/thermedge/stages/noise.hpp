// How noisy a frame is, measured on the frame itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"

namespace thermedge {

// All in counts; 0 where the frame is too small to tell (under 8 px a side).
struct NoiseEstimate {
  double sigma_counts = 0;         // temporal + pixel noise, standard deviation
  double column_sigma_counts = 0;  // stripes along columns, standard deviation of their offsets
  double row_sigma_counts = 0;     // stripes along rows
};

struct NoiseTuning {
  int smallest_side_px = 8;  // shorter sides give no estimate: the median is of too few pixels
  int stripe_samples =
      96;  // second differences per column (row), spread over its length: precision
           // against time; what NoiseEstimator measured is with this number
};

// Pixel noise by the robust high-pass: the residual of [1 -2 1] x [1 -2 1] / 6 (unit gain for white
// noise, blind to planes, columns and rows), its MAD over the flatter half of the frame. Stripes:
// the MAD of the second differences of column (row) offsets, less what the pixel noise adds.
// Measured on 382x288: sigma within 2 % (standard deviation 0.8 %) with up to 30 % of the area on
// edges; stripes of sigma / 3 within 10 %; without stripes, up to sigma / 20 is reported, sigma / 8
// in frames full of strong edges. The rounding to whole counts is taken out, so below sigma 1 the
// result is rough, and 0 where rounding hides all.
// One estimator per thread; allocates on the first frame of a size only. Integers up to the last
// steps: the same result everywhere. Cost: about 0.3 ms for 382x288.
class NoiseEstimator {
 public:
  explicit NoiseEstimator(const NoiseTuning& tuning = {}) : tuning_(tuning) {}

  [[nodiscard]] NoiseEstimate measure(ImageView<const std::uint16_t> frame);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(frame_, residual_, slope_, histogram_, samples_, profile_);
  }

 private:
  void filter(ImageView<const std::uint16_t> frame);
  double pixel_sigma();
  void clear_histogram();
  double stripe_sigma(ImageView<const std::int32_t> second_differences, double pixel_sigma);
  ImageView<const std::int32_t> sample_along_rows();
  ImageView<const std::int32_t> sample_along_columns();

  NoiseTuning tuning_;
  Image<std::uint16_t> frame_;             // copy whose rows may be read past their end
  Image<std::uint16_t> residual_, slope_;  // without the border
  std::vector<std::uint32_t> histogram_;
  Image<std::int32_t> samples_;
  std::vector<float> profile_;
};

}  // namespace thermedge
