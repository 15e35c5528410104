#include "codecs/flir_records.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "codecs/file_format.hpp"
#include "codecs/number_reader.hpp"

namespace thermedge::io {
namespace {

constexpr std::size_t kHeaderBytes = 64;
constexpr std::size_t kEntryBytes = 32;
constexpr std::size_t kRawHeadBytes = 32;

enum RecordType : std::uint32_t { kRawData = 0x01, kCameraInfo = 0x20 };

// Where things lie in the header, in an entry of the directory and in the records.
constexpr std::size_t kVersionAt = 0x14;
constexpr std::size_t kDirectoryAt = 0x18;
constexpr std::size_t kEntryCountAt = 0x1c;
constexpr std::size_t kEntryOffsetAt = 0x0c;
constexpr std::size_t kEntryLengthAt = 0x10;
constexpr std::size_t kWidthAt = 0x02;
constexpr std::size_t kHeightAt = 0x04;
constexpr std::size_t kEmissivityAt = 0x20;
constexpr std::size_t kReflectedAt = 0x28;
constexpr std::size_t kPlanckR1At = 0x58;
constexpr std::size_t kPlanckBAt = 0x5c;
constexpr std::size_t kPlanckFAt = 0x60;
constexpr std::size_t kPlanckOAt = 0x308;
constexpr std::size_t kPlanckR2At = 0x30c;
constexpr std::size_t kTimeAt = 0x384;

// The order in which the version of the format is one that there is.
std::optional<ByteOrder> order_of_block(Bytes block) {
  for (const ByteOrder order : {ByteOrder::kBig, ByteOrder::kLittle}) {
    const auto version = NumberReader(block, order).u32(kVersionAt);
    if (version && *version >= 100 && *version < 200) {
      return order;
    }
  }
  return std::nullopt;
}

// Records begin with the number 2 in their byte order.
std::optional<ByteOrder> order_of_record(Bytes record) {
  for (const ByteOrder order : {ByteOrder::kLittle, ByteOrder::kBig}) {
    if (NumberReader(record, order).u16(0) == 2U) {
      return order;
    }
  }
  return std::nullopt;
}

std::optional<CountsModel> counts_model(const NumberReader& record) {
  const auto r1 = record.f32(kPlanckR1At);
  const auto b = record.f32(kPlanckBAt);
  const auto f = record.f32(kPlanckFAt);
  const auto o = record.u32(kPlanckOAt);
  const auto r2 = record.f32(kPlanckR2At);
  if (!r1 || !b || !f || !o || !r2) {
    return std::nullopt;
  }
  const PlanckResponse black_body{*r1, *b, *f, static_cast<double>(static_cast<std::int32_t>(*o)),
                                  *r2};
  const auto emissivity = record.f32(kEmissivityAt);
  const auto reflected_k = record.f32(kReflectedAt);
  const auto model =
      grey_body_response(black_body, emissivity.value_or(1),
                         reflected_k.value_or(kKelvinAtZeroCelsius) - kKelvinAtZeroCelsius)
          .and_then([](const PlanckResponse& response) { return CountsModel::create(response); });
  return model ? std::optional(*model) : std::nullopt;
}

std::optional<std::int64_t> stamp_ns(const NumberReader& record) {
  constexpr std::int64_t kNsPerSecond = 1000000000;
  constexpr std::int64_t kNsPerMs = 1000000;
  const auto seconds = record.u32(kTimeAt);
  const auto fraction = record.u32(kTimeAt + 4);
  if (!seconds || !fraction || *seconds == 0) {
    return std::nullopt;
  }
  const std::int64_t ms = *fraction & 0xFFFFU;
  return *seconds * kNsPerSecond + (ms < 1000 ? ms * kNsPerMs : 0);
}

struct Segment {
  std::uint8_t marker = 0;
  Bytes data;
  std::size_t end = 0;
};

// The JPEG segment at `at`; nothing after the last one before the picture.
std::optional<Segment> segment_at(Bytes jpeg, std::size_t at) {
  constexpr std::uint8_t kStartOfScan = 0xDA;
  constexpr std::uint8_t kEndOfImage = 0xD9;
  if (at >= jpeg.size() || jpeg[at] != std::byte{0xFF}) {
    return std::nullopt;
  }
  while (at < jpeg.size() && jpeg[at] == std::byte{0xFF}) {
    ++at;  // any number of them may come before a marker
  }
  if (at >= jpeg.size()) {
    return std::nullopt;
  }
  const auto marker = std::to_integer<std::uint8_t>(jpeg[at]);
  const auto length = NumberReader(jpeg, ByteOrder::kBig).u16(at + 1);
  if (marker == kStartOfScan || marker == kEndOfImage || !length || *length < 2 ||
      jpeg.size() - at - 1 < *length) {
    return std::nullopt;
  }
  return Segment{marker, jpeg.subspan(at + 3, *length - 2), at + 1 + *length};
}

constexpr std::size_t kFirstSegmentAt = 2;
constexpr std::size_t kPartHeadBytes = 8;  // "FLIR", 0, 1, number of the part, number of the last

bool is_flir_part(const Segment& segment) {
  constexpr std::uint8_t kApp1 = 0xE1;
  return segment.marker == kApp1 && segment.data.size() > kPartHeadBytes &&
         std::memcmp(segment.data.data(), "FLIR\0", 5) == 0;
}

}  // namespace

Result<FlirBlock> read_flir_block(const EncodedFile& file, std::size_t begin) {
  const Bytes block = file.bytes.subspan(begin);
  const auto order = order_of_block(block);
  if (format_of(block) != FileFormat::kFff || !order || block.size() < kHeaderBytes) {
    return damaged(file, "FLIR file", "its header is not one of an FFF");
  }
  const NumberReader numbers(block, *order);
  const std::size_t directory = *numbers.u32(kDirectoryAt);
  const std::size_t entries = *numbers.u32(kEntryCountAt);
  if (directory > block.size() || entries > (block.size() - directory) / kEntryBytes) {
    return damaged(file, "FLIR file", "its list of records lies past the end of the file");
  }
  FlirBlock found;
  found.end = std::max(kHeaderBytes, directory + entries * kEntryBytes);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + i * kEntryBytes;
    const std::uint32_t type = *numbers.u16(entry);
    const std::size_t offset = *numbers.u32(entry + kEntryOffsetAt);
    const std::size_t length = *numbers.u32(entry + kEntryLengthAt);
    if (type == 0) {
      continue;  // unused
    }
    if (offset > block.size() || length > block.size() - offset) {
      return damaged(file, "FLIR file",
                     "record " + std::to_string(i) + " lies past the end of the file");
    }
    found.end = std::max(found.end, offset + length);
    Bytes* const wanted = type == kRawData      ? &found.raw
                          : type == kCameraInfo ? &found.camera_info
                                                : nullptr;
    if (wanted != nullptr && wanted->empty()) {
      *wanted = block.subspan(offset, length);
    }
  }
  found.end += begin;
  return found;
}

Result<FlirRaw> read_flir_raw(const EncodedFile& file, Bytes record) {
  const auto order = order_of_record(record);
  if (record.size() <= kRawHeadBytes || !order) {
    return damaged(file, "FLIR file", "it has no record of a raw picture");
  }
  const NumberReader numbers(record, *order);
  return FlirRaw{*numbers.u16(kWidthAt), *numbers.u16(kHeightAt), *order,
                 record.subspan(kRawHeadBytes)};
}

FlirCamera read_flir_camera(Bytes record) {
  const auto order = order_of_record(record);
  if (!order) {
    return {};
  }
  const NumberReader numbers(record, *order);
  return {counts_model(numbers), stamp_ns(numbers)};
}

Result<std::vector<std::byte>> flir_of_jpeg(const EncodedFile& file) {
  std::vector<Bytes> parts;
  for (auto segment = segment_at(file.bytes, kFirstSegmentAt); segment;
       segment = segment_at(file.bytes, segment->end)) {
    if (!is_flir_part(*segment)) {
      continue;
    }
    const auto number = std::to_integer<std::size_t>(segment->data[6]);
    const auto last = std::to_integer<std::size_t>(segment->data[7]);
    parts.resize(std::max({parts.size(), number + 1, last + 1}));
    if (parts[number].empty()) {
      parts[number] = segment->data.subspan(kPartHeadBytes);
    }
  }
  std::vector<std::byte> joined;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].empty()) {
      return damaged(file, "FLIR JPEG",
                     "part " + std::to_string(i + 1) + " of " + std::to_string(parts.size()) +
                         " of its raw picture is missing");
    }
    joined.insert(joined.end(), parts[i].begin(), parts[i].end());
  }
  return joined;
}

bool has_flir(Bytes first_bytes) {
  for (auto segment = segment_at(first_bytes, kFirstSegmentAt); segment;
       segment = segment_at(first_bytes, segment->end)) {
    if (is_flir_part(*segment)) {
      return true;
    }
  }
  return false;
}

}  // namespace thermedge::io
