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

// Errors name the path and the system's reason. An existing file stays as it was on failure.
[[nodiscard]] Status write_file(const std::string& path, std::string_view bytes);

// Grey 8 or 16 bit by the ending of `path`: .png, .tif/.tiff (deflate), .pgm, .npy, .raw (little
// endian). Other endings: an error that lists these.
[[nodiscard]] Status write_picture(const std::string& path, ImageView<const std::uint8_t> picture);
[[nodiscard]] Status write_picture(const std::string& path, ImageView<const std::uint16_t> picture);

// Colour, PNG only.
[[nodiscard]] Status write_picture(const std::string& path, ImageView<const Rgb> picture);

}  // namespace thermedge::io
