#include <algorithm>
#include <cmath>

#include "curve_parts.hpp"

namespace thermedge::eval {

NearestOnCurves::NearestOnCurves(std::span<const Curve> curves, double reach_px)
    : reach_px_(reach_px), cell_px_(std::max(reach_px, 4.0)) {
  Point high{0, 0};
  bool any = false;
  for (std::size_t index = 0; index < curves.size(); ++index) {
    const Curve& curve = curves[index];
    const std::size_t first = segments_.size();
    for_each_part(curve, [&](Point from, Point to) {
      segments_.push_back({from, to, index, segments_.size() - first});
    });
    if (!curve.closed && segments_.size() > first) {
      segments_[first].open_from = true;
      segments_.back().open_to = true;
    }
    for (const Point point : curve.points) {
      low_ = any ? Point{std::min(low_.x, point.x), std::min(low_.y, point.y)} : point;
      high = any ? Point{std::max(high.x, point.x), std::max(high.y, point.y)} : point;
      any = true;
    }
  }
  if (!any) {
    return;
  }
  // Points far outside the frame must not cost memory.
  constexpr double kMostCells = 1e6;
  const double area_px2 = (high.x - low_.x) * (high.y - low_.y);
  cell_px_ = std::max(cell_px_, std::sqrt(area_px2 / kMostCells));
  columns_ = static_cast<int>((high.x - low_.x) / cell_px_) + 1;
  rows_ = static_cast<int>((high.y - low_.y) / cell_px_) + 1;
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (std::uint32_t i = 0; i < segments_.size(); ++i) {
    add_to_cells(i);
  }
}

// Piece by piece, since the box around a long part holds many cells that it does not pass.
void NearestOnCurves::add_to_cells(std::uint32_t index) {
  const Segment& segment = segments_[index];
  const double length = distance(segment.from, segment.to);
  const int pieces = std::max(1, static_cast<int>(std::ceil(length / cell_px_)));
  for (int piece = 0; piece < pieces; ++piece) {
    const Point a = between(segment.from, segment.to, static_cast<double>(piece) / pieces);
    const Point b = between(segment.from, segment.to, static_cast<double>(piece + 1) / pieces);
    // A little more than the piece itself, against rounding at the borders of cells.
    constexpr double kMargin = 1e-6;
    for_each_cell({std::min(a.x, b.x) - kMargin, std::min(a.y, b.y) - kMargin},
                  {std::max(a.x, b.x) + kMargin, std::max(a.y, b.y) + kMargin},
                  [&](std::size_t cell) {
                    if (cells_[cell].empty() || cells_[cell].back() != index) {
                      cells_[cell].push_back(index);
                    }
                  });
  }
}

template <class F>
void NearestOnCurves::for_each_cell(Point low, Point high, F&& visit) const {
  const auto cell_of = [&](double offset, int count) {
    return static_cast<int>(std::clamp(std::floor(offset / cell_px_), -1.0, double{1} * count));
  };
  const int left = std::max(cell_of(low.x - low_.x, columns_), 0);
  const int right = std::min(cell_of(high.x - low_.x, columns_), columns_ - 1);
  const int top = std::max(cell_of(low.y - low_.y, rows_), 0);
  const int bottom = std::min(cell_of(high.y - low_.y, rows_), rows_ - 1);
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
            static_cast<std::size_t>(column));
    }
  }
}

NearestOnCurves::PartPlace NearestOnCurves::place_on(const Segment& segment, Point point) const {
  const double dx = segment.to.x - segment.from.x;
  const double dy = segment.to.y - segment.from.y;
  const double px = point.x - segment.from.x;
  const double py = point.y - segment.from.y;
  const double squared_length = dx * dx + dy * dy;
  const double along = squared_length > 0 ? (px * dx + py * dy) / squared_length : 0;
  PartPlace result;
  result.curve = segment.curve;
  result.part = segment.part;
  result.share = std::clamp(along, 0.0, 1.0);
  result.foot = between(segment.from, segment.to, result.share);
  if (squared_length > 0) {
    const double length = std::sqrt(squared_length);
    result.along = {dx / length, dy / length};
  }
  const double away = distance(point, result.foot);
  result.place.distance_px = away;
  result.place.offset_px = dx * py - dy * px >= 0 ? away : -away;
  result.place.beside = !(segment.open_from && along < 0) && !(segment.open_to && along > 1);
  return result;
}

// Where several places have the same distance, the one on the first curve is taken.
NearestOnCurves::Place NearestOnCurves::nearest(Point point) const {
  Place best;
  std::uint32_t best_segment = 0;
  const auto look = [&](std::uint32_t index) {
    const Place place = place_on(segments_[index], point).place;
    if (place.distance_px <= reach_px_ &&
        (place.distance_px < best.distance_px ||
         (place.distance_px == best.distance_px && index < best_segment))) {
      best = place;
      best_segment = index;
    }
  };
  for_each_cell(
      {point.x - reach_px_, point.y - reach_px_}, {point.x + reach_px_, point.y + reach_px_},
      [&](std::size_t cell) { std::for_each(cells_[cell].begin(), cells_[cell].end(), look); });
  return best;
}

void NearestOnCurves::visit_near(Point point,
                                 const std::function<void(const PartPlace&)>& visit) const {
  for_each_cell({point.x - reach_px_, point.y - reach_px_},
                {point.x + reach_px_, point.y + reach_px_}, [&](std::size_t cell) {
                  for (const std::uint32_t index : cells_[cell]) {
                    const PartPlace place = place_on(segments_[index], point);
                    if (place.place.distance_px <= reach_px_) {
                      visit(place);
                    }
                  }
                });
}

}  // namespace thermedge::eval
