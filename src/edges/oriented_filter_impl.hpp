// The state of the oriented filter, shared by its two halves: responses and surround suppression.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "oriented_kernels.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge {

// Pictures with a margin: pixel (x, y) of the frame is at (x + margin, y + margin).
struct OrientedFilterBank::Impl {
  Impl(const OrientedFilterOptions& chosen, const OrientedFilterTuning& chosen_tuning)
      : options(chosen),
        tuning(chosen_tuning),
        fine(std::clamp(chosen.fine_px, 0.5, 2.0), tuning.derivative_cutoff_sigmas),
        fine_noise_gain(detail::noise_gain(fine)),
        all_kernels(detail::make_kernels(chosen, tuning)),
        kernels(&all_kernels.back()) {
    for (const detail::Kernels& each : all_kernels) {
      largest_radius = std::max(largest_radius, each.derivative.radius);
      line_margin = std::max(line_margin, each.weights.radius);
    }
    for (int i = 0; i < kEdgeDirections; ++i) {
      steps[static_cast<std::size_t>(i)] = detail::across(i, tuning);
    }
  }

  void prepare(int width, int height);
  // task(band, y_begin, y_end): the bands depend on the height alone, not on the ParallelRunner.
  template <class F>
  void for_each_band(ParallelRunner& runner, F&& task) const {
    runner.run(bands, [&](int band) {
      task(band, band * kBandRows, std::min((band + 1) * kBandRows, height));
    });
  }
  void differentiate(const detail::Derivative& kernel, int margin, int y_begin, int y_end,
                     float* scratch);
  void find_fine(ParallelRunner& runner, double sigma_counts);
  void project(int band, int y_begin, int y_end, double sigma_counts);
  void find_side_offsets();
  void find_largest(ParallelRunner& runner);
  void suppress(int band, int y_begin, int y_end);
  void merge_fine();
  [[nodiscard]] float suppressed_response_at(int x, int y) const;
  void classify(int x, int y, float over);
  void classify_row(int y, std::span<std::int32_t> xs, float* over);

  static constexpr int kBandRows = 32;  // of a task; no result depends on it

  OrientedFilterOptions options;
  OrientedFilterTuning tuning;
  detail::Derivative fine;
  double fine_noise_gain;
  std::vector<detail::Kernels> all_kernels;  // from clean to noisy
  int largest_radius = 0;                    // of their derivatives
  int line_margin = 0;                       // of their lines
  const detail::Kernels* kernels;            // of this frame
  std::size_t sides = 1;                     // of the tuning's, for this frame
  std::array<detail::Across, kEdgeDirections> steps{};

  int width = 0, height = 0, bands = 0;
  Image<float> padded;   // margin: padding()
  Image<float> gx, gy;   // margin: that of the line, or 0 for the fine one
  Image<float> scratch;  // rows for each band
  Image<float> fine_magnitude;
  Image<float> projected;  // for each band its rows and those of the lines' margins
  Image<float> response;
  Image<std::int32_t> direction;
  Image<float> suppressed_response;
  // Largest responses near by: along the rows, with ripple_reach_px rows of zeros above and below,
  // and around each pixel.
  Image<float> largest_in_row, largest_around;
  // Of one row, for each band: pixels on ridges, and their suppressed_responses.
  Image<std::int32_t> places;
  Image<float> of_places;
  std::array<std::int32_t, kEdgeDirections * OrientedFilterTuning::kSides> side_offsets{};
  Image<std::uint8_t> fine_classes, edges;
  std::vector<std::ptrdiff_t> group;

  [[nodiscard]] int padding() const { return std::max(largest_radius + line_margin, fine.radius); }
};

}  // namespace thermedge
