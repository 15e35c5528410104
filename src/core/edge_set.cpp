#include "thermedge/edge_set.hpp"

namespace thermedge {
namespace {

// Calls `change` for each array of edgels.
template <class Change>
void for_each_array(Edgels& edgels, Change&& change) {
  for (auto* values : {&edgels.x, &edgels.y, &edgels.nx, &edgels.ny, &edgels.magnitude_counts,
                       &edgels.position_sigma_px}) {
    change(*values);
  }
  for (auto* values : {&edgels.edge, &edgels.previous, &edgels.next}) {
    change(*values);
  }
}

}  // namespace

void Edgels::resize(std::size_t count) {
  for_each_array(*this, [=](auto& values) { values.resize(count); });
}

void Edgels::reserve(std::size_t count) {
  for_each_array(*this, [=](auto& values) { values.reserve(count); });
}

void EdgeSet::clear() {
  edgels.resize(0);
  edges.clear();
  corners.clear();
  connections.clear();
  junctions.clear();
  kept = 0;
}

}  // namespace thermedge
