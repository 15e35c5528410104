// The smooth background of a frame, taken off while it is denoised.
#pragma once

#include <cstddef>
#include <vector>

#include "robust_line_fit.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"

namespace thermedge::detail {

// A parabola along the columns and one along the rows: what a lens darker towards its corners adds,
// or a wall that grows warmer evenly. Fitted to the differences between the means of neighbouring
// blocks of pixels, robustly, so that objects do not matter. Denoisers that shrink small
// contrasts make terraces of such a slope, whose edges look real.
class Detrender {
 public:
  // Side of a block: a larger one averages more noise, a smaller one sees small objects apart from
  // the background. A constant, as every pixel is divided by it.
  static constexpr int kBlockPx = 8;

  void prepare(int width, int height);
  void measure(ImageView<const float> frame);
  // `out` may be `in`.
  void subtract(ImageView<const float> in, ImageView<float> out) const;
  void add(ImageView<float> frame) const;

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(blocks_, slopes_, distances_, columns_, rows_);
  }

 private:
  void fill(const Line& slope, std::vector<float>& profile);
  void apply(ImageView<const float> in, float sign, ImageView<float> out) const;

  Image<double> blocks_;  // means
  std::vector<WeightedPoint> slopes_;
  std::vector<double> distances_;
  std::vector<float> columns_, rows_;
};

}  // namespace thermedge::detail
