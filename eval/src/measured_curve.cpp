#include "measured_curve.hpp"

#include <algorithm>
#include <cmath>

#include "curve_parts.hpp"

namespace thermedge::eval {
namespace {

constexpr double kHalfChordPx = 2;

}  // namespace

MeasuredCurve::MeasuredCurve(const Curve& curve) : curve_(curve) {
  arcs_.push_back(0);
  part_directions_.resize(std::max(curve.points.size(), std::size_t{1}));
  if (curve.points.size() < 2) {
    return;
  }
  for_each_part(curve,
                [&](Point from, Point to) { arcs_.push_back(arcs_.back() + distance(from, to)); });
  for (std::size_t part = 0; part + 1 < arcs_.size(); ++part) {
    part_directions_[part] = direction((arcs_[part] + arcs_[part + 1]) / 2);
  }
}

double MeasuredCurve::arc_px(std::size_t part, double share) const {
  const std::size_t next = std::min(part + 1, arcs_.size() - 1);
  return arcs_[part] + share * (arcs_[next] - arcs_[part]);
}

std::size_t MeasuredCurve::part_at(double arc_px) const {
  const auto above = std::upper_bound(arcs_.begin(), arcs_.end(), arc_px);
  const auto part =
      static_cast<std::size_t>(std::max(above - arcs_.begin() - 1, std::ptrdiff_t{0}));
  return std::min(part, std::max(arcs_.size(), std::size_t{2}) - 2);
}

Point MeasuredCurve::at(double arc_px) const {
  const auto& points = curve_.points;
  if (arcs_.size() < 2) {
    return points.front();
  }
  if (is_closed() && length_px() > 0) {
    arc_px -= length_px() * std::floor(arc_px / length_px());
  }
  arc_px = std::clamp(arc_px, 0.0, length_px());
  const std::size_t part = part_at(arc_px);
  const double length = arcs_[part + 1] - arcs_[part];
  return between(points[part], points[(part + 1) % points.size()],
                 length > 0 ? (arc_px - arcs_[part]) / length : 0);
}

Point MeasuredCurve::chord(double from_px, double to_px) const {
  const Point from = at(from_px);
  const Point to = at(to_px);
  return {to.x - from.x, to.y - from.y};
}

Point MeasuredCurve::direction(double arc_px) const {
  const Point way = chord(arc_px - kHalfChordPx, arc_px + kHalfChordPx);
  const double length = std::hypot(way.x, way.y);
  return length > 0 ? Point{way.x / length, way.y / length} : Point{};
}

std::vector<MeasuredCurve::Sample> MeasuredCurve::samples() const {
  if (curve_.points.empty()) {
    return {};
  }
  const double length = length_px();
  const int steps = std::max(1, static_cast<int>(std::lround(length)));
  double straight_px = 0;
  for (int i = 0; i < steps; ++i) {
    const double middle = (i + 0.5) * length / steps;
    const double from = is_closed() ? middle - kHalfChordPx : std::max(middle - kHalfChordPx, 0.0);
    const double to = is_closed() ? middle + kHalfChordPx : std::min(middle + kHalfChordPx, length);
    const Point way = chord(from, to);
    straight_px += to > from ? std::hypot(way.x, way.y) / (to - from) * length / steps : 0;
  }
  const int count = std::max(1, static_cast<int>(std::lround(straight_px)));
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double arc = (i + 0.5) * length / count;
    const std::size_t part = part_at(arc);
    const bool second = arcs_.size() > 1 && arc - arcs_[part] > arcs_[part + 1] - arc;
    samples.push_back({at(arc), arc, (part + (second ? 1 : 0)) % curve_.points.size()});
  }
  return samples;
}

bool directions_agree(Point a, Point b, double least_cosine) {
  const bool lone = (a.x == 0 && a.y == 0) || (b.x == 0 && b.y == 0);
  return lone || std::abs(a.x * b.x + a.y * b.y) >= least_cosine;
}

}  // namespace thermedge::eval
