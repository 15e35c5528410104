// A detection as text: JSON and SVG.
#pragma once

#include <string>

#include "thermedge/detector.hpp"

namespace thermedge::io {

// Names that a result carries besides what was detected.
struct ResultLabel {
  std::string source;  // where the frame came from
  std::string preset;
};

// The kept edges of a frame as one line of JSON: source, width, height, preset, sigma_counts, edges
// (id, rank, score, es, z, log10_nfa, closed, length_px, contrast_counts, corners, connected,
// track, points), junctions, stats (ms of each stage, edges found, dead pixels, thresholds). Points
// are sub-pixel [x, y], pixel centres at integers, rounded to 1/1000 px. Values that were not
// measured (contrast without a frame, a track without a tracker) are null.
[[nodiscard]] std::string edges_to_json(const Detection& detection, const ResultLabel& label);

// The kept edges as vectors in pixel coordinates, one path per edge with its id, rank and score;
// junctions as circles, corners as squares.
[[nodiscard]] std::string edges_to_svg(const Detection& detection, const ResultLabel& label);

}  // namespace thermedge::io
