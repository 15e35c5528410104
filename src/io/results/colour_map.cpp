#include "thermedge/io/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace thermedge::io {
namespace {

// Every 17th of the map's 256 colours.
constexpr std::array<Rgb, 16> kPlasma = {
    Rgb{13, 8, 135}, {51, 5, 151},   {80, 2, 162},   {106, 0, 168},  {132, 5, 167},  {156, 23, 158},
    {177, 42, 144},  {195, 61, 128}, {211, 81, 113}, {225, 100, 98}, {237, 121, 83}, {246, 143, 68},
    {252, 166, 54},  {254, 192, 41}, {249, 220, 36}, {240, 249, 33}};

std::uint8_t blend(int from, int to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
}

}  // namespace

Rgb plasma(double share) {
  const double position = std::clamp(share, 0.0, 1.0) * (kPlasma.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(position), kPlasma.size() - 2);
  const double within = position - static_cast<double>(stop);
  const Rgb a = kPlasma[stop];
  const Rgb b = kPlasma[stop + 1];
  return {blend(a.r, b.r, within), blend(a.g, b.g, within), blend(a.b, b.b, within)};
}

}  // namespace thermedge::io
