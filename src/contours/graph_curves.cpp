// The part of GraphTracer that makes curves of segments.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>
#include <utility>

#include "graph_pixels.hpp"

namespace thermedge {
namespace {

using detail::graph::kNone;

}  // namespace

// At each junction, the smoothest pair first; of those that turn as much, the strongest. Directions
// between pixels are often equal.
void GraphTracer::join_segments() {
  const auto direction = [&](std::int32_t end) {
    const auto pixels = pixels_of(static_cast<std::size_t>(end / 2));
    const std::size_t back = std::min(tuning_.direction_pixels, pixels.size()) - 1;
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
