// Small systems of linear equations, as least squares makes them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace thermedge::detail {

template <std::size_t N>
using Vector = std::array<double, N>;
template <std::size_t N>
using LowerMatrix = std::array<Vector<N>, N>;  // symmetric, of which the lower half is used

// Adds the equation row * x = -residual with its weight to the normal equations.
template <std::size_t N>
void add_outer_product(const Vector<N>& row, double weight, double residual, LowerMatrix<N>& matrix,
                       Vector<N>& right_side) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double weighted = weight * row[i];
    right_side[i] -= weighted * residual;
    for (std::size_t j = 0; j <= i; ++j) {
      matrix[i][j] += weighted * row[j];
    }
  }
}

// Lower half of the Cholesky factor of a matrix, in its place; false where it is singular.
template <std::size_t N>
bool factorise(LowerMatrix<N>& m) {
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) {
        sum -= m[i][k] * m[j][k];
      }
      if (i == j) {
        if (!(sum > 0)) {
          return false;
        }
        m[i][i] = std::sqrt(sum);
      } else {
        m[i][j] = sum / m[j][j];
      }
    }
  }
  return true;
}

// Solves factor factor^T x = b.
template <std::size_t N>
Vector<N> solve(const LowerMatrix<N>& factor, Vector<N> b) {
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      b[i] -= factor[i][k] * b[k];
    }
    b[i] /= factor[i][i];
  }
  for (std::size_t i = b.size(); i-- > 0;) {
    for (std::size_t k = i + 1; k < b.size(); ++k) {
      b[i] -= factor[k][i] * b[k];
    }
    b[i] /= factor[i][i];
  }
  return b;
}

}  // namespace thermedge::detail
