#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <memory>

#include "io/codecs.hpp"

namespace thermedge::io {
namespace {

// libpng reports errors by longjmp, which must not skip destructors: the functions that call setjmp
// hold nothing but plain data; buffers are made by their callers.

struct Message {
  char text[160] = "";
};

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
  auto* message = static_cast<Message*>(png_get_error_ptr(png));
  std::strncpy(message->text, text, sizeof(message->text) - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

struct Input {
  Bytes bytes;
  std::size_t at = 0;
};

void read_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto* input = static_cast<Input*>(png_get_io_ptr(png));
  if (count > input->bytes.size() - input->at) {
    png_error(png, "the file ends early");
  }
  std::memcpy(out, input->bytes.data() + input->at, count);
  input->at += count;
}

class Reader {
 public:
  explicit Reader(Bytes bytes) : input_{bytes} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, on_error, on_warning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool read_header(const Limits& limits);
  bool start_rows();
  bool read_rows(png_bytepp rows);

  [[nodiscard]] const char* message() const { return message_.text; }
  [[nodiscard]] std::uint32_t width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] std::uint32_t height() const { return png_get_image_height(png_, info_); }
  [[nodiscard]] int bits() const { return png_get_bit_depth(png_, info_); }
  [[nodiscard]] int channels() const { return png_get_channels(png_, info_); }
  [[nodiscard]] std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }

 private:
  Message message_;
  Input input_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

bool Reader::read_header(const Limits& limits) {
  if (info_ == nullptr) {
    std::strcpy(message_.text, "out of memory");
    return false;
  }
  if (setjmp(png_jmpbuf(png_)) != 0) {
    return false;
  }
  png_set_read_fn(png_, &input_, read_bytes);
  png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  const auto side = static_cast<png_uint_32>(limits.max_side_px);
  png_set_user_limits(png_, side, side);
  png_read_info(png_, info_);
  return true;
}

// Any kind of PNG becomes 1 or 3 channels of 8 or 16 bits.
bool Reader::start_rows() {
  if (setjmp(png_jmpbuf(png_)) != 0) {
    return false;
  }
  const int colour = png_get_color_type(png_, info_);
  if (colour == PNG_COLOR_TYPE_PALETTE) {
    png_set_palette_to_rgb(png_);
  } else if (colour == PNG_COLOR_TYPE_GRAY) {
    png_set_expand_gray_1_2_4_to_8(png_);
  }
  png_set_strip_alpha(png_);
  if constexpr (std::endian::native == std::endian::little) {
    png_set_swap(png_);
  }
  png_set_interlace_handling(png_);
  png_read_update_info(png_, info_);
  return true;
}

bool Reader::read_rows(png_bytepp rows) {
  if (setjmp(png_jmpbuf(png_)) != 0) {
    return false;
  }
  png_read_image(png_, rows);
  png_read_end(png_, nullptr);
  return true;
}

// Takes the first channel; false where another one differs.
template <class T>
bool take_grey(const std::vector<png_byte>& pixels, std::size_t row_bytes, std::size_t channels,
               ImageView<std::uint16_t> counts) {
  for (int y = 0; y < counts.height(); ++y) {
    const png_byte* row = pixels.data() + static_cast<std::size_t>(y) * row_bytes;
    for (int x = 0; x < counts.width(); ++x) {
      T sample[3];
      std::memcpy(sample, row + static_cast<std::size_t>(x) * channels * sizeof(T),
                  channels * sizeof(T));
      if (std::any_of(sample, sample + channels, [&](T s) { return s != sample[0]; })) {
        return false;
      }
      counts(x, y) = sample[0];
    }
  }
  return true;
}

Error damaged(const std::string& name, const char* message) {
  return {ErrorCode::kBadData, name + ": damaged PNG: " + message};
}

}  // namespace

Status decode_png(const EncodedFile& file, Frame& frame) {
  Reader reader(file.bytes);
  if (!reader.read_header(file.limits)) {
    return tl::unexpected(damaged(file.name, reader.message()));
  }
  constexpr std::uint64_t kMostBytesPerPixel = 6;
  if (Status status =
          check_limits(file.limits, file.name, reader.width(), reader.height(), kMostBytesPerPixel);
      !status) {
    return status;
  }
  if (!reader.start_rows()) {
    return tl::unexpected(damaged(file.name, reader.message()));
  }
  std::vector<png_byte> pixels(reader.row_bytes() * reader.height());
  std::vector<png_bytep> rows(reader.height());
  for (std::size_t y = 0; y < rows.size(); ++y) {
    rows[y] = pixels.data() + y * reader.row_bytes();
  }
  if (!reader.read_rows(rows.data())) {
    return tl::unexpected(damaged(file.name, reader.message()));
  }
  frame.bits = reader.bits();
  frame.counts.resize(static_cast<int>(reader.width()), static_cast<int>(reader.height()));
  const auto channels = static_cast<std::size_t>(reader.channels());
  const bool grey =
      frame.bits == 16
          ? take_grey<std::uint16_t>(pixels, reader.row_bytes(), channels, frame.counts)
          : take_grey<std::uint8_t>(pixels, reader.row_bytes(), channels, frame.counts);
  if (!grey) {
    return failure(ErrorCode::kUnsupported,
                   file.name + ": a colour picture; frames have a single channel (grey)");
  }
  return {};
}

namespace {

void append_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto* out = static_cast<std::vector<char>*>(png_get_io_ptr(png));
  try {
    out->insert(out->end(), bytes, bytes + count);
  } catch (const std::bad_alloc&) {
    png_error(png, "out of memory");
  }
}

void flush_nothing(png_structp) {}

bool write_png(png_structp png, png_infop info, const Samples& samples) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_IHDR(png, info, static_cast<png_uint_32>(samples.width),
               static_cast<png_uint_32>(samples.height), samples.bits,
               samples.channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if constexpr (std::endian::native == std::endian::little) {
    png_set_swap(png);
  }
  for (int y = 0; y < samples.height; ++y) {
    png_write_row(png, reinterpret_cast<png_const_bytep>(samples.row(y)));
  }
  png_write_end(png, info);
  return true;
}

}  // namespace

Result<std::string> encode_png(const Samples& samples, const std::string& name) {
  Message message;
  std::vector<char> out;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool good = info != nullptr;
  if (good) {
    png_set_write_fn(png, &out, append_bytes, flush_nothing);
    good = write_png(png, info, samples);
  }
  png_destroy_write_struct(&png, &info);
  if (!good) {
    return failure(ErrorCode::kIo, name + ": PNG cannot be written: " + message.text);
  }
  return std::string(out.begin(), out.end());
}

}  // namespace thermedge::io
