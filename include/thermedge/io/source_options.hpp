// Options of sources as text: the table [source] of a TOML file, --set source.crop=..., flags.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "thermedge/io/source.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// Sets one option from text:
//   crop                    all, top-half, bottom-half or X,Y,WIDTH,HEIGHT
//   byte_order              format, little, big or swapped
//   raw_size                WIDTHxHEIGHT; empty: not given
//   raw_format              gray16le, gray16be, gray8, grayf32le or grayf32be
//   raw_header_bytes, raw_frame_header_bytes   whole numbers
// Errors say what would be right, for a message that begins with the option and the text; `options`
// is unchanged then. Thread-safe.
[[nodiscard]] Status set_source_option(std::string_view key, std::string_view text,
                                       SourceOptions& options);

// Their names, in this order.
[[nodiscard]] std::vector<std::string> source_option_names();

// All of them as a TOML table, each with its meaning as a comment.
[[nodiscard]] std::string dump_source_options(const SourceOptions& options);

}  // namespace thermedge::io
