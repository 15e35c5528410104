// What neighbouring frames say of each other, place by place along the true edges.
#pragma once

#include <span>

#include "track_frame.hpp"

namespace thermedge::eval {

struct MotionFigures {
  Repeatability repeatability;
  std::int64_t points = 0;  // with a smoothed position, beside a true edge that counts
  double measured_square_px2 = 0, smooth_square_px2 = 0;
  std::int64_t repeated_points = 0;  // that have neighbours in the next frame
  double measured_change_px2 = 0, smooth_change_px2 = 0;
  std::int64_t moving_points = 0;
  double measured_lag_px = 0, smooth_lag_px = 0;  // sums

  MotionFigures& operator+=(const MotionFigures& other);
  [[nodiscard]] SmoothFigures smooth() const;
};

// Frame `index` with the one after it and the three before it.
[[nodiscard]] MotionFigures compare_neighbours(std::span<const FramePair> frames, std::size_t index,
                                               const TrackIndex& tracks,
                                               const TracksOptions& options);

}  // namespace thermedge::eval
