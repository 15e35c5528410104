// The chain of directories, one a page, that runs through a TIFF.
#pragma once

#include <cstdint>
#include <optional>

#include "codecs/codecs.hpp"

namespace thermedge::io {

// Follows the chain without reading what the directories hold. libtiff compares each directory with
// all before it, which makes a recording of thousands of pages slow.
class TiffPageChain {
 public:
  enum class Link { kPage, kEnd, kOutside, kCircle };

  // `file` must stay valid. It may be anything; what is no TIFF has its first page outside.
  explicit TiffPageChain(Bytes file);

  // Goes to the next directory: there is one; the last one was the last; the chain points outside
  // the file, as in one that was cut off; it runs in a circle.
  Link next();
  // Where the directory is that `next` went to.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

 private:
  [[nodiscard]] std::optional<std::uint64_t> number(std::uint64_t at, unsigned bytes) const;
  [[nodiscard]] std::optional<std::uint64_t> link_after(std::uint64_t directory) const;

  Bytes file_;
  bool big_endian_ = false;
  bool big_tiff_ = false;
  std::uint64_t offset_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t milestone_ = 0;  // an earlier offset, to be met again in a circle (Brent)
};

}  // namespace thermedge::io
