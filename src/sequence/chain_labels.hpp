// The labels of the points of a chain that cost least.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/memory.hpp"

namespace thermedge::detail {

struct LabelVote {
  std::int32_t label = -1;  // -1: none
  float weight = 0;         // 0..1: how sure it is
};

struct LabelCosts {
  double change = 6;           // of another label than that of the point before
  double change_at_break = 1;  // the same behind a point that is a break
  double unvoted = 0.25;       // of any label at a point without a vote
};

// Viterbi's algorithm over the labels that were voted for and "none" (-1). A point with a vote
// costs its weight where it gets another label. Reuses its memory.
class ChainLabels {
 public:
  // `is_break[i]`: a change between point i and i + 1 costs little. Fills `labels`, as long as
  // `votes`. Of labels that cost the same, that of the smaller number wins.
  void choose(std::span<const LabelVote> votes, std::span<const std::uint8_t> is_break,
              const LabelCosts& costs, std::span<std::int32_t> labels);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(candidates_, costs_, next_, from_);
  }

 private:
  std::vector<std::int32_t> candidates_;
  std::vector<double> costs_, next_;
  std::vector<std::uint16_t> from_;  // a row of candidates for each point
};

}  // namespace thermedge::detail
