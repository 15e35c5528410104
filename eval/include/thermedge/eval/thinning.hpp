// Edge maps made one pixel wide.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"

namespace thermedge::eval {

// Thins a binary map (nonzero: set) until nothing changes; set pixels become 1. Connections and
// ends stay. A border that is two pixels wide loses the same side everywhere, so the result is not
// symmetric under flips.
// Source: Lam, Lee & Suen (1992), conditions G1-G3 in two alternating passes, each of which takes
// all its pixels at once. Cost: in proportion to the set pixels. Thread-safe.
void thin(ImageView<std::uint8_t> map);

// Thins a strength map (0: none) by taking pixels away one at a time, weakest first (ties: in
// reading order), where that neither breaks a connection nor shortens an end. Strengths that stay
// are kept. The parts of the result above rising thresholds are nested, which makes a sweep over
// thresholds one pass. Thread-safe.
void thin_nested(ImageView<std::uint8_t> strength);

}  // namespace thermedge::eval
