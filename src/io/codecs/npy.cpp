// NumPy's .npy, versions 1 to 3: a dictionary as text, then the array.
#include <charconv>
#include <optional>
#include <string_view>

#include "codecs/codecs.hpp"

namespace thermedge::io {
namespace {

constexpr std::size_t kVersionAt = 6;  // after "\x93NUMPY"; then a minor version
constexpr std::size_t kLengthAt = 8;   // of the header: 2 bytes in version 1, then 4

struct Header {
  std::optional<std::string_view> type;
  std::optional<bool> fortran_order;
  std::optional<std::vector<std::uint64_t>> shape;
};

// Reads the header's Python dictionary: strings, booleans and tuples of whole numbers, which is all
// that NumPy writes for an array of plain numbers.
class DictionaryReader {
 public:
  explicit DictionaryReader(std::string_view text) : text_(text) {}

  tl::expected<Header, std::string_view> read() {
    constexpr std::string_view kNotPlain = "its header does not describe an array of numbers";
    constexpr std::string_view kIncomplete = "its header lacks descr, fortran_order or shape";
    Header header;
    if (!take("{")) {
      return tl::unexpected(kNotPlain);
    }
    while (!take("}")) {
      const auto key = string();
      if (!key || !take(":")) {
        return tl::unexpected(kNotPlain);
      }
      if (!read_value(*key, header)) {
        return tl::unexpected(key == "shape" ? "its shape is not a list of sizes" : kNotPlain);
      }
      if (!take(",") && !text_.starts_with('}')) {
        return tl::unexpected(kNotPlain);
      }
    }
    if (!header.type || !header.fortran_order || !header.shape) {
      return tl::unexpected(kIncomplete);
    }
    return header;
  }

 private:
  bool read_value(std::string_view key, Header& header) {
    if (key == "descr") {
      return (header.type = string()).has_value();
    }
    if (key == "fortran_order") {
      return (header.fortran_order = boolean()).has_value();
    }
    return key == "shape" && (header.shape = sizes()).has_value();
  }

  void skip_blanks() {
    text_.remove_prefix(std::min(text_.find_first_not_of(" \t\n"), text_.size()));
  }
  bool take(std::string_view word) {
    skip_blanks();
    if (!text_.starts_with(word)) {
      return false;
    }
    text_.remove_prefix(word.size());
    skip_blanks();
    return true;
  }
  std::optional<std::string_view> string() {
    if (!text_.starts_with('\'')) {
      return std::nullopt;
    }
    const std::size_t end = text_.find('\'', 1);
    if (end == std::string_view::npos) {
      return std::nullopt;
    }
    const std::string_view content = text_.substr(1, end - 1);
    text_.remove_prefix(end + 1);
    return content;
  }
  std::optional<bool> boolean() {
    if (take("True")) {
      return true;
    }
    return take("False") ? std::optional(false) : std::nullopt;
  }
  std::optional<std::vector<std::uint64_t>> sizes() {
    std::vector<std::uint64_t> values;
    if (!take("(")) {
      return std::nullopt;
    }
    while (!take(")")) {
      std::uint64_t value = 0;
      const auto [stop, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
      if (error != std::errc{}) {
        return std::nullopt;
      }
      text_.remove_prefix(static_cast<std::size_t>(stop - text_.data()));
      values.push_back(value);
      if (!take(",") && !text_.starts_with(')')) {
        return std::nullopt;
      }
    }
    return values;
  }

  std::string_view text_;
};

struct Array {
  int bits = 8;
  ByteOrder byte_order = ByteOrder::kLittle;
  bool fortran_order = false;
  std::uint64_t pages = 1;
  std::uint64_t height = 0;
  std::uint64_t width = 0;
  Bytes data;

  [[nodiscard]] std::uint64_t sample_bytes() const { return static_cast<std::uint64_t>(bits / 8); }
  [[nodiscard]] std::uint64_t page_bytes() const { return width * height * sample_bytes(); }
};

Result<std::string_view> header_text(const EncodedFile& file, std::size_t& data_at) {
  const Bytes bytes = file.bytes;
  const int version = bytes.size() > kVersionAt ? std::to_integer<int>(bytes[kVersionAt]) : 1;
  if (version < 1 || version > 3) {
    return failure(ErrorCode::kUnsupported, file.name + ": an NPY of version " +
                                                std::to_string(version) +
                                                "; versions 1 to 3 are read");
  }
  const std::size_t text_at = kLengthAt + (version == 1 ? 2 : 4);
  if (bytes.size() < text_at) {
    return damaged(file, "NPY", "the file ends early");
  }
  std::size_t length = 0;
  for (std::size_t at = text_at; at-- > kLengthAt;) {
    length = length << 8 | std::to_integer<std::size_t>(bytes[at]);
  }
  if (length > bytes.size() - text_at) {
    return damaged(file, "NPY", "the file ends early");
  }
  data_at = text_at + length;
  return std::string_view(reinterpret_cast<const char*>(bytes.data()) + text_at, length);
}

Status take_type(const Header& header, const EncodedFile& file, Array& array) {
  const std::string_view type = *header.type;
  if (type == "|u1" || type == "<u1" || type == ">u1" || type == "|b1") {
    array.bits = 8;
  } else if (type == "<u2" || type == ">u2") {
    array.bits = 16;
    array.byte_order = type[0] == '>' ? ByteOrder::kBig : ByteOrder::kLittle;
  } else {
    constexpr std::size_t kShown = 20;
    return failure(ErrorCode::kUnsupported, file.name + ": an NPY of '" +
                                                printable(type.substr(0, kShown)) +
                                                "'; frames are uint8 or uint16");
  }
  return {};
}

Status take_shape(const Header& header, const EncodedFile& file, Array& array) {
  const auto& shape = *header.shape;
  if (shape.size() < 2 || shape.size() > 3) {
    return failure(ErrorCode::kUnsupported, file.name + ": an NPY of " +
                                                std::to_string(shape.size()) +
                                                " dimensions; frames have 2, stacks of frames 3");
  }
  array.pages = shape.size() == 3 ? shape[0] : 1;
  array.height = shape[shape.size() - 2];
  array.width = shape[shape.size() - 1];
  // (height, width, channels) would pass for a stack of very narrow frames.
  constexpr std::uint64_t kMostChannels = 4;
  if (shape.size() == 3 && array.width <= kMostChannels && array.height > 4 * kMostChannels) {
    return failure(ErrorCode::kUnsupported,
                   file.name +
                       ": an NPY with its channels last; a frame is (height, width), a "
                       "stack (frames, height, width)");
  }
  return {};
}

Result<Array> parse_npy(const EncodedFile& file) {
  std::size_t data_at = 0;
  const auto text = header_text(file, data_at);
  if (!text) {
    return tl::unexpected(text.error());
  }
  const auto header = DictionaryReader(*text).read();
  if (!header) {
    return damaged(file, "NPY", header.error());
  }
  Array array;
  array.fortran_order = *header->fortran_order;
  return take_type(*header, file, array)
      .and_then([&] { return take_shape(*header, file, array); })
      .and_then([&] { return check_claim(file, array.width, array.height, array.sample_bytes()); })
      .and_then([&]() -> Status {
        array.data = file.bytes.subspan(data_at);
        if (array.pages == 0) {
          return damaged(file, "NPY", "a stack without frames");
        }
        if (array.data.size() / array.page_bytes() < array.pages) {
          return damaged(file, "NPY", "the file ends early");
        }
        return {};
      })
      .map([&] { return array; });
}

// Column-major: the first index runs fastest.
void unpack_fortran(const Array& array, std::size_t page, SourceFrame& frame) {
  const bool wide = array.bits == 16;
  const bool big = array.byte_order == ByteOrder::kBig;
  for (std::size_t y = 0; y < array.height; ++y) {
    for (std::size_t x = 0; x < array.width; ++x) {
      const std::size_t at = (page + array.pages * (y + array.height * x)) * array.sample_bytes();
      const auto low = std::to_integer<unsigned>(array.data[at + (wide && big ? 1 : 0)]);
      const auto high = wide ? std::to_integer<unsigned>(array.data[at + (big ? 0 : 1)]) : 0U;
      frame.counts(static_cast<int>(x), static_cast<int>(y)) =
          static_cast<std::uint16_t>(high << 8 | low);
    }
  }
}

}  // namespace

Result<std::size_t> count_npy_pages(const EncodedFile& file) {
  return parse_npy(file).map([](const Array& array) { return array.pages; });
}

Status decode_npy(const EncodedFile& file, std::size_t page, SourceFrame& frame) {
  return parse_npy(file).and_then([&](const Array& array) -> Status {
    if (page >= array.pages) {
      return no_such_page(file, page);
    }
    frame.bits = array.bits;
    frame.counts.resize(static_cast<int>(array.width), static_cast<int>(array.height));
    if (array.fortran_order) {
      unpack_fortran(array, page, frame);
    } else {
      unpack_samples(array.data.subspan(page * array.page_bytes(), array.page_bytes()), array.bits,
                     array.byte_order, frame);
    }
    return {};
  });
}

std::string encode_npy(const Samples& samples) {
  std::string header = std::string("{'descr': '") + (samples.bits == 16 ? "<u2" : "|u1") +
                       "', 'fortran_order': False, 'shape': (" + std::to_string(samples.height) +
                       ", " + std::to_string(samples.width) + "), }";
  // The array starts at a multiple of 64 bytes, after a line end.
  constexpr std::size_t kTextAt = kLengthAt + 2;
  header.append(63 - (kTextAt + header.size()) % 64, ' ');
  header += '\n';
  std::string out("\x93NUMPY\x01\x00", kLengthAt);
  out += static_cast<char>(header.size() & 0xFF);
  out += static_cast<char>(header.size() >> 8);
  out += header;
  append_samples(samples, ByteOrder::kLittle, out);
  return out;
}

}  // namespace thermedge::io
