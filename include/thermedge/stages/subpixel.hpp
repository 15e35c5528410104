// Positions of edgels between pixels.
#pragma once

#include <cstddef>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge {

struct SubpixelTuning {
  // Edgels to either side that tell the curvature: more are blind to small bends, fewer see the
  // steps between pixels. A constant, as the previous positions kept are as many.
  static constexpr std::size_t kCurvatureReach = 8;
  // position_sigma_px = sigma_times_response * noise / response, px, for kernels of
  // measured_kernel: measured after BM3D: half of what the noise before denoising would leave.
  // The kernel is that of the measurement; it does not follow OrientedFilterOptions.
  double sigma_times_response = 1.25;
  KernelSize measured_kernel{1.2, 2.5};
  double least_sigma_px = 0.01;  // of a position, so that weights by it are finite
  // Shift inwards on a curve, in units of the kernel's variance over the radius: 1/2 in theory;
  // of a kernel cut off at line_cutoff_sigmas, measured on circles.
  double curvature_bias_share = 0.47;
};

// Moves edgels that lie on pixels along their normals to the ridge of `response`, the size of a
// derivative across the edge: to the maximum along the normal of the quadratic that fits the
// logarithm of the 3 x 3 pixels around best (Steger 1998; across a blurred step the response of a
// Gaussian derivative is a Gaussian, whose logarithm is a parabola, so the fit is exact). No edgel
// leaves its pixel; where there is no maximum, it stays. Normals must be set (contrast.hpp).
// A kernel that is long (`kernel`) sees a curved edge from inside, by half its
// variance over the radius; this is made up for, the curvature being that of the circle through
// the edgel and those kCurvatureReach before and after it. Near the ends of open edges it is left
// as it is. Sets position_sigma_px to sigma_times_response * noise / response for kernels of the
// measured size
// (`noise` of the frame in the units of response): half of what the noise before denoising would
// leave (the standard deviation of the response's slope over its curvature, 2.5 / response on
// optics of 1 px), as measured after BM3D. Smaller kernels see less of a step, by the root of
// their area, and are no worse off for that. At least least_sigma_px. Thread-safe; the same result
// for every ParallelRunner. Cost: 0.05 us per edgel on one thread.
void refine_positions(ImageView<const float> response, KernelSize kernel, double noise,
                      EdgeSet& edges, ParallelRunner& runner, const SubpixelTuning& tuning = {});

}  // namespace thermedge
