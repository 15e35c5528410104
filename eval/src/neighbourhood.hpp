// Which of the eight neighbours of a pixel are set, as one byte.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::eval {

// Neighbours are numbered from east, counter-clockwise: E NE N NW W SW S SE, bit 0 to bit 7.
inline constexpr int kNeighbours = 8;
constexpr int opposite(int neighbour) { return (neighbour + 4) % kNeighbours; }
constexpr bool has(unsigned code, int neighbour) {
  return (code >> (neighbour % kNeighbours) & 1U) != 0;
}

// Groups of set neighbours that hang together by themselves, as far as an unset neighbour by edge
// parts them: 1 where the pixel can go without breaking a connection (the crossing number X_H).
constexpr int crossings(unsigned code) {
  int count = 0;
  for (int k = 0; k < kNeighbours; k += 2) {
    count += !has(code, k) && (has(code, k + 1) || has(code, k + 2)) ? 1 : 0;
  }
  return count;
}

// Runs of set neighbours around the pixel.
constexpr int runs(unsigned code) {
  const auto bits = static_cast<std::uint8_t>(code);
  return std::popcount(static_cast<std::uint8_t>(bits & ~std::rotl(bits, 1)));
}

// A map with a frame of unset pixels around it, and the neighbourhood of every pixel, kept up to
// date as pixels are taken away. Places are indices into the framed map.
class Neighbourhoods {
 public:
  // Nonzero pixels are set.
  explicit Neighbourhoods(ImageView<const std::uint8_t> map);

  // All set places of the beginning, in reading order.
  [[nodiscard]] const std::vector<std::int32_t>& places() const { return places_; }
  [[nodiscard]] std::size_t size() const { return set_.size(); }
  [[nodiscard]] bool is_set(std::int32_t place) const { return set_[index(place)] != 0; }
  [[nodiscard]] unsigned code(std::int32_t place) const { return codes_[index(place)]; }
  [[nodiscard]] std::int32_t neighbour(std::int32_t place, int k) const {
    return place + steps_[static_cast<std::size_t>(k)];
  }
  // Row of the map, 1 where set.
  [[nodiscard]] const std::uint8_t* row(int y) const {
    return set_.data() + index((y + 1) * stride_ + 1);
  }

  void remove(std::int32_t place) {
    set_[index(place)] = 0;
    for (int k = 0; k < kNeighbours; ++k) {
      codes_[index(neighbour(place, k))] &= static_cast<std::uint8_t>(~(1U << opposite(k)));
    }
  }

 private:
  static std::size_t index(std::int32_t place) { return static_cast<std::size_t>(place); }

  std::int32_t stride_;
  std::array<std::int32_t, kNeighbours> steps_;
  std::vector<std::uint8_t> set_;
  std::vector<std::uint8_t> codes_;
  std::vector<std::int32_t> places_;
};

}  // namespace thermedge::eval
