#include "thermedge/stages/contour_chains.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace thermedge::detail {
namespace {

// numerator / denominator, rounded half away from zero.
std::int32_t rounded_quotient(std::int32_t numerator, std::int32_t denominator) {
  const std::int32_t magnitude = (2 * std::abs(numerator) + denominator) / (2 * denominator);
  return numerator < 0 ? -magnitude : magnitude;
}

void append_line_by(Pixel from, std::optional<Pixel> corner, Pixel to, std::vector<Pixel>& points) {
  if (corner) {
    append_line(from, *corner, points);
    points.push_back(*corner);
    from = *corner;
  }
  append_line(from, to, points);
}

}  // namespace

Pixel pixel_of(const ContourSet& contours, std::int32_t end) {
  const auto pixels = contours.pixels(contours.items[contour_of(end)]);
  return end % 2 == 0 ? pixels.front() : pixels.back();
}

void append_line(Pixel from, Pixel to, std::vector<Pixel>& points) {
  const std::int32_t dx = to.x - from.x;
  const std::int32_t dy = to.y - from.y;
  const std::int32_t steps = std::max(std::abs(dx), std::abs(dy));
  for (std::int32_t i = 1; i < steps; ++i) {
    points.push_back(
        {from.x + rounded_quotient(i * dx, steps), from.y + rounded_quotient(i * dy, steps)});
  }
}

void CurveChains::reserve(std::size_t most_contours) {
  ends_.reserve(2 * most_contours);
  chain_of_.reserve(most_contours);
}

void CurveChains::reset(const ContourSet& contours) {
  ends_.resize(2 * contours.items.size());
  for (std::int32_t end = 0; end < ends(); ++end) {
    const bool closed = contours.items[contour_of(end)].closed;
    at(end) = {closed ? kClosed : kFree, other_end(end), std::nullopt};
  }
}

bool CurveChains::is_free(std::int32_t end) const { return at(end).partner == kFree; }

bool CurveChains::join(std::int32_t a, std::int32_t b, std::optional<Pixel> corner) {
  assert(is_free(a) && is_free(b) && a != b);
  at(a).corner = at(b).corner = corner;
  if (at(a).far == b) {
    at(a).partner = at(b).partner = kSeam;
    return true;
  }
  at(a).partner = b;
  at(b).partner = a;
  const std::int32_t start = at(a).far;
  const std::int32_t stop = at(b).far;
  at(start).far = stop;
  at(stop).far = start;
  return false;
}

void CurveChains::extend(std::int32_t end, Pixel to) {
  assert(is_free(end));
  at(end).partner = kExtended;
  at(end).corner = to;
}

void CurveChains::assemble(const ContourSet& contours, ContourSet& chained) {
  constexpr std::int32_t kNone = -1;
  chain_of_.assign(contours.items.size(), kNone);
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    if (chain_of_[i] == kNone) {
      append_chain(contours, chain_start(static_cast<std::int32_t>(2 * i)), chained);
    }
  }
}

// Walks back from `end` to where its chain of joined curves begins.
std::int32_t CurveChains::chain_start(std::int32_t end) const {
  while (at(end).partner >= 0) {
    end = other_end(at(end).partner);
  }
  return end;
}

void CurveChains::append_chain(const ContourSet& contours, std::int32_t start,
                               ContourSet& chained) {
  std::vector<Pixel>& points = chained.points;
  const std::size_t first = points.size();
  if (at(start).partner == kExtended) {
    points.push_back(*at(start).corner);
    append_line(points.back(), pixel_of(contours, start), points);
  }
  std::int32_t last = start;
  for (std::int32_t end = start; end >= 0; end = at(last).partner) {
    if (end != start) {
      append_line_by(points.back(), at(end).corner, pixel_of(contours, end), points);
    }
    const auto pixels = contours.pixels(contours.items[contour_of(end)]);
    if (end % 2 == 0) {
      points.insert(points.end(), pixels.begin(), pixels.end());
    } else {
      points.insert(points.end(), pixels.rbegin(), pixels.rend());
    }
    chain_of_[contour_of(end)] = static_cast<std::int32_t>(chained.items.size());
    last = other_end(end);
  }
  if (at(last).partner == kExtended) {
    const Pixel to = *at(last).corner;
    append_line(points.back(), to, points);
    points.push_back(to);
  } else if (at(start).partner == kSeam) {
    append_line_by(points.back(), at(start).corner, points[first], points);
  }
  const bool closed = at(start).partner == kSeam || at(start).partner == kClosed;
  chained.items.push_back(
      {{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(points.size() - first)},
       closed});
}

}  // namespace thermedge::detail
