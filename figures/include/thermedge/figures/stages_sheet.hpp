// Every step from the frame to the edges as a picture: the paper's figures 7 to 12.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "thermedge/figures/figure.hpp"
#include "thermedge/image.hpp"
#include "thermedge/options.hpp"
#include "thermedge/result.hpp"

namespace thermedge::figures {

struct NamedFigure {
  std::string name;  // "01_frame", "02_levels" ...: sorts in the order of the steps
  Figure figure;
};

struct StagesFigures {
  Figure sheet;                    // all steps in a grid
  std::vector<NamedFigure> steps;  // each alone, as on the sheet
};

// Runs the detector on a frame and draws what each step made of it, with its numbers: the frame,
// its 8-bit view, denoised by NL-means and by BM3D (and by the chosen denoiser, where that is
// another), edge pixels, contours, links by type, corners, edges by score and by rank, the mask of
// the kept ones, a table of times. One object per thread.
class StagesSheet {
 public:
  // `panel_width`: about the width of a panel, points. Fails where an option is out of range.
  [[nodiscard]] static Result<StagesSheet> create(const DetectorOptions& options,
                                                  double panel_width = kPanelWidth);
  StagesSheet(StagesSheet&&) noexcept;
  StagesSheet& operator=(StagesSheet&&) noexcept;
  ~StagesSheet();

  // `frame`, `bits` and `valid` (Frame::valid) as for Detector::detect; `source` names the frame on
  // the sheet.
  // Errors: those of Detector::detect.
  [[nodiscard]] Result<StagesFigures> draw(ImageView<const std::uint16_t> frame, int bits,
                                           const std::string& source,
                                           ImageView<const std::uint8_t> valid = {});

 private:
  struct Impl;
  explicit StagesSheet(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge::figures
