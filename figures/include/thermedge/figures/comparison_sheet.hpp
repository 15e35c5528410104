// The classical detectors and thermedge on one frame: the paper's figures 14 and 15.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "thermedge/figures/figure.hpp"
#include "thermedge/image.hpp"
#include "thermedge/options.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/classical.hpp"

namespace thermedge::figures {

struct ComparisonOptions {
  DetectorOptions detector;
  ClassicalOptions classical;
  // The denoiser before the classical detectors; they get the 8-bit view of Algorithm 1.
  DenoiseMethod classical_denoiser = DenoiseMethod::kNone;
  double panel_width = kPanelWidth;  // about the width of a panel, points
};

// The edges that one detector found in the frame.
struct ComparedMap {
  std::string name;           // of files: "prewitt" ... "canny", "thermedge"
  std::string display;        // for people
  Image<std::uint8_t> edges;  // 255 edge, 0 none
  std::size_t edge_pixels = 0;
  std::size_t fragments = 0;  // groups of touching edge pixels
  double ms = 0;              // from the frame to the map; median of some runs
};

struct Comparison {
  Figure sheet;
  std::vector<ComparedMap> maps;  // Prewitt, Roberts, Sobel, LoG, Canny, thermedge
};

// One object per thread.
class ComparisonSheet {
 public:
  // Fails where an option is out of range.
  [[nodiscard]] static Result<ComparisonSheet> create(const ComparisonOptions& options);
  ComparisonSheet(ComparisonSheet&&) noexcept;
  ComparisonSheet& operator=(ComparisonSheet&&) noexcept;
  ~ComparisonSheet();

  // `frame`, `bits` and `valid` (Frame::valid) as for Detector::detect; `source` names the frame on
  // the sheet.
  // Errors: those of Detector::detect and of the denoiser.
  [[nodiscard]] Result<Comparison> draw(ImageView<const std::uint16_t> frame, int bits,
                                        const std::string& source,
                                        ImageView<const std::uint8_t> valid = {});

 private:
  struct Impl;
  explicit ComparisonSheet(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge::figures
