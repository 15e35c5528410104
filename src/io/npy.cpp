// NumPy's .npy, versions 1 to 3: a dictionary as text, then the array.
#include <charconv>
#include <optional>
#include <string_view>

#include "io/codecs.hpp"

namespace thermedge::io {
namespace {

struct Array {
  int bits = 8;
  bool big_endian = false;
  bool fortran_order = false;
  std::uint64_t pages = 1;
  std::uint64_t height = 0;
  std::uint64_t width = 0;
  Bytes data;
};

tl::unexpected<Error> damaged(const EncodedFile& file, const std::string& what) {
  return failure(ErrorCode::kBadData, file.name + ": damaged NPY: " + what);
}

// The text behind `'key':` in the header's dictionary, without leading blanks.
std::optional<std::string_view> value_of(std::string_view header, std::string_view key) {
  const auto found = header.find("'" + std::string(key) + "'");
  if (found == std::string_view::npos) {
    return std::nullopt;
  }
  const auto start = header.find_first_not_of(" :", found + key.size() + 2);
  return start == std::string_view::npos ? std::nullopt : std::optional(header.substr(start));
}

Result<std::string_view> read_header(const EncodedFile& file, std::size_t& data_at) {
  constexpr std::size_t kVersionAt = 6;
  const Bytes bytes = file.bytes;
  const std::size_t length_bytes =
      bytes.size() > kVersionAt && bytes[kVersionAt] == std::byte{1} ? 2 : 4;
  const std::size_t text_at = kVersionAt + 2 + length_bytes;
  if (bytes.size() < text_at) {
    return damaged(file, "the file ends early");
  }
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i) {
    length |= std::to_integer<std::size_t>(bytes[kVersionAt + 2 + i]) << (8 * i);
  }
  if (length > bytes.size() - text_at) {
    return damaged(file, "the file ends early");
  }
  data_at = text_at + length;
  return std::string_view(reinterpret_cast<const char*>(bytes.data()) + text_at, length);
}

Status parse_type(std::string_view header, const EncodedFile& file, Array& array) {
  const auto text = value_of(header, "descr");
  const std::string_view type = text ? text->substr(0, 5) : "";
  if (type == "'|u1'" || type == "'<u1'" || type == "'>u1'") {
    array.bits = 8;
  } else if (type == "'<u2'" || type == "'>u2'") {
    array.bits = 16;
    array.big_endian = type[1] == '>';
  } else {
    return failure(ErrorCode::kUnsupported,
                   file.name + ": an NPY of " +
                       std::string(text ? text->substr(0, text->find_first_of(",}")) : "unknown") +
                       "; frames are uint8 or uint16");
  }
  return {};
}

Status parse_shape(std::string_view header, const EncodedFile& file, Array& array) {
  const auto text = value_of(header, "shape");
  if (!text || !text->starts_with('(')) {
    return damaged(file, "its header has no shape");
  }
  std::vector<std::uint64_t> sizes;
  const char* at = text->data() + 1;
  const char* end = text->data() + text->size();
  while (at != end && *at != ')') {
    std::uint64_t size = 0;
    const auto [stop, error] = std::from_chars(at, end, size);
    if (error != std::errc{}) {
      return damaged(file, "its shape is not a list of sizes");
    }
    sizes.push_back(size);
    at = stop;
    while (at != end && (*at == ',' || *at == ' ')) {
      ++at;
    }
  }
  if (at == end || sizes.size() < 2 || sizes.size() > 3) {
    return failure(ErrorCode::kUnsupported, file.name + ": an NPY of " +
                                                std::to_string(sizes.size()) +
                                                " dimensions; frames have 2, stacks of frames 3");
  }
  array.pages = sizes.size() == 3 ? sizes[0] : 1;
  array.height = sizes[sizes.size() - 2];
  array.width = sizes[sizes.size() - 1];
  return {};
}

Result<Array> parse_npy(const EncodedFile& file) {
  std::size_t data_at = 0;
  const auto header = read_header(file, data_at);
  if (!header) {
    return tl::unexpected(header.error());
  }
  Array array;
  const auto order = value_of(*header, "fortran_order");
  if (!order || !(order->starts_with("True") || order->starts_with("False"))) {
    return damaged(file, "its header has no fortran_order");
  }
  array.fortran_order = order->starts_with("True");
  return parse_type(*header, file, array)
      .and_then([&] { return parse_shape(*header, file, array); })
      .and_then([&] {
        return check_limits(file.limits, file.name, array.width, array.height,
                            static_cast<std::uint64_t>(array.bits / 8));
      })
      .and_then([&]() -> Status {
        array.data = file.bytes.subspan(data_at);
        const std::uint64_t page_bytes = array.width * array.height * (array.bits / 8);
        if (array.pages == 0 || array.data.size() / page_bytes < array.pages) {
          return damaged(file, "the file ends early");
        }
        return {};
      })
      .map([&] { return array; });
}

// Column-major: the first index runs fastest.
void unpack_fortran(const Array& array, std::size_t page, Frame& frame) {
  const std::size_t sample_bytes = static_cast<std::size_t>(array.bits / 8);
  for (std::size_t y = 0; y < array.height; ++y) {
    for (std::size_t x = 0; x < array.width; ++x) {
      const std::size_t at = (page + array.pages * (y + array.height * x)) * sample_bytes;
      const auto low = std::to_integer<unsigned>(array.data[at + (array.big_endian ? 1 : 0)]);
      const auto high = sample_bytes == 2
                            ? std::to_integer<unsigned>(array.data[at + (array.big_endian ? 0 : 1)])
                            : 0U;
      frame.counts(static_cast<int>(x), static_cast<int>(y)) =
          static_cast<std::uint16_t>(low | high << 8);
    }
  }
}

}  // namespace

Result<std::size_t> count_npy_pages(const EncodedFile& file) {
  return parse_npy(file).map([](const Array& array) { return array.pages; });
}

Status decode_npy(const EncodedFile& file, std::size_t page, Frame& frame) {
  return parse_npy(file).map([&](const Array& array) {
    frame.bits = array.bits;
    frame.counts.resize(static_cast<int>(array.width), static_cast<int>(array.height));
    if (array.fortran_order) {
      unpack_fortran(array, page, frame);
    } else {
      const std::size_t page_bytes = array.width * array.height * (array.bits / 8);
      unpack_samples(array.data.subspan(page * page_bytes, page_bytes), array.bits,
                     array.big_endian, frame);
    }
  });
}

std::string encode_npy(const Samples& samples) {
  std::string header = std::string("{'descr': '") + (samples.bits == 16 ? "<u2" : "|u1") +
                       "', 'fortran_order': False, 'shape': (" + std::to_string(samples.height) +
                       ", " + std::to_string(samples.width) + "), }";
  // The array starts at a multiple of 64 bytes, behind a line end.
  constexpr std::size_t kPrefix = 10;
  header.append(63 - (kPrefix + header.size()) % 64, ' ');
  header += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(header.size() & 0xFF);
  out += static_cast<char>(header.size() >> 8);
  return out + header + encode_raw(samples);
}

}  // namespace thermedge::io
