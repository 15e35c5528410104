#include "robust_line_fit.hpp"

#include <algorithm>
#include <cmath>

#include "order_statistics.hpp"

namespace thermedge::detail {

Line robust_line(std::span<const WeightedPoint> points, std::vector<double>& distances) {
  constexpr int kRounds = 6;
  constexpr double kSigmaOverMad = 1.4826;
  constexpr double kSingular = 1e-9;
  Line line;
  double scale = 0;
  for (int round = 0; round < kRounds; ++round) {
    double weights = 0;
    double places = 0;
    double squares = 0;
    double values = 0;
    double products = 0;
    distances.clear();
    for (const WeightedPoint& point : points) {
      const double far = std::abs(point.value - line.at(point.place));
      distances.push_back(far);
      const double beyond = scale > 0 ? std::max(far / scale, 1.0) : 1;
      const double weight = point.weight / (beyond * beyond);
      weights += weight;
      places += weight * point.place;
      squares += weight * point.place * point.place;
      values += weight * point.value;
      products += weight * point.place * point.value;
    }
    const double determinant = weights * squares - places * places;
    if (!(determinant > kSingular * weights * squares)) {
      return {};
    }
    scale = kSigmaOverMad * nth_value(std::span(distances), distances.size() / 2);
    line.level = (values * squares - products * places) / determinant;
    line.rise = (weights * products - places * values) / determinant;
  }
  return line;
}

}  // namespace thermedge::detail
