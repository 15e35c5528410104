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

// The number on the camera's clock of the `index`th frame that is not dropped.
[[nodiscard]] std::int64_t camera_number(const CameraOptions& camera, std::int64_t index);
// The largest that there may be.
inline constexpr int kLargestNumber = 1'900'000;

// Nothing in frames that the shutter didn't touch.
[[nodiscard]] std::optional<ShutterState> shutter_at(const CameraOptions& camera,
                                                     std::uint64_t seed, int frame);
// Nothing in frames that are not frozen, or that the shutter alone freezes. `frame`, here and
// below: on the camera's clock.
[[nodiscard]] std::optional<FreezeState> freeze_at(const CameraOptions& camera, int frame);
// The frame whose picture is seen in `frame`; the frame itself where it is not frozen.
[[nodiscard]] int shown_at(const CameraOptions& camera, int frame);
// Offset of all pixels by shutter and jumps, counts.
[[nodiscard]] double offset_at(const CameraOptions& camera, std::uint64_t seed, int frame);
// What happened between the frames `index` - 1 and `index` that are not dropped.
[[nodiscard]] std::vector<StreamEvent> events_at(const CameraOptions& camera, std::uint64_t seed,
                                                 int index);

// Noise and pattern of one camera.
class Sensor {
 public:
  Sensor(const CameraOptions& camera, std::uint64_t seed);

  // Counts of frame `frame`, which is not frozen: gains, fixed pattern, temporal noise, jumps,
  // flickering and bad pixels, rounded to 14 bits and cut off at their ends.
  void expose(ImageView<const float> clean, int frame, ImageView<std::uint16_t> counts,
              ParallelRunner& runner);
  // New noise on a picture that is repeated in frame `frame`.
  void repeat(double noise_counts, int frame, ImageView<std::uint16_t> counts) const;

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
    std::uint64_t number = 0;  // of the pattern, where it becomes another one at once
  };
  void update(Pattern& pattern, int frame) const;
  void flicker(int frame, ImageView<std::uint16_t> counts) const;

  CameraOptions camera_;
  std::uint64_t seed_;
  Pattern columns_, rows_, offsets_, gains_;
  int pattern_frame_ = -1;
};

}  // namespace thermedge::sim
