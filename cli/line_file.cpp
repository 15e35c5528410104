#include "line_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "thermedge/io/files.hpp"

namespace thermedge::cli {

LineFile::LineFile(LineFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

LineFile& LineFile::operator=(LineFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

LineFile::~LineFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

tl::unexpected<Error> LineFile::error(int reason) const {
  return failure(ErrorCode::kIo, path_ + ": cannot be written: " + io::reason_of(reason));
}

Status LineFile::open() {
  const std::filesystem::path directory = std::filesystem::path(path_).parent_path();
  std::error_code failed;
  if (!directory.empty()) {
    std::filesystem::create_directories(directory, failed);
  }
  if (failed) {
    return error(failed.value());
  }
  constexpr mode_t kAccess = 0666;  // less what the user's umask takes away
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, kAccess);
  return descriptor_ >= 0 ? Status() : error(errno);
}

Status LineFile::write(std::string_view lines) {
  if (descriptor_ < 0) {
    if (Status status = open(); !status) {
      return status;
    }
  }
  const off_t length_before = ::lseek(descriptor_, 0, SEEK_END);  // of a pipe: -1
  while (!lines.empty()) {
    const ssize_t count = ::write(descriptor_, lines.data(), lines.size());
    if (count >= 0) {
      lines.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      const int reason = errno;
      const bool is_cut = length_before >= 0 && ::ftruncate(descriptor_, length_before) == 0;
      auto failed = error(reason);
      if (length_before >= 0 && !is_cut) {
        failed.value().message += ", and its last line is not whole";
      }
      return failed;
    }
  }
  return {};
}

}  // namespace thermedge::cli
