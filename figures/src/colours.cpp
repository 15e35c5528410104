#include "colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace thermedge::figures {
namespace {

std::uint8_t between(int from, int to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
}

Rgb on_ramp(std::span<const Rgb> stops, double share) {
  const double position = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(position), stops.size() - 2);
  const double within = position - static_cast<double>(stop);
  const Rgb a = stops[stop];
  const Rgb b = stops[stop + 1];
  return {between(a.r, b.r, within), between(a.g, b.g, within), between(a.b, b.b, within)};
}

}  // namespace

Rgb category_colour(std::size_t index) {
  static constexpr std::array<Rgb, 7> kColours = {
      Rgb{230, 159, 0}, Rgb{86, 180, 233},  Rgb{0, 158, 115},  Rgb{240, 228, 66},
      Rgb{213, 94, 0},  Rgb{204, 121, 167}, Rgb{236, 238, 240}};
  return kColours[index % kColours.size()];
}

Rgb quantity_colour(double share) {
  static constexpr std::array<Rgb, 5> kStops = {
      Rgb{0, 34, 78}, Rgb{66, 78, 108}, Rgb{124, 123, 120}, Rgb{186, 174, 108}, Rgb{254, 232, 56}};
  return on_ramp(kStops, share);
}

Rgb diverging_colour(double share) {
  static constexpr std::array<Rgb, 5> kStops = {Rgb{20, 80, 150}, Rgb{120, 170, 215},
                                                Rgb{247, 247, 247}, Rgb{230, 165, 95},
                                                Rgb{165, 75, 10}};
  return on_ramp(kStops, 0.5 + 0.5 * share);
}

}  // namespace thermedge::figures
