// Non-local means (Buades, Coll, Morel 2005), pixel by pixel.
#pragma once

#include <cstddef>
#include <cstdint>

#include "float_frame.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge::detail {

// out(p) = sum of w(p, q) in(q) / sum of w(p, q) over the search window of p, with
// w = exp(-max(d2 - 2, 0) / h^2) and d2 the mean squared difference of the patches around p and q,
// all in units of the noise; 2 is what noise alone adds to d2. Pixels of a patch weigh less towards
// its sides, linearly: with equal weights small structures are smeared (0.5 dB to 0.9 dB lost).
class NonLocalMeans {
 public:
  explicit NonLocalMeans(const NlmOptions& options, const NlmTuning& tuning = {})
      : options_(options), tuning_(tuning) {}

  // Makes the scratch memory for frames of this size, which run() would make otherwise.
  void prepare(int width, int height);

  // `out` may be `in`.
  void run(ImageView<const float> in, const NoiseUnits& units, ImageView<float> out,
           ParallelRunner& runner);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(values_, levels_, boxes_, sums_, weights_);
  }

 private:
  void pad(ImageView<const float> in, const NoiseUnits& units, double levels_per_sigma,
           ParallelRunner& runner);

  NlmOptions options_;
  NlmTuning tuning_;
  Image<float> values_;          // the frame in units of the noise, with mirrored margins
  Image<std::uint16_t> levels_;  // the same as integers, for comparing patches
  Image<std::uint16_t> boxes_;   // scratch of each task
  Image<float> sums_;            // for each pixel: sum of w in(q)
  Image<float> weights_;         // ... and of w
};

}  // namespace thermedge::detail
