// Verdicts, order and budgets.
#include "thermedge/stages/selection.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace thermedge {
namespace {

// Edges of 40, 30, 20 and 10 edgels, best first, with these numbers of false alarms and scores; the
// first and the last are connected.
EdgeSet four_edges(const std::vector<double>& log10_nfa, const std::vector<double>& scores) {
  EdgeSet set;
  for (std::size_t i = 0; i < 4; ++i) {
    Edge edge;
    edge.index = edge.rank = static_cast<int>(i);
    edge.score = scores[i];
    edge.log10_nfa = log10_nfa[i];
    edge.edgels = {static_cast<std::uint32_t>(set.edgels.size()),
                   static_cast<std::uint32_t>(40 - 10 * i)};
    set.edgels.resize(set.edgels.size() + edge.edgels.count);
    std::fill_n(set.edgels.edge.end() - edge.edgels.count, edge.edgels.count, edge.index);
    if (i % 3 == 0) {
      edge.connections = {static_cast<std::uint32_t>(set.connections.size()), 1};
      set.connections.push_back(i == 0 ? 3 : 0);
    }
    set.edges.push_back(edge);
  }
  return set;
}

EdgeSet selected(const SelectionOptions& options) {
  EdgeSet set = four_edges({-9, -9, -9, -9}, {4, 3, 2, 1});
  EXPECT_TRUE(EdgeSelector(options).run(set));
  return set;
}

TEST(EdgeSelector, BudgetOfEdges) {
  EXPECT_EQ(selected({0, 0}).kept, 4U);
  EXPECT_EQ(selected({4, 0}).kept, 4U);
  EXPECT_EQ(selected({9, 0}).kept, 4U);
  const EdgeSet set = selected({3, 0});
  EXPECT_EQ(set.kept_edges().size(), 3U);
  EXPECT_EQ(set.edges.size(), 4U);
  EXPECT_TRUE(set.edges[2].kept);
  EXPECT_FALSE(set.edges[3].kept);
  EXPECT_EQ(set.edges[3].status, EdgeStatus::kBeyondBudget);
}

TEST(EdgeSelector, BudgetOfEdgels) {
  EXPECT_EQ(selected({0, 39}).kept, 0U);
  EXPECT_EQ(selected({0, 40}).kept, 1U);
  EXPECT_EQ(selected({0, 69}).kept, 1U);
  EXPECT_EQ(selected({0, 70}).kept, 2U);
  EXPECT_EQ(selected({0, 1000}).kept, 4U);
  EXPECT_EQ(selected({1, 1000}).kept, 1U);
}

// What fails is drawn no stronger than what is kept.
TEST(EdgeSelector, StrengthFollowsTheNewOrder) {
  EdgeSet set = four_edges({-9, 0, -9, -9}, {4, 3, 2, 1});
  for (Edge& edge : set.edges) {
    edge.display_strength = edge.score / 4;
  }
  SelectionOptions options;
  options.max_false_alarms = 0.1;
  ASSERT_TRUE(EdgeSelector(options).run(set));
  ASSERT_EQ(set.edges[3].status, EdgeStatus::kInsignificant);
  EXPECT_EQ(set.edges[3].score, 3);
  EXPECT_EQ(set.edges[0].display_strength, 1);
  EXPECT_EQ(set.edges[2].display_strength, 0.25);
  EXPECT_EQ(set.edges[3].display_strength, 0.25);
}

TEST(EdgeSelector, EdgesThatFailGoBehindTheOthers) {
  SelectionOptions options;
  options.min_score = 1.5;
  options.max_false_alarms = 0.01;
  EdgeSet set = four_edges({-1, -5, -5, -5}, {4, 3, 2, 1});
  ASSERT_TRUE(EdgeSelector(options).run(set));
  EXPECT_EQ(set.kept, 2U);
  const std::vector<EdgeStatus> expected = {EdgeStatus::kKept, EdgeStatus::kKept,
                                            EdgeStatus::kInsignificant, EdgeStatus::kWeak};
  const std::vector<double> scores = {3, 2, 4, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    const Edge& edge = set.edges[i];
    EXPECT_EQ(edge.status, expected[i]);
    EXPECT_EQ(edge.score, scores[i]);
    EXPECT_EQ(edge.rank, static_cast<int>(i));
    for (std::uint32_t k = 0; k < edge.edgels.count; ++k) {
      EXPECT_EQ(set.edgels.edge[edge.edgels.first + k], edge.index);
    }
  }
  ASSERT_EQ(set.connections_of(set.edges[2]).size(), 1U);
  EXPECT_EQ(set.connections_of(set.edges[2])[0], 3);
  EXPECT_EQ(set.connections_of(set.edges[3])[0], 2);
}

// Contrasts of 8, 6, 4 and 2 counts; the noise is stronger where the second edge lies.
EdgeSet edges_with_contrast() {
  EdgeSet set = four_edges({-9, -9, -9, -9}, {4, 3, 2, 1});
  const std::vector<double> sigmas = {4, 1.5, 2, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    set.edges[i].contrast_counts = 8 - 2 * static_cast<double>(i);
    set.edges[i].contrast_sigmas = sigmas[i];
  }
  return set;
}

// The contrasts in counts of what is kept; the others must be said to have too little of it.
std::vector<double> kept_contrasts(const SelectionOptions& options, double counts_per_unit = 1) {
  EdgeSet set = edges_with_contrast();
  EXPECT_TRUE(EdgeSelector(options).run(set, counts_per_unit));
  std::vector<double> kept;
  for (const Edge& edge : set.edges) {
    EXPECT_EQ(edge.status, edge.kept ? EdgeStatus::kKept : EdgeStatus::kLowContrast);
    if (edge.kept) {
      kept.push_back(edge.contrast_counts);
    }
  }
  return kept;
}

TEST(EdgeSelector, DropsWhatHasLessContrastThanAskedFor) {
  using Kept = std::vector<double>;
  const auto asked = [](double value, ContrastUnit unit, double degc_per_count = 0) {
    SelectionOptions options;
    options.min_contrast = {value, unit};
    options.degc_per_count = degc_per_count;
    return options;
  };
  EXPECT_EQ(kept_contrasts({}), (Kept{8, 6, 4, 2}));
  EXPECT_EQ(kept_contrasts(asked(4, ContrastUnit::kCounts)), (Kept{8, 6, 4}))
      << "as much is enough";
  EXPECT_EQ(kept_contrasts(asked(4.01, ContrastUnit::kCounts)), (Kept{8, 6}));
  EXPECT_EQ(kept_contrasts(asked(2, ContrastUnit::kSigma)), (Kept{8, 4}));
  EXPECT_EQ(kept_contrasts(asked(0.25, ContrastUnit::kDegc, 0.0625)), (Kept{8, 6, 4}));
  // Units of a float frame of which one is 3 counts; those of the noise are the same.
  EXPECT_EQ(kept_contrasts(asked(2, ContrastUnit::kCounts), 3), (Kept{8, 6}));
  EXPECT_EQ(kept_contrasts(asked(2, ContrastUnit::kDegc, 1), 3), (Kept{8, 6}));
  EXPECT_EQ(kept_contrasts(asked(2, ContrastUnit::kSigma), 3), (Kept{8, 4}));
}

TEST(EdgeSelector, ContrastIsAskedForLast) {
  SelectionOptions options{.min_score = 1.5, .max_false_alarms = 0.01, .min_contrast = {100}};
  EdgeSet set = four_edges({-1, -5, -5, -5}, {4, 3, 2, 1});
  ASSERT_TRUE(EdgeSelector(options).run(set));
  EXPECT_EQ(set.kept, 0U);
  const std::vector<EdgeStatus> expected = {EdgeStatus::kInsignificant, EdgeStatus::kLowContrast,
                                            EdgeStatus::kLowContrast, EdgeStatus::kWeak};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(set.edges[i].status, expected[i]);
  }
}

// Without noise any contrast is enough; an edge map has none that could be too little.
TEST(EdgeSelector, KeepsEdgesWhoseContrastIsInfiniteOrUnknown) {
  for (const double contrast :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    for (const ContrastUnit unit : {ContrastUnit::kCounts, ContrastUnit::kSigma}) {
      EdgeSet set = edges_with_contrast();
      for (Edge& edge : set.edges) {
        edge.contrast_counts = edge.contrast_sigmas = contrast;
      }
      SelectionOptions options;
      options.min_contrast = {5, unit};
      ASSERT_TRUE(EdgeSelector(options).run(set));
      EXPECT_EQ(set.kept, 4U);
    }
  }
}

TEST(EdgeSelector, DegreesNeedTheWorthOfACount) {
  EdgeSet set;
  SelectionOptions options;
  options.min_contrast = {0.5, ContrastUnit::kDegc};
  const Status status = EdgeSelector(options).run(set);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().option, "selection.min_contrast");
  EXPECT_EQ(status.error().message,
            "selection.min_contrast = 0.5degC needs the worth of a count: set "
            "selection.degc_per_count (on the command line --degc-per-count or --camera)");
  options.degc_per_count = 0.01;
  EXPECT_TRUE(EdgeSelector(options).run(set));
}

TEST(EdgeSelector, KeepsTheJunctionsOfKeptEdges) {
  EdgeSet set = four_edges({-9, -9, -9, -9}, {4, 3, 2, 1});
  // Edge i runs along row 2 i.
  for (const Edge& edge : set.edges) {
    for (std::uint32_t k = 0; k < edge.edgels.count; ++k) {
      set.edgels.x[edge.edgels.first + k] = static_cast<float>(k);
      set.edgels.y[edge.edgels.first + k] = static_cast<float>(2 * edge.index);
    }
  }
  set.junctions = {{{5, 1}}, {{5, 5}}, {{35, 1}}};  // of edges 0 and 1, 2 and 3, 0 alone
  EdgeSelector selector({2, 0});
  ASSERT_TRUE(selector.run(set));
  selector.keep_junctions(60, 20, set);
  ASSERT_EQ(set.junctions.size(), 1U);
  EXPECT_EQ(set.junctions[0].at, (Pixel{5, 1}));
}

TEST(EdgeSelector, TuningSaysHowNearEdgesMeetAtAJunction) {
  for (const int reach : {0, 1}) {
    EdgeSet set = four_edges({-9, -9, -9, -9}, {4, 3, 2, 1});
    for (const Edge& edge : set.edges) {
      for (std::uint32_t k = 0; k < edge.edgels.count; ++k) {
        set.edgels.x[edge.edgels.first + k] = static_cast<float>(k);
        set.edgels.y[edge.edgels.first + k] = static_cast<float>(2 * edge.index);
      }
    }
    set.junctions = {{{5, 1}}};
    EdgeSelector selector({2, 0}, {.junction_reach_px = reach});
    ASSERT_TRUE(selector.run(set));
    selector.keep_junctions(60, 20, set);
    EXPECT_EQ(set.junctions.size(), reach == 0 ? 0U : 1U);
  }
}

TEST(EdgeSelector, RefusesBudgetsBelowZero) {
  EdgeSet set;
  EXPECT_FALSE(EdgeSelector({-1, 0}).run(set));
}

}  // namespace
}  // namespace thermedge
