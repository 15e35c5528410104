// The picture formats, one decoder and one encoder each, on bytes in memory.
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

// The input of a decoder: the bytes, the name for messages, the bounds.
struct EncodedFile {
  Bytes bytes;
  const std::string& name;
  const Limits& limits;
};

// Decoders check the size against the limits before they allocate and fill `counts` and `bits` of
// the frame. A file that ends early, or whose checksums do not match, is an error.
[[nodiscard]] Status decode_png(const EncodedFile& file, SourceFrame& frame);
[[nodiscard]] Status decode_pgm(const EncodedFile& file, SourceFrame& frame);
[[nodiscard]] Status decode_tiff(const EncodedFile& file, std::size_t page, SourceFrame& frame);
[[nodiscard]] Status decode_npy(const EncodedFile& file, std::size_t page, SourceFrame& frame);
[[nodiscard]] Result<std::size_t> count_tiff_pages(const EncodedFile& file);
[[nodiscard]] Result<std::size_t> count_npy_pages(const EncodedFile& file);

// Checks what a header claims: the size against the limits, for pixels that take
// `bytes_per_pixel` on the way to counts, and that a file of so few bytes can hold it.
[[nodiscard]] Status check_claim(const EncodedFile& file, std::uint64_t width, std::uint64_t height,
                                 std::uint64_t bytes_per_pixel);

// Words out of a file, fit for a message: one line, and no commands to a terminal.
[[nodiscard]] std::string printable(std::string_view text);

// "NAME: damaged FORMAT: what", of which `what` may come from the file.
[[nodiscard]] tl::unexpected<Error> damaged(const EncodedFile& file, std::string_view format,
                                            std::string_view what);
[[nodiscard]] tl::unexpected<Error> no_such_page(const EncodedFile& file, std::size_t page);

// A picture to encode: rows of `channels` samples of `bits` bits (8 or 16, native byte order).
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

enum class ByteOrder { kLittle, kBig };

// Packed samples of 8 or 16 bits to and from the byte order of a file.
void unpack_samples(Bytes packed, int bits, ByteOrder order, SourceFrame& frame);
void append_samples(const Samples& samples, ByteOrder order, std::string& out);

}  // namespace thermedge::io
