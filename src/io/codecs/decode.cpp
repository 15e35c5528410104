// Hands a picture to the decoder of its kind.
#include <algorithm>
#include <bit>
#include <utility>

#include "codecs/codecs.hpp"
#include "codecs/file_format.hpp"
#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/io/files.hpp"

namespace thermedge::io {

Status decode_picture(std::span<const std::byte> bytes, const std::string& name,
                      const Limits& limits, std::size_t page, SourceFrame& frame) {
  return catch_bad_alloc(name, [&]() -> Status {
    const EncodedFile file{bytes, name, limits};
    switch (format_of(bytes)) {
      case FileFormat::kPng:
        return page == 0 ? decode_png(file, frame) : no_such_page(file, page);
      case FileFormat::kPgm:
        return page == 0 ? decode_pgm(file, frame) : no_such_page(file, page);
      case FileFormat::kTiff:
        return decode_tiff(file, page, frame);
      case FileFormat::kNpy:
        return decode_npy(file, page, frame);
      case FileFormat::kUnknown:
        break;
    }
    return tl::unexpected(unknown_format(bytes, name));
  });
}

Result<std::size_t> count_pages(std::span<const std::byte> bytes, const std::string& name,
                                const Limits& limits) {
  return catch_bad_alloc(name, [&]() -> Result<std::size_t> {
    const EncodedFile file{bytes, name, limits};
    switch (format_of(bytes)) {
      case FileFormat::kTiff:
        return count_tiff_pages(file);
      case FileFormat::kNpy:
        return count_npy_pages(file);
      case FileFormat::kPng:
      case FileFormat::kPgm:
        return 1;
      case FileFormat::kUnknown:
        break;
    }
    return tl::unexpected(unknown_format(bytes, name));
  });
}

Result<SourceFrame> read_picture(const std::string& path, const Limits& limits) {
  return catch_bad_alloc(path, [&] {
    return read_file(path, limits).and_then([&](const std::vector<std::byte>& bytes) {
      SourceFrame frame;
      frame.source = path;
      frame.stem = stem_of(path);
      return decode_picture(bytes, path, limits, 0, frame).map([&] { return std::move(frame); });
    });
  });
}

Status check_claim(const EncodedFile& file, std::uint64_t width, std::uint64_t height,
                   std::uint64_t bytes_per_pixel) {
  constexpr std::uint64_t kCountBytes = 2;
  // No compression that is read here packs more bytes into one: deflate 1032, LZW 2730.
  constexpr std::uint64_t kMostPacked = 4096;
  return check_limits(file.limits, file.name, width, height, std::max(bytes_per_pixel, kCountBytes))
      .and_then([&]() -> Status {
        const std::uint64_t least_bytes = width * height / 8;  // a pixel has at least one bit
        if (least_bytes > file.bytes.size() * kMostPacked) {
          return failure(ErrorCode::kBadData, file.name + ": the file is too short for " +
                                                  std::to_string(width) + "x" +
                                                  std::to_string(height) + " pixels");
        }
        return {};
      });
}

std::string printable(std::string_view text) {
  std::string result(text);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

tl::unexpected<Error> damaged(const EncodedFile& file, std::string_view format,
                              std::string_view what) {
  return failure(ErrorCode::kBadData,
                 file.name + ": damaged " + std::string(format) + ": " + printable(what));
}

tl::unexpected<Error> no_such_page(const EncodedFile& file, std::size_t page) {
  return failure(ErrorCode::kInvalidArgument,
                 file.name + ": has no page " + std::to_string(page) + " (the first is 0)");
}

void unpack_samples(Bytes packed, int bits, ByteOrder order, SourceFrame& frame) {
  const std::byte* sample = packed.data();
  for (int y = 0; y < frame.counts.height(); ++y) {
    std::uint16_t* row = frame.counts.row(y);
    for (int x = 0; x < frame.counts.width(); ++x) {
      if (bits == 8) {
        row[x] = std::to_integer<std::uint16_t>(*sample++);
      } else {
        const auto first = std::to_integer<unsigned>(sample[0]);
        const auto second = std::to_integer<unsigned>(sample[1]);
        row[x] = static_cast<std::uint16_t>(order == ByteOrder::kBig ? first << 8 | second
                                                                     : second << 8 | first);
        sample += 2;
      }
    }
  }
}

void append_samples(const Samples& samples, ByteOrder order, std::string& out) {
  const bool native_is_big = std::endian::native == std::endian::big;
  const bool as_it_lies = samples.bits == 8 || native_is_big == (order == ByteOrder::kBig);
  const std::size_t row_bytes = samples.packed_row_bytes();
  out.reserve(out.size() + row_bytes * static_cast<std::size_t>(samples.height));
  for (int y = 0; y < samples.height; ++y) {
    const auto* bytes = reinterpret_cast<const char*>(samples.row(y));
    if (as_it_lies) {
      out.append(bytes, row_bytes);
    } else {
      for (std::size_t i = 0; i < row_bytes; i += 2) {
        out += bytes[i + 1];
        out += bytes[i];
      }
    }
  }
}

}  // namespace thermedge::io
