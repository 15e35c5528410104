#include "thermedge/stages/edge_graph.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <tuple>

namespace thermedge {
namespace {

constexpr std::int32_t kNone = -1;
constexpr std::int32_t kVisited = -2;  // part of a segment

// The eight neighbours of a pixel, around it; those at even places share a side with it.
constexpr std::array<Pixel, 8> kAround = {Pixel{1, 0}, {1, 1},   {0, 1},  {-1, 1},
                                          {-1, 0},     {-1, -1}, {0, -1}, {1, -1}};

std::ptrdiff_t offset_of(Pixel step, std::ptrdiff_t stride) { return step.y * stride + step.x; }

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

// The neighbours of a pixel that are set, as bits in the order of kAround.
unsigned set_around(const std::uint8_t* pixel, std::ptrdiff_t stride) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < kAround.size(); ++k) {
    bits |= static_cast<unsigned>(pixel[offset_of(kAround[k], stride)] != 0) << k;
  }
  return bits;
}

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

Pixel GraphTracer::position(std::int32_t pixel) const {
  const auto stride = static_cast<std::int32_t>(map_.stride());
  return {pixel % stride - 1, pixel / stride - 1};
}

float GraphTracer::strength_at(std::int32_t pixel) const {
  const Pixel at = position(pixel);
  return strength_(at.x, at.y);
}

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

void GraphTracer::find_neighbours() {
  for (const std::int32_t pixel : order_) {
    neighbours_.row(0)[pixel] =
        static_cast<std::uint8_t>(connected_around(set_around(map_.row(0) + pixel, map_.stride())));
  }
}

// The first of the neighbours whose bits are set.
std::int32_t GraphTracer::neighbour(std::int32_t pixel, unsigned bits) const {
  const Pixel step = kAround[static_cast<std::size_t>(std::countr_zero(bits))];
  return static_cast<std::int32_t>(pixel + offset_of(step, map_.stride()));
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

std::int32_t GraphTracer::pixel_at(std::int32_t end) const {
  const auto pixels = pixels_of(static_cast<std::size_t>(end / 2));
  return end % 2 == 0 ? pixels.front() : pixels.back();
}

// At each junction, the smoothest pair first; of those that turn as much, the strongest. Directions
// between pixels are often equal.
void GraphTracer::join_segments() {
  constexpr std::size_t kDirectionPixels = 8;
  const auto direction = [&](std::int32_t end) {
    const auto pixels = pixels_of(static_cast<std::size_t>(end / 2));
    const std::size_t back = std::min(kDirectionPixels, pixels.size()) - 1;
    const Pixel tip = position(pixel_at(end));
    const Pixel from = position(end % 2 == 0 ? pixels[back] : pixels[pixels.size() - 1 - back]);
    const double x = tip.x - from.x;
    const double y = tip.y - from.y;
    const double length = std::sqrt(x * x + y * y);
    return length > 0 ? std::pair{x / length, y / length} : std::pair{0.0, 0.0};
  };
  // Ends by junction: counting sort.
  ends_of_junction_.assign(junctions_.size(), {});
  for (const End& end : ends_) {
    if (end.junction != kNone) {
      ++ends_of_junction_[static_cast<std::size_t>(end.junction)].count;
    }
  }
  std::uint32_t total = 0;
  for (Range& range : ends_of_junction_) {
    range.first = total;
    total += range.count;
    range.count = 0;
  }
  ends_at_.resize(total);
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (ends_[i].junction != kNone) {
      Range& range = ends_of_junction_[static_cast<std::size_t>(ends_[i].junction)];
      ends_at_[range.first + range.count++] = static_cast<std::int32_t>(i);
    }
  }
  const double least = std::cos(options_.max_turn_deg * std::numbers::pi / 180);
  for (const Range& range : ends_of_junction_) {
    const auto ends = slice(ends_at_, range);
    pairs_.clear();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t k = i + 1; k < ends.size(); ++k) {
        const auto a = direction(ends[i]);
        const auto b = direction(ends[k]);
        const double smoothness = -(a.first * b.first + a.second * b.second);
        if (smoothness >= least) {
          const float response = strength_at(pixel_at(ends[i])) + strength_at(pixel_at(ends[k]));
          pairs_.push_back({smoothness, response, ends[i], ends[k]});
        }
      }
    }
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
      return std::tie(b.smoothness, b.response, a.a, a.b) <
             std::tie(a.smoothness, a.response, b.a, b.b);
    });
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Pair& pair = pairs_[i];
      End& a = ends_[static_cast<std::size_t>(pair.a)];
      End& b = ends_[static_cast<std::size_t>(pair.b)];
      if (a.partner == kNone && b.partner == kNone) {
        a.partner = pair.b;
        b.partner = pair.a;
        a.place = b.place = static_cast<std::int32_t>(i);
      }
    }
  }
}

// The pixel of a junction with the smallest squared distances from `a` and `b` together; of those
// as near, the strongest.
std::int32_t GraphTracer::nearest_of_junction(std::int32_t junction, Pixel a, Pixel b) const {
  const auto pixels = slice(junction_pixels_, junctions_[static_cast<std::size_t>(junction)]);
  return *std::min_element(pixels.begin(), pixels.end(), [&](std::int32_t p, std::int32_t q) {
    const auto order = [&](std::int32_t pixel) {
      return std::pair{squared_distance(position(pixel), a) + squared_distance(position(pixel), b),
                       -strength_at(pixel)};
    };
    return order(p) < order(q);
  });
}

std::int32_t GraphTracer::strongest_of_junction(std::size_t junction) const {
  const auto pixels = slice(junction_pixels_, junctions_[junction]);
  return *std::max_element(pixels.begin(), pixels.end(), [&](std::int32_t p, std::int32_t q) {
    return strength_at(p) < strength_at(q);
  });
}

// Appends the curve that begins with the end `start`: a free one, or any one of a ring.
void GraphTracer::append_curve(std::int32_t start, LinkedContours& curves) {
  std::vector<Pixel>& points = curves.contours.points;
  const std::size_t first = points.size();
  const auto number = static_cast<std::int32_t>(curves.contours.items.size());
  const auto junction_of = [&](std::int32_t end) {
    return ends_[static_cast<std::size_t>(end)].junction;
  };
  const auto append_junction = [&](std::int32_t junction, Pixel a, Pixel b) {
    points.push_back(position(nearest_of_junction(junction, a, b)));
  };
  passed_.clear();
  bool closed = false;
  const bool ring = ends_[static_cast<std::size_t>(start)].partner != kNone;
  if (!ring && junction_of(start) != kNone) {
    const Pixel at = position(pixel_at(start));
    append_junction(junction_of(start), at, at);
  }
  for (std::int32_t end = start;;) {
    const auto segment = static_cast<std::size_t>(end / 2);
    used_[segment] = 1;
    const auto pixels = pixels_of(segment);
    const auto to_position = [&](std::int32_t pixel) { return position(pixel); };
    if (end % 2 == 0) {
      std::transform(pixels.begin(), pixels.end(), std::back_inserter(points), to_position);
    } else {
      std::transform(pixels.rbegin(), pixels.rend(), std::back_inserter(points), to_position);
    }
    const std::int32_t far = end ^ 1;
    const std::int32_t next = ends_[static_cast<std::size_t>(far)].partner;
    const Pixel at = position(pixel_at(far));
    if (junction_of(far) != kNone) {
      append_junction(junction_of(far), at, next == kNone ? at : position(pixel_at(next)));
      if (next != kNone) {
        passed_.push_back(far);
      }
    }
    if (next == kNone || used_[static_cast<std::size_t>(next / 2)] != 0) {
      closed = next != kNone;
      break;
    }
    end = next;
  }
  const std::size_t count = points.size() - first;
  if (count < static_cast<std::size_t>(options_.min_length_px)) {
    points.resize(first);
    return;
  }
  curves.contours.items.push_back(
      {{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)}, closed});
  for (const std::int32_t end : passed_) {
    const auto& [junction, partner, place] = ends_[static_cast<std::size_t>(end)];
    Passage& passage = through_[static_cast<std::size_t>(junction)];
    if (passage.curve == kNone || place < passage.place) {
      passage = {number, place};
    }
  }
}

void GraphTracer::close_curves(LinkedContours& curves) const {
  for (Contour& contour : curves.contours.items) {
    const auto pixels = curves.contours.pixels(contour);
    const double gap =
        std::sqrt(static_cast<double>(squared_distance(pixels.front(), pixels.back())));
    if (gap<options_.closed_gap_px&& static_cast<double>(pixels.size())> options_
            .closed_length_gaps *
        std::max(gap, 1.0)) {
      contour.closed = true;
    }
  }
}

// Ends at a junction that another curve goes through are connected with it.
void GraphTracer::connect_ends(LinkedContours& curves) {
  for (std::size_t i = 0; i < junctions_.size(); ++i) {
    if (through_[i].curve != kNone) {
      curves.contours.junctions.push_back({position(strongest_of_junction(i))});
    }
  }
  for (std::uint32_t i = 0; i < curves.contours.items.size(); ++i) {
    const Contour& contour = curves.contours.items[i];
    if (contour.closed) {
      continue;
    }
    const auto pixels = curves.contours.pixels(contour);
    for (const Pixel end : {pixels.front(), pixels.back()}) {
      const std::int32_t junction = label_at(end);
      const std::int32_t other =
          junction >= 0 ? through_[static_cast<std::size_t>(junction)].curve : kNone;
      if (other != kNone && other != static_cast<std::int32_t>(i)) {
        curves.links.push_back(
            {LinkType::kEndToMiddle, i, static_cast<std::uint32_t>(other), end, end});
      }
    }
  }
}

}  // namespace thermedge
