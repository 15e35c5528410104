// Sine and cosine from + - * / alone, so that they give the same bits with every C library.
#pragma once

#include <numbers>

namespace thermedge::sim {

struct SinCos {
  double sin = 0, cos = 1;
};

// To about 1e-15 for |x| up to some turns: Taylor's series of x / 16, doubled four times.
[[nodiscard]] constexpr SinCos sin_cos(double x) {
  constexpr int kDoublings = 4;
  const double small = x / (1 << kDoublings);
  double sine = 0;
  double cosine = 0;
  double term = 1;
  for (int k = 0; k < 24; k += 2) {
    cosine += term;
    term *= small / (k + 1);
    sine += term;
    term *= -small / (k + 2);
  }
  SinCos result{sine, cosine};
  for (int i = 0; i < kDoublings; ++i) {
    result = {2 * result.sin * result.cos, result.cos * result.cos - result.sin * result.sin};
  }
  return result;
}

constexpr double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

}  // namespace thermedge::sim
