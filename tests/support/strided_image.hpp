// A picture whose rows begin at odd places in memory, with sentinels between them.
#pragma once

#include <cstddef>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::test {

template <class T>
class StridedImage {
 public:
  StridedImage(int width, int height, T sentinel = T(77))
      : width_(width),
        height_(height),
        stride_(width + 3 + width % 2),
        sentinel_(sentinel),
        elements_(static_cast<std::size_t>(stride_ * (height + 2) + 1), sentinel) {}

  // The first row begins behind one row of sentinels and one more element.
  [[nodiscard]] ImageView<T> view() {
    return {elements_.data() + stride_ + 1, width_, height_, stride_};
  }
  [[nodiscard]] ImageView<const T> view() const {
    return {elements_.data() + stride_ + 1, width_, height_, stride_};
  }
  // Whether nothing was written outside.
  [[nodiscard]] bool intact() const {
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      const auto place = static_cast<std::ptrdiff_t>(i) - 1;
      const bool inside =
          place >= stride_ && place < stride_ * (height_ + 1) && place % stride_ < width_;
      if (!inside && !(elements_[i] == sentinel_)) {
        return false;
      }
    }
    return true;
  }

 private:
  int width_, height_;
  std::ptrdiff_t stride_;  // odd
  T sentinel_;
  std::vector<T> elements_;
};

}  // namespace thermedge::test
