// Why each edge was kept or dropped, drawn over the frame.
#pragma once

#include <cstdint>

#include "thermedge/detection.hpp"
#include "thermedge/figures/figure.hpp"
#include "thermedge/image.hpp"

namespace thermedge::figures {

// The overlay of all edges (io::OverlayContent::kExplained), one point a pixel, and below it what
// each colour means, the option that decides, and how many edges it has. `counts`: the frame; black
// where it is empty.
[[nodiscard]] Figure draw_explained_overlay(const Detection& detection,
                                            ImageView<const std::uint16_t> counts);

}  // namespace thermedge::figures
