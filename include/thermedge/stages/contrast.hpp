// What the frame says about an edge: contrast, significance, normals.
#pragma once

#include <cstdint>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"

namespace thermedge {

// Fills nx, ny, magnitude_counts and position_sigma_px of the edgels, and contrast_counts, z and
// log10_nfa of the edges, from the counts before denoising. Everything else must be set.
// Normal: across the curve after smoothing (binomial weights, sigma 2 points; closed curves wrap,
// open ones are reflected at their ends); on all of an edge towards the side that is warmer on
// average. An edge without a direction (one point) gets (1, 0) or (-1, 0).
// Magnitude: |counts 1 px ahead - counts 1 px behind| / 2 along the normal, bilinear.
// Contrast: mean difference of the counts 1.5, 2.5 and 3.5 px to both sides along the normal;
// samples outside the frame are left out. z = contrast / (sigma sqrt(2 / samples)); bilinear
// samples are a little less noisy than pixels, so z errs on the safe side by about 10 %. A frame
// without noise (sigma 0) gives z = infinity where there is contrast, and log10_nfa = -infinity.
// NFA = tests * P(|Z| > z), tests = number of pieces of all curves, sum of N (N - 1) / 2, at least
// 1 (as in edge drawing with a-contrario validation). Position sigma: noise moves the place where
// the profile crosses its middle by sigma / slope, where slope is the magnitude, at least its own
// noise sigma / sqrt(2); whole pixels add 1 / sqrt(12) px: sqrt(1/12 + (sigma / slope)^2), 0.29
// .. 1.44 px. Thread-safe. Cost: about 0.1 us per edgel.
void measure_edges(ImageView<const std::uint16_t> frame, double sigma_counts, EdgeSet& edges);

struct SignificanceOptions {
  // What is left of column and row offsets, sigma: edges along an axis may be made of it.
  double stripe_sigmas = 0;
};

// The same for edges that must prove themselves. Contrast: as above, up to 4.5 px to both sides, so
// that faint edges show. z is stricter. A slope of the scene is no edge: the contrast is reduced by
// what the slope between the counts 16 px to both sides makes of it, to nothing at most.
// z = contrast / (sigma sqrt(2 / samples + (stripe_sigmas a)^2)), where a is the mean of max(nx^16,
// ny^16), 1 along an axis. Without noise (sigma 0) every edge with a contrast is certain.
// NFA: those edges of frames of pure noise that the detector finds at all are the ones whose noise
// looks like an edge, so z alone flatters them. What speaks for an edge is z + 1.6 min(score, 0.5):
// the frame as it came, and the denoised one as far as it can be trusted. On edges in noise that
// was measured to be a normal variable of mean 1.3 and deviation 1.3 (docs/tuning.md), and there
// are about as many of them as 55000 px go into the frame. NFA = that number * P(more than this).
void measure_edges(ImageView<const std::uint16_t> frame, double sigma_counts,
                   ImageView<const std::int32_t> direction, const SignificanceOptions& options,
                   EdgeSet& edges);

// Normals from the shape alone, for edges that came without a frame: smoothed as above, to the
// right of the walking direction as seen on the picture.
void set_normals_from_shape(EdgeSet& edges);

}  // namespace thermedge
