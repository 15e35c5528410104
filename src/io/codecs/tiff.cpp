#include <algorithm>
#include <array>
#include <cstring>

#include "codecs/codecs.hpp"
#include "codecs/tiff_memory.hpp"
#include "codecs/tiff_pages.hpp"

namespace thermedge::io {
namespace {

using Link = TiffPageChain::Link;

tl::unexpected<Error> damaged_tiff(const EncodedFile& file, const TiffMemory& memory) {
  return damaged(file, "TIFF", memory.error[0] != '\0' ? memory.error : "it cannot be read");
}

struct Header {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t bits = 1;
  bool min_is_white = false;
};

// The kind of a TIFF that is not read; empty where it is read.
std::string refusal(TIFF* tiff) {
  std::uint16_t channels = 1;
  std::uint16_t bits = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  std::uint16_t compression = COMPRESSION_NONE;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
  if (photometric != PHOTOMETRIC_MINISBLACK && photometric != PHOTOMETRIC_MINISWHITE) {
    return "a colour picture; frames have a single channel (grey)";
  }
  if (channels != 1) {
    return "a TIFF of " + std::to_string(channels) + " channels; frames have a single one (grey)";
  }
  const bool whole_numbers = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID;
  if (!whole_numbers || (bits != 8 && bits != 16)) {
    return "a TIFF of " + std::to_string(bits) + " bits" +
           (whole_numbers ? "" : ", not unsigned whole numbers") +
           "; frames have 8 or 16 unsigned bits";
  }
  constexpr std::array<std::uint16_t, 5> kRead = {COMPRESSION_NONE, COMPRESSION_LZW,
                                                  COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE,
                                                  COMPRESSION_PACKBITS};
  if (std::find(kRead.begin(), kRead.end(), compression) == kRead.end()) {
    return "a TIFF with compression " + std::to_string(compression) +
           "; none, LZW, deflate and PackBits are read";
  }
  return "";
}

Result<Header> read_header(TIFF* tiff, const EncodedFile& file) {
  if (const std::string reason = refusal(tiff); !reason.empty()) {
    return failure(ErrorCode::kUnsupported, file.name + ": " + reason);
  }
  Header header;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &header.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &header.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &header.bits);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  header.min_is_white = photometric == PHOTOMETRIC_MINISWHITE;
  return check_claim(file, header.width, header.height, header.bits / 8).map([&] {
    return header;
  });
}

void store_row(const std::byte* samples, const Header& header, std::size_t count,
               std::uint16_t* row) {
  const unsigned largest = header.bits == 8 ? 255 : 65535;
  for (std::size_t x = 0; x < count; ++x) {
    std::uint16_t value = 0;
    if (header.bits == 8) {
      value = std::to_integer<std::uint16_t>(samples[x]);
    } else {
      std::memcpy(&value, samples + 2 * x, 2);
    }
    row[x] = header.min_is_white ? static_cast<std::uint16_t>(largest - value) : value;
  }
}

bool read_strips(TIFF* tiff, const Header& header, ImageView<std::uint16_t> counts) {
  std::vector<std::byte> line(std::size_t{header.width} * (header.bits / 8));
  if (static_cast<std::size_t>(TIFFScanlineSize(tiff)) != line.size()) {
    return false;
  }
  for (int y = 0; y < counts.height(); ++y) {
    if (TIFFReadScanline(tiff, line.data(), static_cast<std::uint32_t>(y)) != 1) {
      return false;
    }
    store_row(line.data(), header, header.width, counts.row(y));
  }
  return true;
}

bool read_tiles(TIFF* tiff, const Header& header, const Limits& limits,
                ImageView<std::uint16_t> counts) {
  std::uint32_t tile_width = 0;
  std::uint32_t tile_height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &tile_width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &tile_height);
  const std::size_t row_bytes = std::size_t{tile_width} * (header.bits / 8);
  const auto tile_bytes = static_cast<std::uint64_t>(std::max<tmsize_t>(TIFFTileSize(tiff), 0));
  if (tile_bytes == 0 || tile_bytes > limits.max_bytes || tile_bytes != row_bytes * tile_height) {
    return false;
  }
  std::vector<std::byte> tile(tile_bytes);
  for (std::uint32_t y0 = 0; y0 < header.height; y0 += tile_height) {
    for (std::uint32_t x0 = 0; x0 < header.width; x0 += tile_width) {
      if (TIFFReadTile(tiff, tile.data(), x0, y0, 0, 0) < 0) {
        return false;
      }
      const std::size_t columns = std::min(tile_width, header.width - x0);
      for (std::uint32_t y = y0; y < header.height && y - y0 < tile_height; ++y) {
        store_row(tile.data() + (y - y0) * row_bytes, header, columns,
                  counts.row(static_cast<int>(y)) + x0);
      }
    }
  }
  return true;
}

Status decode_directory(const EncodedFile& file, std::uint64_t offset, SourceFrame& frame) {
  TiffMemory memory;
  memory.input = file.bytes;
  const TiffFile tiff = open_tiff(memory, "rh", file.limits.max_bytes);
  if (!tiff || TIFFSetSubDirectory(tiff.get(), offset) != 1) {
    return damaged_tiff(file, memory);
  }
  const auto header = read_header(tiff.get(), file);
  if (!header) {
    return tl::unexpected(header.error());
  }
  frame.bits = header->bits;
  frame.counts.resize(static_cast<int>(header->width), static_cast<int>(header->height));
  const bool good = TIFFIsTiled(tiff.get()) != 0
                        ? read_tiles(tiff.get(), *header, file.limits, frame.counts)
                        : read_strips(tiff.get(), *header, frame.counts);
  if (!good || memory.error[0] != '\0') {
    return damaged_tiff(file, memory);
  }
  return {};
}

}  // namespace

Result<std::size_t> count_tiff_pages(const EncodedFile& file) {
  TiffPageChain chain(file.bytes);
  for (std::size_t pages = 0;; ++pages) {
    switch (chain.next()) {
      case Link::kPage:
        break;
      case Link::kEnd:
        return pages > 0 ? Result<std::size_t>(pages) : damaged(file, "TIFF", "it has no pages");
      case Link::kOutside:
        return pages + 1;  // where reading it says what is wrong, after the good ones
      case Link::kCircle:
        return damaged(file, "TIFF", "its pages follow each other in a circle");
    }
  }
}

Status decode_tiff(const EncodedFile& file, std::size_t page, SourceFrame& frame) {
  TiffPageChain chain(file.bytes);
  for (std::size_t before = 0;; ++before) {
    switch (chain.next()) {
      case Link::kPage:
        if (before == page) {
          return decode_directory(file, chain.offset(), frame);
        }
        break;
      case Link::kEnd:
        return no_such_page(file, page);
      case Link::kOutside:
        return damaged(file, "TIFF",
                       "page " + std::to_string(before) + " lies past the end of the file");
      case Link::kCircle:
        return damaged(file, "TIFF", "its pages follow each other in a circle");
    }
  }
}

Result<std::string> encode_tiff(const Samples& samples, const std::string& name) {
  TiffMemory memory;
  constexpr std::uint64_t kNoBound = 0;
  TiffFile tiff = open_tiff(memory, "w", kNoBound);
  bool good = tiff != nullptr;
  if (good) {
    TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, samples.width);
    TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, samples.height);
    TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, samples.bits);
    TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, samples.channels);
    TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff.get(), 0));
    std::vector<std::byte> line(samples.packed_row_bytes());
    for (int y = 0; y < samples.height && good; ++y) {
      // A copy, because the predictor works in place.
      std::copy_n(samples.row(y), line.size(), line.begin());
      good = TIFFWriteScanline(tiff.get(), line.data(), static_cast<std::uint32_t>(y)) == 1;
    }
    good = good && TIFFFlush(tiff.get()) == 1;
  }
  tiff.reset();
  if (!good || memory.error[0] != '\0') {
    return failure(ErrorCode::kOutOfMemory, name + ": TIFF cannot be written: " + memory.error);
  }
  return std::move(memory.output);
}

}  // namespace thermedge::io
