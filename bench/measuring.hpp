// How good competitors are on frames, and which setting of a peer is best.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "competitors.hpp"
#include "test_frames.hpp"
#include "thermedge/eval/counts.hpp"

namespace thermedge::bench {

struct Performance {
  eval::MatchCounts counts;  // summed over the frames
  double ms = 0;             // median processor time of a frame
};
[[nodiscard]] Performance measure(const Competitor& competitor, std::size_t setting,
                                  const std::vector<TestFrame>& frames);

// F, precision and recall as columns of a CSV file.
[[nodiscard]] std::string quality_cells(const eval::MatchCounts& counts);

// The setting with the best F over these frames (ties: the first).
[[nodiscard]] std::size_t best_setting(const Competitor& competitor,
                                       const std::vector<TestFrame>& frames);

// Random scenes `first_seed`, first_seed + 1 ... with their noise.
[[nodiscard]] std::vector<CleanScene> random_scenes(std::uint64_t first_seed, int count);
[[nodiscard]] std::vector<TestFrame> exposed(const std::vector<CleanScene>& scenes,
                                             double sigma_counts, std::uint64_t seed);

// Processor time of all threads of this process until now, ms. Other programs don't count.
[[nodiscard]] double processor_ms();

[[nodiscard]] double median(std::vector<double> values);

}  // namespace thermedge::bench
