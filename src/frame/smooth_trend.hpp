// The part of a profile of columns that changes slowly from side to side: the scene, not stripes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "robust_line_fit.hpp"

namespace thermedge::detail {

// Of the slope, which edges must not bend; and of the trend (docs/experiments.md, "Stripes").
inline constexpr int kSlopeDegree = 3;
inline constexpr int kTrendDegree = 6;

// A polynomial over a range of places, which it maps to -1 .. 1.
struct SmoothSlope {
  double middle = 0;
  double half = 1;
  std::array<double, kSlopeDegree + 1> coefficients{};  // of rising powers

  // Of the place: the trend whose slope this is, 0 in the middle.
  [[nodiscard]] double trend(double place) const;
};

// Least squares, refitted with weights that fall with the square of the distance beyond the MAD.
// Where the points are too few to tell there is no slope. `distances` is scratch.
SmoothSlope robust_slope(std::span<const WeightedPoint> points, double middle, double half,
                         std::vector<double>& distances);

// The polynomial trend in a profile of which the rest is white with a given deviation: least
// squares, with a level of its own for each run of columns with the same number. Each degree counts
// as far as it stands out of the rest. Allocates in prepare only.
class TrendFit {
 public:
  void prepare(int columns);
  // Fills trend(). A degree of which there are z deviations counts by 1 - (least_z / z)^2, or not
  // at all (James and Stein), so that small changes of the profile make small ones of the trend.
  void fit(std::span<const double> profile, std::span<const int> segments, double deviation,
           double least_z);
  [[nodiscard]] std::span<const double> trend() const { return trend_; }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  using Basis = std::array<std::vector<double>, kTrendDegree>;
  static void find_basis(std::span<const int> segments, Basis& basis);

  Basis whole_, parts_;  // of one segment, and of those of a profile
  std::vector<double> rest_, trend_;
};

}  // namespace thermedge::detail
