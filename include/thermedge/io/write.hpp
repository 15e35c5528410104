// Writes files whole or not at all: beside the target first, then renamed over it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "thermedge/image.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

// Errors name the path and the system's reason. An existing file stays as it was on failure, and
// nobody sees half of a new one. Devices and pipes are written to as they are. Thread-safe.
[[nodiscard]] Status write_file(const std::string& path, std::string_view bytes);

// Grey of 8 or 16 bits in the format that the ending of `path` names: .png, .tif/.tiff (deflate),
// .pgm, .npy, .raw (little endian). Other endings: an error that lists these.
[[nodiscard]] Status write_picture(const std::string& path, ImageView<const std::uint8_t> picture);
[[nodiscard]] Status write_picture(const std::string& path, ImageView<const std::uint16_t> picture);

// Float values: .tif/.tiff, .npy, .raw.
[[nodiscard]] Status write_picture(const std::string& path, ImageView<const float> picture);

// Colour, PNG only.
[[nodiscard]] Status write_picture(const std::string& path, ImageView<const Rgb> picture);

}  // namespace thermedge::io
