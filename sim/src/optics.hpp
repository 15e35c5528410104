// The blur that lens and pixel apertures give a picture.
#pragma once

#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/parallel_runner.hpp"

namespace thermedge::sim {

// Samples along a side of a pixel that the blur works on: at blur 1 px a step lies within 0.01 px
// of its truth with two of them, within 0.04 px with one.
inline constexpr int kSubpixels = 2;

// Gaussian and diffraction, then the average over each pixel, in one pass. The sum of the weights
// is one, so a uniform picture stays as it is and no radiance is lost.
class Optics {
 public:
  // Gaussian of standard deviation `blur_px`; Airy's pattern with its first dark ring at `airy_px`,
  // cut off at the third; 0: none.
  Optics(double blur_px, double airy_px);

  // The margin that the picture must have on each side beyond the pixels, px.
  [[nodiscard]] int margin_px() const { return margin_px_; }

  // `fine`: sub-pixels of `pixels` and of a margin of margin_px() around it.
  void run(ImageView<const float> fine, ImageView<float> pixels, ParallelRunner& runner);

 private:
  void run_separable(ImageView<const float> fine, ImageView<float> pixels, ParallelRunner& runner);
  void run_full(ImageView<const float> fine, ImageView<float> pixels, ParallelRunner& runner) const;

  int margin_px_ = 1;
  std::vector<float> line_;   // weights along one axis, of an even number of sub-pixels
  std::vector<float> plane_;  // weights over a square of plane_side_ sub-pixels; empty: separable
  int plane_side_ = 0;
  Image<float> rows_;
};

}  // namespace thermedge::sim
