#include "thermedge/eval/structure.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "neighbourhood.hpp"

namespace thermedge::eval {
namespace {

constexpr int kJunctionRuns = 3;

class StructureMeter {
 public:
  explicit StructureMeter(ImageView<const std::uint8_t> map)
      : pixels_(map), visited_(pixels_.size(), 0) {}

  MapStructure run(int short_px) {
    MapStructure result;
    result.edge_pixels = pixels_.places().size();
    for_each_group([](std::int32_t) { return true; },
                   [&] { result.fragments_px.push_back(size_of_group()); });
    for_each_group([&](std::int32_t place) { return !is_junction(place); },
                   [&] {
                     result.contours_px.push_back(size_of_group());
                     result.spurs += size_of_group() < short_px && hangs_by_one_end() ? 1 : 0;
                   });
    return result;
  }

 private:
  [[nodiscard]] bool is_junction(std::int32_t place) const {
    return runs(pixels_.code(place)) >= kJunctionRuns;
  }
  // At an end of a line at most two neighbours remain, side by side.
  [[nodiscard]] bool is_end(std::int32_t place) const {
    const unsigned code = pixels_.code(place);
    return runs(code) <= 1 && std::popcount(code) <= 2;
  }
  [[nodiscard]] std::int32_t size_of_group() const {
    return static_cast<std::int32_t>(group_.size());
  }

  template <class F>
  void for_each_neighbour(std::int32_t place, F&& visit) const {
    for (unsigned left = pixels_.code(place); left != 0; left &= left - 1) {
      visit(pixels_.neighbour(place, std::countr_zero(left)));
    }
  }

  // Calls `visit` with each group of touching member pixels in group_.
  template <class Member, class Visit>
  void for_each_group(Member&& is_member, Visit&& visit) {
    std::fill(visited_.begin(), visited_.end(), std::uint8_t{0});
    const auto take = [&](std::int32_t place) {
      std::uint8_t& visited = visited_[static_cast<std::size_t>(place)];
      if (visited == 0 && is_member(place)) {
        visited = 1;
        group_.push_back(place);
      }
    };
    for (const std::int32_t seed : pixels_.places()) {
      group_.clear();
      take(seed);
      std::size_t next = 0;
      while (next < group_.size()) {  // grows meanwhile
        for_each_neighbour(group_[next++], take);
      }
      if (!group_.empty()) {
        visit();
      }
    }
  }

  [[nodiscard]] bool hangs_by_one_end() const {
    bool touches_junction = false;
    bool has_end = false;
    for (const std::int32_t place : group_) {
      has_end = has_end || is_end(place);
      for_each_neighbour(place, [&](std::int32_t neighbour) {
        touches_junction = touches_junction || is_junction(neighbour);
      });
    }
    return touches_junction && has_end;
  }

  Neighbourhoods pixels_;
  std::vector<std::uint8_t> visited_;
  std::vector<std::int32_t> group_;
};

using Lengths = std::vector<std::int32_t>;

Lengths gather(std::span<const MapStructure> maps, Lengths MapStructure::*lengths) {
  Lengths all;
  for (const MapStructure& map : maps) {
    all.insert(all.end(), (map.*lengths).begin(), (map.*lengths).end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

double sum(const Lengths& lengths) {
  return static_cast<double>(std::accumulate(lengths.begin(), lengths.end(), std::int64_t{0}));
}

// The median of sorted lengths: the mean of the two in the middle where their number is even.
double median(const Lengths& sorted) {
  const std::size_t upper = sorted.size() / 2;
  const std::size_t lower = (sorted.size() - 1) / 2;
  return sorted.empty() ? 0 : (sorted[lower] + sorted[upper]) / 2.0;
}

double weighted_median(const Lengths& sorted) {
  const double half = sum(sorted) / 2;
  double below = 0;
  for (const std::int32_t length : sorted) {
    below += length;
    if (below >= half) {
      return length;
    }
  }
  return 0;
}

std::vector<std::size_t> by_powers_of_two(const Lengths& lengths) {
  std::vector<std::size_t> counts;
  for (const std::int32_t length : lengths) {
    const auto bin = static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(length)) - 1);
    counts.resize(std::max(counts.size(), bin + 1), 0);
    ++counts[bin];
  }
  return counts;
}

}  // namespace

MapStructure measure_structure(ImageView<const std::uint8_t> map, int short_px) {
  return StructureMeter(map).run(short_px);
}

StructureSummary summarise_structure(std::span<const MapStructure> maps, int short_px) {
  double pixels = 0;
  double spurs = 0;
  for (const MapStructure& map : maps) {
    pixels += static_cast<double>(map.edge_pixels);
    spurs += static_cast<double>(map.spurs);
  }
  StructureSummary summary;
  if (pixels == 0) {
    return summary;
  }
  const Lengths fragments = gather(maps, &MapStructure::fragments_px);
  const Lengths contours = gather(maps, &MapStructure::contours_px);
  const Lengths short_ones(fragments.begin(),
                           std::lower_bound(fragments.begin(), fragments.end(), short_px));
  const auto count = static_cast<double>(fragments.size());
  summary.edge_pixels = pixels / static_cast<double>(maps.size());
  summary.fragments_per_1000_px = 1000 * count / pixels;
  summary.spurs_per_1000_px = 1000 * spurs / pixels;
  summary.median_contour_px = median(contours);
  summary.weighted_median_contour_px = weighted_median(contours);
  summary.short_fragments = static_cast<double>(short_ones.size()) / count;
  summary.short_fragments_px = sum(short_ones) / pixels;
  summary.contour_lengths = by_powers_of_two(contours);
  return summary;
}

}  // namespace thermedge::eval
