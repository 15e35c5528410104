// Portable graymap: text (P2) or binary (P5) pixels after a header of three numbers.
#include <cctype>
#include <optional>

#include "codecs/codecs.hpp"

namespace thermedge::io {
namespace {

// Reads the numbers of a PGM header (and of the pixels of a P2), past white space and comments.
class NumberReader {
 public:
  explicit NumberReader(Bytes bytes) : bytes_(bytes) {}

  std::optional<std::uint32_t> next() {
    skip_space();
    std::uint32_t value = 0;
    bool any = false;
    while (at_ < bytes_.size() && std::isdigit(peek()) != 0) {
      const auto digit = static_cast<std::uint32_t>(peek() - '0');
      if (value > (UINT32_MAX - digit) / 10) {
        return std::nullopt;
      }
      value = value * 10 + digit;
      any = true;
      ++at_;
    }
    return any ? std::optional(value) : std::nullopt;
  }

  // Exactly one white space parts the header from the pixels.
  [[nodiscard]] std::optional<Bytes> pixels() const {
    if (at_ >= bytes_.size() || std::isspace(peek()) == 0) {
      return std::nullopt;
    }
    return bytes_.subspan(at_ + 1);
  }

 private:
  [[nodiscard]] int peek() const { return std::to_integer<int>(bytes_[at_]); }
  void skip_space() {
    while (at_ < bytes_.size() && (std::isspace(peek()) != 0 || peek() == '#')) {
      if (peek() == '#') {
        while (at_ < bytes_.size() && peek() != '\n') {
          ++at_;
        }
      } else {
        ++at_;
      }
    }
  }

  Bytes bytes_;
  std::size_t at_ = 2;  // after "P5" or "P2"
};

Status read_text_pixels(NumberReader& numbers, std::uint32_t largest, const EncodedFile& file,
                        ImageView<std::uint16_t> counts) {
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      const auto value = numbers.next();
      if (!value || *value > largest) {
        return damaged(file, "PGM",
                       value ? "a pixel is above the maximum of the header"
                             : "the file ends early, or a pixel is no number");
      }
      counts(x, y) = static_cast<std::uint16_t>(*value);
    }
  }
  return {};
}

}  // namespace

Status decode_pgm(const EncodedFile& file, SourceFrame& frame) {
  NumberReader numbers(file.bytes);
  const auto width = numbers.next();
  const auto height = numbers.next();
  const auto largest = numbers.next();
  if (!width || !height || !largest || *largest == 0 || *largest > 65535) {
    return damaged(file, "PGM", "the header should hold width, height and a maximum of 1 to 65535");
  }
  if (Status status = check_claim(file, *width, *height, 2); !status) {
    return status;
  }
  frame.bits = *largest > 255 ? 16 : 8;
  const bool text = file.bytes[1] == std::byte{'2'};
  const std::size_t pixel_count = static_cast<std::size_t>(*width) * *height;
  // As text, a pixel has at least a digit, and white space before the next one.
  const std::size_t needed =
      text ? 2 * pixel_count - 1 : pixel_count * static_cast<std::size_t>(frame.bits / 8);
  const auto pixels = numbers.pixels();
  if (!pixels || pixels->size() < needed) {
    return damaged(file, "PGM", "the file ends early");
  }
  frame.counts.resize(static_cast<int>(*width), static_cast<int>(*height));
  if (text) {
    return read_text_pixels(numbers, *largest, file, frame.counts);
  }
  unpack_samples(*pixels, frame.bits, ByteOrder::kBig, frame);
  return {};
}

std::string encode_pgm(const Samples& samples) {
  std::string out = "P5\n" + std::to_string(samples.width) + " " + std::to_string(samples.height) +
                    "\n" + (samples.bits == 16 ? "65535" : "255") + "\n";
  append_samples(samples, ByteOrder::kBig, out);
  return out;
}

}  // namespace thermedge::io
