#include "thermedge/eval/matching.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace thermedge::eval {
namespace {

constexpr std::int32_t kNone = -1;
constexpr std::int32_t kUsed = -2;  // layer of a found pixel that this phase is done with

struct Offset {
  int dx, dy;
  int squared;
  std::int32_t ring = 0;
};

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

// How far an offset goes along an axis; never farther than the map is large.
int reach_of(double radius_px, ImageView<const std::uint8_t> map) {
  return static_cast<int>(
      std::min<double>(std::floor(radius_px), std::max(map.width(), map.height())));
}

// The offsets within the radius, nearest first, then in reading order.
std::vector<Offset> disc(double radius_px, int reach) {
  std::vector<Offset> offsets;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const int squared = dx * dx + dy * dy;
      if (squared <= radius_px * radius_px) {
        offsets.push_back({dx, dy, squared});
      }
    }
  }
  std::sort(offsets.begin(), offsets.end(), [](const Offset& a, const Offset& b) {
    return std::tie(a.squared, a.dy, a.dx) < std::tie(b.squared, b.dy, b.dx);
  });
  for (std::size_t i = 1; i < offsets.size(); ++i) {
    offsets[i].ring = offsets[i - 1].ring + (offsets[i].squared > offsets[i - 1].squared ? 1 : 0);
  }
  return offsets;
}

// Adds found pixels one at a time (Kuhn's algorithm).
class GrowingMatching {
 public:
  explicit GrowingMatching(const MatchGraph& graph)
      : graph_(graph),
        truth_of_(graph.found_count(), kNone),
        found_of_(graph.truth_count(), kNone),
        reached_from_(graph.truth_count(), kNone),
        seen_by_(graph.truth_count(), kNone),
        lost_(graph.truth_count(), 0) {}

  bool add(std::int32_t found) {
    queue_.clear();
    std::int32_t free = reach(found, found);
    for (std::size_t i = 0; free == kNone && i < queue_.size(); ++i) {
      free = reach(found_of_[at(queue_[i])], found);
    }
    if (free == kNone) {
      // From none of these a free true pixel can be reached, now or ever again.
      for (const std::int32_t truth : queue_) {
        lost_[at(truth)] = 1;
      }
      return false;
    }
    while (free != kNone) {  // back along the path, each takes the partner of the one after it
      const std::int32_t taker = reached_from_[at(free)];
      found_of_[at(free)] = taker;
      free = std::exchange(truth_of_[at(taker)], free);
    }
    return true;
  }

 private:
  // Queues the unseen partners of `found`; gives one that is free, where there is one.
  std::int32_t reach(std::int32_t found, std::int32_t root) {
    for (const auto& [truth, ring] : graph_.partners(at(found))) {
      if (lost_[at(truth)] != 0 || seen_by_[at(truth)] == root) {
        continue;
      }
      seen_by_[at(truth)] = root;
      reached_from_[at(truth)] = found;
      if (found_of_[at(truth)] == kNone) {
        return truth;
      }
      queue_.push_back(truth);
    }
    return kNone;
  }

  const MatchGraph& graph_;
  std::vector<std::int32_t> truth_of_, found_of_;
  std::vector<std::int32_t> reached_from_;  // the found pixel that led to a true one
  std::vector<std::int32_t> seen_by_;       // the search that saw a true pixel last
  std::vector<std::uint8_t> lost_;
  std::vector<std::int32_t> queue_;
};

}  // namespace

MatchGraph::MatchGraph(std::span<const Pixel> found, ImageView<const std::uint8_t> truth,
                       double radius_px) {
  const std::vector<Offset> offsets = disc(radius_px, reach_of(radius_px, truth));
  rings_ = offsets.empty() ? 0 : offsets.back().ring + 1;
  // Numbers of the true pixels, with a margin so that no offset leads outside.
  const int margin = reach_of(radius_px, truth);
  Image<std::int32_t> numbers(truth.width() + 2 * margin, truth.height() + 2 * margin);
  fill_pixels(numbers.view(), kNone);
  for (int y = 0; y < truth.height(); ++y) {
    for (int x = 0; x < truth.width(); ++x) {
      if (truth(x, y) != 0) {
        numbers(x + margin, y + margin) = static_cast<std::int32_t>(truth_count_++);
      }
    }
  }
  starts_.reserve(found.size() + 1);
  starts_.push_back(0);
  for (const Pixel pixel : found) {
    const std::int32_t* centre = &numbers(pixel.x + margin, pixel.y + margin);
    for (const Offset& offset : offsets) {
      const std::int32_t number = centre[offset.dy * numbers.stride() + offset.dx];
      if (number != kNone) {
        partners_.push_back({number, offset.ring});
      }
    }
    starts_.push_back(partners_.size());
  }
}

PixelMatcher::PixelMatcher(const MatchGraph& graph)
    : graph_(graph),
      truth_of_(graph.found_count(), kNone),
      found_of_(graph.truth_count(), kNone),
      layer_(graph.found_count(), kNone),
      next_(graph.found_count(), 0) {}

void PixelMatcher::pair(std::int32_t found, std::int32_t truth) {
  truth_of_[at(found)] = truth;
  found_of_[at(truth)] = found;
}

std::size_t PixelMatcher::match(std::span<const std::int32_t> chosen) {
  std::fill(truth_of_.begin(), truth_of_.end(), kNone);
  std::fill(found_of_.begin(), found_of_.end(), kNone);
  pairs_ = 0;
  pair_nearest(chosen);
  while (make_layers(chosen)) {
    for (const std::int32_t found : chosen) {
      if (layer_[at(found)] == 0 && truth_of_[at(found)] == kNone && augment(found)) {
        ++pairs_;
      }
    }
  }
  return pairs_;
}

void PixelMatcher::pair_nearest(std::span<const std::int32_t> chosen) {
  queue_.assign(chosen.begin(), chosen.end());  // those that may still find a partner
  for (const std::int32_t found : chosen) {
    next_[at(found)] = 0;
  }
  for (int ring = 0; ring < graph_.rings() && !queue_.empty(); ++ring) {
    std::size_t kept = 0;
    for (const std::int32_t found : queue_) {
      const auto partners = graph_.partners(at(found));
      std::uint32_t& next = next_[at(found)];
      bool paired = false;
      for (; !paired && next < partners.size() && partners[next].ring == ring; ++next) {
        if (found_of_[at(partners[next].truth)] == kNone) {
          pair(found, partners[next].truth);
          paired = true;
        }
      }
      pairs_ += paired ? 1 : 0;
      if (!paired && next < partners.size()) {
        queue_[kept++] = found;
      }
    }
    queue_.resize(kept);
  }
}

// Numbers found pixels by the length of the alternating path that leads to them from one without
// partner. false: no path ends at a free true pixel, so the matching is as large as can be.
bool PixelMatcher::make_layers(std::span<const std::int32_t> chosen) {
  queue_.clear();
  for (const std::int32_t found : chosen) {
    const bool root = truth_of_[at(found)] == kNone && !graph_.partners(at(found)).empty();
    layer_[at(found)] = root ? 0 : kNone;
    next_[at(found)] = 0;
    if (root) {
      queue_.push_back(found);
    }
  }
  bool free_reached = false;
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    for (const auto& [truth, ring] : graph_.partners(at(queue_[i]))) {
      const std::int32_t owner = found_of_[at(truth)];
      if (owner == kNone) {
        free_reached = true;
      } else if (layer_[at(owner)] == kNone) {
        layer_[at(owner)] = layer_[at(queue_[i])] + 1;
        queue_.push_back(owner);
      }
    }
  }
  return free_reached;
}

// Depth first from layer to layer; on success, every found pixel on the path takes the true one
// that it looked at.
bool PixelMatcher::augment(std::int32_t root) {
  path_.assign(1, root);
  while (!path_.empty()) {
    const std::int32_t found = path_.back();
    const auto partners = graph_.partners(at(found));
    std::uint32_t& next = next_[at(found)];
    if (next == partners.size()) {
      layer_[at(found)] = kUsed;
      path_.pop_back();
      if (!path_.empty()) {
        ++next_[at(path_.back())];
      }
      continue;
    }
    const std::int32_t owner = found_of_[at(partners[next].truth)];
    if (owner == kNone) {
      for (const std::int32_t taker : path_) {
        pair(taker, graph_.partners(at(taker))[next_[at(taker)]].truth);
        layer_[at(taker)] = kUsed;
      }
      return true;
    }
    if (layer_[at(owner)] == layer_[at(found)] + 1) {
      path_.push_back(owner);
    } else {
      ++next;
    }
  }
  return false;
}

std::vector<std::uint8_t> match_in_order(const MatchGraph& graph,
                                         std::span<const std::int32_t> order) {
  GrowingMatching matching(graph);
  std::vector<std::uint8_t> gains(order.size());
  std::transform(order.begin(), order.end(), gains.begin(), [&](std::int32_t found) {
    return static_cast<std::uint8_t>(matching.add(found) ? 1 : 0);
  });
  return gains;
}

}  // namespace thermedge::eval
