#include "codecs/tiff_pages.hpp"

#include <bit>

namespace thermedge::io {
namespace {

// Sizes in bytes: classic TIFF, BigTIFF.
constexpr unsigned kOffsetBytes[] = {4, 8};
constexpr unsigned kEntryCountBytes[] = {2, 8};
constexpr unsigned kEntryBytes[] = {12, 20};

// Of a number of this type; 0: not a whole number without sign.
unsigned bytes_of_type(std::uint64_t type) {
  switch (type) {
    case 1:  // byte
    case 2:  // text
      return 1;
    case 3:
      return 2;
    case 4:
    case 13:  // directory
      return 4;
    case 16:
    case 18:
      return 8;
    default:
      return 0;
  }
}

}  // namespace

TiffPageChain::TiffPageChain(Bytes file) : file_(file) {
  order_ = !file.empty() && file[0] == std::byte{'M'} ? ByteOrder::kBig : ByteOrder::kLittle;
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

std::optional<std::uint64_t> TiffPageChain::entries_of(std::uint64_t directory) const {
  const auto entries = number(directory, kEntryCountBytes[big_tiff_]);
  return entries && *entries <= file_.size() / kEntryBytes[big_tiff_] ? entries : std::nullopt;
}

std::optional<std::uint64_t> TiffPageChain::link_after(std::uint64_t directory) const {
  const auto entries = entries_of(directory);
  if (!entries) {
    return std::nullopt;
  }
  const std::uint64_t end =
      directory + kEntryCountBytes[big_tiff_] + *entries * kEntryBytes[big_tiff_];
  return number(end, kOffsetBytes[big_tiff_]);
}

std::optional<TiffPageChain::Entry> TiffPageChain::find(std::uint64_t directory,
                                                        std::uint16_t tag) const {
  const std::uint64_t entries = entries_of(directory).value_or(0);
  const unsigned offset_bytes = kOffsetBytes[big_tiff_];
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::uint64_t at = directory + kEntryCountBytes[big_tiff_] + i * kEntryBytes[big_tiff_];
    if (number(at, 2) != tag) {
      continue;
    }
    const auto type = number(at + 2, 2);
    const auto count = number(at + 4, offset_bytes);
    const std::uint64_t value_at = at + 4 + offset_bytes;
    if (!type || !count || *count == 0 || bytes_of_type(*type) == 0) {
      return std::nullopt;
    }
    if (*count <= offset_bytes / bytes_of_type(*type)) {
      return Entry{*type, *count, value_at};
    }
    const auto data_at = number(value_at, offset_bytes);
    return data_at ? std::optional(Entry{*type, *count, *data_at}) : std::nullopt;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> TiffPageChain::first_number(std::uint64_t directory,
                                                         std::uint16_t tag) const {
  const auto entry = find(directory, tag);
  return entry ? number(entry->data_at, bytes_of_type(entry->type)) : std::nullopt;
}

std::string_view TiffPageChain::text(std::uint64_t directory, std::uint16_t tag) const {
  const auto entry = find(directory, tag);
  if (!entry || bytes_of_type(entry->type) != 1 || entry->data_at > file_.size() ||
      file_.size() - entry->data_at < entry->count) {
    return {};
  }
  return {reinterpret_cast<const char*>(file_.data()) + entry->data_at, entry->count};
}

}  // namespace thermedge::io
