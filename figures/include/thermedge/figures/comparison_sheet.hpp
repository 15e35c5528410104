// The classical detectors and thermedge on one frame: the paper's figures 14 and 15.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "thermedge/figures/figure.hpp"
#include "thermedge/image.hpp"
#include "thermedge/options.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/classical.hpp"

namespace thermedge::figures {

enum class GradientUnit : std::uint8_t { kCounts, kSigma };

// Gradients in counts a pixel (levels of an 8-bit frame), or in units of the frame's noise a pixel.
struct CannyThresholds {
  Quantity<GradientUnit> high;
  Quantity<GradientUnit> low;
};

struct ComparisonOptions {
  DetectorOptions detector;
  ClassicalOptions classical;
  // The denoiser before the classical detectors, which then get the 8-bit view of Algorithm 1.
  // None given: they get the very picture that thermedge finds its edges on.
  std::optional<DenoiseMethod> classical_denoiser = {};
  // Thresholds of the classical Canny; 0: automatic (ClassicalOptions::canny). A low one of 0 is
  // 0.4 of the high one, which must be given where the low one is.
  CannyThresholds canny_thresholds;
  double panel_width = kPanelWidth;  // about the width of a panel, points
};

// The edges that one detector found in the frame.
struct ComparedMap {
  std::string name;           // of files: "prewitt" ... "canny", "thermedge"
  std::string display;        // for people
  Image<std::uint8_t> edges;  // 255 edge, 0 none
  std::size_t edge_pixels = 0;
  std::size_t fragments = 0;  // groups of touching edge pixels
  double ms = 0;              // from the frame to the map, denoising included; median of some runs
};

struct Comparison {
  Figure sheet;
  std::vector<ComparedMap> maps;  // Prewitt, Roberts, Sobel, LoG, Canny, thermedge
};

// One object per thread.
class ComparisonSheet {
 public:
  // Fails where an option is out of range, or where the low threshold is above the high one.
  [[nodiscard]] static Result<ComparisonSheet> create(const ComparisonOptions& options);
  ComparisonSheet(ComparisonSheet&&) noexcept;
  ComparisonSheet& operator=(ComparisonSheet&&) noexcept;
  ~ComparisonSheet();

  // `frame`, `bits` and `valid` (Frame::valid) as for Detector::detect; `source` names the frame on
  // the sheet.
  // Errors: those of Detector::detect and of the denoiser; thresholds in units of the noise where
  // the frame has none.
  [[nodiscard]] Result<Comparison> draw(ImageView<const std::uint16_t> frame, int bits,
                                        const std::string& source,
                                        ImageView<const std::uint8_t> valid = {});

 private:
  struct Impl;
  explicit ComparisonSheet(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge::figures
