// The kernels of the oriented filter: derivatives of a Gaussian that is longer than it is wide.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge::detail {

// Weights of a Gaussian and of its derivative, cut off at `cutoff_sigmas` standard deviations.
struct Derivative {
  Derivative(double sigma_px, double cutoff_sigmas);

  // The two-dimensional kernel, derivative along x, at (x, y).
  [[nodiscard]] double at(int x, int y) const;

  int radius;
  std::vector<float> smooth;
  std::vector<float> slope;  // positive; of pixels ahead, those behind have the negative
};

// The standard deviation that noise of 1 leaves in a derivative.
[[nodiscard]] double noise_gain(const Derivative& derivative);

// Where a pixel is compared with its neighbours across the edge: between two of them on either
// side, `share` of the way from the first to the second.
struct Across {
  int first_x, first_y;
  int second_x, second_y;
  float share;
  std::array<int, OrientedFilterTuning::kSides> side_x, side_y;
};
[[nodiscard]] Across across(int direction, const OrientedFilterTuning& tuning);

// A line that adds derivatives up along the edges of one orientation.
struct Line {
  std::array<int, OrientedFilterTuning::kMaxLineRadius + 1> dx;
  std::array<int, OrientedFilterTuning::kMaxLineRadius + 1> dy;
  float gx_gain;  // the response is the line's sum of gx_gain gx + gy_gain gy: noise of 1 makes 1
  float gy_gain;
};

struct LineWeights {
  int radius;
  std::array<float, OrientedFilterTuning::kMaxLineRadius + 1> weights;
};

// All orientations of one size.
struct Kernels {
  Kernels(double across_px, double along_px, const OrientedFilterTuning& tuning);

  Derivative derivative;
  LineWeights weights;
  std::array<Line, kEdgeOrientations> lines{};
  KernelSize size;
};

// From the clean kernels to those for noise.
[[nodiscard]] std::vector<Kernels> make_kernels(const OrientedFilterOptions& options,
                                                const OrientedFilterTuning& tuning);

}  // namespace thermedge::detail
