// A detection as text: JSON and SVG.
#pragma once

#include <string>

#include "thermedge/detector.hpp"

namespace thermedge::io {

// The kept edges of a frame as one line of JSON: source, width, height, preset, sigma_counts, edges
// (index, rank, score, es, z, log10_nfa, closed, begins_at_invalid, ends_at_invalid,
// length_px, contrast_counts, corners, connected, points), junctions, stats (ms of each stage,
// noise that was measured, edges found and dropped, invalid and bad pixels, thresholds). Points are
// sub-pixel [x, y], pixel centres at integers, rounded to 1/1000 px. Values that were not measured
// (contrast without a frame) or are infinite (z and NFA without noise) are null.
[[nodiscard]] std::string edges_to_json(const Detection& detection, const std::string& source);

// The kept edges as vectors in pixel coordinates, one path per edge with its index, rank and score;
// junctions as circles, corners as squares. What of `source` cannot stand in XML (bytes that are
// not UTF-8, control characters) becomes question marks.
[[nodiscard]] std::string edges_to_svg(const Detection& detection, const std::string& source);

}  // namespace thermedge::io
