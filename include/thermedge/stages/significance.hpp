// How sure an edge is: its contrast against what noise alone gives.
#pragma once

#include <cstdint>
#include <optional>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/stages/contrast.hpp"

namespace thermedge {

// Those edges of frames of pure noise that a detector finds at all are the ones whose noise looks
// like an edge, so z alone flatters them. The evidence for an edge is z + per_score * min(score,
// most_score): the frame as it came, and the denoised one as far as it can be trusted. On edges
// found in noise it is a normal variable of this mean and deviation, and there is about one such
// edge in px_per_candidate pixels. A model belongs to the denoiser and the filter that it was
// measured with.
struct FalseAlarmModel {
  double per_score = 1.6;           // evidence per unit of score
  double most_score = 0.5;          // score beyond which a denoiser is trusted no further
  double mean = 1.3;                // of the evidence on edges in noise
  double deviation = 1.3;           // of the same
  double px_per_candidate = 55000;  // pixels of the frame

  // log10 of the expected number of such edges in a frame of `pixels` of pure noise.
  [[nodiscard]] double log10_nfa(const Edge& edge, double pixels) const;
};

// Measured: docs/tuning.md, mask F on simulated scenes with noise of 20 (s20) and 8 (s08) counts.
struct SignificanceTuning {
  // Farther out than measure_contrast looks, so that faint edges show: up to 7.5 px instead of 4.5
  // gives +.001 at s20 and -.005 at s08.
  ContrastTuning contrast{.farthest_px = 4.5};
  double slope_px = 16;  // distance to both sides at which the slope of the scene is taken: a
                         // shorter one sees the edge itself ("what the slope over 16 px explains")
};

struct SignificanceOptions {
  // What is left of column and row offsets, in units of the noise: edges along an axis may be made
  // of it. >= 0.
  double stripe_sigmas = 0;
  // None: log10_nfa is NaN.
  std::optional<FalseAlarmModel> model;
};

// Fills what measure_contrast fills (contrast.hpp), for edges that must prove themselves. Contrast:
// up to 4.5 px to both sides, so that faint edges show. z is stricter. A slope of the scene is no
// edge: the contrast is reduced by what the slope between the counts slope_px to both sides makes
// of it, to nothing at most. z = contrast / (sigma sqrt(2 / samples + (stripe_sigmas a)^2)), where
// a is the mean of max(nx^16, ny^16), 1 along an axis. Without noise (sigma 0) every edge with a
// contrast is certain. `direction`: of the oriented filter, which way the warmer side of a pixel
// lies. Thread-safe. Cost: about 0.1 us per edgel.
void test_significance(ImageView<const std::uint16_t> frame, double sigma_counts,
                       ImageView<const std::int32_t> direction, const SignificanceOptions& options,
                       EdgeSet& edges, const SignificanceTuning& tuning = {});

}  // namespace thermedge
