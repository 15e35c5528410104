// The direction in which an arm of a contour leaves a corner (paper eq. 11).
#pragma once

#include <cstddef>

#include "thermedge/geometry.hpp"

namespace thermedge::detail {

struct Vector {
  double x, y;
};

inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }

// The tangent at the beginning of an arm: of the parabola that fits the positions of its samples
// over their numbers best, of a straight line where the arm is short. Of any length. `offset(k)`:
// from the corner, which is sample 0, to sample k.
template <class Offset>
Vector tangent(std::size_t length, Offset&& offset) {
  constexpr std::size_t kShort = 4;
  const auto last = static_cast<double>(length);
  const double mean_square = last * (last + 2) / 3;  // of `u`
  Vector slope{0, 0};
  Vector bend{0, 0};
  double slope_norm = 0;
  double bend_norm = 0;
  for (std::size_t k = 0; k <= length; ++k) {
    const Pixel at = offset(k);
    const double u = 2 * static_cast<double>(k) - last;
    const double v = u * u - mean_square;  // orthogonal to `u` and to 1
    slope = {slope.x + u * at.x, slope.y + u * at.y};
    bend = {bend.x + v * at.x, bend.y + v * at.y};
    slope_norm += u * u;
    bend_norm += v * v;
  }
  if (length <= kShort) {
    return slope;
  }
  const double share = 2 * last * slope_norm / bend_norm;  // d(v)/du = 2 u = -2 `last` at sample 0
  return {slope.x - share * bend.x, slope.y - share * bend.y};
}

}  // namespace thermedge::detail
