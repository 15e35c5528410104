#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <limits>
#include <new>

#include "codecs/codecs.hpp"

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

// Methods that give a bool tell by false that `message` has the reason.
class Reader {
 public:
  explicit Reader(Bytes bytes) : input_{bytes} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, on_error, on_warning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool read_header();
  bool start_rows();
  bool read_rows(png_bytepp rows);

  [[nodiscard]] const char* message() const { return message_.text; }
  [[nodiscard]] std::uint32_t width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] std::uint32_t height() const { return png_get_image_height(png_, info_); }
  [[nodiscard]] int bits() const { return png_get_bit_depth(png_, info_); }
  [[nodiscard]] int channels() const { return png_get_channels(png_, info_); }
  // Behind start_rows, colour still apart.
  [[nodiscard]] std::uint64_t decoded_bytes_per_pixel() const {
    const bool colour = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_COLOR) != 0;
    return std::uint64_t{colour ? 3U : 1U} * (bits() == 16 ? 2 : 1);
  }
  [[nodiscard]] std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }

 private:
  Message message_;
  Input input_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

bool Reader::read_header() {
  if (info_ == nullptr) {
    std::strcpy(message_.text, "out of memory");
    return false;
  }
  if (setjmp(png_jmpbuf(png_)) != 0) {
    return false;
  }
  png_set_read_fn(png_, &input_, read_bytes);
  png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  // Texts and profiles may be packed to a thousandth of their size: skipped, their checksums
  // tested.
  constexpr int kAllThatPixelsDoNotNeed = -1;
  png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, kAllThatPixelsDoNotNeed);
  // Our own limits are checked next, with a better message.
  constexpr auto kNoLimit = static_cast<png_uint_32>(std::numeric_limits<std::int32_t>::max());
  png_set_user_limits(png_, kNoLimit, kNoLimit);
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
bool take_grey(const std::vector<png_byte>& pixels, const Reader& reader,
               ImageView<std::uint16_t> counts) {
  const auto channels = static_cast<std::size_t>(reader.channels());
  for (int y = 0; y < counts.height(); ++y) {
    const png_byte* row = pixels.data() + static_cast<std::size_t>(y) * reader.row_bytes();
    for (std::size_t x = 0; x < reader.width(); ++x) {
      T sample[3];
      std::memcpy(sample, row + x * channels * sizeof(T), channels * sizeof(T));
      if (std::any_of(sample, sample + channels, [&](T s) { return s != sample[0]; })) {
        return false;
      }
      counts.row(y)[x] = sample[0];
    }
  }
  return true;
}

}  // namespace

Status decode_png(const EncodedFile& file, Frame& frame) {
  Reader reader(file.bytes);
  if (!reader.read_header()) {
    return damaged(file, "PNG", reader.message());
  }
  if (Status status =
          check_claim(file, reader.width(), reader.height(), reader.decoded_bytes_per_pixel());
      !status) {
    return status;
  }
  if (!reader.start_rows()) {
    return damaged(file, "PNG", reader.message());
  }
  std::vector<png_byte> pixels(reader.row_bytes() * reader.height());
  std::vector<png_bytep> rows(reader.height());
  for (std::size_t y = 0; y < rows.size(); ++y) {
    rows[y] = pixels.data() + y * reader.row_bytes();
  }
  if (!reader.read_rows(rows.data())) {
    return damaged(file, "PNG", reader.message());
  }
  frame.bits = reader.bits();
  frame.counts.resize(static_cast<int>(reader.width()), static_cast<int>(reader.height()));
  const bool grey = frame.bits == 16 ? take_grey<std::uint16_t>(pixels, reader, frame.counts)
                                     : take_grey<std::uint8_t>(pixels, reader, frame.counts);
  if (!grey) {
    return failure(ErrorCode::kUnsupported,
                   file.name + ": a colour picture; frames have a single channel (grey)");
  }
  return {};
}

namespace {

struct Output {
  std::string bytes;
  bool out_of_memory = false;
};

void write_bytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto* output = static_cast<Output*>(png_get_io_ptr(png));
  try {
    output->bytes.append(reinterpret_cast<const char*>(bytes), count);
  } catch (const std::bad_alloc&) {
    output->out_of_memory = true;  // a longjmp from here would leak the exception
  }
  if (output->out_of_memory) {
    png_error(png, "out of memory");
  }
}

void flush_nothing(png_structp) {}

// Sensor noise has next to no repeats to search for: run lengths behind the Paeth filter pack it as
// well as the full search does, in a tenth of the time. 8-bit results are flat and drawn.
void set_compression(png_structp png, const Samples& samples) {
  constexpr int kQuick = 4;
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
  png_set_compression_level(png, kQuick);
  png_set_compression_strategy(png, samples.bits == 16 ? Z_RLE : Z_DEFAULT_STRATEGY);
}

bool write_png(png_structp png, png_infop info, Output* output, const Samples& samples) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_write_fn(png, output, write_bytes, flush_nothing);
  // Our own pictures may be larger than what libpng would read unasked.
  constexpr auto kNoLimit = static_cast<png_uint_32>(std::numeric_limits<std::int32_t>::max());
  png_set_user_limits(png, kNoLimit, kNoLimit);
  set_compression(png, samples);
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
  Output output;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool good = info != nullptr && write_png(png, info, &output, samples);
  png_destroy_write_struct(&png, &info);
  if (!good) {
    return failure(ErrorCode::kOutOfMemory, name + ": PNG cannot be written: " + message.text);
  }
  return std::move(output.bytes);
}

}  // namespace thermedge::io
