// One page of a TIFF.
#pragma once

#include <cstdint>
#include <optional>

#include "codecs/codecs.hpp"
#include "codecs/samples.hpp"

namespace thermedge::io {

// Samples by the numbers of the tags SampleFormat and BitsPerSample; nothing where they are not
// read.
[[nodiscard]] std::optional<SampleFormat> sample_format(std::uint64_t kind, std::uint64_t bits);

// Decodes the page whose directory lies at `offset` of a file of this byte order.
[[nodiscard]] Status decode_tiff_directory(const EncodedFile& file, std::uint64_t offset,
                                           ByteOrder order, SourceFrame& frame);

}  // namespace thermedge::io
