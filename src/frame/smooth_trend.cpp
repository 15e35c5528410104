#include "smooth_trend.hpp"

#include <algorithm>
#include <cmath>

#include "order_statistics.hpp"
#include "thermedge/memory.hpp"

namespace thermedge::detail {
namespace {

constexpr std::size_t kTerms = kSlopeDegree + 1;
using Terms = std::array<double, kTerms>;

Terms powers(double u) {
  Terms out;
  out[0] = 1;
  for (std::size_t i = 1; i < kTerms; ++i) {
    out[i] = out[i - 1] * u;
  }
  return out;
}

double dot(const Terms& a, const Terms& b) {
  double sum = 0;
  for (std::size_t i = 0; i < kTerms; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

// In four sums, which need not wait for each other.
double dot(std::span<const double> a, std::span<const double> b) {
  constexpr std::size_t kSums = 4;
  std::array<double, kSums> sums{};
  std::size_t i = 0;
  for (; i + kSums <= a.size(); i += kSums) {
    for (std::size_t k = 0; k < kSums; ++k) {
      sums[k] += a[i + k] * b[i + k];
    }
  }
  for (; i < a.size(); ++i) {
    sums[0] += a[i] * b[i];
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

struct NormalEquations {
  std::array<Terms, kTerms> matrix{};  // the lower half
  Terms right{};

  void add(const Terms& term, double value, double weight) {
    for (std::size_t i = 0; i < kTerms; ++i) {
      const double weighted = weight * term[i];
      right[i] += weighted * value;
      for (std::size_t j = 0; j <= i; ++j) {
        matrix[i][j] += weighted * term[j];
      }
    }
  }

  // By Cholesky's decomposition; false where they say too little.
  bool solve(Terms& result) {
    constexpr double kSingular = 1e-9;
    const double least = kSingular * matrix[0][0];
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = matrix[i][j];
        for (std::size_t k = 0; k < j; ++k) {
          sum -= matrix[i][k] * matrix[j][k];
        }
        if (i == j && !(sum > least)) {
          return false;
        }
        matrix[i][j] = i == j ? std::sqrt(sum) : sum / matrix[j][j];
      }
    }
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        right[i] -= matrix[i][k] * right[k];
      }
      right[i] /= matrix[i][i];
    }
    for (std::size_t i = kTerms; i-- > 0;) {
      for (std::size_t k = i + 1; k < kTerms; ++k) {
        right[i] -= matrix[k][i] * right[k];
      }
      right[i] /= matrix[i][i];
    }
    result = right;
    return true;
  }
};

// Takes the mean of each segment away.
void centre(std::span<const int> segments, std::span<double> values) {
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin;
    double sum = 0;
    while (end < values.size() && segments[end] == segments[begin]) {
      sum += values[end++];
    }
    const double mean = sum / static_cast<double>(end - begin);
    for (; begin < end; ++begin) {
      values[begin] -= mean;
    }
  }
}

void add_scaled(std::span<const double> values, double factor, std::span<double> sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] += factor * values[i];
  }
}

}  // namespace

double SmoothSlope::trend(double place) const {
  const double u = (place - middle) / half;
  double sum = 0;
  for (std::size_t i = kTerms; i-- > 0;) {
    sum = sum * u + coefficients[i] / static_cast<double>(i + 1);
  }
  return half * u * sum;
}

SmoothSlope robust_slope(std::span<const WeightedPoint> points, double middle, double half,
                         std::vector<double>& distances) {
  constexpr int kRounds = 3;
  constexpr double kSigmaOverMad = 1.4826;
  constexpr double kRidge = 1e-4;  // of the sum of the weights, for terms beyond a line
  SmoothSlope slope{middle, half, {}};
  double scale = 0;
  for (int round = 0; round < kRounds; ++round) {
    NormalEquations equations;
    distances.clear();
    for (const WeightedPoint& point : points) {
      const Terms term = powers((point.place - middle) / half);
      const double far = std::abs(point.value - dot(slope.coefficients, term));
      distances.push_back(far);
      const double beyond = scale > 0 ? std::max(far / scale, 1.0) : 1;
      equations.add(term, point.value, point.weight / (beyond * beyond));
    }
    for (std::size_t i = 2; i < kTerms; ++i) {
      equations.matrix[i][i] += kRidge * equations.matrix[0][0];
    }
    if (points.empty() || !equations.solve(slope.coefficients)) {
      return {middle, half, {}};
    }
    scale = kSigmaOverMad * nth_value(std::span(distances), distances.size() / 2);
  }
  return slope;
}

void TrendFit::prepare(int columns) {
  const auto n = static_cast<std::size_t>(columns);
  if (trend_.size() == n) {
    return;
  }
  for (std::size_t i = 0; i < whole_.size(); ++i) {
    whole_[i].resize(n);
    parts_[i].resize(n);
  }
  rest_.resize(n);
  trend_.assign(n, 0.0);
  find_basis(std::vector<int>(n, 0), whole_);
}

std::size_t TrendFit::memory_bytes() const {
  std::size_t sum = memory_of(rest_, trend_);
  for (std::size_t i = 0; i < whole_.size(); ++i) {
    sum += memory_of(whole_[i], parts_[i]);
  }
  return sum;
}

// Polynomials of rising degree without a mean in any segment, orthogonal, of length 1; zero where
// the segments leave nothing of them. By Gram and Schmidt.
void TrendFit::find_basis(std::span<const int> segments, Basis& basis) {
  constexpr double kSingular = 1e-9;
  const std::size_t n = segments.size();
  for (std::size_t degree = 0; degree < basis.size(); ++degree) {
    std::vector<double>& term = basis[degree];
    for (std::size_t x = 0; x < n; ++x) {
      const double u = 2 * static_cast<double>(x) / static_cast<double>(n - 1) - 1;
      term[x] = degree == 0 ? u : u * basis[degree - 1][x];
    }
    centre(segments, term);
    const double before = dot(term, term);
    for (std::size_t other = 0; other < degree; ++other) {
      add_scaled(basis[other], -dot(term, basis[other]), term);
    }
    const double squares = dot(term, term);
    const double scale = squares > kSingular * before ? 1 / std::sqrt(squares) : 0;
    std::transform(term.begin(), term.end(), term.begin(), [=](double t) { return scale * t; });
  }
}

void TrendFit::fit(std::span<const double> profile, std::span<const int> segments, double deviation,
                   double least_z) {
  std::copy(profile.begin(), profile.end(), rest_.begin());
  centre(segments, rest_);
  const bool is_whole = segments.front() == segments.back();
  if (!is_whole) {
    find_basis(segments, parts_);
  }
  const Basis& basis = is_whole ? whole_ : parts_;
  std::fill(trend_.begin(), trend_.end(), 0.0);
  const double least = least_z * deviation;
  for (const std::vector<double>& term : basis) {
    const double share = dot(rest_, term);
    if (std::abs(share) > least) {
      add_scaled(term, share - least * least / share, trend_);
    }
  }
}

}  // namespace thermedge::detail
