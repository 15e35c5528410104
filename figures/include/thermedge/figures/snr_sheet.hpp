// Frames of high and of low signal-to-noise ratio side by side: the paper's figure 5.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "thermedge/figures/figure.hpp"
#include "thermedge/image.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/result.hpp"

namespace thermedge::figures {

struct SnrFrame {
  ImageView<const std::uint16_t> counts;
  std::string source;  // names the frame on the sheet
};

inline constexpr std::size_t kMostSnrFrames = 6;

// Of each frame, whose bad pixels are replaced first, a column: its counts, with their range in
// degC (eqs. 3 and 4), the noise and the ratio of both, and its 8-bit view by Algorithm 1. Errors:
// no frame or more than kMostSnrFrames, an option out of range.
[[nodiscard]] Result<Figure> draw_snr(std::span<const SnrFrame> frames,
                                      const GreyScaleOptions& grey_scale = {},
                                      double degc_per_count = kDegcPerCount,
                                      double panel_width = kPanelWidth);

}  // namespace thermedge::figures
