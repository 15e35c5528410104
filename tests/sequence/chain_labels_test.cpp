// Labels along chains against all labellings that there are.
#include "chain_labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace thermedge::detail {
namespace {

using Labels = std::vector<std::int32_t>;

double cost_of(const std::vector<LabelVote>& votes, const std::vector<std::uint8_t>& is_break,
               const LabelCosts& costs, const Labels& labels) {
  double sum = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (votes[i].label < 0) {
      sum += labels[i] < 0 ? 0 : costs.unvoted;
    } else {
      sum += labels[i] == votes[i].label ? 0 : static_cast<double>(votes[i].weight);
    }
    if (i > 0 && labels[i] != labels[i - 1]) {
      sum += is_break[i - 1] != 0 ? costs.change_at_break : costs.change;
    }
  }
  return sum;
}

double least_cost(const std::vector<LabelVote>& votes, const std::vector<std::uint8_t>& is_break,
                  const LabelCosts& costs, const Labels& candidates) {
  double best = std::numeric_limits<double>::max();
  std::vector<std::size_t> digits(votes.size(), 0);
  while (true) {
    Labels labels(votes.size());
    std::transform(digits.begin(), digits.end(), labels.begin(),
                   [&](std::size_t digit) { return candidates[digit]; });
    best = std::min(best, cost_of(votes, is_break, costs, labels));
    std::size_t i = 0;
    while (i < digits.size() && ++digits[i] == candidates.size()) {
      digits[i++] = 0;
    }
    if (i == digits.size()) {
      return best;
    }
  }
}

TEST(ChainLabels, CostNoMoreThanAnyOtherLabelling) {
  std::mt19937 random(3);
  ChainLabels chain;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<LabelVote> votes(7);
    std::vector<std::uint8_t> is_break(7);
    for (std::size_t i = 0; i < votes.size(); ++i) {
      const int label = std::uniform_int_distribution<int>(-1, 2)(random);
      votes[i] = {label, std::uniform_real_distribution<float>(0, 1)(random)};
      is_break[i] = std::uniform_int_distribution<int>(0, 3)(random) == 0 ? 1 : 0;
    }
    const LabelCosts costs{0.9, 0.2, 0.15};
    Labels labels(votes.size(), 99);
    chain.choose(votes, is_break, costs, labels);
    EXPECT_NEAR(cost_of(votes, is_break, costs, labels),
                least_cost(votes, is_break, costs, {-1, 0, 1, 2}), 1e-5);
  }
}

TEST(ChainLabels, AFewWrongVotesChangeNothing) {
  std::vector<LabelVote> votes(30, {4, 1});
  votes[10] = votes[11] = {7, 1};
  Labels labels(30);
  ChainLabels().choose(votes, std::vector<std::uint8_t>(30, 0), {}, labels);
  EXPECT_EQ(labels, Labels(30, 4));
}

TEST(ChainLabels, ChangeAtTheBreak) {
  std::vector<LabelVote> votes(30);
  std::fill_n(votes.begin(), 12, LabelVote{1, 1});
  std::fill_n(votes.begin() + 18, 12, LabelVote{2, 1});
  std::vector<std::uint8_t> is_break(30, 0);
  is_break[14] = 1;
  Labels labels(30);
  ChainLabels().choose(votes, is_break, {}, labels);
  Labels expected(30, 2);
  std::fill_n(expected.begin(), 15, 1);
  EXPECT_EQ(labels, expected);
}

TEST(ChainLabels, WithoutVotesThereIsNone) {
  Labels labels(5, 3);
  ChainLabels().choose(std::vector<LabelVote>(5), std::vector<std::uint8_t>(5, 0), {}, labels);
  EXPECT_EQ(labels, Labels(5, -1));
}

}  // namespace
}  // namespace thermedge::detail
