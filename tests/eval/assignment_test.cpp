// The best assignment against a look at all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "assignment.hpp"

namespace thermedge::eval {
namespace {

using Pairs = std::vector<PossiblePair>;

// The largest sum of gains that rows from `row` on can have with columns that are not taken.
double best_sum(const Pairs& pairs, std::int32_t rows, std::int32_t row,
                std::set<std::int32_t>& taken) {
  if (row == rows) {
    return 0;
  }
  double best = best_sum(pairs, rows, row + 1, taken);
  for (const PossiblePair& pair : pairs) {
    if (pair.row == row && taken.insert(pair.column).second) {
      best = std::max(best, pair.gain + best_sum(pairs, rows, row + 1, taken));
      taken.erase(pair.column);
    }
  }
  return best;
}

// The sum of the gains of an assignment, which takes each column once and only pairs that there
// are.
double sum_of(const Pairs& pairs, const std::vector<std::int32_t>& columns) {
  double sum = 0;
  std::set<std::int32_t> taken;
  for (std::size_t row = 0; row < columns.size(); ++row) {
    if (columns[row] < 0) {
      continue;
    }
    EXPECT_TRUE(taken.insert(columns[row]).second);
    const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const PossiblePair& one) {
      return one.row == static_cast<std::int32_t>(row) && one.column == columns[row];
    });
    EXPECT_NE(pair, pairs.end());
    sum += pair != pairs.end() ? pair->gain : 0;
  }
  return sum;
}

TEST(Assignment, HasTheLargestSumOfAll) {
  std::mt19937 random(3);
  const auto chance = [&] { return static_cast<double>(random() % 10000) / 10000; };
  for (int trial = 0; trial < 600; ++trial) {
    const auto rows = static_cast<std::int32_t>(random() % 7);
    const auto columns = static_cast<std::int32_t>(1 + random() % 6);
    const double density = 0.2 + 0.8 * chance();
    Pairs pairs;
    for (std::int32_t row = 0; row < rows; ++row) {
      for (std::int32_t column = 0; column < columns; ++column) {
        if (chance() < density) {
          // Few different gains now and then, so that many assignments are equally good.
          const double gain = trial % 3 == 0 ? 1 + static_cast<double>(random() % 3) : chance();
          pairs.push_back({row, column, gain + 1e-3});
        }
      }
    }
    const auto found =
        best_assignment(pairs, static_cast<std::size_t>(rows), static_cast<std::size_t>(columns));
    ASSERT_EQ(found.size(), static_cast<std::size_t>(rows));
    std::set<std::int32_t> taken;
    ASSERT_NEAR(sum_of(pairs, found), best_sum(pairs, rows, 0, taken), 1e-9) << trial;
  }
}

// Two rows of samples, each within reach of its neighbours: all are paired side by side.
TEST(Assignment, PairsSamplesOfACurveSideBySide) {
  constexpr std::int32_t kSamples = 2000;
  Pairs pairs;
  for (std::int32_t row = 0; row < kSamples; ++row) {
    for (std::int32_t column = std::max(row - 1, 0); column <= std::min(row + 1, kSamples - 1);
         ++column) {
      pairs.push_back({row, column, column == row ? 0.5 : 0.499999});
    }
  }
  const auto columns = best_assignment(pairs, kSamples, kSamples);
  for (std::int32_t row = 0; row < kSamples; ++row) {
    ASSERT_EQ(columns[static_cast<std::size_t>(row)], row);
  }
}

}  // namespace
}  // namespace thermedge::eval
