#include "codecs/tiff_directory.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "codecs/tiff_memory.hpp"

namespace thermedge::io {
namespace {

tl::unexpected<Error> damaged_tiff(const EncodedFile& file, const TiffMemory& memory) {
  return damaged(file, "TIFF", memory.error[0] != '\0' ? memory.error : "it cannot be read");
}

struct Header {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t channels = 1;
  std::uint16_t colours = 1;  // channels without alpha
  std::uint16_t kind = SAMPLEFORMAT_UINT;
  std::uint16_t bits = 1;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  std::uint16_t compression = COMPRESSION_NONE;
  bool are_planes = false;  // the channels lie one after the other
  SampleFormat samples;

  [[nodiscard]] std::size_t pixel_bytes() const { return channels * samples.bytes(); }
  // Of what lies together: all channels of a pixel, or a single one.
  [[nodiscard]] std::size_t group_bytes() const {
    return are_planes ? samples.bytes() : pixel_bytes();
  }
  [[nodiscard]] std::uint16_t planes() const { return are_planes ? channels : 1; }
};

Header read_tags(TIFF* tiff) {
  Header header;
  std::uint16_t planes = PLANARCONFIG_CONTIG;
  std::uint16_t extra_count = 0;
  const std::uint16_t* extra = nullptr;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &header.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &header.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &header.channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &header.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &header.kind);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &header.photometric);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &header.compression);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planes);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extra);
  header.are_planes = planes == PLANARCONFIG_SEPARATE && header.channels > 1;
  header.colours = header.channels;
  for (std::uint16_t i = 0; i < extra_count && header.colours > 1; ++i) {
    header.colours -= extra[i] == EXTRASAMPLE_UNSPECIFIED ? 0 : 1;
  }
  return header;
}

// The kind of a page that is not read; empty where it is read. Sets how its samples are read.
std::string refusal(Header& header) {
  constexpr std::uint16_t kMostChannels = 4;
  constexpr std::uint16_t kRgb = 3;
  const bool is_rgb = header.photometric == PHOTOMETRIC_RGB && header.colours >= kRgb;
  if (header.photometric > PHOTOMETRIC_MINISBLACK && !is_rgb) {
    return "a colour picture; frames have a single channel (grey)";
  }
  if (header.channels > kMostChannels || (header.colours != 1 && header.colours != kRgb)) {
    return "a TIFF page of " + std::to_string(header.channels) +
           " channels; frames have a single one (grey)";
  }
  const auto samples = sample_format(header.kind, header.bits);
  if (!samples) {
    return "a TIFF page of " + std::to_string(header.bits) +
           " bits; frames are whole numbers of 8, 16 or 32 bits or floats of 16, 32 or 64";
  }
  header.samples = *samples;
  constexpr std::array<std::uint16_t, 5> kRead = {COMPRESSION_NONE, COMPRESSION_LZW,
                                                  COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE,
                                                  COMPRESSION_PACKBITS};
  if (std::find(kRead.begin(), kRead.end(), header.compression) == kRead.end()) {
    return "a TIFF page with compression " + std::to_string(header.compression) +
           "; none, LZW, deflate and PackBits are read";
  }
  return "";
}

// All samples of a page, plane after plane, row after row.
using Pixels = std::vector<std::byte>;

bool read_strips(TIFF* tiff, const Header& header, Pixels& pixels) {
  const std::size_t row_bytes = header.width * header.group_bytes();
  if (static_cast<std::size_t>(TIFFScanlineSize(tiff)) != row_bytes) {
    return false;
  }
  std::byte* row = pixels.data();
  for (std::uint16_t plane = 0; plane < header.planes(); ++plane) {
    for (std::uint32_t y = 0; y < header.height; ++y, row += row_bytes) {
      if (TIFFReadScanline(tiff, row, y, plane) != 1) {
        return false;
      }
    }
  }
  return true;
}

bool read_tiles(TIFF* tiff, const Header& header, const Limits& limits, Pixels& pixels) {
  std::uint32_t tile_width = 0;
  std::uint32_t tile_height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &tile_width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &tile_height);
  const std::size_t group = header.group_bytes();
  const std::size_t row_bytes = tile_width * group;
  const auto tile_bytes = static_cast<std::uint64_t>(std::max<tmsize_t>(TIFFTileSize(tiff), 0));
  if (tile_bytes == 0 || tile_bytes > limits.max_bytes || tile_bytes != row_bytes * tile_height) {
    return false;
  }
  Pixels tile(tile_bytes);
  for (std::uint16_t plane = 0; plane < header.planes(); ++plane) {
    for (std::uint32_t y0 = 0; y0 < header.height; y0 += tile_height) {
      for (std::uint32_t x0 = 0; x0 < header.width; x0 += tile_width) {
        if (TIFFReadTile(tiff, tile.data(), x0, y0, 0, plane) < 0) {
          return false;
        }
        const std::size_t columns = std::min(tile_width, header.width - x0);
        for (std::uint32_t y = y0; y < header.height && y - y0 < tile_height; ++y) {
          const std::size_t row = std::size_t{plane} * header.height + y;
          std::memcpy(pixels.data() + (row * header.width + x0) * group,
                      tile.data() + (y - y0) * row_bytes, columns * group);
        }
      }
    }
  }
  return true;
}

// Whether all colours of all pixels are the same.
bool is_grey(const Header& header, const Pixels& pixels) {
  const std::size_t bytes = header.samples.bytes();
  const std::size_t count = std::size_t{header.width} * header.height;
  const std::size_t to_next_pixel = header.group_bytes();
  const std::size_t to_next_colour = header.are_planes ? count * bytes : bytes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::byte* first = pixels.data() + i * to_next_pixel;
    for (std::size_t c = 1; c < header.colours; ++c) {
      if (std::memcmp(first, first + c * to_next_colour, bytes) != 0) {
        return false;
      }
    }
  }
  return true;
}

Status store(const EncodedFile& file, const Header& header, const Pixels& pixels, bool is_swapped,
             SourceFrame& frame) {
  const bool is_inverted = header.photometric == PHOTOMETRIC_MINISWHITE;
  SampleStore store(header.samples, is_swapped ? other_order(kNativeOrder) : kNativeOrder,
                    static_cast<int>(header.width), static_cast<int>(header.height), is_inverted,
                    frame);
  const std::size_t step = header.group_bytes();
  for (std::size_t y = 0; y < header.height; ++y) {
    store.put(0, static_cast<int>(y), pixels.data() + y * header.width * step, header.width, step);
  }
  return store.finish(file);
}

}  // namespace

std::optional<SampleFormat> sample_format(std::uint64_t kind, std::uint64_t bits) {
  const bool is_whole = bits == 8 || bits == 16 || bits == 32;
  if ((kind == SAMPLEFORMAT_UINT || kind == SAMPLEFORMAT_VOID) && is_whole) {
    return SampleFormat{SampleKind::kUnsigned, static_cast<int>(bits)};
  }
  if (kind == SAMPLEFORMAT_INT && is_whole) {
    return SampleFormat{SampleKind::kSigned, static_cast<int>(bits)};
  }
  if (kind == SAMPLEFORMAT_IEEEFP && (bits == 16 || bits == 32 || bits == 64)) {
    return SampleFormat{SampleKind::kFloat, static_cast<int>(bits)};
  }
  return std::nullopt;
}

Status decode_tiff_directory(const EncodedFile& file, std::uint64_t offset, ByteOrder order,
                             SourceFrame& frame) {
  TiffMemory memory;
  memory.input = file.bytes;
  const TiffFile tiff = open_tiff(memory, "rh", file.limits.max_bytes);
  if (!tiff || TIFFSetSubDirectory(tiff.get(), offset) != 1) {
    return damaged_tiff(file, memory);
  }
  Header header = read_tags(tiff.get());
  if (const std::string reason = refusal(header); !reason.empty()) {
    return failure(ErrorCode::kUnsupported, file.name + ": " + reason);
  }
  return check_claim(file, header.width, header.height,
                     std::max(header.pixel_bytes(), header.samples.frame_bytes()))
      .and_then([&]() -> Status {
        Pixels pixels(std::size_t{header.width} * header.height * header.pixel_bytes());
        const bool is_good = TIFFIsTiled(tiff.get()) != 0
                                 ? read_tiles(tiff.get(), header, file.limits, pixels)
                                 : read_strips(tiff.get(), header, pixels);
        if (!is_good || memory.error[0] != '\0') {
          return damaged_tiff(file, memory);
        }
        if (!is_grey(header, pixels)) {
          return failure(ErrorCode::kUnsupported,
                         file.name + ": a colour picture; frames have a single channel (grey)");
        }
        return store(file, header, pixels, chosen_order(file.order, order) != order, frame);
      });
}

}  // namespace thermedge::io
