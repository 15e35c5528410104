// A smoothed frame at half, a quarter and an eighth of its size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"

namespace thermedge::detail {

// Level 0 has half the frame's size: smoothed by a binomial kernel of variance 2 px^2 (about
// a Gaussian of 1.4 px) and sampled at every second pixel. Each further level is the one before,
// smoothed by (1 2 1) / 4 and sampled at every second pixel. Pixel (x, y) of level l is centred on
// pixel (2^(l+1) x, 2^(l+1) y) of the frame.
class MotionPyramid {
 public:
  static constexpr int kLevels = 3;

  // What white noise of 1 count becomes: standard deviation of a pixel of level 0, and of its
  // gradient per pixel of level 0 (half the difference of its neighbours).
  static const double kPixelGain;
  static const double kGradientGain;

  // Frames of 16 x 16 px at least.
  void build(ImageView<const std::uint16_t> counts);
  [[nodiscard]] ImageView<const float> level(int l) const {
    return levels_[static_cast<std::size_t>(l)].view();
  }
  [[nodiscard]] bool empty() const { return levels_[0].empty(); }
  void clear() { levels_[0].resize(0, 0); }

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(levels_[0], levels_[1], levels_[2], row_);
  }

 private:
  std::array<Image<float>, kLevels> levels_;
  Image<float> row_;  // one row of sums, with a margin
};

}  // namespace thermedge::detail
