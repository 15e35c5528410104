// Edge pixels by Canny's method (paper Algorithm 2, eqs. 6-8).
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/parallel.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct CannyOptions {
  // Threshold of the gradient magnitude above which a pixel is an edge for sure, in units of the
  // input per pixel times 8 (the gain of the Sobel kernels); 0: automatic.
  double high_threshold = 0;
  // Where automatic: the share of pixels that are not edges; high is that percentile of the
  // magnitude (64-bin histogram up to its maximum, upper bound of the bin), 0..1.
  double non_edge_share = 0.7;
  double low_over_high = 0.4;  // low threshold as a share of the high one, 0..1
};

// Gradients and edge pixels of one frame; the views live in the Canny object that made them, until
// its next run.
struct CannyResult {
  ImageView<const float> gx;             // Sobel, positive where the input grows to the right
  ImageView<const float> gy;             // Sobel, positive where the input grows downwards
  ImageView<const float> magnitude;      // sqrt(gx^2 + gy^2), eq. 7
  ImageView<const std::uint8_t> edges;   // 255 edge, 0 none
  double low = 0;                        // thresholds used
  double high = 0;
};

// Sobel gradients (eq. 6, borders replicated), magnitude (eq. 7), direction (eq. 8) rounded to
// 0/45/90/135 degrees, non-maximum suppression along it, hysteresis with 8-connectivity. A pixel
// survives suppression when its magnitude is > the neighbour before it and >= the one behind it, in
// reading order, so that a plateau two pixels wide leaves one. Border pixels are never edges.
// One object per thread; allocates on the first frame of a size only.
class Canny {
 public:
  explicit Canny(const CannyOptions& options) : options_(options) {}

  // Errors: empty frame, option out of range, non-finite pixel.
  [[nodiscard]] Result<CannyResult> run(ImageView<const float> in, Runner& runner);

 private:
  CannyOptions options_;
  Image<float> gx_, gy_, magnitude_;
  Image<std::uint8_t> edges_;
  std::vector<std::int32_t> stack_;
};

}  // namespace thermedge
