// Edges drawn over the frame, for people.
#pragma once

#include <cstdint>

#include "thermedge/detector.hpp"
#include "thermedge/image.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::io {

// Grey view for the eye: counts between the 0.5th and the 99.5th percentile spread over 0..255 (a
// frame whose range is under 16 counts is spread over 16, so that noise is not blown up). Both of
// one size, which may be without pixels.
void draw_view(ImageView<const std::uint16_t> counts, ImageView<std::uint8_t> view);

// Colour of a rank: `share` 0 (best) .. 1 (last) runs from the yellow end of `plasma` over
// orange to purple, the darkest part left out.
[[nodiscard]] Rgb rank_colour(double share);

// The frame (`counts`; black, where it is empty) enlarged twice, darkened, with the kept
// edges as thin lines coloured by rank, their corners as small squares and junctions as rings.
// Edges beyond the budgets are drawn in a muted blue, without corners.
void draw_overlay(const Detection& detection, ImageView<const std::uint16_t> counts,
                  Image<Rgb>& overlay);

}  // namespace thermedge::io
