// A straight line through points of which some have nothing to do with it.
#pragma once

#include <span>
#include <vector>

namespace thermedge::detail {

struct Line {
  double level = 0;
  double rise = 0;
  [[nodiscard]] double at(double place) const { return level + rise * place; }
};

struct WeightedPoint {
  double place;
  double value;
  double weight;  // above 0
};

// Least squares, refitted with weights that fall with the square of the distance beyond the MAD
// (iteratively reweighted, Cauchy-like). Level 0 and rise 0 where fewer than two places are given.
// `distances` is scratch.
Line robust_line(std::span<const WeightedPoint> points, std::vector<double>& distances);

}  // namespace thermedge::detail
