// Linear equations whose symmetric, positive definite matrix has a narrow band.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace thermedge::detail {

// Solves A x = b by Cholesky's decomposition A = L L^T, in the order of the columns, so that
// results have the same bits everywhere. `band` holds the lower half of A column by column: element
// (c + i, c) at c * (kHalfWidth + 1) + i for i from 0 to kHalfWidth. `right_side` holds b and
// becomes x. Both have kHalfWidth columns of zeros after the last one, so that the loops need no
// bounds; `band` becomes L. Golub, Van Loan: Matrix Computations, sec. 4.3.5.
template <int kHalfWidth>
void solve_banded(std::span<double> band, std::span<double> right_side) {
  constexpr std::size_t kColumn = kHalfWidth + 1;
  const std::size_t columns = right_side.size() - kHalfWidth;
  for (std::size_t c = 0; c < columns; ++c) {
    double* column = &band[c * kColumn];
    double* right = &right_side[c];
    column[0] = std::sqrt(column[0]);
    right[0] /= column[0];
    for (int i = 1; i <= kHalfWidth; ++i) {
      column[i] /= column[0];
    }
    // The column that is done is subtracted from those after it.
#pragma GCC unroll 8
    for (int i = 1; i <= kHalfWidth; ++i) {
      double* other = column + i * static_cast<int>(kColumn) - i;
#pragma GCC unroll 8
      for (int j = i; j <= kHalfWidth; ++j) {
        other[j] -= column[j] * column[i];
      }
      right[i] -= column[i] * right[0];
    }
  }
  for (std::size_t c = columns; c-- > 0;) {
    const double* column = &band[c * kColumn];
    double* right = &right_side[c];
    for (int i = 1; i <= kHalfWidth; ++i) {
      right[0] -= column[i] * right[i];
    }
    right[0] /= column[0];
  }
}

}  // namespace thermedge::detail
