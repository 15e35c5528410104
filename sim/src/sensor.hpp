// Noise and patterns that the sensor adds to a clean picture, and when its shutter closes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {

inline constexpr std::uint16_t kLargestCount = 16383;  // 14 bits

// Nothing in frames that the shutter didn't touch.
[[nodiscard]] std::optional<ShutterState> shutter_at(const CameraOptions& camera,
                                                     std::uint64_t seed, int frame);

// Noise and pattern of one camera.
class Sensor {
 public:
  Sensor(const CameraOptions& camera, std::uint64_t seed);

  // Counts of frame `frame`, which is not frozen: gains, fixed pattern, temporal noise, jumps of
  // the shutter, flickering and bad pixels, rounded to 14 bits and cut off at their ends.
  void expose(ImageView<const float> clean, int frame, ImageView<std::uint16_t> counts,
              ParallelRunner& runner);

 private:
  // One kind of fixed pattern, e.g. the columns' offsets: normal numbers that turn into others.
  struct Pattern {
    std::uint64_t stream;
    double sigma;
    std::size_t size;
    std::vector<double> values{};
    // The two ends that `values` lie between, and which pair of the sequence that is.
    std::vector<double> from{}, to{};
    double knot = -1;
  };
  void update(Pattern& pattern, int frame) const;
  void flicker(int frame, ImageView<std::uint16_t> counts) const;

  CameraOptions camera_;
  std::uint64_t seed_;
  Pattern columns_, rows_, offsets_, gains_;
  int pattern_frame_ = -1;
};

}  // namespace thermedge::sim
