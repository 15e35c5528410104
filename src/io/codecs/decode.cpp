// Hands a picture to the decoder of its kind, and what decoders share.
#include <algorithm>
#include <iterator>
#include <utility>

#include "codecs/codecs.hpp"
#include "codecs/file_format.hpp"
#include "codecs/picture_reader.hpp"
#include "codecs/samples.hpp"
#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/io/files.hpp"

namespace thermedge::io {

OpenedPicture open_picture(const EncodedFile& file) {
  switch (format_of(file.bytes)) {
    case FileFormat::kPng:
      return open_png(file);
    case FileFormat::kPgm:
      return open_pgm(file);
    case FileFormat::kTiff:
      return open_tiff(file);
    case FileFormat::kNpy:
      return open_npy(file);
    case FileFormat::kFff:
      return open_fff(file);
    case FileFormat::kJpeg:
      return open_jpeg(file);
    case FileFormat::kUnknown:
      break;
  }
  return tl::unexpected(unknown_format(file.bytes, file.name));
}

Status decode_picture(std::span<const std::byte> bytes, const std::string& name,
                      const Limits& limits, std::size_t page, SourceFrame& frame) {
  return catch_bad_alloc(name, [&]() -> Status {
    const EncodedFile file{bytes, name, limits};
    return open_picture(file).and_then([&](const std::unique_ptr<PictureReader>& reader) {
      return page < reader->pages() ? reader->read(page, name, frame)
                                    : Status(no_such_page(file, page));
    });
  });
}

Result<std::size_t> count_pages(std::span<const std::byte> bytes, const std::string& name,
                                const Limits& limits) {
  return catch_bad_alloc(name, [&] {
    return open_picture({bytes, name, limits})
        .map([](const std::unique_ptr<PictureReader>& reader) { return reader->pages(); });
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

tl::unexpected<Error> left_over(const EncodedFile& file, std::size_t bytes, std::string_view what) {
  return failure(ErrorCode::kBadData, file.name + ": " + std::to_string(bytes) +
                                          (bytes == 1 ? " byte is" : " bytes are") +
                                          " left over after " + std::string(what));
}

tl::unexpected<Error> no_such_page(const EncodedFile& file, std::size_t page) {
  return failure(ErrorCode::kInvalidArgument,
                 file.name + ": has no page " + std::to_string(page) + " (the first is 0)");
}

void append_samples(const Samples& samples, ByteOrder order, std::string& out) {
  const bool as_it_lies = samples.bits == 8 || order == kNativeOrder;
  const auto sample_bytes = static_cast<std::size_t>(samples.bits) / 8;
  const std::size_t row_bytes = samples.packed_row_bytes();
  out.reserve(out.size() + row_bytes * static_cast<std::size_t>(samples.height));
  for (int y = 0; y < samples.height; ++y) {
    const auto* bytes = reinterpret_cast<const char*>(samples.row(y));
    if (as_it_lies) {
      out.append(bytes, row_bytes);
    } else {
      for (std::size_t i = 0; i < row_bytes; i += sample_bytes) {
        out.append(std::make_reverse_iterator(bytes + i + sample_bytes),
                   std::make_reverse_iterator(bytes + i));
      }
    }
  }
}

}  // namespace thermedge::io
