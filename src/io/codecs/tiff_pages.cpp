#include "codecs/tiff_pages.hpp"

#include <bit>

namespace thermedge::io {
namespace {

// Sizes in bytes: classic TIFF, BigTIFF.
constexpr unsigned kOffsetBytes[] = {4, 8};
constexpr unsigned kEntryCountBytes[] = {2, 8};
constexpr unsigned kEntryBytes[] = {12, 20};

}  // namespace

TiffPageChain::TiffPageChain(Bytes file) : file_(file) {
  big_endian_ = !file.empty() && file[0] == std::byte{'M'};
  big_tiff_ = number(2, 2) == 43U;
}

TiffPageChain::Link TiffPageChain::next() {
  const auto link =
      steps_ == 0 ? number(kOffsetBytes[big_tiff_], kOffsetBytes[big_tiff_]) : link_after(offset_);
  if (!link) {
    return Link::kOutside;
  }
  if (*link == 0) {
    return Link::kEnd;
  }
  if (!number(*link, kEntryCountBytes[big_tiff_])) {
    return Link::kOutside;
  }
  if (*link == milestone_) {
    return Link::kCircle;
  }
  offset_ = *link;
  if (std::has_single_bit(++steps_)) {
    milestone_ = offset_;
  }
  return Link::kPage;
}

std::optional<std::uint64_t> TiffPageChain::number(std::uint64_t at, unsigned bytes) const {
  if (at > file_.size() || file_.size() - at < bytes) {
    return std::nullopt;
  }
  std::uint64_t value = 0;
  for (unsigned i = 0; i < bytes; ++i) {
    const std::byte next = file_[at + (big_endian_ ? i : bytes - 1 - i)];
    value = value << 8 | std::to_integer<std::uint64_t>(next);
  }
  return value;
}

std::optional<std::uint64_t> TiffPageChain::link_after(std::uint64_t directory) const {
  const auto entries = number(directory, kEntryCountBytes[big_tiff_]);
  if (!entries || *entries > file_.size() / kEntryBytes[big_tiff_]) {
    return std::nullopt;
  }
  const std::uint64_t end =
      directory + kEntryCountBytes[big_tiff_] + *entries * kEntryBytes[big_tiff_];
  return number(end, kOffsetBytes[big_tiff_]);
}

}  // namespace thermedge::io
