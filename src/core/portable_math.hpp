// Functions for filter tables, made of additions, multiplications and divisions alone, so that
// they give the same bits with every C library.
#pragma once

namespace thermedge::detail {

// e^x for |x| up to some hundreds: Taylor's series near 0, then squared back.
[[nodiscard]] constexpr double portable_exp(double x) {
  int halvings = 0;
  for (; x > 0.5 || x < -0.5; x /= 2) {
    ++halvings;
  }
  double sum = 1;
  double term = 1;
  for (int k = 1; k <= 18; ++k) {
    term *= x / k;
    sum += term;
  }
  for (; halvings > 0; --halvings) {
    sum *= sum;
  }
  return sum;
}

// Modified Bessel function of the first kind and order 0 as a function of the argument's square,
// 0 to 100: sum of (x / 2)^(2 k) / (k!)^2.
[[nodiscard]] constexpr double bessel_i0_of_square(double x_squared) {
  double sum = 1;
  double term = 1;
  for (int k = 1; k <= 40; ++k) {
    term *= x_squared / (4.0 * k * k);
    sum += term;
  }
  return sum;
}

}  // namespace thermedge::detail
