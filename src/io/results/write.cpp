#include "thermedge/io/write.hpp"

#include <string_view>
#include <type_traits>

#include "codecs/codecs.hpp"
#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/io/files.hpp"

namespace thermedge::io {
namespace {

template <class T>
Samples samples_of(ImageView<const T> picture) {
  constexpr bool kColour = std::is_same_v<T, Rgb>;
  return {.data = picture.data(),
          .row_bytes = static_cast<std::size_t>(picture.stride()) * sizeof(T),
          .width = picture.width(),
          .height = picture.height(),
          .bits = kColour ? 8 : static_cast<int>(8 * sizeof(T)),
          .channels = kColour ? 3 : 1};
}

// The endings that a picture of these samples may have.
std::string_view endings_of(const Samples& samples) {
  return samples.channels != 1 ? ".png"
         : samples.bits == 32  ? ".tif, .tiff, .npy or .raw, which hold float values"
                               : ".png, .tif, .tiff, .pgm, .npy or .raw";
}

Result<std::string> encode(const Samples& samples, const std::string& path) {
  const std::string ending = ending_of(path);
  const bool grey = samples.channels == 1;
  const bool whole = samples.bits != 32;
  if (samples.width == 0 || samples.height == 0) {
    return failure(ErrorCode::kInvalidArgument, path + ": a picture without pixels");
  }
  if (whole && ending == ".png") {
    return encode_png(samples, path);
  }
  if (grey && (ending == ".tif" || ending == ".tiff")) {
    return encode_tiff(samples, path);
  }
  if (grey && whole && ending == ".pgm") {
    return encode_pgm(samples);
  }
  if (grey && ending == ".npy") {
    return encode_npy(samples);
  }
  if (grey && ending == ".raw") {
    std::string bytes;
    append_samples(samples, ByteOrder::kLittle, bytes);
    return bytes;
  }
  return failure(ErrorCode::kInvalidArgument,
                 path + ": the name should end in " + std::string(endings_of(samples)));
}

Status write_samples(const std::string& path, const Samples& samples) {
  return catch_bad_alloc(path, [&] {
    return encode(samples, path).and_then([&](const std::string& bytes) {
      return write_file(path, bytes);
    });
  });
}

}  // namespace

Status write_picture(const std::string& path, ImageView<const std::uint8_t> picture) {
  return write_samples(path, samples_of(picture));
}

Status write_picture(const std::string& path, ImageView<const std::uint16_t> picture) {
  return write_samples(path, samples_of(picture));
}

Status write_picture(const std::string& path, ImageView<const float> picture) {
  return write_samples(path, samples_of(picture));
}

Status write_picture(const std::string& path, ImageView<const Rgb> picture) {
  return write_samples(path, samples_of(picture));
}

}  // namespace thermedge::io
