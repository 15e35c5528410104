// Options as text: TOML files and "stage.option=value".
#pragma once

#include <string>
#include <string_view>

#include "thermedge/options.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// Changes the options that a TOML file names and leaves the others. A `preset` in the file is
// applied first, whatever its place. Keys are those of dump_config. Errors name the file, the line
// and the key: unreadable file, not TOML, unknown key, wrong type, out of range. On error `options`
// is unchanged. Thread-safe.
[[nodiscard]] Status load_config(const std::string& path, DetectorOptions& options);

// The same for text; `name` is for messages.
[[nodiscard]] Status parse_config(std::string_view toml, const std::string& name,
                                  DetectorOptions& options);

// Applies one "stage.option=value", e.g. "contours.gap_px=2" or "denoise.method=nlm".
// Errors name the option; an unknown one is answered with the names that are nearest.
[[nodiscard]] Status apply_setting(std::string_view setting, DetectorOptions& options);

// All options as TOML, each with its meaning as a comment; load_config reads it back unchanged.
[[nodiscard]] std::string dump_config(const DetectorOptions& options);

}  // namespace thermedge::io
