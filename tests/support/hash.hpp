// A hash of what a stage gives, the same on every machine.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>

#include "thermedge/geometry.hpp"
#include "thermedge/image.hpp"

namespace thermedge::test {

// FNV-1a (64 bits) over whole numbers, each as eight bytes. Numbers with decimals are rounded to a
// step first, so that the last bit of a library function does not count.
class Hash {
 public:
  template <std::integral T>
  Hash& add(T value) {
    auto bits = static_cast<std::uint64_t>(value);
    for (int byte = 0; byte < 8; ++byte) {
      value_ = (value_ ^ (bits & 0xFF)) * 0x100000001B3;
      bits >>= 8;
    }
    return *this;
  }
  Hash& add_rounded(double value, double step) {
    return add(std::isnan(value) ? std::int64_t{1} << 62 : std::llround(value / step));
  }
  template <class T>
  Hash& add_pixels(ImageView<const T> image) {
    add(image.width()).add(image.height());
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        add(image(x, y));
      }
    }
    return *this;
  }
  Hash& add(Pixel pixel) { return add(pixel.x).add(pixel.y); }

  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325;
};

}  // namespace thermedge::test
