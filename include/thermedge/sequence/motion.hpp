// How the picture moves from one frame to the next.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"

namespace thermedge {

// The motion of the whole picture since the frame before, as a homography of pixel coordinates.
// Near and far things move differently where the camera is displaced; this is what most of the
// picture does.
struct Motion {
  // (x, y, 1) of the frame before to a multiple of (x', y', 1) of this one, row by row; px, pixel
  // centres at integers. The last element is 1.
  std::array<double, 9> homography = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  double offset_counts = 0;        // how much brighter the frame is as a whole, counts
  double offset_sigma_counts = 0;  // its standard deviation
  int offset_parts = 0;  // of 16 parts of the picture, those that are brighter, or darker, by at
                         // least half of it, once moved
  double inliers = 0;    // share of the compared points that agree with the map, 0..1
  double sigma_px = 0;   // standard deviation of the mapped positions, rms over the frame, px
  bool found = false;    // false: nothing to compare; the map is the identity

  // Where a point of the frame before lies in this frame, px.
  [[nodiscard]] Point operator()(Point p) const {
    const auto& h = homography;
    const auto x = static_cast<double>(p.x);
    const auto y = static_cast<double>(p.y);
    const double scale = h[6] * x + h[7] * y + h[8];
    return {static_cast<float>((h[0] * x + h[1] * y + h[2]) / scale),
            static_cast<float>((h[3] * x + h[4] * y + h[5]) / scale)};
  }
};

struct MotionTuning {
  // Least gradient of a point that is compared, in units of what noise makes of it, across or down:
  // in a frame without edges noise exceeds 4.5 at one pixel or two. Higher ones leave out faint
  // edges.
  double least_gradient_sigmas = 4.5;
  // Points are the strongest of each square of so many pixels of the picture at half, a quarter and
  // an eighth of the size: time against precision.
  std::array<int, 3> cell_px = {3, 2, 2};
  std::array<int, 3> most_steps = {8, 5, 5};  // of Gauss and Newton at each of these sizes
  double settled_px = 0.02;                   // a step below this ends them; px of the frame
  double good_start = 0.8;      // share of points that agree with the last motion from which on no
                                // other start is tried
  double huber_sigmas = 1.345;  // residuals beyond count in proportion, not by their square
  double inlier_sigmas = 3;     // residuals within agree with the map
  // Residuals have this share of the gradient on top of the noise: sampling, and things that move
  // by themselves. In px of the picture at half size.
  double model_error_px = 0.05;
  // Standard deviation of what the border of the picture moves more than its middle, px over 100
  // px. A weak prior, for frames with few edges.
  double bend_prior_px = 3;
  int search_px = 48;              // largest jump of the picture that is looked for, px
  double least_inliers = 0.2;      // fewer: not found
  std::size_t fewest_points = 12;  // fewer: not found
};

// Estimates the motion between consecutive frames: Gauss and Newton on the differences of smoothed
// pictures at points with gradient, from an eighth of the size to half of it, robustly, with one
// offset in counts, so that a shutter event is no motion. It starts from the best of the last
// motion, none, and the shift at which small pictures fit (sum of absolute differences).
// Deterministic: the same result for every number of threads and instruction set. One object per
// thread; allocates on the first two frames of a size only.
class MotionEstimator {
 public:
  explicit MotionEstimator(const MotionTuning& tuning = {});
  MotionEstimator(MotionEstimator&&) noexcept;
  MotionEstimator& operator=(MotionEstimator&&) noexcept;
  ~MotionEstimator();

  // The motion from the frame of the last call to this one. `counts`: dead pixels, stripes and
  // fixed pattern removed, as these do not move; `level_counts`: its noise (NoiseModel). Not found
  // on the first frame and on one of another size. `gap`: number of frame times since the last
  // call, 1 where none was lost; the last motion is scaled by it.
  const Motion& update(ImageView<const std::uint16_t> counts, double level_counts, double gap = 1);
  [[nodiscard]] const Motion& motion() const;

  // Forgets the last frame.
  void restart();

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
