#include "codecs/file_format.hpp"

#include <array>
#include <cstring>
#include <string_view>

namespace thermedge::io {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  FileFormat kind;
};
constexpr std::array kMagics = {
    Magic{"\x89PNG\r\n\x1a\n"sv, FileFormat::kPng},
    Magic{"II*\0"sv, FileFormat::kTiff},
    Magic{"MM\0*"sv, FileFormat::kTiff},
    Magic{"II+\0"sv, FileFormat::kTiff},
    Magic{"MM\0+"sv, FileFormat::kTiff},
    Magic{"\x93NUMPY"sv, FileFormat::kNpy},
    Magic{"FFF\0"sv, FileFormat::kFff},
    Magic{"AFF\0"sv, FileFormat::kFff},
    Magic{"\xff\xd8\xff"sv, FileFormat::kJpeg},
};

constexpr std::string_view kPipeVideo =
    "pipe it in: ffmpeg -i FILE -f rawvideo -pix_fmt gray16le - | thermedge ... - --raw-size WxH";
constexpr std::string_view kWhatIsRead =
    "not a picture that thermedge reads (PNG, TIFF, PGM, NPY, FLIR JPEG, FFF and SEQ); frames "
    "without "
    "a header need --raw-size WxH";

// Kinds that people try and that thermedge does not read.
struct UnsupportedFormat {
  std::size_t at;
  std::string_view bytes;
  std::string_view name;
  std::string_view advice = kWhatIsRead;
};
constexpr std::array kUnsupportedFormats = {
    UnsupportedFormat{0, "BM"sv, "a BMP picture"},
    UnsupportedFormat{0, "GIF8"sv, "a GIF picture"},
    UnsupportedFormat{8, "WEBP"sv, "a WebP picture"},
    UnsupportedFormat{0, "P6"sv, "a colour PPM picture"},
    UnsupportedFormat{8, "AVI "sv, "an AVI video", kPipeVideo},
    UnsupportedFormat{4, "ftyp"sv, "an MP4 or MOV video", kPipeVideo},
    UnsupportedFormat{0, "\x1a\x45\xdf\xa3"sv, "a Matroska or WebM video", kPipeVideo},
    UnsupportedFormat{0, "\x89HDF"sv, "an HDF5 file"},
    UnsupportedFormat{0, "PK\x03\x04"sv, "a ZIP or NPZ archive"},
};

bool has(std::span<const std::byte> bytes, std::size_t at, std::string_view magic) {
  return bytes.size() >= at + magic.size() &&
         std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

// "P5" and "P2" are too short to be a proof; white space or a comment follows.
bool is_pgm(std::span<const std::byte> bytes) {
  constexpr std::string_view kFollows = " \t\r\n\v\f#";
  return (has(bytes, 0, "P5") || has(bytes, 0, "P2")) && bytes.size() > 2 &&
         kFollows.find(static_cast<char>(bytes[2])) != std::string_view::npos;
}

}  // namespace

FileFormat format_of(std::span<const std::byte> first_bytes) {
  for (const Magic& magic : kMagics) {
    if (has(first_bytes, 0, magic.bytes)) {
      return magic.kind;
    }
  }
  return is_pgm(first_bytes) ? FileFormat::kPgm : FileFormat::kUnknown;
}

Error unknown_format(std::span<const std::byte> first_bytes, const std::string& name) {
  if (first_bytes.empty()) {
    return {ErrorCode::kBadData, name + ": the file is empty"};
  }
  for (const UnsupportedFormat& format : kUnsupportedFormats) {
    if (has(first_bytes, format.at, format.bytes)) {
      return {ErrorCode::kUnsupported,
              name + ": " + std::string(format.name) + "; " + std::string(format.advice)};
    }
  }
  return {ErrorCode::kUnsupported, name + ": " + std::string(kWhatIsRead)};
}

}  // namespace thermedge::io
