// Transposition of pictures.
#pragma once

#include <algorithm>
#include <cassert>

#include "thermedge/image.hpp"

namespace thermedge::detail {

// to(y, x) = from(x, y), block by block, so that what is read stays in the cache.
template <class T>
void transpose(ImageView<const T> from, ImageView<T> to) {
  constexpr int kBlock = 32;
  assert(from.width() == to.height() && from.height() == to.width());
  for (int top = 0; top < from.height(); top += kBlock) {
    const int bottom = std::min(top + kBlock, from.height());
    for (int x = 0; x < from.width(); ++x) {
      T* out = to.row(x);
      for (int y = top; y < bottom; ++y) {
        out[y] = from.data()[y * from.stride() + x];
      }
    }
  }
}

}  // namespace thermedge::detail
