#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "thermedge/stages/scoring.hpp"

namespace thermedge {
namespace {

constexpr std::size_t kCoefficients = 4;

// Number of different abscissae, counted to four: the rank of the fit.
std::size_t distinct_abscissae(std::span<const Pixel> points) {
  std::array<std::int32_t, kCoefficients> seen{};
  std::size_t count = 0;
  for (auto point = points.begin(); point != points.end() && count < seen.size(); ++point) {
    const auto end = seen.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::find(seen.begin(), end, point->x) == end) {
      seen[count++] = point->x;
    }
  }
  return count;
}

// A polynomial sum_k weight[k] p_k(x) over the polynomials that are orthogonal on the points:
// p_0 = 1, p_(k+1) = (x - shift[k]) p_k - damping[k] p_(k-1) (Stieltjes, Forsythe 1957).
struct OrthogonalFit {
  std::array<double, kCoefficients> shift{}, damping{}, weight{};

  struct Value {
    double basis;  // p_degree(x)
    double fit;    // sum over k < degree
  };
  [[nodiscard]] Value at(double x, std::size_t degree) const {
    double previous = 0;
    Value value{1, 0};
    for (std::size_t k = 0; k < degree; ++k) {
      value.fit += weight[k] * value.basis;
      const double next = (x - shift[k]) * value.basis - damping[k] * previous;
      previous = value.basis;
      value.basis = next;
    }
    return value;
  }
};

}  // namespace

// Each degree is fitted to what the lower ones left over. The basis is orthogonal, so that neither
// scale nor place of the points matters, nor is there a matrix that could be near singular.
double cubic_residual(std::span<const Pixel> points) {
  constexpr double kRounding = 1e-9;
  const std::size_t rank = distinct_abscissae(points);
  OrthogonalFit fit;
  double previous_norm = 0;
  for (std::size_t degree = 0; degree < rank; ++degree) {
    double norm = 0;
    double moment = 0;
    double product = 0;
    for (const Pixel point : points) {
      const auto [basis, fitted] = fit.at(point.x, degree);
      norm += basis * basis;
      moment += point.x * basis * basis;
      product += (point.y - fitted) * basis;
    }
    fit.weight[degree] = product / norm;
    fit.shift[degree] = moment / norm;
    fit.damping[degree] = degree > 0 ? norm / previous_norm : 0;
    previous_norm = norm;
  }
  double residual = 0;
  for (const Pixel point : points) {
    const double rest = point.y - fit.at(point.x, rank).fit;
    residual += rest * rest;
  }
  return residual < kRounding ? 0 : residual;
}

}  // namespace thermedge
