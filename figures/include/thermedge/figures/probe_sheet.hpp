// The properties of a recording as a picture.
#pragma once

#include <cstdint>
#include <string>

#include "thermedge/figures/figure.hpp"
#include "thermedge/image.hpp"
#include "thermedge/probe/probe.hpp"

namespace thermedge::figures {

// A frame of the recording, the histogram of its counts with what Algorithm 1 keeps of them, a map
// of the noise, the offsets of columns and rows, and median and noise over time where there is a
// sequence. `report` must be of at least one frame; `source` names the recording.
[[nodiscard]] Figure draw_probe(const RecordingReport& report, ImageView<const std::uint16_t> frame,
                                const std::string& source, double panel_width = kPanelWidth);

}  // namespace thermedge::figures
