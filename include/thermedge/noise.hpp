// How noisy a frame is, measured on the frame itself.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge {

// All in counts; 0 where the frame is too small to tell (under 8x8).
struct NoiseEstimate {
  double sigma_counts = 0;         // temporal + pixel noise, standard deviation
  double column_sigma_counts = 0;  // stripes along columns, standard deviation of their offsets
  double row_sigma_counts = 0;     // stripes along rows
};

// Measures noise by the robust high-pass: the residual of [1 -2 1] x [1 -2 1] / 6 (unit gain
// for white noise, blind to planes, columns and rows), its MAD over flat areas. Stripe levels are
// what the second difference of column (row) means shows beyond the pixel noise.
// Holds scratch memory: one estimator per thread. Integer arithmetic: the same result everywhere.
class NoiseEstimator {
 public:
  [[nodiscard]] NoiseEstimate measure(ImageView<const std::uint16_t> frame);

 private:
  std::vector<std::uint32_t> histogram_;
  std::vector<std::int32_t> residual_;
  std::vector<std::int64_t> profile_;
};

}  // namespace thermedge
