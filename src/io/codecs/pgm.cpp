// Portable graymap: text (P2) or binary (P5) pixels after a header of three numbers; several
// pictures may follow each other in a file.
#include <algorithm>
#include <cctype>
#include <cstring>
#include <optional>
#include <vector>

#include "codecs/codecs.hpp"
#include "codecs/file_format.hpp"
#include "codecs/picture_reader.hpp"
#include "codecs/samples.hpp"

namespace thermedge::io {
namespace {

int byte_at(Bytes bytes, std::size_t at) { return std::to_integer<int>(bytes[at]); }

std::size_t skip_blanks(Bytes bytes, std::size_t at) {
  while (at < bytes.size() && std::isspace(byte_at(bytes, at)) != 0) {
    ++at;
  }
  return at;
}

// To the end of a line that has a comment, or to the end of the file.
std::size_t skip_line(Bytes bytes, std::size_t at) {
  while (at < bytes.size() && byte_at(bytes, at) != '\n') {
    ++at;
  }
  return std::min(at + 1, bytes.size());
}

std::size_t skip_blanks_and_comments(Bytes bytes, std::size_t at) {
  at = skip_blanks(bytes, at);
  while (at < bytes.size() && byte_at(bytes, at) == '#') {
    at = skip_blanks(bytes, skip_line(bytes, at));
  }
  return at;
}

// Takes the number at `at`, after blanks and comments.
std::optional<std::uint32_t> take_number(Bytes bytes, std::size_t& at) {
  at = skip_blanks_and_comments(bytes, at);
  std::uint32_t value = 0;
  const std::size_t begin = at;
  for (; at < bytes.size() && std::isdigit(byte_at(bytes, at)) != 0; ++at) {
    const auto digit = static_cast<std::uint32_t>(byte_at(bytes, at) - '0');
    if (value > (UINT32_MAX - digit) / 10) {
      return std::nullopt;
    }
    value = value * 10 + digit;
  }
  return at > begin ? std::optional(value) : std::nullopt;
}

struct Header {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t largest = 0;
  bool is_text = false;
  std::size_t end = 0;  // after the last digit of the maximum

  [[nodiscard]] int bits() const { return largest > 255 ? 16 : 8; }
  [[nodiscard]] std::size_t pixels() const { return std::size_t{width} * height; }
  // Of a binary picture's pixels.
  [[nodiscard]] std::size_t raster_bytes() const {
    return pixels() * static_cast<std::size_t>(bits() / 8);
  }
};

Result<Header> read_header(const EncodedFile& file, std::size_t begin) {
  Header header;
  header.is_text = byte_at(file.bytes, begin + 1) == '2';
  std::size_t at = begin + 2;
  const auto width = take_number(file.bytes, at);
  const auto height = take_number(file.bytes, at);
  const auto largest = take_number(file.bytes, at);
  if (!width || !height || !largest || *largest == 0 || *largest > 65535) {
    return damaged(file, "PGM", "the header should hold width, height and a maximum of 1 to 65535");
  }
  header.width = *width;
  header.height = *height;
  header.largest = *largest;
  header.end = at;
  return check_claim(file, *width, *height, 2).map([&] { return header; });
}

bool is_picture(Bytes bytes, std::size_t at) {
  return at < bytes.size() && format_of(bytes.subspan(at)) == FileFormat::kPgm;
}

// Where the pixels of a binary picture begin. One white space parts them from the maximum; there
// are files with "\r\n" there, and files with comments. Their first bytes may be pixels as well, so
// the first reading is taken after which the file, or the next picture, follows at once; else the
// first after which nothing but white space lies between; else the first that leaves room for the
// pixels.
std::optional<std::size_t> find_raster(Bytes bytes, const Header& header) {
  if (header.end >= bytes.size()) {
    return std::nullopt;
  }
  std::vector<std::size_t> readings;
  if (std::isspace(byte_at(bytes, header.end)) != 0) {
    readings.push_back(header.end + 1);
    if (byte_at(bytes, header.end) == '\r' && header.end + 1 < bytes.size() &&
        byte_at(bytes, header.end + 1) == '\n') {
      readings.push_back(header.end + 2);
    }
  }
  const std::size_t word = skip_blanks(bytes, header.end);
  if (word < bytes.size() && byte_at(bytes, word) == '#') {
    std::size_t after = word;
    while (after < bytes.size() && byte_at(bytes, after) == '#') {
      after = skip_line(bytes, after);
    }
    readings.push_back(after);
  }
  const auto has_room = [&](std::size_t at) { return bytes.size() - at >= header.raster_bytes(); };
  const auto ends_at_once = [&](std::size_t at) {
    const std::size_t end = at + header.raster_bytes();
    return has_room(at) && (end == bytes.size() || is_picture(bytes, end));
  };
  const auto ends_after_blanks = [&](std::size_t at) {
    const std::size_t end = has_room(at) ? skip_blanks(bytes, at + header.raster_bytes()) : 0;
    return has_room(at) && (end == bytes.size() || is_picture(bytes, end));
  };
  auto found = std::find_if(readings.begin(), readings.end(), ends_at_once);
  found = found != readings.end()
              ? found
              : std::find_if(readings.begin(), readings.end(), ends_after_blanks);
  found =
      found != readings.end() ? found : std::find_if(readings.begin(), readings.end(), has_room);
  return found != readings.end() ? std::optional(*found) : std::nullopt;
}

// One picture of the file.
struct Picture {
  Header header;
  std::size_t raster = 0;  // where its pixels begin
  std::size_t end = 0;     // after them
};

// Reads the numbers of a text picture; gives where they end.
Result<std::size_t> read_text(const EncodedFile& file, const Header& header,
                              ImageView<std::uint16_t> counts) {
  std::size_t at = header.end;
  for (int y = 0; y < static_cast<int>(header.height); ++y) {
    for (int x = 0; x < static_cast<int>(header.width); ++x) {
      const auto value = take_number(file.bytes, at);
      if (!value || *value > header.largest) {
        return damaged(file, "PGM",
                       value ? "a pixel is above the maximum of the header"
                             : "the file ends early, or a pixel is no number");
      }
      if (!counts.empty()) {
        counts(x, y) = static_cast<std::uint16_t>(*value);
      }
    }
  }
  return at;
}

Result<Picture> find_picture(const EncodedFile& file, std::size_t begin) {
  const auto header = read_header(file, begin);
  if (!header) {
    return tl::unexpected(header.error());
  }
  Picture picture{*header, header->end, 0};
  if (header->is_text) {
    // A pixel has at least a digit, and white space before it.
    if (file.bytes.size() - header->end < 2 * header->pixels()) {
      return damaged(file, "PGM", "the file ends early");
    }
    return read_text(file, *header, {}).map([&](std::size_t end) {
      picture.end = end;
      return picture;
    });
  }
  const auto raster = find_raster(file.bytes, *header);
  if (!raster) {
    return damaged(file, "PGM", "the file ends early");
  }
  picture.raster = *raster;
  picture.end = *raster + header->raster_bytes();
  return picture;
}

class PgmReader final : public PicturesReader<Picture> {
 public:
  PgmReader(const EncodedFile& file, const Picture& first) : PicturesReader(file, first) {
    while (!fault_) {
      const std::size_t next = skip_blanks_of(pictures_.back());
      if (next >= file.bytes.size()) {
        break;
      }
      add_next(next);
    }
  }

 private:
  Status read_picture(const Picture& picture, const EncodedFile& named,
                      SourceFrame& frame) const override {
    const Header& header = picture.header;
    const auto width = static_cast<int>(header.width);
    const auto height = static_cast<int>(header.height);
    if (header.is_text) {
      SampleStore store({SampleKind::kUnsigned, header.bits()}, kNativeOrder, width, height, false,
                        frame);
      return read_text(named, header, frame.counts).and_then([&](std::size_t) {
        return store.finish(named);
      });
    }
    return store_packed(named, named.bytes.subspan(picture.raster, header.raster_bytes()),
                        {SampleKind::kUnsigned, header.bits()},
                        chosen_order(named.order, ByteOrder::kBig), width, height, frame);
  }

  // Comments may follow a text picture.
  [[nodiscard]] std::size_t skip_blanks_of(const Picture& picture) const {
    return picture.header.is_text ? skip_blanks_and_comments(file().bytes, picture.end)
                                  : skip_blanks(file().bytes, picture.end);
  }

  void add_next(std::size_t begin) {
    if (!is_picture(file().bytes, begin)) {
      fault_ = left_over(file(), file().bytes.size() - pictures_.back().end, "the picture").value();
      return;
    }
    const auto picture = find_picture(file(), begin);
    if (picture) {
      pictures_.push_back(*picture);
    } else {
      fault_ = picture.error();
    }
  }
};

}  // namespace

OpenedPicture open_pgm(const EncodedFile& file) {
  return find_picture(file, 0).map([&](const Picture& first) -> std::unique_ptr<PictureReader> {
    return std::make_unique<PgmReader>(file, first);
  });
}

std::string encode_pgm(const Samples& samples) {
  std::string out = "P5\n" + std::to_string(samples.width) + " " + std::to_string(samples.height) +
                    "\n" + (samples.bits == 16 ? "65535" : "255") + "\n";
  append_samples(samples, ByteOrder::kBig, out);
  return out;
}

}  // namespace thermedge::io
