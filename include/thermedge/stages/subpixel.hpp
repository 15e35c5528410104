// Positions of edgels between pixels.
#pragma once

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge {

// Moves edgels that lie on pixels along their normals to the ridge of `response`, the size of a
// derivative across the edge: to the maximum along the normal of the quadratic that fits the
// logarithm of the 3 x 3 pixels around best (Steger 1998; across a blurred step the response of a
// Gaussian derivative is a Gaussian, whose logarithm is a parabola, so the fit is exact). No edgel
// leaves its pixel; where there is no maximum, it stays. Normals must be set (measure.hpp).
// A kernel that is long (`kernel`) sees a curved edge from inside, by half its
// variance over the radius; this is made up for, the curvature being that of the circle through
// the edgel and those 8 before and behind it. Near the ends of open edges it is left as it is.
// Sets position_sigma_px to 1.25 noise / response for kernels of 1.2 x 2.5 px (`noise` of the frame
// in the units of response): half of what the noise before denoising would leave (the standard
// deviation of the response's slope over its curvature, 2.5 / response on optics of 1 px), as
// measured behind BM3D. Smaller kernels see less of a step, by the root of their area, and are no
// worse off for that. At least 0.01 px.
// Thread-safe. Cost: 0.05 us per edgel.
void refine_positions(ImageView<const float> response, KernelSize kernel, double noise,
                      EdgeSet& edges);

}  // namespace thermedge
