#include <spng.h>
#include <zlib.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "codecs/codecs.hpp"
#include "codecs/file_format.hpp"
#include "codecs/number_reader.hpp"
#include "codecs/picture_reader.hpp"
#include "codecs/samples.hpp"

namespace thermedge::io {
namespace {

struct DestroyContext {
  void operator()(spng_ctx* png) const { spng_ctx_free(png); }
};
using Context = std::unique_ptr<spng_ctx, DestroyContext>;

Context make_context(int flags) {
  Context png(spng_ctx_new(flags));
  if (png == nullptr) {
    throw std::bad_alloc();
  }
  return png;
}

// The message for an error of libspng. Running out of memory is thrown, as everywhere here.
const char* message_of(int error) {
  switch (error) {
    case SPNG_EMEM:
      throw std::bad_alloc();
    case SPNG_IO_ERROR:
      return "the file ends early";
    case SPNG_ECHUNK_LIMITS:
      return "more than 1000 texts, or 16 MiB of texts and profiles";
    default:
      return spng_strerror(error);
  }
}

// Hands over the next `count` bytes. libspng 0.7.3 takes SPNG_IO_EOF for a checksum to pass over,
// so the end is told as SPNG_IO_ERROR.
int read_bytes(spng_ctx*, void* rest, void* out, std::size_t count) {
  Bytes& bytes = *static_cast<Bytes*>(rest);
  if (count > bytes.size()) {
    return SPNG_IO_ERROR;
  }
  std::memcpy(out, bytes.data(), count);
  bytes = bytes.subspan(count);
  return 0;
}

// `rest` holds what is still to be read as long as `png` lives.
int set_up_reading(spng_ctx* png, Bytes& rest) {
  // libspng keeps texts and profiles, which may be packed to a thousandth of their size.
  constexpr std::size_t kMostBesidePixels = std::size_t{16} << 20;
  if (const int error = spng_set_chunk_limits(png, kMostBesidePixels, kMostBesidePixels);
      error != 0) {
    return error;
  }
  if (const int error = spng_set_crc_action(png, SPNG_CRC_ERROR, SPNG_CRC_ERROR); error != 0) {
    return error;
  }
  return spng_set_png_stream(png, read_bytes, &rest);
}

// How decoded pixels lie in memory: rows without gaps, samples in native byte order.
struct Layout {
  spng_format format = SPNG_FMT_PNG;
  int bits = 8;
  int channels = 1;
  int colours = 1;  // of the channels; alpha follows them
};

Layout layout_of(const spng_ihdr& header) {
  switch (header.color_type) {
    case SPNG_COLOR_TYPE_INDEXED:
      return {SPNG_FMT_RGB8, 8, 3, 3};
    case SPNG_COLOR_TYPE_TRUECOLOR:
      return {SPNG_FMT_PNG, header.bit_depth, 3, 3};
    case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
      return {SPNG_FMT_PNG, header.bit_depth, 4, 3};
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return {SPNG_FMT_PNG, header.bit_depth, 2, 1};
    default:
      return header.bit_depth == 16 ? Layout{SPNG_FMT_PNG, 16, 1, 1} : Layout{SPNG_FMT_G8, 8, 1, 1};
  }
}

// Stores the first colour of each pixel; false where another one differs.
bool store_grey(const std::vector<std::byte>& pixels, const Layout& layout, SampleStore& store,
                int width, int height) {
  const auto sample_bytes = static_cast<std::size_t>(layout.bits) / 8;
  const std::size_t pixel_bytes = static_cast<std::size_t>(layout.channels) * sample_bytes;
  const std::byte* pixel = pixels.data();
  for (int y = 0; y < height; ++y) {
    store.put(0, y, pixel, static_cast<std::size_t>(width), pixel_bytes);
    for (int x = 0; x < width; ++x, pixel += pixel_bytes) {
      for (int c = 1; c < layout.colours; ++c) {
        if (std::memcmp(pixel, pixel + static_cast<std::size_t>(c) * sample_bytes, sample_bytes) !=
            0) {
          return false;
        }
      }
    }
  }
  return true;
}

// One picture of the file; `file.bytes` begin with its signature.
Status decode(const EncodedFile& file, SourceFrame& frame) {
  const Context png = make_context(0);
  spng_ihdr header{};
  Bytes rest = file.bytes;
  int error = set_up_reading(png.get(), rest);
  if (error != 0 || (error = spng_get_ihdr(png.get(), &header)) != 0) {
    return damaged(file, "PNG", message_of(error));
  }
  const Layout layout = layout_of(header);
  const auto pixel_bytes = static_cast<std::size_t>(layout.channels * layout.bits / 8);
  if (Status status = check_claim(file, header.width, header.height, pixel_bytes); !status) {
    return status;
  }
  std::vector<std::byte> pixels(pixel_bytes * header.width * header.height);
  error = spng_decode_image(png.get(), pixels.data(), pixels.size(), layout.format, 0);
  if (error != 0 || (error = spng_decode_chunks(png.get())) != 0) {
    return damaged(file, "PNG", message_of(error));
  }
  const auto width = static_cast<int>(header.width);
  const auto height = static_cast<int>(header.height);
  // libspng gives native samples of what PNG says are big endian ones.
  const bool is_swapped = chosen_order(file.order, ByteOrder::kBig) != ByteOrder::kBig;
  SampleStore store({SampleKind::kUnsigned, layout.bits},
                    is_swapped ? other_order(kNativeOrder) : kNativeOrder, width, height, false,
                    frame);
  if (!store_grey(pixels, layout, store, width, height)) {
    return failure(ErrorCode::kUnsupported,
                   file.name + ": a colour picture; frames have a single channel (grey)");
  }
  return store.finish(file);
}

constexpr std::size_t kSignatureBytes = 8;

// Where the picture ends that begins at `begin`: after its IEND chunk, or at the end of the file
// where it was cut off.
std::size_t end_of_picture(Bytes file, std::size_t begin) {
  constexpr std::size_t kAroundData = 12;  // length, name, checksum
  const NumberReader numbers(file, ByteOrder::kBig);
  std::size_t at = begin + kSignatureBytes;
  while (at + kAroundData <= file.size()) {
    const std::size_t length = *numbers.u32(at);
    if (length > file.size() - at - kAroundData) {
      break;
    }
    const bool is_last = std::memcmp(file.data() + at + 4, "IEND", 4) == 0;
    at += kAroundData + length;
    if (is_last) {
      return at;
    }
  }
  return file.size();
}

// Pictures one after the other, as image pipes write them; any other bytes at the end are passed
// over, where cameras put what they have to say besides.
class PngReader final : public PictureReader {
 public:
  explicit PngReader(const EncodedFile& file) : PictureReader(file) {
    std::size_t at = 0;
    do {
      pictures_.push_back(at);
      at = end_of_picture(file.bytes, at);
    } while (format_of(file.bytes.subspan(at)) == FileFormat::kPng);
    bytes_after_ = file.bytes.size() - at;
  }

  [[nodiscard]] std::size_t pages() const override { return pictures_.size(); }
  Status read(std::size_t page, const std::string& name, SourceFrame& frame) override {
    EncodedFile picture = file(name);
    picture.bytes = picture.bytes.subspan(pictures_[page]);
    return decode(picture, frame);
  }
  [[nodiscard]] std::string note() const override {
    return bytes_after_ > 0
               ? std::to_string(bytes_after_) + " bytes after the picture are passed over"
               : "";
  }

 private:
  std::vector<std::size_t> pictures_;  // where they begin
  std::size_t bytes_after_ = 0;
};

}  // namespace

OpenedPicture open_png(const EncodedFile& file) { return std::make_unique<PngReader>(file); }

namespace {

// Sensor noise has next to no repeats to search for: run lengths pack it as well as the full search
// does, in a tenth of the time. 8-bit results are flat and drawn. The Paeth filter would make files
// 3 % (noise) to 15 % (drawings) smaller for a quarter more time.
int set_up_writing(spng_ctx* png, const Samples& samples) {
  constexpr int kQuick = 4;
  const bool noisy = samples.bits == 16;
  const std::pair<spng_option, int> options[] = {
      {SPNG_ENCODE_TO_BUFFER, 1},
      {SPNG_FILTER_CHOICE, noisy ? SPNG_FILTER_CHOICE_SUB : SPNG_FILTER_CHOICE_UP},
      {SPNG_IMG_COMPRESSION_LEVEL, kQuick},
      {SPNG_IMG_COMPRESSION_STRATEGY, noisy ? Z_RLE : Z_DEFAULT_STRATEGY}};
  for (const auto& [option, value] : options) {
    if (const int error = spng_set_option(png, option, value); error != 0) {
      return error;
    }
  }
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(samples.width);
  header.height = static_cast<std::uint32_t>(samples.height);
  header.bit_depth = static_cast<std::uint8_t>(samples.bits);
  header.color_type = samples.channels == 3 ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_GRAYSCALE;
  return spng_set_ihdr(png, &header);
}

int write_rows(spng_ctx* png, const Samples& samples) {
  int error = spng_encode_image(png, nullptr, 0, SPNG_FMT_PNG,
                                SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE);
  for (int y = 0; y < samples.height && error == 0; ++y) {
    error = spng_encode_row(png, samples.row(y), samples.packed_row_bytes());
  }
  return error == SPNG_EOI ? 0 : error;
}

}  // namespace

Result<std::string> encode_png(const Samples& samples, const std::string& name) {
  const Context png = make_context(SPNG_CTX_ENCODER);
  int error = set_up_writing(png.get(), samples);
  if (error == 0) {
    error = write_rows(png.get(), samples);
  }
  std::size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(
      error == 0 ? spng_get_png_buffer(png.get(), &size, &error) : nullptr, &std::free);
  if (bytes == nullptr) {
    return failure(ErrorCode::kUnsupported, name + ": PNG cannot be written: " + message_of(error));
  }
  return std::string(static_cast<const char*>(bytes.get()), size);
}

}  // namespace thermedge::io
