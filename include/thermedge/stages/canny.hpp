// Edge pixels by Canny's method (paper Algorithm 2, eqs. 6-8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge {

struct CannyOptions {
  // Threshold of the gradient magnitude above which a pixel is an edge for sure, in units of the
  // input per pixel times 8 (the gain of the Sobel kernels); 0: automatic.
  double high_threshold = 0;
  // Where automatic: the share of pixels that are not edges; high is that percentile of the
  // magnitude (64-bin histogram up to its maximum, upper bound of the bin), 0..1.
  double non_edge_share = 0.7;
  double low_over_high = 0.4;  // low threshold as a share of the high one, 0..1
  bool blur = false;           // the Gaussian of eq. 5 before the gradients (Algorithm 2, line 3)

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<CannyOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("high_threshold", o.high_threshold, Bounds{0, 1e6},
    "Sobel magnitude of a certain edge, grey levels (0: automatic)");
  v("non_edge_share", o.non_edge_share, Bounds{0, 1},
    "automatic: share of pixels below the high one");
  v("low_over_high", o.low_over_high, Bounds{0, 1}, "low threshold as a share of the high one");
  v("blur", o.blur, Bounds{0, 1}, "blurs the denoised frame by the 5x5 Gaussian of eq. 5");
}

// Gradients and edge pixels of one frame; the views live in the Canny object that made them, until
// its next run.
struct CannyResult {
  ImageView<const float> gx;            // Sobel, positive where the input grows to the right
  ImageView<const float> gy;            // Sobel, positive where the input grows downwards
  ImageView<const float> magnitude;     // sqrt(gx^2 + gy^2), eq. 7
  ImageView<const std::uint8_t> edges;  // 255 edge, 0 none
  double low = 0;                       // thresholds used
  double high = 0;
};

// The Gaussian of eq. 5 where options.blur asks for it, Sobel gradients (eq. 6, borders
// replicated), magnitude (eq. 7), direction (eq. 8) rounded to 0/45/90/135 degrees, non-maximum
// suppression along it, hysteresis with 8-connectivity. A pixel survives suppression when its
// magnitude is > the neighbour before it and >= the one after it, in reading order, so that a
// plateau two pixels wide leaves one. Edges are above the thresholds, not at them, so a constant
// frame has none. Border pixels are never edges. The result is bit-identical for every
// ParallelRunner and SIMD target. One object per thread; allocates on the first frame of a size
// only. Cost on one thread at 382x288: about 0.2 ms, 0.6 ms where noise makes every fourth pixel an
// edge.
class Canny {
 public:
  explicit Canny(const CannyOptions& options);

  // Errors: empty frame, option out of range, a pixel that is NaN, infinite or beyond 1e18.
  [[nodiscard]] Result<CannyResult> run(ImageView<const float> in, ParallelRunner& runner);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(blur_, blurred_, bands_, bordered_, gx_, gy_, magnitude_, edges_,
                             group_);
  }

 private:
  static constexpr int kBins = 64;
  struct Thresholds {
    float low;
    float high;
  };
  struct Band {  // what the task of one band of rows found
    float largest_magnitude;
    std::array<std::uint32_t, kBins> histogram;
  };

  void prepare(int width, int height);
  template <class F>
  void for_each_band(ParallelRunner& runner, F&& task);
  void add_border(ImageView<const float> in, int y_begin, int y_end);
  float find_gradients(int y_begin, int y_end);
  Thresholds choose_thresholds(float largest_magnitude, ParallelRunner& runner);
  void suppress(int y_begin, int y_end, Thresholds thresholds);

  CannyOptions options_;
  Denoiser blur_;
  Image<float> blurred_;
  std::vector<Band> bands_;
  Image<float> bordered_, gx_, gy_, magnitude_;
  Image<std::uint8_t> edges_;
  std::vector<std::ptrdiff_t> group_;  // of connected edge pixels
};

}  // namespace thermedge
