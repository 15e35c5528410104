#include "thermedge/stages/selection.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

namespace thermedge {

Status SelectionOptions::check() const {
  return check_ranges(*this, "selection.").and_then([&]() -> Status {
    if (min_contrast.unit == ContrastUnit::kDegc && degc_per_count == 0) {
      return failure(
          ErrorCode::kInvalidArgument,
          "selection.min_contrast = " + detail::quantity_text(min_contrast, kContrastUnits) +
              " needs the worth of a count: set selection.degc_per_count (on the command line "
              "--degc-per-count or --camera)",
          "selection.min_contrast");
    }
    return {};
  });
}

Status EdgeSelector::run(EdgeSet& edges, double counts_per_unit) {
  if (Status status = options_.check(); !status) {
    return status;
  }
  bool in_order = true;
  for (Edge& edge : edges.edges) {
    edge.status = judge(edge, counts_per_unit);
    in_order = in_order && edge.status == EdgeStatus::kKept;
  }
  rank_of_.reserve(edges.edges.capacity());
  if (!in_order) {
    reorder(edges);
  }
  keep_best(edges);
  return {};
}

EdgeStatus EdgeSelector::judge(const Edge& edge, double counts_per_unit) const {
  if (edge.score < options_.min_score) {
    return EdgeStatus::kWeak;
  }
  if (options_.max_false_alarms > 0 && edge.log10_nfa > std::log10(options_.max_false_alarms)) {
    return EdgeStatus::kInsignificant;
  }
  return has_contrast(edge, counts_per_unit) ? EdgeStatus::kKept : EdgeStatus::kLowContrast;
}

// Edges of edge maps have no contrast, and pass.
bool EdgeSelector::has_contrast(const Edge& edge, double counts_per_unit) const {
  const double wanted = options_.min_contrast.value;
  switch (options_.min_contrast.unit) {
    case ContrastUnit::kCounts:
      return !(edge.contrast_counts < wanted * counts_per_unit);
    case ContrastUnit::kSigma:
      return !(edge.contrast_sigmas < wanted);
    case ContrastUnit::kDegc:
      return !(edge.contrast_counts * options_.degc_per_count < wanted * counts_per_unit);
  }
  return true;
}

void EdgeSelector::reorder(EdgeSet& edges) {
  std::sort(edges.edges.begin(), edges.edges.end(), [](const Edge& a, const Edge& b) {
    const bool a_fails = a.status != EdgeStatus::kKept;
    const bool b_fails = b.status != EdgeStatus::kKept;
    return std::tie(a_fails, a.rank) < std::tie(b_fails, b.rank);
  });
  rank_of_.resize(edges.edges.size());
  for (std::size_t i = 0; i < edges.edges.size(); ++i) {
    rank_of_[static_cast<std::size_t>(edges.edges[i].rank)] = static_cast<std::int32_t>(i);
  }
  double strength = 1;  // of those before
  for (std::size_t i = 0; i < edges.edges.size(); ++i) {
    Edge& edge = edges.edges[i];
    edge.display_strength = strength = std::min(edge.display_strength, strength);
    edge.index = edge.rank = static_cast<std::int32_t>(i);
    std::fill_n(edges.edgels.edge.begin() + edge.edgels.first, edge.edgels.count, edge.index);
    const auto connections = slice(edges.connections, edge.connections);
    std::transform(connections.begin(), connections.end(), connections.begin(),
                   [&](std::int32_t id) { return rank_of_[static_cast<std::size_t>(id)]; });
    std::sort(connections.begin(), connections.end());
  }
}

void EdgeSelector::keep_best(EdgeSet& edges) const {
  const std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  const auto limit = [=](int option) {
    return option > 0 ? static_cast<std::size_t>(option) : unlimited;
  };
  const std::size_t most_edges = limit(options_.keep_edges);
  const std::size_t most_edgels = limit(options_.max_edgels);
  std::size_t edgels = 0;
  bool within = true;
  for (Edge& edge : edges.edges) {
    if (edge.status != EdgeStatus::kKept) {
      break;
    }
    edgels += edge.edgels.count;
    within = within && edges.kept != most_edges && edgels <= most_edgels;
    if (within) {
      edge.kept = true;
      ++edges.kept;
    } else {
      edge.status = EdgeStatus::kBeyondBudget;
    }
  }
}

void EdgeSelector::keep_junctions(int width, int height, EdgeSet& edges) {
  constexpr std::int32_t kNobody = -1;
  const int reach = tuning_.junction_reach_px;
  owner_.resize(width, height);
  fill_pixels(owner_.view(), kNobody);
  for (const Edge& edge : edges.kept_edges()) {
    for (std::size_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
      owner_(static_cast<int>(std::floor(edges.edgels.x[i] + 0.5F)),
             static_cast<int>(std::floor(edges.edgels.y[i] + 0.5F))) = edge.index;
    }
  }
  std::erase_if(edges.junctions, [&](const Junction& junction) {
    std::int32_t first = kNobody;
    for (int y = junction.at.y - reach; y <= junction.at.y + reach; ++y) {
      for (int x = junction.at.x - reach; x <= junction.at.x + reach; ++x) {
        const std::int32_t owner = owner_.view().contains(x, y) ? owner_(x, y) : kNobody;
        if (owner != kNobody && first != kNobody && owner != first) {
          return false;
        }
        first = owner != kNobody ? owner : first;
      }
    }
    return true;
  });
}

}  // namespace thermedge
