// One edge map against its truth: matched pixels at each threshold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/result.hpp"

namespace thermedge::eval {

// The true edges of a frame, as maps (nonzero: edge) of one size.
struct TruthMaps {
  std::vector<Image<std::uint8_t>> annotators;  // at least one; recall is measured on these
  // Edges that may be found without being asked for (weak ones): where not empty, precision is
  // measured on these instead.
  std::vector<Image<std::uint8_t>> accepted;
};

// Pixels at one threshold, or sums of them over frames.
struct MatchCounts {
  std::int64_t truth_matched = 0;  // summed over annotators
  std::int64_t truth = 0;          // summed over annotators
  std::int64_t found_matched = 0;  // by any annotator
  std::int64_t found = 0;

  // Shares of 1; where there is nothing to divide by, 0. Both are 1 where there is nothing to find
  // and nothing was found.
  [[nodiscard]] double recall() const;
  [[nodiscard]] double precision() const;
  [[nodiscard]] double f_measure() const;
  MatchCounts& operator+=(const MatchCounts& other);
  friend bool operator==(const MatchCounts&, const MatchCounts&) = default;
};

// 2 P R / (P + R), 0 where both are 0.
[[nodiscard]] double f_measure(double precision, double recall);

struct CountOptions {
  double max_distance = 0.0075;  // of pairs, share of the image diagonal, 0..0.1
  bool thin = true;  // thin the map at every threshold (protocol of BSDS); false: thin it once by
                     // strength, so that one pass serves all thresholds
};

// The largest distance of a pair in a frame of this size, px.
[[nodiscard]] double match_radius_px(const CountOptions& options, int width, int height);

// Counts for each of the thresholds (rising, 1..255): pixels of at least that strength are found.
// Errors: a size that differs, no annotators. Thread-safe.
// Source: Martin, Fowlkes & Malik (2004) with a largest matching instead of one of least cost.
[[nodiscard]] Result<std::vector<MatchCounts>> count_matches(ImageView<const std::uint8_t> strength,
                                                             const TruthMaps& truth,
                                                             std::span<const int> thresholds,
                                                             const CountOptions& options);

// Pixels of at least `threshold` as a map of 0 and 1, one pixel wide.
void thin_at(ImageView<const std::uint8_t> strength, double threshold, Image<std::uint8_t>& map);

// The same for maps that are judged: a map that is just what an annotator drew stays as it is, so
// that a map against itself is exact.
void found_at(ImageView<const std::uint8_t> strength, double threshold,
              std::span<const Image<std::uint8_t>> annotators, Image<std::uint8_t>& map);

}  // namespace thermedge::eval
