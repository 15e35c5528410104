#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

#include "io/codecs.hpp"

namespace thermedge::io {
namespace {

// What libtiff reads from or writes to, and the first error that it reports.
struct Memory {
  Bytes input;
  std::vector<char> output;
  std::uint64_t at = 0;
  std::string error;
};

tmsize_t read_bytes(thandle_t handle, void* out, tmsize_t count) {
  auto* memory = static_cast<Memory*>(handle);
  const std::uint64_t size = memory->input.size();
  const auto left = static_cast<tmsize_t>(size - std::min(memory->at, size));
  const tmsize_t taken = std::min(count, left);
  if (taken > 0) {
    std::memcpy(out, memory->input.data() + memory->at, static_cast<std::size_t>(taken));
    memory->at += static_cast<std::uint64_t>(taken);
  }
  return taken;
}

tmsize_t write_bytes(thandle_t handle, void* bytes, tmsize_t count) {
  auto* memory = static_cast<Memory*>(handle);
  const auto length = static_cast<std::size_t>(count);
  memory->output.resize(std::max<std::size_t>(memory->output.size(), memory->at + length));
  std::memcpy(memory->output.data() + memory->at, bytes, length);
  memory->at += length;
  return count;
}

toff_t size_of(thandle_t handle) {
  const auto* memory = static_cast<Memory*>(handle);
  return std::max<toff_t>(memory->input.size(), memory->output.size());
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  auto* memory = static_cast<Memory*>(handle);
  memory->at = whence == SEEK_SET   ? offset
               : whence == SEEK_CUR ? memory->at + offset
                                    : size_of(handle) + offset;
  return memory->at;
}

int close_nothing(thandle_t) { return 0; }

int on_error(TIFF*, void* user, const char*, const char* format, std::va_list arguments) {
  auto* memory = static_cast<Memory*>(user);
  if (memory->error.empty()) {
    char text[256];
    std::vsnprintf(text, sizeof(text), format, arguments);
    memory->error = text;
    std::replace(memory->error.begin(), memory->error.end(), '\n', ' ');
  }
  return 1;
}

int on_warning(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

struct TiffCloser {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffFile = std::unique_ptr<TIFF, TiffCloser>;

TiffFile open_tiff(Memory& memory, const char* mode, std::uint64_t max_bytes) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  if (options == nullptr) {
    memory.error = "out of memory";
    return nullptr;
  }
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, static_cast<tmsize_t>(max_bytes));
  TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, &memory);
  TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, &memory);
  TIFF* tiff = TIFFClientOpenExt("", mode, &memory, read_bytes, write_bytes, seek, close_nothing,
                                 size_of, nullptr, nullptr, options);
  TIFFOpenOptionsFree(options);
  return TiffFile(tiff);
}

tl::unexpected<Error> damaged(const EncodedFile& file, const Memory& memory) {
  return failure(
      ErrorCode::kBadData,
      file.name + ": damaged TIFF: " + (memory.error.empty() ? "it cannot be read" : memory.error));
}

struct Header {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t bits = 1;
  bool min_is_white = false;
};

Result<Header> read_header(TIFF* tiff, const EncodedFile& file) {
  Header header;
  std::uint16_t channels = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &header.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &header.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &header.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  const bool grey = photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE;
  if (!grey || channels != 1 || (header.bits != 8 && header.bits != 16) ||
      (format != SAMPLEFORMAT_UINT && format != SAMPLEFORMAT_VOID)) {
    return failure(ErrorCode::kUnsupported,
                   file.name + ": a TIFF of " + std::to_string(channels) + " channel(s) of " +
                       std::to_string(header.bits) + " bits" +
                       (format == SAMPLEFORMAT_UINT ? "" : ", not unsigned integers") +
                       "; frames have one channel of 8 or 16 unsigned bits");
  }
  header.min_is_white = photometric == PHOTOMETRIC_MINISWHITE;
  return check_limits(file.limits, file.name, header.width, header.height, 2).map([&] {
    return header;
  });
}

void store_row(const std::byte* samples, const Header& header, std::size_t count,
               std::uint16_t* row) {
  const auto largest = static_cast<std::uint16_t>(header.bits == 8 ? 255 : 65535);
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
  std::vector<std::byte> line(static_cast<std::size_t>(TIFFScanlineSize(tiff)));
  if (line.size() < static_cast<std::size_t>(counts.width()) * (header.bits / 8)) {
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
  const std::size_t pixel_bytes = header.bits / 8;
  const std::uint64_t tile_bytes = std::uint64_t{tile_width} * tile_height * pixel_bytes;
  if (tile_bytes == 0 || tile_bytes > limits.max_bytes ||
      static_cast<std::uint64_t>(TIFFTileSize(tiff)) != tile_bytes) {
    return false;
  }
  std::vector<std::byte> tile(tile_bytes);
  for (std::uint32_t y0 = 0; y0 < header.height; y0 += tile_height) {
    for (std::uint32_t x0 = 0; x0 < header.width; x0 += tile_width) {
      if (TIFFReadTile(tiff, tile.data(), x0, y0, 0, 0) < 0) {
        return false;
      }
      const std::size_t columns = std::min(tile_width, header.width - x0);
      for (std::uint32_t y = y0; y < std::min(y0 + tile_height, header.height); ++y) {
        store_row(tile.data() + std::size_t{y - y0} * tile_width * pixel_bytes, header, columns,
                  counts.row(static_cast<int>(y)) + x0);
      }
    }
  }
  return true;
}

}  // namespace

Result<std::size_t> count_tiff_pages(const EncodedFile& file) {
  Memory memory;
  memory.input = file.bytes;
  const TiffFile tiff = open_tiff(memory, "r", file.limits.max_bytes);
  const std::size_t pages = tiff ? TIFFNumberOfDirectories(tiff.get()) : 0;
  if (pages == 0 || !memory.error.empty()) {
    return damaged(file, memory);
  }
  return pages;
}

Status decode_tiff(const EncodedFile& file, std::size_t page, Frame& frame) {
  Memory memory;
  memory.input = file.bytes;
  const TiffFile tiff = open_tiff(memory, "r", file.limits.max_bytes);
  if (!tiff || TIFFSetDirectory(tiff.get(), static_cast<tdir_t>(page)) != 1) {
    return damaged(file, memory);
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
  if (!good || !memory.error.empty()) {
    return damaged(file, memory);
  }
  return {};
}

Result<std::string> encode_tiff(const Samples& samples, const std::string& name) {
  Memory memory;
  constexpr std::uint64_t kNoLimit = 0;
  TiffFile tiff = open_tiff(memory, "w", kNoLimit);
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
  if (!good || !memory.error.empty()) {
    return failure(ErrorCode::kIo, name + ": TIFF cannot be written: " + memory.error);
  }
  return std::string(memory.output.begin(), memory.output.end());
}

}  // namespace thermedge::io
