// The result of one frame: edges, and the figures that were measured on the way to them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/presets.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/stage_times.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/linking.hpp"
#include "thermedge/stages/oriented_filter.hpp"
#include "thermedge/stages/preprocessor.hpp"

namespace thermedge {

// A value that belongs to the caller: it outlives the detector, and a tracker may hold several.
// Handed to Detector::detect again it is overwritten without allocation, once it has held the
// result of one frame of that size.
struct Detection {
  Preset preset = Preset::kRobust;
  int width = 0, height = 0;             // px
  std::optional<std::int64_t> stamp_ns;  // of the frame, as are these
  std::int64_t index = 0;
  std::uint32_t flags = 0;  // FrameFlag bits

  Corrections corrections;  // nothing, where the input was an edge map
  double sigma_counts = 0;  // the noise that the denoiser was told; 0: none, so it copied the frame
  double threshold_low = 0,
         threshold_high = 0;  // hysteresis: Sobel magnitude in grey levels, or unit_counts
  ClippedShares clipped;      // by Algorithm 1, of the valid pixels; preset paper on 16 bits only
  double unit_counts = 0;     // of the oriented filter's thresholds; 0 for preset paper
  KernelSize kernel_px{0, 0};
  EdgeSet edges;
  StageTimes times;

  [[nodiscard]] std::span<const Edge> kept_edges() const { return edges.kept_edges(); }
  [[nodiscard]] EdgePoints points(const Edge& edge) const { return edges.points_of(edge); }
  [[nodiscard]] std::span<const std::uint32_t> corners(const Edge& edge) const {
    return edges.corners_of(edge);
  }
};

// The pictures and sets between the stages, for people who look at each step; made on demand only.
// Empty where a step did not run.
struct Intermediates {
  Image<std::uint16_t> corrected;  // counts
  Image<std::uint8_t> levels;      // 8-bit view by Algorithm 1
  Image<std::uint8_t> denoised;    // 8-bit view of what edge pixels were found on
  Image<float> denoised_values;    // the same before rounding: counts; of preset paper levels
  Image<std::uint8_t> edge_map;    // what was traced: 255 edge, 0 none
  ContourSet contours;             // before linking or closing of gaps
  LinkedContours linked;           // after it
};

}  // namespace thermedge
