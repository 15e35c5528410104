#include "sources/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "thermedge/io/files.hpp"

namespace thermedge::io {

Result<InputFile> InputFile::open(const std::string& path) {
  if (path == "-") {
    return InputFile("standard input", STDIN_FILENO);
  }
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return failure(ErrorCode::kIo, path + ": cannot be opened: " + reason_of(errno));
  }
  return InputFile(path, descriptor);
}

InputFile::~InputFile() {
  if (descriptor_ > STDIN_FILENO) {
    ::close(descriptor_);
  }
}

Result<std::size_t> InputFile::read(std::span<std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count == 0) {
      break;
    }
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      return failure(ErrorCode::kIo, name_ + ": cannot be read: " + reason_of(errno));
    }
  }
  return done;
}

std::optional<std::uint64_t> InputFile::size_bytes() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace thermedge::io
