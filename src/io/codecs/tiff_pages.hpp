// The chain of directories, one a page, that runs through a TIFF, and single tags in them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "codecs/codecs.hpp"
#include "codecs/number_reader.hpp"

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

  // The first number of a tag of the directory at `directory`: bytes, whole numbers of 16, 32 or 64
  // bits. Nothing where there is no such tag, or it lies outside the file.
  [[nodiscard]] std::optional<std::uint64_t> first_number(std::uint64_t directory,
                                                          std::uint16_t tag) const;
  // The bytes of a text; empty where there is none.
  [[nodiscard]] std::string_view text(std::uint64_t directory, std::uint16_t tag) const;

  [[nodiscard]] ByteOrder byte_order() const { return order_; }

 private:
  struct Entry {
    std::uint64_t type = 0;
    std::uint64_t count = 0;
    std::uint64_t data_at = 0;
  };

  [[nodiscard]] std::optional<std::uint64_t> number(std::uint64_t at, unsigned bytes) const {
    return NumberReader(file_, order_).number(at, bytes);
  }
  [[nodiscard]] std::optional<std::uint64_t> entries_of(std::uint64_t directory) const;
  [[nodiscard]] std::optional<std::uint64_t> link_after(std::uint64_t directory) const;
  [[nodiscard]] std::optional<Entry> find(std::uint64_t directory, std::uint16_t tag) const;

  Bytes file_;
  ByteOrder order_ = ByteOrder::kLittle;
  bool big_tiff_ = false;
  std::uint64_t offset_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t milestone_ = 0;  // an earlier offset, to be met again in a circle (Brent)
};

}  // namespace thermedge::io
