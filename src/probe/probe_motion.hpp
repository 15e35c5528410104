// Whether the scene moved over the sensor.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::detail {

// The two thresholds are in units of the noise of a pixel, which a block of 8x8 px averages to an
// eighth.
struct MotionTuning {
  // Side of a block, px. A constant, as sums over it are unrolled.
  static constexpr int kBlockPx = 8;
  float structure_sigmas = 6;  // step over two blocks that tells structure: far above what noise
                               // makes, so that a flat picture has none
  float change_sigmas = 0.6F;  // change of a block's mean: more than 3 times what noise makes of
                               // the difference of two
  int least_structured = 8;    // blocks with structure; with fewer a picture tells nothing
  int moved_part = 3;          // the scene moved where one in this many of them changed: an object
                               // alone changes fewer
};

// Compares the means of blocks of pixels with those of the last frame in which the scene had moved.
// It moved when one in moved_part of the blocks with structure around them changed by more than the
// noise beyond what all blocks changed: one object crossing a view at rest is not enough. A picture
// without structure counts as moved: nothing there can be taken for a pattern of the sensor.
class MotionGate {
 public:
  explicit MotionGate(const MotionTuning& tuning = {}) : tuning_(tuning) {}

  // True for the first frame. Frames have one size.
  [[nodiscard]] bool moved(ImageView<const std::uint16_t> frame, double sigma_counts);

 private:
  void measure(ImageView<const std::uint16_t> frame);
  [[nodiscard]] bool has_structure(int x, int y, float least_step) const;
  [[nodiscard]] float common_change();

  MotionTuning tuning_;
  Image<float> blocks_, last_;  // means, counts
  std::vector<float> changes_;
  bool started_ = false;
};

}  // namespace thermedge::detail
