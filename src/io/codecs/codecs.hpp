// What the picture formats share: encoded files, messages about them, and the encoders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/limits.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

using Bytes = std::span<const std::byte>;

// The input of a decoder: the bytes, the name for messages, the bounds, and how samples of more
// than one byte are read.
struct EncodedFile {
  Bytes bytes;
  const std::string& name;
  const Limits& limits;
  SampleOrder order = SampleOrder::kAsFormat;
};

// Checks what a header claims: the size against the limits, for pixels that take
// `bytes_per_pixel` on the way to counts, and that a file of so few bytes can hold it.
[[nodiscard]] Status check_claim(const EncodedFile& file, std::uint64_t width, std::uint64_t height,
                                 std::uint64_t bytes_per_pixel);

// Words out of a file, fit for a message: one line, and no commands to a terminal.
[[nodiscard]] std::string printable(std::string_view text);

// "NAME: N bytes are left over after WHAT": no picture, and nothing else that is known.
[[nodiscard]] tl::unexpected<Error> left_over(const EncodedFile& file, std::size_t bytes,
                                              std::string_view what);

// "NAME: damaged FORMAT: what", of which `what` may come from the file.
[[nodiscard]] tl::unexpected<Error> damaged(const EncodedFile& file, std::string_view format,
                                            std::string_view what);
[[nodiscard]] tl::unexpected<Error> no_such_page(const EncodedFile& file, std::size_t page);

// A picture to encode: rows of `channels` samples of `bits` bits in native byte order: whole
// numbers of 8 or 16 bits, or floats of 32.
struct Samples {
  const void* data = nullptr;
  std::size_t row_bytes = 0;  // distance between rows in memory
  int width = 0;
  int height = 0;
  int bits = 8;
  int channels = 1;

  [[nodiscard]] const std::byte* row(int y) const {
    return static_cast<const std::byte*>(data) + static_cast<std::size_t>(y) * row_bytes;
  }
  [[nodiscard]] std::size_t packed_row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels * bits / 8);
  }
};

// Encoders give the whole file. `name` is for messages.
[[nodiscard]] Result<std::string> encode_png(const Samples& samples, const std::string& name);
[[nodiscard]] Result<std::string> encode_tiff(const Samples& samples, const std::string& name);
[[nodiscard]] std::string encode_pgm(const Samples& samples);
[[nodiscard]] std::string encode_npy(const Samples& samples);

enum class ByteOrder : std::uint8_t { kLittle, kBig };

// Packed samples in the byte order of a file.
void append_samples(const Samples& samples, ByteOrder order, std::string& out);

}  // namespace thermedge::io
