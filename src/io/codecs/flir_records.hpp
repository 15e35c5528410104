// The records of a FLIR FFF file: what a camera stores beside each other about one picture. A SEQ
// file is many of them, one after the other, and a radiometric JPEG has one in its APP1 segments.
//
// After the public description of the format by ExifTool (Image::ExifTool::FLIR).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "codecs/codecs.hpp"
#include "thermedge/radiometry/planck.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// The record of the raw picture.
struct FlirRaw {
  std::uint32_t width = 0;   // px
  std::uint32_t height = 0;  // px
  ByteOrder order = ByteOrder::kLittle;
  Bytes data;  // after the head of the record
};

// One FFF: the records that are used, and where it ends.
struct FlirBlock {
  Bytes raw;            // whole record; empty: none
  Bytes camera_info;    // whole record; empty: none
  std::size_t end = 0;  // in the file, after the last record
};

// The block that begins at `begin`. Fails where it is no FFF or where its records do not lie within
// the file.
[[nodiscard]] Result<FlirBlock> read_flir_block(const EncodedFile& file, std::size_t begin);

[[nodiscard]] Result<FlirRaw> read_flir_raw(const EncodedFile& file, Bytes record);

struct FlirCamera {
  std::optional<CountsModel> counts_model;  // for the emissivity and reflected temperature stored
  std::optional<std::int64_t> stamp_ns;     // since 1970 UTC
};
// What is missing or makes no sense stays unknown.
[[nodiscard]] FlirCamera read_flir_camera(Bytes record);

// The FFF in the APP1 segments of a JPEG; empty where it has none. Fails where parts are missing.
[[nodiscard]] Result<std::vector<std::byte>> flir_of_jpeg(const EncodedFile& file);
// Whether the first bytes of a JPEG have the beginning of one.
[[nodiscard]] bool has_flir(Bytes first_bytes);

}  // namespace thermedge::io
