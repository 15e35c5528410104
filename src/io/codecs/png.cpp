#include <spng.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "codecs/codecs.hpp"

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

// Takes the first colour; false where another one differs.
template <class T>
bool take_grey(const std::vector<std::byte>& pixels, const Layout& layout,
               ImageView<std::uint16_t> counts) {
  const auto channels = static_cast<std::size_t>(layout.channels);
  const std::byte* pixel = pixels.data();
  for (int y = 0; y < counts.height(); ++y) {
    std::uint16_t* row = counts.row(y);
    for (int x = 0; x < counts.width(); ++x, pixel += channels * sizeof(T)) {
      T sample[4];
      std::memcpy(sample, pixel, channels * sizeof(T));
      if (std::any_of(sample, sample + layout.colours, [&](T s) { return s != sample[0]; })) {
        return false;
      }
      row[x] = sample[0];
    }
  }
  return true;
}

}  // namespace

Status decode_png(const EncodedFile& file, SourceFrame& frame) {
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
  frame.bits = layout.bits;
  frame.counts.resize(static_cast<int>(header.width), static_cast<int>(header.height));
  const bool grey = frame.bits == 16 ? take_grey<std::uint16_t>(pixels, layout, frame.counts)
                                     : take_grey<std::uint8_t>(pixels, layout, frame.counts);
  if (!grey) {
    return failure(ErrorCode::kUnsupported,
                   file.name + ": a colour picture; frames have a single channel (grey)");
  }
  return {};
}

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
