// How sure an edge is: its contrast against what the noise of this frame gives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/noise_model.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/stages/contrast.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge {

// Distances along the normal of an edge at which the slope of the scene beside it is taken, px.
// Half of a contrast from 1.5 to 4.5 px is made at 3 px, so a slope of s counts per px explains 6 s
// of it.
struct SideSlopeTuning {
  // A slope that is there on both sides goes on through the edge. Taken over a long way, as noise
  // asks for; nearer it sees the flank of the edge itself, farther the next one.
  double chord_from_px = 4;
  double chord_to_px = 16;
  double most_uneven = 2;  // the weaker of both sides counts for this much of the stronger one
  // A ramp that ends at the edge: on one side, as steep from the first to the second distance as
  // from there to the third, which the flank of a neighbouring edge is not.
  double ramp_from_px = 3;
  double ramp_by_px = 7;
  double ramp_to_px = 11;
  double ramp_sigmas = 0.5;    // by so many standard deviations of it a ramp counts for less: noise
                               // makes one of two sides steep
  double most_of_ramp = 0.75;  // of the contrast that a ramp on one side can explain: the flanks of
                               // neighbours that an edge passes at many distances look like one
  // Share of the edgels at either end of the slopes' order that is left out of their mean: an edge
  // that meets another one has its slope at that end.
  double trim = 0.25;
};

// How the contrast along curves spreads where no edge is, measured on lines through the frame.
struct ContrastSpreadTuning {
  // Between parallel lines along the columns and the rows, and between those of each other
  // direction, odd numbers: precision against time.
  int line_step_px = 11;
  int oblique_step_px = 61;
  // Pixels of edges whose suppressed response is above this are surely of the scene, in its units;
  // lines keep so many px away. Fainter ones do not move the quantile.
  double sure_response = 0.7;
  int clearance_px = 6;
  // At least this share of the valid pixels is measured, those with the weakest edges near: where
  // edges are everywhere, most of them are a fixed pattern or a texture (simulated rooms leave .58
  // to .7 free, a desk .3 to .45, a street .06, a frame full of fixed pattern .02).
  double least_measured = 0.35;
  double quantile = 0.6;  // of the magnitudes of contrasts, and the z that normal ones have there
  double quantile_z = 0.8416;
  std::size_t fewest =
      16;              // contrasts of a length; with fewer its variance goes on from shorter ones
  double doubt = 3.3;  // two standard deviations of such a variance, times the root of the number
                       // of its samples: within it a length has the variance of half of it
  // Variance of the contrast less its slope for one edgel of white noise of 1, and the part of the
  // slope in it; and the least variance, of the first, that is believed.
  double white_variance = 0.94;
  double slope_share = 1.0 / 3;
  double least_variance = 0.6;
  // The noise's map follows its level where that grows by up to this factor over so many px; where
  // it grows by more, the level at an edge is what is so far away less this growth.
  int level_reach_px = 24;
  double smooth_level_growth = 1.25;
};

// What edges of noise look like. They climb along its ridges, so their z grows with the root of
// their length N, whatever noise it is and whatever has been done to it: measured on frames of 15
// kinds of noise, behind BM3D and behind a Gaussian, z = .55 sqrt(N) + .2 +- .9 (.7 to 1.1),
// lengths beyond 8 edgels and responses are exponential.
struct NoiseEdgeTuning {
  double climb = 0.55;
  double deviation = 1.0;
  // Rings are drawn around the peaks of noise and have all their inner samples in them: they have
  // so much more z, or so much over the number of their edgels if that is less (measured on five
  // kinds of noise: 2.7 up to 12 edgels, 2.4 up to 18, 1.5 up to 30, .7 beyond).
  double ring_climb = 2.7;
  double ring_climb_edgels = 36;
  // What is expected before a frame is looked at: edges of white noise.
  double px_per_candidate = 110000;  // pixels of the frame
  double mean_length = 13;           // edgels beyond the shortest ones
  double log_response = -1.66;       // natural logarithm of the mean suppressed response
  double log_response_excess = 0.1;  // mean of what is above it
  double weight = 120;               // of this, in candidates of the frame
  double longest_mean_length = 25;
  int shortest = 8;  // edgels
  // Below this, in standard deviations, length and response prove nothing: even noise of that
  // length has more contrast.
  double least_climb = -1;
  // Edges below the mean of noise are half of its candidates, but for this many of each sure edge
  // (more than sure_deviations above it): faint ones of the scene.
  double faint_per_sure = 0.2;
  double sure_deviations = 3;
};

struct SignificanceTuning {
  // Farther out than measure_contrast looks, so that faint edges show.
  ContrastTuning contrast{.farthest_px = 4.5};
  // Share of the edgels at either end of the contrasts' order that is left out of their mean. Of .1
  // and none, F on scenes of 4000 counts is .960 and .956, at 8 counts of noise .976 and .975.
  double contrast_trim = 0.1;
  SideSlopeTuning slopes = {};
  ContrastSpreadTuning spread = {};
  NoiseEdgeTuning noise_edges = {};
};

// Measured: docs/experiments.md ("Significance").
//
// Fills what measure_contrast fills (contrast.hpp), for edges that must prove themselves on the
// frame before denoising. The contrast is up to 4.5 px to both sides, without the edgels of the
// most and the least. z is the contrast less what slopes of the scene make of it, in units of the
// standard deviation that it has along curves of this length and direction where no edge is; that
// is measured on the frame itself, so stripes that are left, a fixed pattern and noise that is
// smooth or rough all count for what they are. The level at each place comes from the noise's map.
//
// log10_nfa: how many edges of noise as sure, as long and as strong there are in such a frame. The
// frame's own candidates tell how many there are, how long and how strong: those with less z than
// noise has on average are taken for half of them. NFA = n p (1 + x + x^2 / 2), where p = e^-x is
// the product of the three probabilities, each for itself (the sum is the distribution of such a
// product).
//
// Normals point to the warmer side as the filter saw it at each pixel. One object per thread;
// allocates on the first frames of a size only; the same result for every SIMD target and
// ParallelRunner. Cost: about 2 ms for 382x288 on one thread.
class SignificanceTest {
 public:
  explicit SignificanceTest(const SignificanceTuning& tuning = {});
  SignificanceTest(SignificanceTest&&) noexcept;
  SignificanceTest& operator=(SignificanceTest&&) noexcept;
  ~SignificanceTest();

  // `frame`: corrected counts; `noise`: of it; `valid`: nonzero where it is a measurement, empty:
  // everywhere; `pixels`: what the edges were made of. A level of 0
  // is no noise: every edge with a contrast is certain then (z = infinity, log10_nfa = -infinity).
  void run(ImageView<const std::uint16_t> frame, const NoiseModel& noise,
           ImageView<const std::uint8_t> valid, const OrientedFilterResult& pixels, EdgeSet& edges,
           ParallelRunner& runner);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
