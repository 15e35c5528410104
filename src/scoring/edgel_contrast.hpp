// Counts across edges: shared by measure_contrast and test_significance.
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

struct Contrast {
  double counts = 0;  // mean over the samples
  int samples = 0;
};

// From nearest_px to `farthest_px` on both sides.
[[nodiscard]] Contrast contrast_across(ImageView<const std::uint16_t> frame, const Edgels& edgels,
                                       Range range, double farthest_px,
                                       const ContrastTuning& tuning);

// Smoothed, to the right of the walking direction.
void set_normals(Edgels& edgels, const Edge& edge);
void flip_normals(Edgels& edgels, Range range);

// Magnitudes and position sigmas.
void measure_edgels(ImageView<const std::uint16_t> frame, double sigma_counts, Range range,
                    Edgels& edgels);

// `more_variance`: of the contrast, in units of the noise, beside that of its samples.
[[nodiscard]] double z_of(const Contrast& contrast, double sigma_counts, double more_variance);

// log10 of P(Z > z) for a standard normal Z.
[[nodiscard]] double log10_tail(double z);

// The contrast is that from nearest_px to `farthest_px` on both sides. significance(contrast, edge)
// is the z of an edge; orient(edge) may turn normals round before.
template <class Orient, class Significance, class Tail>
void measure_all(ImageView<const std::uint16_t> frame, double sigma_counts, double tests,
                 double farthest_px, const ContrastTuning& tuning, EdgeSet& edges, Orient&& orient,
                 Significance&& significance, Tail&& log10_p) {
  const double log10_tests = std::log10(tests);
  for (Edge& edge : edges.edges) {
    set_normals(edges.edgels, edge);
    orient(edge);
    Contrast contrast = contrast_across(frame, edges.edgels, edge.edgels, farthest_px, tuning);
    if (contrast.counts < 0) {
      flip_normals(edges.edgels, edge.edgels);
      contrast.counts = -contrast.counts;
    }
    measure_edgels(frame, sigma_counts, edge.edgels, edges.edgels);
    edge.contrast_counts = contrast.counts;
    edge.z = significance(contrast, edge);
    edge.log10_nfa = log10_tests + log10_p(edge);
  }
}

}  // namespace thermedge::detail
