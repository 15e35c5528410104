// Outlines of things in random scenes.
#pragma once

#include <cstdint>
#include <vector>

#include "random.hpp"
#include "thermedge/eval/curves.hpp"

namespace thermedge::bench {

// Numbers of one stream, one after the other.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t stream) : random_(seed, stream) {}
  double uniform(double low, double high) { return random_.uniform(next_++, low, high); }
  double normal(double sigma) { return sigma * random_.normal(next_++); }
  bool coin() { return uniform(0, 1) < 0.5; }
  // low .. high, both included.
  int integer(int low, int high) { return static_cast<int>(uniform(low, high + 1)); }

 private:
  sim::Random random_;
  std::uint64_t next_ = 0;
};

// A closed polygon; a point is inside by the even-odd rule. Immutable; thread-safe.
class Polygon {
 public:
  explicit Polygon(std::vector<eval::Point> corners);

  [[nodiscard]] const std::vector<eval::Point>& corners() const { return corners_; }
  [[nodiscard]] bool contains(eval::Point point) const;
  // Where the horizontal line at `y` enters and leaves, rising, an even number.
  void crossings(double y, std::vector<double>& x) const;
  [[nodiscard]] double top() const { return low_.y; }
  [[nodiscard]] double bottom() const { return high_.y; }

 private:
  std::vector<eval::Point> corners_;
  eval::Point low_, high_;
};

// An ellipse, a convex polygon, a box, a smooth blob or a bent strip of 15 to 85 px half size
// anywhere in a frame of this size.
[[nodiscard]] Polygon random_shape(int width, int height, Draws& draws);

// An ellipse or a box of .1 to 1 % of a frame of 382x288, away from the border of a frame of this
// size.
[[nodiscard]] Polygon random_small_shape(int width, int height, Draws& draws);

// What lies between two lines along an axis and crosses the whole frame.
[[nodiscard]] Polygon random_wall(int width, int height, Draws& draws);

}  // namespace thermedge::bench
