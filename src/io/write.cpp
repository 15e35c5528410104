#include "thermedge/io/write.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>

#include "io/codecs.hpp"

namespace thermedge::io {
namespace {

Error write_error(const std::string& path) {
  return {ErrorCode::kIo, path + ": cannot be written: " + std::strerror(errno)};
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) {
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  return true;
}

template <class T>
Samples samples_of(ImageView<const T> picture) {
  constexpr bool colour = std::is_same_v<T, Rgb>;
  return {.data = picture.data(),
          .row_bytes = static_cast<std::size_t>(picture.stride()) * sizeof(T),
          .width = picture.width(),
          .height = picture.height(),
          .bits = colour ? 8 : static_cast<int>(8 * sizeof(T)),
          .channels = colour ? 3 : 1};
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Result<std::string> encode(const Samples& samples, const std::string& path) {
  const std::string ending = ending_of(path);
  if (samples.width == 0 || samples.height == 0) {
    return failure(ErrorCode::kInvalidArgument, path + ": a picture without pixels");
  }
  if (ending == ".png") {
    return encode_png(samples, path);
  }
  if (samples.channels == 1) {
    if (ending == ".tif" || ending == ".tiff") {
      return encode_tiff(samples, path);
    }
    if (ending == ".pgm") {
      return encode_pgm(samples);
    }
    if (ending == ".npy") {
      return encode_npy(samples);
    }
    if (ending == ".raw") {
      return encode_raw(samples);
    }
  }
  return failure(ErrorCode::kInvalidArgument,
                 path + ": the name should end in .png" +
                     (samples.channels == 1 ? ", .tif, .tiff, .pgm, .npy or .raw" : ""));
}

Status write_samples(const std::string& path, const Samples& samples) {
  try {
    return encode(samples, path).and_then([&](const std::string& bytes) {
      return write_file(path, bytes);
    });
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, path + ": out of memory");
  }
}

}  // namespace

Status write_file(const std::string& path, std::string_view bytes) {
  const std::string beside = path + "." + std::to_string(::getpid()) + ".tmp";
  constexpr mode_t kAccess = 0666;  // less what the user's umask takes away
  const int file = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kAccess);
  if (file < 0) {
    return tl::unexpected(write_error(path));
  }
  bool good = write_all(file, bytes);
  good = ::close(file) == 0 && good;
  if (good && std::rename(beside.c_str(), path.c_str()) == 0) {
    return {};
  }
  Error error = write_error(path);
  ::unlink(beside.c_str());
  return tl::unexpected(std::move(error));
}

Status write_picture(const std::string& path, ImageView<const std::uint8_t> picture) {
  return write_samples(path, samples_of(picture));
}

Status write_picture(const std::string& path, ImageView<const std::uint16_t> picture) {
  return write_samples(path, samples_of(picture));
}

Status write_picture(const std::string& path, ImageView<const Rgb> picture) {
  return write_samples(path, samples_of(picture));
}

}  // namespace thermedge::io
