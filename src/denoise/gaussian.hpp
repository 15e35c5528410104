// Gaussian smoothing: the 5x5 kernel of eq. 5, or any sigma.
#pragma once

#include <cstddef>
#include <vector>

#include "thermedge/memory.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge::detail {

class GaussianFilter {
 public:
  explicit GaussianFilter(const GaussianOptions& options, const GaussianTuning& tuning = {})
      : options_(options), tuning_(tuning) {}

  // For frames of this size; run does it otherwise.
  void prepare(int width, int height);

  // `out` may be `in`. `share`, 0 to 1: of the standard deviation; not of the 5x5 kernel.
  void run(ImageView<const float> in, double share, ImageView<float> out, ParallelRunner& runner);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const { return memory_of(weights_, padded_, rows_); }

 private:
  [[nodiscard]] int radius() const;
  void make_weights(double share);
  void filter_row(int y, float* scratch, float* more_scratch, float* result) const;

  GaussianOptions options_;
  GaussianTuning tuning_;
  std::vector<float> weights_;  // of the distances 0, 1, 2 ...; their sum over both sides is 1
  Image<float> padded_;         // the frame with mirrored margins of the kernel's radius
  Image<float> rows_;           // scratch of the tasks
};

}  // namespace thermedge::detail
