// One-to-one matching of found and true edge pixels that lie close to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/stages/contours.hpp"

namespace thermedge::eval {

// Who can be matched with whom: found pixels and the true pixels within a radius of each, nearest
// first (ties: in reading order). Immutable after construction; const functions are thread-safe.
class MatchGraph {
 public:
  // `found`: pixels inside the map. `truth`: nonzero pixels are true. radius_px >= 0: distances up
  // to and including it count. Cost: in proportion to found pixels times the area of the disc.
  MatchGraph(std::span<const Pixel> found, ImageView<const std::uint8_t> truth, double radius_px);

  [[nodiscard]] std::size_t found_count() const { return starts_.size() - 1; }
  [[nodiscard]] std::size_t truth_count() const { return truth_count_; }

  // A true pixel near a found one. `ring` numbers the distances that occur, 0 = nearest.
  struct Partner {
    std::int32_t truth;
    std::int32_t ring;
  };
  [[nodiscard]] std::span<const Partner> partners(std::size_t found) const {
    return {partners_.data() + starts_[found], starts_[found + 1] - starts_[found]};
  }
  [[nodiscard]] int rings() const { return rings_; }

 private:
  std::vector<std::size_t> starts_;  // of each found pixel in partners_, and the end
  std::vector<Partner> partners_;
  std::size_t truth_count_ = 0;
  int rings_ = 0;
};

// Largest matchings of parts of the found pixels. Keeps scratch memory; one caller at a time; the
// graph must outlive it.
// With several annotators a found pixel counts when any of them matches it, and then it matters
// which of the largest matchings is taken: pairs are formed nearest first, then by the found
// pixel's number; found pixels without partner are then tried in rising order, in phases of
// shortest-first layers (Hopcroft & Karp 1973).
class PixelMatcher {
 public:
  explicit PixelMatcher(const MatchGraph& graph);

  // Matches the found pixels whose numbers are in `chosen` (rising). Gives the number of pairs.
  std::size_t match(std::span<const std::int32_t> chosen);
  // Whether this one of the chosen pixels has a partner in the last match.
  [[nodiscard]] bool is_matched(std::int32_t found) const {
    return truth_of_[static_cast<std::size_t>(found)] >= 0;
  }

 private:
  void pair_nearest(std::span<const std::int32_t> chosen);
  [[nodiscard]] bool make_layers(std::span<const std::int32_t> chosen);
  [[nodiscard]] bool augment(std::int32_t root);
  void pair(std::int32_t found, std::int32_t truth);

  const MatchGraph& graph_;
  std::vector<std::int32_t> truth_of_;  // of a found pixel, -1: none
  std::vector<std::int32_t> found_of_;  // of a true pixel, -1: none
  std::vector<std::int32_t> layer_;     // of a found pixel in the current phase
  std::vector<std::uint32_t> next_;     // partner of a found pixel to try next
  std::vector<std::int32_t> queue_, path_;
  std::size_t pairs_ = 0;
};

// For found pixels that are added one after the other (`order`: their numbers): whether the one
// added makes the largest matching larger. The sum of the first n flags is the number of pairs of
// the first n pixels, and the flagged ones among them can all be matched at once.
[[nodiscard]] std::vector<std::uint8_t> match_in_order(const MatchGraph& graph,
                                                       std::span<const std::int32_t> order);

}  // namespace thermedge::eval
