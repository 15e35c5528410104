// The light bilateral filter after a denoiser.
#pragma once

#include <cstddef>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge::detail {

// Rows first, then columns (Pham & van Vliet 2005).
class BilateralFilter {
 public:
  explicit BilateralFilter(const BilateralOptions& options, const BilateralTuning& tuning = {})
      : options_(options), tuning_(tuning) {}

  // For frames of this size; run does it otherwise.
  void prepare(int width, int height);

  // `in` may be `out`. `range` > 0: of the differences that are evened out, in the units of `in`.
  void run(ImageView<const float> in, double range, ImageView<float> out, ParallelRunner& runner);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(weights_, padded_, rows_, result_);
  }

 private:
  [[nodiscard]] int radius() const;

  BilateralOptions options_;
  BilateralTuning tuning_;
  std::vector<float> weights_;
  Image<float> padded_, rows_, result_;
};

}  // namespace thermedge::detail
