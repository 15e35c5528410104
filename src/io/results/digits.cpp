#include "results/digits.hpp"

#include <charconv>
#include <cmath>
#include <iterator>

namespace thermedge::io {

double to_decimals(double value, int digits) {
  double steps = 1;
  for (int i = 0; i < digits; ++i) {
    steps *= 10;
  }
  // -0 becomes 0.
  return std::isfinite(value) ? std::round(value * steps) / steps + 0.0 : value;
}

double to_significant(double value, int digits) {
  if (!std::isfinite(value)) {
    return value;
  }
  char text[32];
  const auto written = std::to_chars(std::begin(text), std::end(text), value,
                                     std::chars_format::scientific, digits - 1);
  double rounded = value;
  std::from_chars(std::begin(text), written.ptr, rounded);
  return rounded;
}

}  // namespace thermedge::io
