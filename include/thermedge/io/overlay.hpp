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

enum class OverlayContent : std::uint8_t {
  kKept,       // the kept edges, coloured by rank
  kExplained,  // all edges, coloured by their status
};

// Colour of edges in an explained overlay.
[[nodiscard]] Rgb status_colour(EdgeStatus status);

// The frame (`counts`; black, where it is empty) enlarged twice, darkened, with edges as thin
// lines: the kept ones with their corners as small squares, and junctions as rings. Dropped edges
// are drawn only where they are asked for, without corners and below the kept ones.
void draw_overlay(const Detection& detection, ImageView<const std::uint16_t> counts,
                  Image<Rgb>& overlay, OverlayContent content = OverlayContent::kKept);

}  // namespace thermedge::io
