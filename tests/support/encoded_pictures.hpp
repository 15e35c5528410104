// PNG, TIFF and NPY files put together byte by byte, so that the decoders meet other files than
// those that this project's encoders make.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace thermedge::test {

inline std::string number(std::uint64_t value, int bytes, bool big_endian) {
  std::string text;
  for (int i = 0; i < bytes; ++i) {
    text += static_cast<char>(value >> 8 * (big_endian ? bytes - 1 - i : i) & 0xFF);
  }
  return text;
}

// A zlib stream (RFC 1950) whose blocks are stored as they are.
inline std::string stored_zlib(const std::string& data) {
  constexpr std::size_t kMostInBlock = 65535;
  std::string out = "\x78\x01";
  for (std::size_t at = 0; at == 0 || at < data.size(); at += kMostInBlock) {
    const std::string block = data.substr(at, kMostInBlock);
    out += at + kMostInBlock >= data.size() ? '\x01' : '\x00';
    out += number(block.size(), 2, false) + number(~block.size(), 2, false) + block;
  }
  std::uint32_t low = 1;
  std::uint32_t high = 0;
  for (const char c : data) {
    low = (low + static_cast<std::uint8_t>(c)) % 65521;
    high = (high + low) % 65521;
  }
  return out + number(high << 16 | low, 4, true);
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : type + data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 1) != 0 ? crc >> 1 ^ 0xEDB88320 : crc >> 1;
    }
  }
  return number(data.size(), 4, true) + type + data + number(~crc, 4, true);
}

enum class PngColour : std::uint8_t {
  kGrey = 0,
  kRgb = 2,
  kPalette = 3,
  kGreyAlpha = 4,
  kRgba = 6
};

struct PngParts {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  int bits = 8;
  PngColour colour = PngColour::kGrey;
  bool interlaced = false;
  std::string before_pixels = {};  // whole chunks
  std::string rows = {};           // each with its filter byte in front
};

inline std::string png_file(const PngParts& parts) {
  const std::string header = number(parts.width, 4, true) + number(parts.height, 4, true) +
                             static_cast<char>(parts.bits) + static_cast<char>(parts.colour) +
                             '\0' + '\0' + (parts.interlaced ? '\1' : '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + parts.before_pixels +
         png_chunk("IDAT", stored_zlib(parts.rows)) + png_chunk("IEND", "");
}

// LZW as TIFF has it, with literal codes of 9 bits only: the table is cleared before they grow.
inline std::string literal_lzw(const std::string& data) {
  constexpr std::uint32_t kClear = 256;
  constexpr std::uint32_t kEnd = 257;
  constexpr std::size_t kLiterals = 200;
  std::vector<std::uint32_t> codes;
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (i % kLiterals == 0) {
      codes.push_back(kClear);
    }
    codes.push_back(static_cast<std::uint8_t>(data[i]));
  }
  codes.push_back(kEnd);
  std::string out;
  std::uint32_t pending = 0;
  int bits = 0;
  for (const std::uint32_t code : codes) {
    pending = pending << 9 | code;
    for (bits += 9; bits >= 8; bits -= 8) {
      out += static_cast<char>(pending >> (bits - 8) & 0xFF);
    }
  }
  return bits > 0 ? out + static_cast<char>(pending << (8 - bits) & 0xFF) : out;
}

enum TiffTag : std::uint16_t {
  kWidth = 256,
  kHeight = 257,
  kBits = 258,
  kCompression = 259,
  kPhotometric = 262,
  kStripOffsets = 273,
  kChannels = 277,
  kRowsPerStrip = 278,
  kStripBytes = 279,
  kPredictor = 317,
  kTileWidth = 322,
  kTileHeight = 323,
  kTileOffsets = 324,
  kTileBytes = 325,
  kSampleFormat = 339
};

struct TiffPage {
  std::vector<std::pair<std::uint16_t, std::uint64_t>> tags;
  std::vector<std::string> parts;  // strips or tiles, as they lie in the file
  bool tiled = false;
};

class TiffWriter {
 public:
  TiffWriter(bool big_endian, bool big_tiff)
      : big_endian_(big_endian), offset_bytes_(big_tiff ? 8 : 4) {
    file_ = big_endian ? "MM" : "II";
    add(big_tiff ? 43 : 42, 2);
    if (big_tiff) {
      add(8, 2);
      add(0, 2);
    }
    link_at_ = file_.size();
    add(0, offset_bytes_);
  }

  void add_page(TiffPage page) {
    std::vector<std::uint64_t> offsets;
    std::vector<std::uint64_t> sizes;
    for (const std::string& part : page.parts) {
      offsets.push_back(file_.size());
      sizes.push_back(part.size());
      file_ += part;
    }
    const std::uint64_t offsets_at = add_array(offsets);
    const std::uint64_t sizes_at = add_array(sizes);
    link_to(file_.size());
    const std::uint16_t offsets_tag = page.tiled ? kTileOffsets : kStripOffsets;
    const std::uint16_t sizes_tag = page.tiled ? kTileBytes : kStripBytes;
    page.tags.emplace_back(offsets_tag, offsets_at);
    page.tags.emplace_back(sizes_tag, sizes_at);
    std::sort(page.tags.begin(), page.tags.end());
    add(page.tags.size(), offset_bytes_ == 8 ? 8 : 2);
    for (const auto& [tag, value] : page.tags) {
      const bool array = tag == offsets_tag || tag == sizes_tag;
      add(tag, 2);
      add(offset_bytes_ == 8 ? kLong8 : kLong, 2);
      add(array ? offsets.size() : 1, offset_bytes_);
      add(value, offset_bytes_);
    }
    link_at_ = file_.size();
    add(0, offset_bytes_);
  }

  // Where the last directory says that the next one is.
  void link_to(std::uint64_t offset) {
    file_.replace(link_at_, static_cast<std::size_t>(offset_bytes_),
                  number(offset, offset_bytes_, big_endian_));
  }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  static constexpr int kLong = 4;  // types of tags
  static constexpr int kLong8 = 16;

  void add(std::uint64_t value, int bytes) { file_ += number(value, bytes, big_endian_); }

  // Numbers in the file, or the value itself where it is a single one.
  std::uint64_t add_array(const std::vector<std::uint64_t>& values) {
    if (values.size() == 1) {
      return values[0];
    }
    const std::uint64_t at = file_.size();
    for (const std::uint64_t value : values) {
      add(value, offset_bytes_);
    }
    return at;
  }

  bool big_endian_;
  int offset_bytes_;
  std::string file_;
  std::size_t link_at_ = 0;
};

inline std::string npy_file(const std::string& header, const std::string& data, char version = 1) {
  return std::string("\x93NUMPY") + version + '\0' +
         number(header.size(), version == 1 ? 2 : 4, false) + header + data;
}

}  // namespace thermedge::test
