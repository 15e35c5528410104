// The whole detector: a frame of counts in, ranked smooth edges out (paper Algorithm 6).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/options.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/bad_pixels.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/linking.hpp"
#include "thermedge/stages/noise.hpp"
#include "thermedge/stages/stripes.hpp"

namespace thermedge {

// Wall time of each stage of the last frame, ms.
struct StageTimes {
  double noise = 0, nuc = 0, scale = 0, denoise = 0, canny = 0, contours = 0, corners = 0,
         linking = 0, scoring = 0, measure = 0;
  [[nodiscard]] double total() const;
};

// Every stage by name, in the order in which they run.
struct Stage {
  std::string_view name;
  double StageTimes::*ms;
};
inline constexpr std::array kStages = {
    Stage{"noise", &StageTimes::noise},     Stage{"nuc", &StageTimes::nuc},
    Stage{"scale", &StageTimes::scale},     Stage{"denoise", &StageTimes::denoise},
    Stage{"canny", &StageTimes::canny},     Stage{"contours", &StageTimes::contours},
    Stage{"linking", &StageTimes::linking}, Stage{"corners", &StageTimes::corners},
    Stage{"scoring", &StageTimes::scoring}, Stage{"measure", &StageTimes::measure}};

// What one frame gave. Everything is owned by the detector and stays valid until its next call.
struct Detection {
  int width = 0, height = 0;
  NoiseEstimate noise;      // zero where the input was an edge map
  double sigma_counts = 0;  // the noise that the denoiser was told
  double threshold_low = 0,
         threshold_high = 0;  // thresholds used; of oriented kernels in units of the noise
  // Of oriented kernels, 0 otherwise: what the thresholds are in units of, and what it came from.
  double range_counts = 0;  // of the frame, its 0.1st to 99.9th percentile
  double unit_counts = 0;   // noise, at least a share of the range
  KernelSize kernel_px{0, 0};
  EdgeSet edges;
  StageTimes ms;
  // Intermediate pictures and sets, for looking at each step; empty where a step did not run.
  std::span<const BadPixel> bad_pixels;
  const StripeOffsets* stripes = nullptr;    // that were removed
  ImageView<const std::uint16_t> corrected;  // counts after nuc
  ImageView<const std::uint8_t> levels;      // Algorithm 1
  ImageView<const std::uint8_t> denoised;    // what Canny saw, or a view of what the kernels saw
  ImageView<const std::uint8_t> edge_map;    // what the tracer saw: 255 edge, 0 none
  const ContourSet* contours = nullptr;      // before linking
  const LinkedContours* linked = nullptr;    // after linking
};

// Detects edges frame by frame. Not thread-safe: one detector per thread; it spreads the work of a
// frame over its own threads. Allocates nothing after the second frame of one size. Results are
// bit-identical for every number of threads and SIMD target.
class Detector {
 public:
  // Fails where an option is out of range.
  [[nodiscard]] static Result<Detector> create(const DetectorOptions& options);
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;
  ~Detector();

  // `frame`: raw counts (8-bit pictures: their grey levels, with bits = 8, which skips the scaling
  // of Algorithm 1). Errors: empty frame, out of memory.
  [[nodiscard]] Result<const Detection*> detect(ImageView<const std::uint16_t> frame,
                                                int bits = 16);

  // The second half alone, on somebody else's binary edge map (nonzero = edge). Contrast, z and NFA
  // are NaN: only a frame tells them.
  [[nodiscard]] Result<const Detection*> trace(ImageView<const std::uint8_t> edge_map);

  [[nodiscard]] const DetectorOptions& options() const;

 private:
  struct Impl;
  explicit Detector(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
