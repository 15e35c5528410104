// Replaces a file whole or not at all.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/io/files.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::io {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> write_error(const std::string& path, const std::string& reason) {
  return failure(ErrorCode::kIo, path + ": cannot be written: " + reason);
}

// An open file for writing.
class OutputFile {
 public:
  OutputFile(const fs::path& path, int flags) {
    constexpr mode_t kAccess = 0666;  // less what the user's umask takes away
    descriptor_ = ::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC, kAccess);
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile() { close(); }

  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }

  // False, with `errno` set, on failure.
  bool write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno != EINTR) {
        return false;
      }
      bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
    return true;
  }
  // Some file systems tell only here that the disk is full.
  bool close() { return !is_open() || ::close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_ = -1;
};

// A name that no file has yet; hidden, so that nobody takes a half-written file for a picture.
fs::path name_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() / (".thermedge-" + std::to_string(::getpid()) + "-" +
                                 std::to_string(counter.fetch_add(1)) + ".tmp");
}

Status replace(const std::string& path, const fs::path& target, std::string_view bytes) {
  constexpr int kAttempts = 100;  // names that a killed process may have left
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const fs::path beside = name_beside(target);
    OutputFile file(beside, O_CREAT | O_EXCL);
    if (!file.is_open() && errno == EEXIST) {
      continue;
    }
    if (!file.is_open()) {
      return write_error(path, reason_of(errno));
    }
    const bool good =
        file.write(bytes) && file.close() && std::rename(beside.c_str(), target.c_str()) == 0;
    if (!good) {
      const int reason = errno;
      ::unlink(beside.c_str());
      return write_error(path, reason_of(reason));
    }
    return {};
  }
  return write_error(path, "temporary files of earlier runs are in the way");
}

// A device or a pipe has nothing to replace.
Status write_into(const std::string& path, std::string_view bytes) {
  OutputFile file(path, 0);
  if (!file.is_open() || !file.write(bytes) || !file.close()) {
    return write_error(path, reason_of(errno));
  }
  return {};
}

Status write_to(const std::string& path, std::string_view bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    return write_error(path, "it is a directory");
  }
  if (fs::is_other(status)) {
    return write_into(path, bytes);
  }
  // Through a symbolic link, the file that it points to is replaced.
  const fs::path target =
      fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : fs::path(path);
  const fs::path directory = target.has_parent_path() ? target.parent_path() : ".";
  if (!fs::exists(directory, error)) {
    return write_error(path, "there is no directory " + directory.string());
  }
  return replace(path, target, bytes);
}

}  // namespace

Status write_file(const std::string& path, std::string_view bytes) {
  return catch_bad_alloc(path, [&] { return write_to(path, bytes); });
}

}  // namespace thermedge::io
