#include "thermedge/stages/edge_graph.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "graph_pixels.hpp"

namespace thermedge {
namespace {

using detail::graph::kNone;
using detail::graph::kVisited;

// The first place from `x` on at which a row is not 0, or `width`. Eight at a time: most are.
int next_set(const std::uint8_t* row, int x, int width) {
  std::uint64_t eight = 0;
  while (x + 8 <= width && (std::memcpy(&eight, row + x, sizeof(eight)), eight == 0)) {
    x += 8;
  }
  while (x < width && row[x] == 0) {
    ++x;
  }
  return x;
}

// Of the set neighbours those that are connected: diagonal ones only where no path along the sides
// leads there.
unsigned connected_around(unsigned around) {
  unsigned connected = around & 0x55U;
  for (unsigned k = 1; k < 8; k += 2) {
    const bool detour = (around >> (k - 1) & 1U) != 0 || (around >> ((k + 1) % 8) & 1U) != 0;
    if (!detour) {
      connected |= around & (1U << k);
    }
  }
  return connected;
}

}  // namespace

Status GraphOptions::check() const { return check_ranges(*this, "graph."); }

Status GraphTracer::run(ImageView<const std::uint8_t> edges, ImageView<const float> response,
                        LinkedContours& curves) {
  curves.clear();
  if (Status status = options_.check(); !status) {
    return status;
  }
  if (!same_size(edges, response)) {
    return failure(ErrorCode::kInvalidArgument, "response: its size is not that of the edge map");
  }
  if (edges.size() > std::size_t{1} << 30U) {
    return failure(ErrorCode::kLimitExceeded, "edge map: more than 2^30 pixels");
  }
  strength_ = response;
  prepare(edges, curves);
  thin();
  find_neighbours();
  find_junctions();
  find_segments();
  join_segments();
  through_.assign(junctions_.size(), {kNone, kNone});
  used_.assign(segments_.size(), 0);
  for (std::size_t end = 0; end < ends_.size(); ++end) {
    if (ends_[end].partner == kNone && used_[end / 2] == 0) {
      append_curve(static_cast<std::int32_t>(end), curves);
    }
  }
  for (std::size_t i = 0; i < segments_.size(); ++i) {  // rings
    if (used_[i] == 0) {
      append_curve(static_cast<std::int32_t>(2 * i), curves);
    }
  }
  close_curves(curves);
  connect_ends(curves);
  return {};
}

void GraphTracer::prepare(ImageView<const std::uint8_t> edges, LinkedContours& curves) {
  map_.resize(edges.width() + 2, edges.height() + 2);
  neighbours_.resize(map_.width(), map_.height());
  label_.resize(static_cast<std::size_t>(map_.stride() * map_.height()));
  fill_pixels(map_.view(), std::uint8_t{0});
  const std::size_t most = edges.size();
  order_.reserve(most);
  candidates_.reserve(most);
  pixels_.reserve(most);
  junction_pixels_.reserve(most);
  junctions_.reserve(most / 4 + 1);
  segments_.reserve(most / 2 + 1);
  ends_.reserve(most + 2);
  used_.reserve(most / 2 + 1);
  ends_at_.reserve(most + 2);
  ends_of_junction_.reserve(most / 4 + 1);
  through_.reserve(most / 4 + 1);
  passed_.reserve(most / 2 + 1);
  pairs_.reserve(most / 4 + 1);
  const std::size_t most_curves =
      most / static_cast<std::size_t>(std::max(options_.min_length_px, 1)) + 1;
  curves.contours.points.reserve(most);
  curves.contours.items.reserve(most_curves);
  curves.contours.junctions.reserve(most / 4 + 1);
  curves.links.reserve(2 * most_curves);
  order_.clear();
  for (int y = 0; y < edges.height(); ++y) {
    const std::uint8_t* const row = edges.row(y);
    for (int x = next_set(row, 0, edges.width()); x < edges.width();
         x = next_set(row, x + 1, edges.width())) {
      map_(x + 1, y + 1) = 1;
      order_.push_back(static_cast<std::int32_t>((y + 1) * map_.stride() + x + 1));
    }
  }
}

void GraphTracer::find_neighbours() {
  for (const std::int32_t pixel : order_) {
    neighbours_.row(0)[pixel] = static_cast<std::uint8_t>(
        connected_around(detail::graph::set_around(map_.row(0) + pixel, map_.stride())));
  }
}

// A junction is a connected group of pixels with three or more neighbours.
void GraphTracer::find_junctions() {
  junctions_.clear();
  junction_pixels_.clear();
  std::int32_t* const label = label_.data();
  const std::uint8_t* const neighbours = neighbours_.row(0);
  const auto is_node = [&](std::int32_t pixel) {
    return std::popcount(unsigned{neighbours[pixel]}) >= 3;
  };
  for (const std::int32_t pixel : order_) {
    label[pixel] = kNone;
  }
  for (const std::int32_t seed : order_) {
    if (label[seed] != kNone || !is_node(seed)) {
      continue;
    }
    const std::size_t first = junction_pixels_.size();
    const auto number = static_cast<std::int32_t>(junctions_.size());
    const auto add = [&](std::int32_t pixel) {
      label[pixel] = number;
      junction_pixels_.push_back(pixel);
    };
    add(seed);
    for (std::size_t i = first; i < junction_pixels_.size(); ++i) {
      const std::int32_t pixel = junction_pixels_[i];
      for (unsigned bits = neighbours[pixel]; bits != 0; bits &= bits - 1) {
        const std::int32_t next = neighbour(pixel, bits);
        if (label[next] == kNone && is_node(next)) {
          add(next);
        }
      }
    }
    junctions_.push_back({static_cast<std::uint32_t>(first),
                          static_cast<std::uint32_t>(junction_pixels_.size() - first)});
  }
}

void GraphTracer::find_segments() {
  segments_.clear();
  ends_.clear();
  pixels_.clear();
  for (const std::int32_t pixel : order_) {
    if (label_[static_cast<std::size_t>(pixel)] == kNone) {
      add_segment(pixel);
    }
  }
}

// Appends the pixels behind `from` up to a junction or an end.
void GraphTracer::walk(std::int32_t from) {
  std::int32_t* const label = label_.data();
  for (bool found = true; found;) {
    found = false;
    for (unsigned bits = neighbours_.row(0)[from]; bits != 0 && !found; bits &= bits - 1) {
      const std::int32_t next = neighbour(from, bits);
      if (label[next] == kNone) {
        label[next] = kVisited;
        pixels_.push_back(next);
        from = next;
        found = true;
      }
    }
  }
}

// The junction beside a pixel, another one than given where there are two.
std::int32_t GraphTracer::junction_beside(std::int32_t pixel, std::int32_t other_than) const {
  std::int32_t found = kNone;
  for (unsigned bits = neighbours_.row(0)[pixel]; bits != 0; bits &= bits - 1) {
    const std::int32_t junction = label_[static_cast<std::size_t>(neighbour(pixel, bits))];
    if (junction >= 0 && (found == kNone || found == other_than)) {
      found = junction;
    }
  }
  return found;
}

void GraphTracer::add_segment(std::int32_t seed) {
  const std::size_t first = pixels_.size();
  label_[static_cast<std::size_t>(seed)] = kVisited;
  pixels_.push_back(seed);
  walk(seed);
  const auto begin = pixels_.begin() + static_cast<std::ptrdiff_t>(first);
  std::reverse(begin, pixels_.end());
  walk(seed);
  const std::size_t count = pixels_.size() - first;
  const std::int32_t front = pixels_[first];
  const std::int32_t back = pixels_.back();
  const std::int32_t front_junction = junction_beside(front, kNone);
  const bool two_sided = count > 1 || std::popcount(unsigned{neighbours_.row(0)[front]}) > 1;
  const std::int32_t back_junction =
      count > 1 ? junction_beside(back, kNone)
                : (two_sided ? junction_beside(back, front_junction) : kNone);
  const Pixel a = position(front);
  const Pixel b = position(back);
  const bool loop = count > 3 && front_junction == kNone && back_junction == kNone &&
                    squared_distance(a, b) <= 2 &&
                    std::popcount(unsigned{neighbours_.row(0)[front]}) == 2;
  segments_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
  const auto self = static_cast<std::int32_t>(ends_.size());
  ends_.push_back({front_junction, loop ? self + 1 : kNone, kNone});
  ends_.push_back({back_junction, loop ? self : kNone, kNone});
}

}  // namespace thermedge
