// Edge pixels by short oriented kernels, in units of the noise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "thermedge/image.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct OrientedFilterOptions {
  double across_px = 1.2;        // standard deviation of the kernels across the edge, 0.5..2,
  double along_px = 2.5;         // and along it, from across_px to 4, in strong noise;
  double clean_across_px = 0.8;  // and the same in next to none
  double clean_along_px = 1.0;
  double low = 0.1;       // hysteresis, in units of the noise before denoising, > 0
  double high = 0.2;      // from `low` up
  double fine_px = 0.8;   // standard deviation of the fine derivative, 0.5..2; 0: none
  double fine_above = 1;  // the response of the fine one from which it decides, > 0

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<OrientedFilterOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("across_px", o.across_px, Bounds{0.5, 2},
    "standard deviation of the kernels across the edge, px");
  v("clean_across_px", o.clean_across_px, Bounds{0.5, 2},
    "across_px for frames with almost no noise, px");
  v("clean_along_px", o.clean_along_px, Bounds{0.5, 4},
    "along_px for frames with almost no noise, px");
  v("along_px", o.along_px, Bounds{0.5, 4}, "standard deviation of the kernels along the edge, px");
  v("low", o.low, Bounds{1e-6, 1000}, "low threshold of the hysteresis, in units of the noise");
  v("high", o.high, Bounds{1e-6, 1000}, "high threshold of the hysteresis, in units of the noise");
  v("fine_px", o.fine_px, Bounds{0, 2}, "standard deviation of the fine derivative, px (0: none)");
  v("fine_above", o.fine_above, Bounds{1e-6, 1000},
    "response of the fine derivative from which it decides, in units of the noise");
}

// Steps of 15 degrees: the orientations of edges, and their directions with the side that is
// warmer.
inline constexpr int kEdgeOrientations = 12;
inline constexpr int kEdgeDirections = 2 * kEdgeOrientations;

// "Measured" refers to the table of docs/experiments.md: mask F on simulated scenes with a range of
// 130 counts and noise of 20, 8 and 0 counts. Where a line names no measurement, it tells what the
// value trades off.
struct OrientedFilterTuning {
  static constexpr std::size_t kSides = 2;
  // How far to both sides the response is compared that an edge has to be over, px, ascending; the
  // farther pair in noise only. Measured: "what lies 4 px to both sides", "sides 8 px away too".
  std::array<int, kSides> side_distances_px = {4, 8};
  double far_sides_from = 0.5;  // least noisiness (0..1) with the farther pair: denoisers blur
                                // faint edges, but two clean edges 8 px apart suppress each other
  // Least suppressed response as a share of the response itself: slopes have next to none, knees at
  // the end of a slope half of it. Measured: "sharpness".
  double least_sharpness = 0.4;
  // What a strong edge leaves around it (ripple of the denoiser, halo of the optics) is in
  // proportion to it: a suppressed response is taken for over / sqrt(1 + (share m)^2), where m is
  // the largest response up to so many px away in both directions. Measured: "ceiling".
  double ripple_share = 0.04;
  int ripple_reach_px = 10;
  int kernel_steps = 8;  // sizes between the clean kernels and those for noise: memory
                         // against evenness over the noise
  // Where kernels are cut off, in standard deviations: of the Gaussian across, whose tails bias the
  // derivative, and of the line along it, where shorter is faster. compensate_curvature_bias
  // (subpixel.hpp) is measured with the latter.
  double derivative_cutoff_sigmas = 3.5;
  double line_cutoff_sigmas = 2.25;
  // Longest line to one side, px: the size of arrays. The largest along_px (4) needs 9.
  static constexpr int kMaxLineRadius = 10;
  // Groups of the fine derivative with fewer pixels are left out: noise makes small ones.
  std::size_t fine_group_px = 8;
  double fine_low_ratio = 0.6;  // low threshold of the fine derivative, of the high one: a lower
                                // one lets groups grow into noise
  // Half the widths of the rows of the disc around a fine edge in which it replaces the others, px.
  // A constant, as the number of rows is its size.
  static constexpr std::array kFineHalfWidthsPx = {0, 1, 2, 1, 0};
};

// Standard deviations.
struct KernelSize {
  double across_px;
  double along_px;
};

// Of one frame; the views live in the object that made them, until its next run.
struct OrientedFilterResult {
  ImageView<const float> response;          // largest response of all orientations, in sigma
  ImageView<const std::int32_t> direction;  // whose, 0..23: the edge runs at direction * 15
                                            // degrees from the x axis towards the y axis, and the
                                            // warmer side lies 90 degrees further on
  ImageView<const float> suppressed_response;  // of edge pixels: response over that of what lies
                                               // 4 px to both sides; slopes have next to none
  ImageView<const std::uint8_t> edges;         // 255 edge, 0 none
  KernelSize kernel;                           // that found them
};

// Derivatives of a Gaussian that is longer than it is wide, at 12 orientations (what runs along an
// edge tells as much of it as what lies across, and noise less), scaled so that white noise of 1
// sigma gives responses of 1 sigma. The response of a pixel is that of its best orientation. An
// edge pixel is not weaker than the response interpolated one pixel to both sides across the edge.
// Hysteresis with 8-connectivity.
// The kernels blur. Edges that a fine, round derivative of a Gaussian sees too, in groups of some
// pixels, lie where that one has them: sharp corners, lines side by side. Both of Canny's design.
// Border pixels are no edges; beyond the border the frame is mirrored.
// Bit-identical for every ParallelRunner and SIMD target. One object per thread; allocates on the
// first frame of a size only.
class OrientedFilterBank {
 public:
  explicit OrientedFilterBank(const OrientedFilterOptions& options,
                              const OrientedFilterTuning& tuning = {});
  OrientedFilterBank(OrientedFilterBank&&) noexcept;
  OrientedFilterBank& operator=(OrientedFilterBank&&) noexcept;
  ~OrientedFilterBank();

  // `in`: counts, denoised or not; `sigma_counts` > 0: the noise before denoising; `noisiness`: how
  // much of a burden it is, 0 (the short clean kernels) to 1 (the long ones).
  // Errors: empty frame; sigma not positive or not finite; noisiness out of range; an option out of
  // range; a pixel that is NaN, infinite or beyond 1e18.
  [[nodiscard]] Result<OrientedFilterResult> run(ImageView<const float> in, double sigma_counts,
                                                 double noisiness, ParallelRunner& runner);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
