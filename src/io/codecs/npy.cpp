// NumPy's .npy, versions 1 to 3: a dictionary as text, then the array.
#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <optional>
#include <string_view>

#include "codecs/codecs.hpp"
#include "codecs/file_format.hpp"
#include "codecs/number_reader.hpp"
#include "codecs/picture_reader.hpp"
#include "codecs/samples.hpp"

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
  SampleFormat samples;
  ByteOrder byte_order = ByteOrder::kLittle;
  bool fortran_order = false;
  std::uint64_t pages = 1;
  std::uint64_t height = 0;
  std::uint64_t width = 0;
  Bytes data;
  std::string doubt;           // what the user should know about the order of indices
  std::size_t first_page = 0;  // of the file that holds several arrays

  [[nodiscard]] std::uint64_t page_bytes() const { return width * height * samples.bytes(); }
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
  const auto length =
      NumberReader(bytes, ByteOrder::kLittle).number(kLengthAt, text_at - kLengthAt);
  if (!length || *length > bytes.size() - text_at) {
    return damaged(file, "NPY", "the file ends early");
  }
  data_at = text_at + *length;
  return std::string_view(reinterpret_cast<const char*>(bytes.data()) + text_at, *length);
}

struct TypeName {
  std::string_view name;  // without its byte order
  SampleFormat samples;
};
constexpr std::array kTypes = {
    TypeName{"b1", {SampleKind::kUnsigned, 8}},  TypeName{"u1", {SampleKind::kUnsigned, 8}},
    TypeName{"u2", {SampleKind::kUnsigned, 16}}, TypeName{"u4", {SampleKind::kUnsigned, 32}},
    TypeName{"u8", {SampleKind::kUnsigned, 64}}, TypeName{"i1", {SampleKind::kSigned, 8}},
    TypeName{"i2", {SampleKind::kSigned, 16}},   TypeName{"i4", {SampleKind::kSigned, 32}},
    TypeName{"i8", {SampleKind::kSigned, 64}},   TypeName{"f2", {SampleKind::kFloat, 16}},
    TypeName{"f4", {SampleKind::kFloat, 32}},    TypeName{"f8", {SampleKind::kFloat, 64}}};

Status take_type(const Header& header, const EncodedFile& file, Array& array) {
  constexpr std::string_view kOrders = "<>|=";
  const std::string_view type = *header.type;
  if (!type.empty() && kOrders.find(type[0]) != std::string_view::npos) {
    for (const TypeName& known : kTypes) {
      if (known.name == type.substr(1)) {
        array.samples = known.samples;
        array.byte_order =
            chosen_order(file.order, type[0] == '>' ? ByteOrder::kBig : ByteOrder::kLittle);
        return {};
      }
    }
  }
  constexpr std::size_t kShown = 20;
  return failure(ErrorCode::kUnsupported, file.name + ": an NPY of '" +
                                              printable(type.substr(0, kShown)) +
                                              "'; frames are whole numbers or floats of 8 to 64 "
                                              "bits");
}

std::string shape_text(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return "(" + std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c) + ")";
}

std::string how_to_move_axes(const std::vector<std::uint64_t>& shape) {
  return "a stack is (frames, height, width): numpy.save(FILE, numpy.moveaxis(a, -1, 0)) makes "
         "it " +
         shape_text(shape[2], shape[0], shape[1]);
}

// A stack whose frames are counted by the last index would pass for one of very narrow frames.
Status check_index_order(const std::vector<std::uint64_t>& shape, const EncodedFile& file) {
  constexpr std::uint64_t kMostChannels = 4;
  constexpr std::uint64_t kNarrow = 16;
  const bool has_channels = shape[2] <= kMostChannels && shape[1] > 4 * kMostChannels;
  const bool is_narrow = shape[2] <= kNarrow && shape[1] > 4 * kNarrow && shape[0] > 4 * kNarrow;
  if (!has_channels && !is_narrow) {
    return {};
  }
  return failure(ErrorCode::kUnsupported,
                 file.name + ": an NPY of shape " + shape_text(shape[0], shape[1], shape[2]) +
                     ", which looks like (height, width, frames or channels); " +
                     how_to_move_axes(shape));
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
  if (shape.size() == 3 && array.width < std::min(array.pages, array.height)) {
    array.doubt = "the array " + shape_text(shape[0], shape[1], shape[2]) + " is read as " +
                  std::to_string(array.pages) + " frames of " + std::to_string(array.width) + "x" +
                  std::to_string(array.height) +
                  " pixels; should it be (height, width, frames): " + how_to_move_axes(shape);
  }
  return shape.size() == 3 ? check_index_order(shape, file) : Status();
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
      .and_then(
          [&] { return check_claim(file, array.width, array.height, array.samples.frame_bytes()); })
      .and_then([&]() -> Status {
        array.data = file.bytes.subspan(data_at);
        if (array.pages == 0) {
          return damaged(file, "NPY", "a stack without frames");
        }
        const std::size_t page_bytes = array.page_bytes();
        if (page_bytes == 0 || array.data.size() / page_bytes < array.pages) {
          return damaged(file, "NPY", "the file ends early");
        }
        array.data = array.data.first(array.pages * page_bytes);
        return {};
      })
      .map([&] { return array; });
}

Status store(const Array& array, std::size_t page, const EncodedFile& file, SourceFrame& frame) {
  const auto width = static_cast<int>(array.width);
  const auto height = static_cast<int>(array.height);
  if (!array.fortran_order) {
    return store_packed(file, array.data.subspan(page * array.page_bytes(), array.page_bytes()),
                        array.samples, array.byte_order, width, height, frame);
  }
  // Column-major: the first index runs fastest.
  SampleStore samples(array.samples, array.byte_order, width, height, false, frame);
  const std::size_t step = array.pages * array.height * array.samples.bytes();
  for (std::size_t y = 0; y < array.height; ++y) {
    samples.put(0, static_cast<int>(y),
                array.data.data() + (page + array.pages * y) * array.samples.bytes(), array.width,
                step);
  }
  return samples.finish(file);
}

// Arrays one after the other, as numpy.save writes them into a file that is open.
class NpyReader final : public PictureReader {
 public:
  NpyReader(const EncodedFile& file, const Array& first) : PictureReader(file) {
    add(first);
    while (!fault_ && end_ < file.bytes.size()) {
      add_next();
    }
  }

  [[nodiscard]] std::size_t pages() const override { return pages_ + (fault_ ? 1 : 0); }
  [[nodiscard]] PageKind kind(std::size_t page) const override {
    return page < pages_ ? PageKind::kFrame : PageKind::kFault;
  }
  Status read(std::size_t page, const std::string& name, SourceFrame& frame) override {
    if (page >= pages_) {
      return failure(fault_->code, name + fault_->message.substr(file().name.size()));
    }
    const auto after =
        std::upper_bound(arrays_.begin(), arrays_.end(), page,
                         [](std::size_t p, const Array& array) { return p < array.first_page; });
    const Array& array = *std::prev(after);
    return store(array, page - array.first_page, file(name), frame);
  }
  [[nodiscard]] std::string note() const override { return arrays_.front().doubt; }

 private:
  void add(Array array) {
    array.first_page = pages_;
    pages_ += array.pages;
    end_ = static_cast<std::size_t>(array.data.data() - file().bytes.data()) + array.data.size();
    arrays_.push_back(std::move(array));
  }

  void add_next() {
    EncodedFile rest = file();
    rest.bytes = rest.bytes.subspan(end_);
    if (format_of(rest.bytes) != FileFormat::kNpy) {
      fault_ = left_over(file(), rest.bytes.size(), "the array").value();
    } else if (auto array = parse_npy(rest)) {
      add(std::move(*array));
    } else {
      fault_ = array.error();
    }
  }

  std::vector<Array> arrays_;
  std::size_t pages_ = 0;
  std::size_t end_ = 0;         // of the arrays so far
  std::optional<Error> fault_;  // of what follows the last good array
};

}  // namespace

OpenedPicture open_npy(const EncodedFile& file) {
  return parse_npy(file).map([&](const Array& first) -> std::unique_ptr<PictureReader> {
    return std::make_unique<NpyReader>(file, first);
  });
}

std::string encode_npy(const Samples& samples) {
  std::string header = std::string("{'descr': '") +
                       (samples.bits == 32   ? "<f4"
                        : samples.bits == 16 ? "<u2"
                                             : "|u1") +
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
