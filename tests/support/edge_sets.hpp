// Edge sets made by hand, for tests.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "thermedge/edge_set.hpp"

namespace thermedge::test {

// Appends an edge through `points`, ranked behind those before; everything that is measured is 0.
// Kept edges must come first.
inline Edge& add_edge(EdgeSet& set, const std::vector<std::pair<float, float>>& points,
                      bool closed = false, bool kept = true) {
  Edgels& edgels = set.edgels;
  Edge edge;
  edge.index = static_cast<std::int32_t>(set.edges.size());
  edge.rank = edge.index;
  edge.closed = closed;
  edge.kept = kept;
  edge.edgels = {static_cast<std::uint32_t>(edgels.x.size()),
                 static_cast<std::uint32_t>(points.size())};
  for (const auto& [x, y] : points) {
    edgels.x.push_back(x);
    edgels.y.push_back(y);
    edgels.edge.push_back(edge.index);
  }
  for (auto* values :
       {&edgels.nx, &edgels.ny, &edgels.magnitude_counts, &edgels.position_sigma_px}) {
    values->resize(edgels.x.size());
  }
  edgels.previous.resize(edgels.x.size(), -1);
  edgels.next.resize(edgels.x.size(), -1);
  set.kept += kept ? 1 : 0;
  return set.edges.emplace_back(edge);
}

}  // namespace thermedge::test
