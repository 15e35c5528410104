// Counts across edges: shared by measure_contrast and SignificanceTest.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "edgel_runs_simd.hpp"
#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/stages/contrast.hpp"

namespace thermedge::detail {

// task(first, count) for parts of a range that kernels take at once.
template <class F>
void for_each_run(Range range, F&& task) {
  for (std::size_t done = 0; done < range.count; done += kMostEdgels) {
    task(range.first + done, std::min<std::size_t>(range.count - done, kMostEdgels));
  }
}

using RunOfDoubles = std::array<double, kMostEdgels>;

// Counts `distance` px ahead along the normals of `count` edgels, at most kMostEdgels, less those
// as far behind them; NaN where one lies outside the frame.
void differences(ImageView<const std::uint16_t> frame, const Edgels& edgels, std::size_t first,
                 std::size_t count, double distance, RunOfDoubles& out);

// A contrast from 1.5 to 4.5 px on both sides is what a slope makes over this many px.
inline constexpr double kContrastPx = 6;

// Where a slope is taken: on the side to which the normals point (1) or on the other one (-1).
struct Beside {
  double side = 1;
  double from_px = 0;
  double to_px = 0;
};

// What the slope beside each of `count` edgels, at most kMostEdgels, makes of a contrast, counts;
// NaN where it leaves the frame.
void slopes_beside(ImageView<const std::uint16_t> frame, const Edgels& edgels, std::size_t first,
                   std::size_t count, const Beside& where, RunOfDoubles& out);

struct Contrast {
  double counts = 0;  // mean over the samples
  int samples = 0;
  double beyond_flank = 0;  // mean without the nearest samples, counts
};

struct RunOfContrasts {
  RunOfDoubles sums;  // of the differences
  std::array<int, kMostEdgels> samples;
  RunOfDoubles nearest;  // the difference at nearest_px; NaN where it is outside

  // Mean difference of an edgel that has samples, with and without the nearest one.
  [[nodiscard]] double mean(std::size_t i) const { return sums[i] / samples[i]; }
  [[nodiscard]] double mean_beyond_flank(std::size_t i) const {
    return samples[i] > 1 ? (sums[i] - nearest[i]) / (samples[i] - 1) : mean(i);
  }
};

// Of `count` edgels, at most kMostEdgels, from nearest_px to farthest_px on both sides.
void contrasts_across(ImageView<const std::uint16_t> frame, const Edgels& edgels, std::size_t first,
                      std::size_t count, const ContrastTuning& tuning, RunOfContrasts& out);

[[nodiscard]] Contrast contrast_across(ImageView<const std::uint16_t> frame, const Edgels& edgels,
                                       Range range, const ContrastTuning& tuning);

// Smoothed, to the right of the walking direction.
void set_normals(Edgels& edgels, const Edge& edge);
void flip_normals(Edgels& edgels, Range range);

// Magnitudes and position sigmas.
void measure_edgels(ImageView<const std::uint16_t> frame, double sigma_counts, Range range,
                    Edgels& edgels);

// Makes the contrast of an edge whose normals are set positive by turning them round where the
// warmer side is the other one; fills magnitudes, position sigmas and contrast_counts, which is
// corrected for the blur of the optics (contrast.hpp).
void take_contrast(ImageView<const std::uint16_t> frame, double sigma_counts, Edgels& edgels,
                   Edge& edge, Contrast& contrast);

// A contrast in units of the noise; infinite without noise.
[[nodiscard]] double in_sigmas(double contrast_counts, double sigma_counts);

// In units of its standard deviation; infinite without noise.
[[nodiscard]] double z_of(const Contrast& contrast, double sigma_counts);

// log10 of P(Z > z) for a standard normal Z.
[[nodiscard]] double log10_tail(double z);

}  // namespace thermedge::detail
