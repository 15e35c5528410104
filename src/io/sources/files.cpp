#include "thermedge/io/files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "sources/input_file.hpp"

namespace thermedge::io {
namespace {

namespace fs = std::filesystem;

// Opening a pipe or a device may wait or act, so the kind is asked for first.
Status check_is_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  switch (status.type()) {
    case fs::file_type::regular:
      return {};
    case fs::file_type::not_found:
      return failure(ErrorCode::kIo, path + ": no such file or directory");
    case fs::file_type::none:
      return failure(ErrorCode::kIo, path + ": cannot be opened: " + error.message());
    case fs::file_type::directory:
      return failure(ErrorCode::kUnsupported, path + ": a directory, not a picture file");
    case fs::file_type::character:
      return failure(ErrorCode::kUnsupported,
                     path +
                         ": a device; pipe a camera in: ffmpeg -f v4l2 -input_format gray16le "
                         "-i DEVICE -f rawvideo - | thermedge ... - --raw-size WxH");
    default:
      return failure(ErrorCode::kUnsupported,
                     path +
                         ": neither a file nor a directory; raw frames may come on standard "
                         "input (-)");
  }
}

}  // namespace

std::string reason_of(int error_number) { return std::generic_category().message(error_number); }

Result<std::vector<std::byte>> read_file(const std::string& path, const Limits& limits) {
  if (Status status = check_is_file(path); !status) {
    return tl::unexpected(status.error());
  }
  auto file = InputFile::open(path);
  if (!file) {
    return tl::unexpected(file.error());
  }
  const std::uint64_t size = file->size_bytes().value_or(0);
  if (size > limits.max_bytes) {
    return failure(ErrorCode::kLimitExceeded, path + ": " + std::to_string(size) +
                                                  " bytes are more than the limit of " +
                                                  std::to_string(limits.max_bytes));
  }
  std::vector<std::byte> bytes(size);
  return file->read(bytes).map([&](std::size_t count) {
    bytes.resize(count);  // should it have been cut in the meantime
    return std::move(bytes);
  });
}

Result<std::vector<std::byte>> first_bytes_of(const std::string& path) {
  constexpr std::size_t kEnough =
      256 * 1024;  // FLIR's part of a JPEG comes after Exif and thumbnail
  if (Status status = check_is_file(path); !status) {
    return tl::unexpected(status.error());
  }
  return InputFile::open(path).and_then([&](InputFile file) {
    std::vector<std::byte> bytes(kEnough);
    return file.read(bytes).map([&](std::size_t count) {
      bytes.resize(count);
      return std::move(bytes);
    });
  });
}

std::string stem_of(const std::string& path) { return fs::path(path).stem().string(); }

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool has_picture_ending(const std::string& path) {
  static constexpr std::array<std::string_view, 6> kEndings = {".png", ".tif", ".tiff",
                                                               ".pgm", ".npy", ".raw"};
  return std::find(kEndings.begin(), kEndings.end(), ending_of(path)) != kEndings.end();
}

bool has_raw_ending(const std::string& path) { return ending_of(path) == ".raw"; }

}  // namespace thermedge::io
