#include <algorithm>
#include <cctype>
#include <optional>

#include "io/codecs.hpp"

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
  std::optional<Bytes> pixels() const {
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
  std::size_t at_ = 2;  // behind "P5" or "P2"
};

tl::unexpected<Error> damaged(const EncodedFile& file, const std::string& what) {
  return failure(ErrorCode::kBadData, file.name + ": damaged PGM: " + what);
}

Status read_text_pixels(NumberReader& numbers, std::uint32_t largest, const EncodedFile& file,
                        ImageView<std::uint16_t> counts) {
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      const auto value = numbers.next();
      if (!value || *value > largest) {
        return damaged(
            file, value ? "a pixel is above the maximum of the header" : "the file ends early");
      }
      counts(x, y) = static_cast<std::uint16_t>(*value);
    }
  }
  return {};
}

}  // namespace

Status decode_pgm(const EncodedFile& file, Frame& frame) {
  NumberReader numbers(file.bytes);
  const auto width = numbers.next();
  const auto height = numbers.next();
  const auto largest = numbers.next();
  if (!width || !height || !largest || *largest == 0 || *largest > 65535) {
    return damaged(file, "the header should hold width, height and a maximum of 1 to 65535");
  }
  if (Status status = check_limits(file.limits, file.name, *width, *height, 2); !status) {
    return status;
  }
  frame.bits = *largest > 255 ? 16 : 8;
  const std::size_t needed =
      static_cast<std::size_t>(*width) * *height * static_cast<std::size_t>(frame.bits / 8);
  const bool text = file.bytes[1] == std::byte{'2'};
  const auto pixels = numbers.pixels();
  if (!pixels || (!text && pixels->size() < needed)) {
    return damaged(file, "the file ends early");
  }
  frame.counts.resize(static_cast<int>(*width), static_cast<int>(*height));
  if (text) {
    return read_text_pixels(numbers, *largest, file, frame.counts);
  }
  unpack_samples(pixels->first(needed), frame.bits, true, frame);
  return {};
}

std::string encode_pgm(const Samples& samples) {
  std::string out = "P5\n" + std::to_string(samples.width) + " " + std::to_string(samples.height) +
                    "\n" + (samples.bits == 16 ? "65535" : "255") + "\n";
  for (int y = 0; y < samples.height; ++y) {
    for (int x = 0; x < samples.width; ++x) {
      if (samples.bits == 16) {
        const std::uint16_t value = reinterpret_cast<const std::uint16_t*>(samples.row(y))[x];
        out += static_cast<char>(value >> 8);
        out += static_cast<char>(value & 0xFF);
      } else {
        out += static_cast<char>(samples.row(y)[x]);
      }
    }
  }
  return out;
}

}  // namespace thermedge::io
