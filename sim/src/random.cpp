#include "random.hpp"

#include <cmath>

namespace thermedge::sim {
namespace {

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15ULL;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31);
}

double to_unit(std::uint64_t bits) {
  constexpr double kStep = 1.0 / 9007199254740992.0;  // 2^-53
  return (static_cast<double>(bits >> 11) + 0.5) * kStep;
}

}  // namespace

double exact_log(double x) {
  constexpr double kLog2 = 0.693147180559945309417;
  constexpr double kSqrtHalf = 0.707106781186547524401;
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // in [0.5, 1)
  if (mantissa < kSqrtHalf) {
    mantissa *= 2;
    --exponent;
  }
  // log m = 2 artanh t, a series in t^2 <= 0.0295.
  const double t = (mantissa - 1) / (mantissa + 1);
  const double square = t * t;
  double series = 0;
  for (int k = 19; k >= 1; k -= 2) {
    series = series * square + 1.0 / k;
  }
  return exponent * kLog2 + 2 * t * series;
}

Random::Random(std::uint64_t seed, std::uint64_t stream) : key_(mix(mix(seed) ^ stream)) {}

std::uint64_t Random::bits(std::uint64_t index) const { return mix(key_ ^ mix(index)); }

double Random::uniform(std::uint64_t index) const { return to_unit(bits(index)); }

double Random::uniform(std::uint64_t index, double low, double high) const {
  return low + (high - low) * uniform(index);
}

double Random::normal(std::uint64_t index) const {
  std::uint64_t state = bits(index);
  for (;;) {
    state = mix(state);
    const double u = 2 * to_unit(state) - 1;
    state = mix(state);
    const double v = 2 * to_unit(state) - 1;
    const double square = u * u + v * v;
    if (square < 1 && square > 0) {
      return u * std::sqrt(-2 * exact_log(square) / square);
    }
  }
}

}  // namespace thermedge::sim
