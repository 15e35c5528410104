#include "chain_labels.hpp"

#include <algorithm>
#include <limits>

namespace thermedge::detail {

void ChainLabels::choose(std::span<const LabelVote> votes, std::span<const std::uint8_t> is_break,
                         const LabelCosts& costs, std::span<std::int32_t> labels) {
  candidates_.assign(1, -1);
  for (const LabelVote& vote : votes) {
    if (vote.label >= 0) {
      candidates_.push_back(vote.label);
    }
  }
  std::sort(candidates_.begin(), candidates_.end());
  candidates_.erase(std::unique(candidates_.begin(), candidates_.end()), candidates_.end());
  // More labels on one chain than any real one has; the rest would not fit into from_.
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  candidates_.resize(std::min(candidates_.size(), kMost));
  const std::size_t count = candidates_.size();
  if (count == 1) {
    std::fill(labels.begin(), labels.end(), -1);
    return;
  }
  const auto cost_of = [&](const LabelVote& vote, std::int32_t label) {
    if (vote.label < 0) {
      return label < 0 ? 0.0 : costs.unvoted;
    }
    return vote.label == label ? 0.0 : static_cast<double>(vote.weight);
  };
  costs_.assign(count, 0);
  next_.resize(count);
  from_.resize(votes.size() * count);
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const auto best =
        static_cast<std::size_t>(std::min_element(costs_.begin(), costs_.end()) - costs_.begin());
    const double change = i == 0 ? 0 : is_break[i - 1] != 0 ? costs.change_at_break : costs.change;
    for (std::size_t k = 0; k < count; ++k) {
      const bool stays = costs_[k] <= costs_[best] + change;
      from_[i * count + k] = static_cast<std::uint16_t>(stays ? k : best);
      next_[k] = (stays ? costs_[k] : costs_[best] + change) + cost_of(votes[i], candidates_[k]);
    }
    costs_.swap(next_);
  }
  auto at =
      static_cast<std::size_t>(std::min_element(costs_.begin(), costs_.end()) - costs_.begin());
  for (std::size_t i = votes.size(); i-- > 0;) {
    labels[i] = candidates_[at];
    at = from_[i * count + at];
  }
}

}  // namespace thermedge::detail
