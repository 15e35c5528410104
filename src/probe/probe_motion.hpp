// Whether the scene moved over the sensor.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::detail {

// Compares the means of blocks of 8x8 px with those of the last frame in which the scene had moved.
// It moved when a third of the blocks with structure around them changed by more than the noise
// beyond what all blocks changed: one object crossing a view at rest is not enough. A picture
// without structure counts as moved: nothing there can be taken for a pattern of the sensor.
class MotionGate {
 public:
  // True for the first frame. Frames have one size.
  [[nodiscard]] bool moved(ImageView<const std::uint16_t> frame, double sigma_counts);

 private:
  void measure(ImageView<const std::uint16_t> frame);
  [[nodiscard]] bool has_structure(int x, int y, float least_step) const;
  [[nodiscard]] float common_change();

  Image<float> blocks_, last_;  // means, counts
  std::vector<float> changes_;
  bool started_ = false;
};

}  // namespace thermedge::detail
