#include "thermedge/linking.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "thermedge/options.hpp"
#include "window.hpp"

namespace thermedge {
namespace {

constexpr std::int32_t kNone = -1;

// What `partner` holds for an end that was not joined to another curve's.
constexpr std::int32_t kFree = -1;
constexpr std::int32_t kSeam = -2;    // joined to the other end of its own chain: a loop
constexpr std::int32_t kClosed = -3;  // an end of a curve that came closed: no end at all

constexpr std::size_t contour_of(std::int32_t end) { return static_cast<std::size_t>(end) / 2; }
constexpr std::int32_t other_end(std::int32_t end) { return end ^ 1; }

Pixel pixel_of(const ContourSet& contours, std::int32_t end) {
  const auto pixels = contours.pixels(contours.contours[contour_of(end)]);
  return end % 2 == 0 ? pixels.front() : pixels.back();
}

int reach_of(double gap_px) { return static_cast<int>(std::ceil(gap_px)); }

// numerator / denominator, rounded half away from zero.
std::int32_t rounded_quotient(std::int32_t numerator, std::int32_t denominator) {
  const std::int32_t magnitude = (2 * std::abs(numerator) + denominator) / (2 * denominator);
  return numerator < 0 ? -magnitude : magnitude;
}

// Appends the pixels of the digital line strictly between `from` and `to`.
void append_bridge(Pixel from, Pixel to, std::vector<Pixel>& points) {
  const std::int32_t dx = to.x - from.x;
  const std::int32_t dy = to.y - from.y;
  const std::int32_t steps = std::max(std::abs(dx), std::abs(dy));
  for (std::int32_t i = 1; i < steps; ++i) {
    points.push_back(
        {from.x + rounded_quotient(i * dx, steps), from.y + rounded_quotient(i * dy, steps)});
  }
}

}  // namespace

void LinkedContours::clear() {
  contours.clear();
  links.clear();
}

// Algorithm 5.
Status Linker::run(const ContourSet& contours, int width, int height, LinkedContours& linked) {
  linked.clear();
  if (Status status = check_ranges(options_, "linking."); !status) {
    return status;
  }
  prepare(contours, width, height, linked);
  place_ends(contours);
  join_ends(contours, linked);
  assemble(contours, linked);
  if (offsets_.empty()) {
    linked.contours.junctions.assign(contours.junctions.begin(), contours.junctions.end());
    return {};
  }
  paint_owners(contours, linked);
  connect_free_ends(contours, linked);
  return {};
}

// Every join uses up two ends and inserts less than gap_px pixels.
void Linker::prepare(const ContourSet& contours, int width, int height, LinkedContours& linked) {
  const double gap_px = options_.gap_px;
  const int reach = reach_of(gap_px);
  const std::size_t most_contours = contours.contours.capacity();
  detail::list_offsets(
      reach,
      [=](Pixel offset) {
        return static_cast<double>(squared_distance(offset, {})) < gap_px * gap_px;
      },
      offsets_);
  ends_.reserve(2 * most_contours);
  linked_as_.reserve(most_contours);
  linked.links.reserve(2 * most_contours);
  linked.contours.contours.reserve(most_contours);
  linked.contours.junctions.reserve(std::max(2 * most_contours, contours.junctions.capacity()));
  linked.contours.points.reserve(contours.points.capacity() +
                                 most_contours * static_cast<std::size_t>(reach));
  end_at_.resize(width, height);
  owner_.resize(width, height);
}

void Linker::place_ends(const ContourSet& contours) {
  fill_pixels(end_at_.view(), kNone);
  const std::size_t count = 2 * contours.contours.size();
  ends_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto end = static_cast<std::int32_t>(i);
    const bool closed = contours.contours[contour_of(end)].closed;
    const Pixel at = pixel_of(contours, end);
    assert(end_at_.view().contains(at.x, at.y));
    ends_[i] = {closed ? kClosed : kFree, other_end(end), end_at_(at.x, at.y)};
    end_at_(at.x, at.y) = end;
  }
}

// Distance by distance, each free end in turn takes the first free end at that distance: the order
// of all pairs sorted by distance, first and second end, without a list of them.
void Linker::join_ends(const ContourSet& contours, LinkedContours& linked) {
  const auto differs = [](Pixel a, Pixel b) {
    return squared_distance(a, {}) != squared_distance(b, {});
  };
  for (auto first = offsets_.begin(); first != offsets_.end();) {
    const auto adjacent = std::adjacent_find(first, offsets_.end(), differs);
    const auto last = adjacent == offsets_.end() ? adjacent : adjacent + 1;
    for (std::int32_t end = 0; end < static_cast<std::int32_t>(ends_.size()); ++end) {
      if (ends_[end].partner != kFree) {
        continue;
      }
      const std::int32_t partner =
          find_free_end(pixel_of(contours, end), std::span(first, last), end);
      if (partner != kNone) {
        join(contours, end, partner, linked);
      }
    }
    first = last;
  }
}

std::int32_t Linker::find_free_end(Pixel around, std::span<const Pixel> offsets,
                                   std::int32_t other_than) const {
  std::int32_t found = kNone;
  for (const Pixel offset : offsets) {
    const Pixel at{around.x + offset.x, around.y + offset.y};
    if (!end_at_.view().contains(at.x, at.y)) {
      continue;
    }
    for (std::int32_t end = end_at_(at.x, at.y); end != kNone; end = ends_[end].next) {
      if (end != other_than && ends_[end].partner == kFree && (found == kNone || end < found)) {
        found = end;
      }
    }
  }
  return found;
}

// Until assemble(), the link names the contours as they came.
void Linker::join(const ContourSet& contours, std::int32_t a, std::int32_t b,
                  LinkedContours& linked) {
  const bool loop = ends_[a].far == b;
  if (loop) {
    ends_[a].partner = ends_[b].partner = kSeam;
  } else {
    ends_[a].partner = b;
    ends_[b].partner = a;
    const std::int32_t start = ends_[a].far;
    const std::int32_t stop = ends_[b].far;
    ends_[start].far = stop;
    ends_[stop].far = start;
  }
  const auto contour = static_cast<std::uint32_t>(contour_of(a));
  linked.links.push_back({loop ? LinkType::kLoop : LinkType::kEndToEnd, contour, contour,
                          pixel_of(contours, a), pixel_of(contours, b)});
}

void Linker::assemble(const ContourSet& contours, LinkedContours& linked) {
  linked_as_.assign(contours.contours.size(), kNone);
  for (std::size_t i = 0; i < contours.contours.size(); ++i) {
    if (linked_as_[i] == kNone) {
      append_chain(contours, chain_start(static_cast<std::int32_t>(2 * i)), linked);
    }
  }
  for (Link& link : linked.links) {
    link.a = link.b = static_cast<std::uint32_t>(linked_as_[link.a]);
  }
}

// Walks back from `end` to where its chain of joined curves begins.
std::int32_t Linker::chain_start(std::int32_t end) const {
  while (ends_[end].partner >= 0) {
    end = other_end(ends_[end].partner);
  }
  return end;
}

void Linker::append_chain(const ContourSet& contours, std::int32_t start, LinkedContours& linked) {
  std::vector<Pixel>& points = linked.contours.points;
  const std::size_t first = points.size();
  for (std::int32_t end = start; end >= 0; end = ends_[other_end(end)].partner) {
    if (end != start) {
      append_bridge(points.back(), pixel_of(contours, end), points);
    }
    const auto pixels = contours.pixels(contours.contours[contour_of(end)]);
    if (end % 2 == 0) {
      points.insert(points.end(), pixels.begin(), pixels.end());
    } else {
      points.insert(points.end(), pixels.rbegin(), pixels.rend());
    }
    linked_as_[contour_of(end)] = static_cast<std::int32_t>(linked.contours.contours.size());
  }
  const std::int32_t state = ends_[start].partner;
  if (state == kSeam) {
    append_bridge(points.back(), points[first], points);
  }
  const Range range{static_cast<std::uint32_t>(first),
                    static_cast<std::uint32_t>(points.size() - first)};
  linked.contours.contours.push_back({range, state != kFree});
}

// A pixel under a bridge stays with the curve that had it first.
void Linker::paint_owners(const ContourSet& contours, const LinkedContours& linked) {
  fill_pixels(owner_.view(), kNone);
  for (std::size_t i = 0; i < linked.contours.contours.size(); ++i) {
    for (const Pixel pixel : linked.contours.pixels(linked.contours.contours[i])) {
      owner_(pixel.x, pixel.y) = static_cast<std::int32_t>(i);
    }
  }
  for (std::size_t i = 0; i < contours.contours.size(); ++i) {
    for (const Pixel pixel : contours.pixels(contours.contours[i])) {
      owner_(pixel.x, pixel.y) = linked_as_[i];
    }
  }
}

void Linker::connect_free_ends(const ContourSet& contours, LinkedContours& linked) const {
  for (std::int32_t end = 0; end < static_cast<std::int32_t>(ends_.size()); ++end) {
    if (ends_[end].partner != kFree) {
      continue;
    }
    const Pixel from = pixel_of(contours, end);
    const std::int32_t self = linked_as_[contour_of(end)];
    const auto target = [=](Pixel offset) { return Pixel{from.x + offset.x, from.y + offset.y}; };
    const auto owner = [&](Pixel at) {
      return owner_.view().contains(at.x, at.y) ? owner_(at.x, at.y) : kNone;
    };
    const auto nearest = std::find_if(offsets_.begin(), offsets_.end(), [&](Pixel offset) {
      const std::int32_t other = owner(target(offset));
      return other != kNone && other != self;
    });
    if (nearest != offsets_.end()) {
      const Pixel to = target(*nearest);
      linked.links.push_back({LinkType::kEndToMiddle, static_cast<std::uint32_t>(self),
                              static_cast<std::uint32_t>(owner(to)), from, to});
      linked.contours.junctions.push_back({from});
    }
  }
}

}  // namespace thermedge
