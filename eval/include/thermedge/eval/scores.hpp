// Figures of merit over a set of frames: ODS, OIS, AP; Pratt's figure of one map.
#pragma once

#include <span>
#include <vector>

#include "thermedge/eval/counts.hpp"

namespace thermedge::eval {

// The usual set of thresholds for strength maps: `count` (1..254) of them, evenly spread
// over 1..255 without the ends, rising, each once.
[[nodiscard]] std::vector<int> spread_thresholds(int count);

struct Scores {
  double f = 0;  // ODS: the best F of the summed counts over all thresholds; between neighbouring
                 // thresholds precision and recall are interpolated
  double threshold = 0;              // where that is
  double precision = 0, recall = 0;  // there
  double ois = 0;                    // F of the summed counts, each frame at its own best threshold
  double ap = 0;  // area under precision over recall, in steps of 0.01; 0 for a single threshold
};

// `counts[frame][threshold]`: at least one frame, all with as many counts as there are thresholds.
[[nodiscard]] Scores score(std::span<const std::vector<MatchCounts>> counts,
                           std::span<const int> thresholds);

// Pratt's figure of merit (1978): sum of 1 / (1 + d^2 / 9) over the found pixels, d px from the
// nearest true one, divided by the number of found or of true pixels, whichever is larger. 1 where
// both maps are empty, 0 where one is. Maps of one size, nonzero: edge. Thread-safe.
struct PrattFom {
  double mean = 0;  // over annotators
  double best = 0;
};
[[nodiscard]] PrattFom pratt_merit(ImageView<const std::uint8_t> found,
                                   std::span<const Image<std::uint8_t>> annotators);

}  // namespace thermedge::eval
