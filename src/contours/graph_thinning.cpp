// The part of GraphTracer that thins the edge map.
#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

#include "graph_pixels.hpp"

namespace thermedge {
namespace {

using detail::graph::kNone;
using detail::graph::kVisited;
using detail::graph::set_around;

// Whether a pixel with these neighbours can go without changing how they are connected, and is no
// end of a line: one 8-connected group of two or more, with background at a side.
constexpr bool is_superfluous(unsigned around) {
  int groups = 0;  // Hilditch's crossing number
  for (unsigned k = 0; k < 8; k += 2) {
    const auto is_set = [&](unsigned i) { return (around >> (i % 8) & 1U) != 0; };
    if (!is_set(k) && (is_set(k + 1) || is_set(k + 2))) {
      ++groups;
    }
  }
  return groups == 1 && std::popcount(around) >= 2;
}

constexpr auto kSuperfluous = [] {
  std::array<bool, 256> table{};
  for (unsigned around = 0; around < table.size(); ++around) {
    table[around] = is_superfluous(around);
  }
  return table;
}();

}  // namespace

// Round by round, the weakest first. Only what lies beside a pixel that went can have become
// superfluous since it was looked at.
void GraphTracer::thin() {
  const std::uint8_t* const map = map_.row(0);
  std::vector<std::int32_t>& affected = pixels_;
  affected.assign(order_.begin(), order_.end());
  for (const std::int32_t pixel : order_) {
    label_[static_cast<std::size_t>(pixel)] = kNone;  // otherwise, it is in `affected`
  }
  while (!affected.empty()) {
    candidates_.clear();
    for (const std::int32_t pixel : affected) {
      label_[static_cast<std::size_t>(pixel)] = kNone;
      if (map[pixel] != 0 && kSuperfluous[set_around(map + pixel, map_.stride())]) {
        candidates_.push_back({strength_at(pixel), pixel});
      }
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return std::tie(a.response, a.pixel) < std::tie(b.response, b.pixel);
    });
    affected.clear();
    take_off_candidates();
  }
  std::erase_if(order_, [&](std::int32_t pixel) { return map[pixel] == 0; });
}

// Those that are still superfluous when it is their turn; pixels_ are their neighbours.
void GraphTracer::take_off_candidates() {
  std::uint8_t* const map = map_.row(0);
  for (const Candidate& candidate : candidates_) {
    const unsigned around = set_around(map + candidate.pixel, map_.stride());
    if (!kSuperfluous[around]) {
      continue;
    }
    map[candidate.pixel] = 0;
    for (unsigned bits = around; bits != 0; bits &= bits - 1) {
      const std::int32_t beside = neighbour(candidate.pixel, bits);
      std::int32_t& label = label_[static_cast<std::size_t>(beside)];
      if (label == kNone) {
        label = kVisited;
        pixels_.push_back(beside);
      }
    }
  }
}

}  // namespace thermedge
