#include "hysteresis.hpp"

#include <algorithm>

#include "suppression_simd.hpp"

namespace thermedge::detail {
namespace {

// Marks all that is connected with `seed`. Pixels of the border have no class, so all neighbours
// that are looked at lie inside.
void keep_group(ImageView<std::uint8_t> classes, std::ptrdiff_t seed, std::size_t min_group_px,
                std::vector<std::ptrdiff_t>& group) {
  const std::ptrdiff_t stride = classes.stride();
  const std::ptrdiff_t neighbours[] = {-stride - 1, -stride,    -stride + 1, -1,
                                       1,           stride - 1, stride,      stride + 1};
  std::uint8_t* const pixels = classes.data();
  const auto keep = [&](std::ptrdiff_t pixel) {
    pixels[pixel] = kKeptEdge;
    group.push_back(pixel);
  };
  group.clear();
  keep(seed);
  for (std::size_t next = 0; next < group.size();) {
    const std::ptrdiff_t pixel = group[next++];
    for (const std::ptrdiff_t step : neighbours) {
      const std::uint8_t found = pixels[pixel + step];
      if (found == kWeakEdge || found == kStrongEdge) {
        keep(pixel + step);
      }
    }
  }
  if (group.size() < min_group_px) {
    for (const std::ptrdiff_t pixel : group) {
      pixels[pixel] = kNoEdge;
    }
  }
}

}  // namespace

void apply_hysteresis(ImageView<std::uint8_t> classes, std::size_t min_group_px,
                      std::vector<std::ptrdiff_t>& scratch) {
  for (int y = 1; y + 1 < classes.height(); ++y) {
    std::uint8_t* const row_end = classes.row(y) + classes.width();
    std::uint8_t* seed = find_pixel(classes.row(y), row_end, kStrongEdge);
    while (seed != row_end) {
      keep_group(classes, seed - classes.data(), min_group_px, scratch);
      seed = find_pixel(seed, row_end, kStrongEdge);
    }
  }
  for (int y = 1; y + 1 < classes.height(); ++y) {
    std::uint8_t* const row = classes.row(y);
    std::transform(row, row + classes.width(), row, [](std::uint8_t value) {
      return value == kKeptEdge ? kKeptEdge : std::uint8_t{kNoEdge};
    });
  }
}

}  // namespace thermedge::detail
