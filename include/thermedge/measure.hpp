// What the frame says about an edge: contrast, significance, normals.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/edges.hpp"
#include "thermedge/image.hpp"

namespace thermedge {

// Fills nx, ny, magnitude_counts and position_sigma_px of the edgels, and contrast_counts, z and
// log10_nfa of the edges, from the counts before denoising.
// Contrast: mean difference of the counts 1.5, 2.5 and 3.5 px to both sides along the normal of the
// smoothed curve. z = contrast / (sigma sqrt(2 / samples)). NFA = tests * P(|Z| > z), tests = number
// of pieces of all curves, sum of N (N - 1) / 2 (as in edge drawing with a-contrario validation).
// A frame without noise (sigma 0) gives z = infinity where there is contrast.
// One object per thread.
class EdgeMeter {
 public:
  void run(ImageView<const std::uint16_t> frame, double sigma_counts, EdgeSet& edges);

 private:
  std::vector<float> smooth_x_, smooth_y_;
};

// Normals from the shape alone, for edges that came without a frame.
void set_normals_from_shape(EdgeSet& edges);

}  // namespace thermedge
