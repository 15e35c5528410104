// A curve by its length: places, directions and samples along it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "thermedge/eval/curves.hpp"

namespace thermedge::eval {

// The curve must outlive it. Immutable; thread-safe.
class MeasuredCurve {
 public:
  explicit MeasuredCurve(const Curve& curve);

  struct Sample {
    Point place;
    double arc_px = 0;      // from the first point
    std::size_t point = 0;  // the nearest point of the curve
  };
  // Evenly spread, 1 px apart as nearly as a whole number allows; at least one where there is a
  // point. How many there are is told from the curve without its wiggles of a pixel or two, so that
  // noise makes no curve longer.
  [[nodiscard]] std::vector<Sample> samples() const;

  [[nodiscard]] double length_px() const { return arcs_.back(); }
  // From the first point to the place on the part that begins at the `part`th point.
  [[nodiscard]] double arc_px(std::size_t part, double share) const;
  // The direction of the chord over 4 px around a place, a unit vector; 0 on a lone point.
  [[nodiscard]] Point direction(double arc_px) const;
  // The same around the middle of the part that begins at the `part`th point.
  [[nodiscard]] Point part_direction(std::size_t part) const { return part_directions_[part]; }

 private:
  [[nodiscard]] bool is_closed() const { return arcs_.size() > curve_.points.size(); }
  [[nodiscard]] std::size_t part_at(double arc_px) const;
  [[nodiscard]] Point at(double arc_px) const;
  [[nodiscard]] Point chord(double from_px, double to_px) const;

  const Curve& curve_;
  std::vector<double> arcs_;  // of each point; of closed curves once more of the first one
  std::vector<Point> part_directions_;
};

// Whether two directions differ by no more than the angle of this cosine, whichever way the curves
// walk. Directions of lone points agree with all.
[[nodiscard]] bool directions_agree(Point a, Point b, double least_cosine);

}  // namespace thermedge::eval
