// Marks what is near a pixel.
#pragma once

#include <algorithm>

#include "thermedge/image.hpp"

namespace thermedge::detail {

// Sets the pixels up to `reach` from (x, y) across and down, as far as they are in the image.
template <class T>
void fill_square(ImageView<T> image, int x, int y, int reach, T value) {
  const int left = std::max(x - reach, 0);
  const int count = std::min(x + reach, image.width() - 1) - left + 1;
  for (int v = std::max(y - reach, 0); v <= std::min(y + reach, image.height() - 1); ++v) {
    std::fill_n(image.row(v) + left, count, value);
  }
}

}  // namespace thermedge::detail
