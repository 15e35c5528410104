// Numbers among bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

#include "codecs/codecs.hpp"

namespace thermedge::io {

// Reads numbers from bytes of either order. Nothing where they lie outside.
class NumberReader {
 public:
  NumberReader(Bytes bytes, ByteOrder order) : bytes_(bytes), order_(order) {}

  [[nodiscard]] std::optional<std::uint32_t> u16(std::size_t at) const {
    return narrow(number(at, 2));
  }
  [[nodiscard]] std::optional<std::uint32_t> u32(std::size_t at) const {
    return narrow(number(at, 4));
  }
  [[nodiscard]] std::optional<double> f32(std::size_t at) const {
    const auto bits = u32(at);
    if (!bits) {
      return std::nullopt;
    }
    float value = 0;
    std::memcpy(&value, &*bits, sizeof(value));
    return static_cast<double>(value);
  }
  // A whole number without sign of up to 8 bytes.
  [[nodiscard]] std::optional<std::uint64_t> number(std::uint64_t at, std::size_t bytes) const {
    if (at > bytes_.size() || bytes_.size() - at < bytes) {
      return std::nullopt;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      const std::size_t place = order_ == ByteOrder::kBig ? i : bytes - 1 - i;
      value = value << 8 | std::to_integer<std::uint64_t>(bytes_[at + place]);
    }
    return value;
  }

 private:
  [[nodiscard]] static std::optional<std::uint32_t> narrow(std::optional<std::uint64_t> value) {
    return value ? std::optional(static_cast<std::uint32_t>(*value)) : std::nullopt;
  }

  Bytes bytes_;
  ByteOrder order_;
};

}  // namespace thermedge::io
