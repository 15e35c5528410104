#include "colours.hpp"

#include <array>

namespace thermedge::figures {

Rgb category_colour(std::size_t index) {
  static constexpr std::array<Rgb, 7> kColours = {
      Rgb{230, 159, 0}, Rgb{86, 180, 233},  Rgb{0, 158, 115},  Rgb{240, 228, 66},
      Rgb{213, 94, 0},  Rgb{204, 121, 167}, Rgb{236, 238, 240}};
  return kColours[index % kColours.size()];
}

}  // namespace thermedge::figures
