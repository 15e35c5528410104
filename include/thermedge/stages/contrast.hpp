// Contrast and normals of edges, measured on the frame.
#pragma once

#include <cstddef>
#include <cstdint>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"

namespace thermedge {

// Distances from an edgel along its normal. Nearer samples lie on the blurred step itself, farther
// ones across the next edge. Every whole step from the nearest to the farthest is sampled.
struct ContrastTuning {
  // At most kMostSteps samples to a side: the size of an array on the stack.
  static constexpr std::size_t kMostSteps = 4;
  double nearest_px = 1.5;   // beyond the flank of optics with a blur of about 1 px; contrast from
                             // 3.5 px on only loses .007 of F at s20 (docs/experiments.md)
  double farthest_px = 3.5;  // of measure_contrast: edges 7 px apart do not see each other
};

// Fills nx, ny, magnitude_counts and position_sigma_px of the edgels, and contrast_counts, z and
// log10_nfa of the edges, from the counts before denoising. Everything else must be set.
// Normal: across the curve after smoothing (binomial weights, sigma 2 points; closed curves wrap,
// open ones are reflected at their ends); on all of an edge towards the side that is warmer on
// average. An edge without a direction (one point) gets (1, 0) or (-1, 0).
// Magnitude: |counts 1 px ahead - counts 1 px back| / 2 along the normal, bilinear.
// Contrast: mean difference of the counts 1.5, 2.5 and 3.5 px to both sides along the normal;
// samples outside the frame are left out. At 1.5 px the blur of the optics still takes a part off:
// contrast_counts is the mean without these samples where that is more, but at most 6 % more. A
// step behind a blur of up to 0.8 px is told within 1 %, of 1 px within 4 %. z = contrast before
// that / (sigma sqrt(2 / samples)); bilinear samples are a little less noisy than pixels, so z errs
// on the safe side by about 10 %. A frame without noise (sigma 0) gives z = infinity where there is
// contrast, and log10_nfa = -infinity. NFA = tests * P(|Z| > z), tests = number of pieces of all
// curves, sum of N (N - 1) / 2, at least 1 (as in edge drawing with a-contrario validation).
// Position sigma: noise moves the place where the profile crosses its middle by sigma / slope,
// where slope is the magnitude, at least its own noise sigma / sqrt(2); whole pixels add 1 /
// sqrt(12) px: sqrt(1/12 + (sigma / slope)^2), 0.29
// .. 1.44 px. Thread-safe. Cost: about 0.1 us per edgel.
void measure_contrast(ImageView<const std::uint16_t> frame, double sigma_counts, EdgeSet& edges,
                      const ContrastTuning& tuning = {});

// Normals from the shape alone, for edges that came without a frame: smoothed as above, to the
// right of the walking direction as seen on the picture.
void set_normals_from_shape(EdgeSet& edges);

}  // namespace thermedge
