// Sizes for messages.
#pragma once

#include <string>

#include "thermedge/image.hpp"

namespace thermedge::eval {

template <class T>
[[nodiscard]] std::string size_text(ImageView<T> image) {
  return std::to_string(image.width()) + "x" + std::to_string(image.height());
}

}  // namespace thermedge::eval
