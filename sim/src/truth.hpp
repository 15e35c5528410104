// Exact edges of a world before a camera.
#pragma once

#include <vector>

#include "ray_caster.hpp"

namespace thermedge::sim {

// Every curve of the world that shows inside the frame and has a step of at least
// `least_contrast_counts` across it, point by point; in the order of the curves. A point shows
// where the ray just beside it meets a facet that the curve bounds.
[[nodiscard]] std::vector<TrueEdge> true_edges(const RayCaster& ray_caster,
                                               double least_contrast_counts, double vignetting,
                                               ParallelRunner& runner);

}  // namespace thermedge::sim
