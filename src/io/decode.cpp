// Finds the kind of a picture by its first bytes.
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>

#include "io/codecs.hpp"
#include "io/files.hpp"
#include "io/kinds.hpp"

namespace thermedge::io {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::size_t at;
  std::string_view bytes;
  Kind kind;
};
constexpr std::array kMagics = {
    Magic{0, "\x89PNG\r\n\x1a\n"sv, Kind::kPng},
    Magic{0, "II*\0"sv, Kind::kTiff},
    Magic{0, "MM\0*"sv, Kind::kTiff},
    Magic{0, "II+\0"sv, Kind::kTiff},
    Magic{0, "MM\0+"sv, Kind::kTiff},
    Magic{0, "P5"sv, Kind::kPgm},
    Magic{0, "P2"sv, Kind::kPgm},
    Magic{0, "\x93NUMPY"sv, Kind::kNpy},
};

// Kinds that people try and that thermedge does not read.
struct Stranger {
  std::size_t at;
  std::string_view bytes;
  std::string_view name;
  bool video;
};
constexpr std::array kStrangers = {
    Stranger{0, "\xff\xd8\xff"sv, "a JPEG picture", false},
    Stranger{0, "BM"sv, "a BMP picture", false},
    Stranger{0, "GIF8"sv, "a GIF picture", false},
    Stranger{0, "P6"sv, "a colour PPM picture", false},
    Stranger{8, "AVI "sv, "an AVI video", true},
    Stranger{4, "ftyp"sv, "an MP4 or MOV video", true},
    Stranger{0, "\x1a\x45\xdf\xa3"sv, "a Matroska video", true},
    Stranger{0, "\x89HDF"sv, "an HDF5 file", false},
    Stranger{0, "PK\x03\x04"sv, "a ZIP or NPZ archive", false},
};

bool has(Bytes bytes, std::size_t at, std::string_view magic) {
  return bytes.size() >= at + magic.size() &&
         std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

Error unknown_kind(Bytes bytes, const std::string& name) {
  std::string message = name + ": ";
  for (const Stranger& stranger : kStrangers) {
    if (has(bytes, stranger.at, stranger.bytes)) {
      message += std::string(stranger.name) + "; ";
      if (stranger.video) {
        return {ErrorCode::kUnsupported,
                message +
                    "pipe it in: ffmpeg -i FILE -f rawvideo -pix_fmt gray16le - | "
                    "thermedge ... - --raw-size WxH"};
      }
      break;
    }
  }
  return {ErrorCode::kUnsupported,
          message + "not a picture that thermedge reads (PNG, TIFF, PGM, NPY; .raw by name)"};
}

template <class F>
auto guarded(const std::string& name, F&& decode) -> decltype(decode()) {
  try {
    return decode();
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, name + ": out of memory");
  }
}

}  // namespace

Kind kind_of(Bytes first_bytes) {
  for (const Magic& magic : kMagics) {
    if (has(first_bytes, magic.at, magic.bytes)) {
      return magic.kind;
    }
  }
  return Kind::kUnknown;
}

Status decode_picture(std::span<const std::byte> bytes, const std::string& name,
                      const Limits& limits, std::size_t page, Frame& frame) {
  return guarded(name, [&]() -> Status {
    const EncodedFile file{bytes, name, limits};
    switch (kind_of(bytes)) {
      case Kind::kPng:
        return decode_png(file, frame);
      case Kind::kTiff:
        return decode_tiff(file, page, frame);
      case Kind::kPgm:
        return decode_pgm(file, frame);
      case Kind::kNpy:
        return decode_npy(file, page, frame);
      case Kind::kUnknown:
        break;
    }
    return tl::unexpected(unknown_kind(bytes, name));
  });
}

Result<std::size_t> count_pages(std::span<const std::byte> bytes, const std::string& name,
                                const Limits& limits) {
  return guarded(name, [&]() -> Result<std::size_t> {
    const EncodedFile file{bytes, name, limits};
    switch (kind_of(bytes)) {
      case Kind::kTiff:
        return count_tiff_pages(file);
      case Kind::kNpy:
        return count_npy_pages(file);
      case Kind::kPng:
      case Kind::kPgm:
        return 1;
      case Kind::kUnknown:
        break;
    }
    return tl::unexpected(unknown_kind(bytes, name));
  });
}

Result<Frame> read_picture(const std::string& path, const Limits& limits) {
  return read_file(path, limits).and_then([&](const std::vector<std::byte>& bytes) {
    Frame frame;
    frame.source = path;
    frame.stem = stem_of(path);
    return decode_picture(bytes, path, limits, 0, frame).map([&] { return std::move(frame); });
  });
}

void unpack_samples(Bytes packed, int bits, bool big_endian, Frame& frame) {
  const std::byte* sample = packed.data();
  for (int y = 0; y < frame.counts.height(); ++y) {
    std::uint16_t* row = frame.counts.row(y);
    for (int x = 0; x < frame.counts.width(); ++x) {
      if (bits == 8) {
        row[x] = std::to_integer<std::uint16_t>(*sample++);
      } else {
        const auto first = std::to_integer<unsigned>(sample[0]);
        const auto second = std::to_integer<unsigned>(sample[1]);
        row[x] = static_cast<std::uint16_t>(big_endian ? first << 8 | second : second << 8 | first);
        sample += 2;
      }
    }
  }
}

std::string encode_raw(const Samples& samples) {
  std::string out;
  out.reserve(samples.packed_row_bytes() * static_cast<std::size_t>(samples.height));
  for (int y = 0; y < samples.height; ++y) {
    const auto* bytes = reinterpret_cast<const char*>(samples.row(y));
    if (samples.bits == 8 || std::endian::native == std::endian::little) {
      out.append(bytes, samples.packed_row_bytes());
    } else {
      for (std::size_t i = 0; i < samples.packed_row_bytes(); i += 2) {
        out += bytes[i + 1];
        out += bytes[i];
      }
    }
  }
  return out;
}

}  // namespace thermedge::io
