// A file or standard input, read from front to back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "thermedge/result.hpp"

namespace thermedge::io {

// Reads through the descriptor itself: with stdio's buffer in between, a frame could wait for bytes
// of the next one.
class InputFile {
 public:
  // "-" is standard input; it is not closed at the end.
  [[nodiscard]] static Result<InputFile> open(const std::string& path);

  InputFile(InputFile&& other) noexcept
      : name_(std::move(other.name_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  InputFile& operator=(InputFile&&) = delete;
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  // Fills `bytes`, waiting for them where need be, and takes none after them. Gives their number,
  // which is less than asked for only at the end of the file.
  [[nodiscard]] Result<std::size_t> read(std::span<std::byte> bytes);

  // For messages: the path, or "standard input".
  [[nodiscard]] const std::string& name() const { return name_; }
  // Nothing where it is not known beforehand, as with a pipe.
  [[nodiscard]] std::optional<std::uint64_t> size_bytes() const;

 private:
  InputFile(std::string name, int descriptor) : name_(std::move(name)), descriptor_(descriptor) {}

  std::string name_;
  int descriptor_;
};

// The beginning of a file, as much as tells its kind. Errors: it is no regular file, or unreadable.
[[nodiscard]] Result<std::vector<std::byte>> first_bytes_of(const std::string& path);

}  // namespace thermedge::io
