// Against Eigen's dense decomposition.
#include "banded_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <vector>

namespace thermedge::detail {
namespace {

template <int kHalfWidth>
void expect_as_eigen(int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd right(columns);
  std::vector<double> band(static_cast<std::size_t>((kHalfWidth + 1) * (columns + kHalfWidth)));
  std::vector<double> solution(static_cast<std::size_t>(columns + kHalfWidth));
  for (int c = 0; c < columns; ++c) {
    for (int i = 0; i <= kHalfWidth && c + i < columns; ++i) {
      // The diagonal outweighs the rest of its row, so that the matrix is positive definite.
      const double value = i == 0 ? 2 * kHalfWidth + 1 + uniform(random) : uniform(random);
      matrix(c + i, c) = matrix(c, c + i) = value;
      band[static_cast<std::size_t>(c * (kHalfWidth + 1) + i)] = value;
    }
    right(c) = solution[static_cast<std::size_t>(c)] = 100 * uniform(random);
  }
  solve_banded<kHalfWidth>(band, solution);
  const Eigen::VectorXd expected = matrix.llt().solve(right);
  for (int c = 0; c < columns; ++c) {
    EXPECT_NEAR(solution[static_cast<std::size_t>(c)], expected(c), 1e-11) << columns << ", " << c;
  }
}

TEST(BandedCholesky, SolvesWhatEigenSolves) {
  for (int columns = 1; columns <= 40; ++columns) {
    expect_as_eigen<1>(columns, static_cast<unsigned>(columns));
    expect_as_eigen<3>(columns, static_cast<unsigned>(columns));
    expect_as_eigen<8>(columns, static_cast<unsigned>(columns));
  }
  expect_as_eigen<8>(382, 7);
}

}  // namespace
}  // namespace thermedge::detail
