// Options as text: TOML files and "stage.option=value".
#pragma once

#include <string>
#include <string_view>

#include "thermedge/frame_denoiser.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/options.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// Whether a file may choose the preset, or the caller has done so already.
enum class PresetChoice { kFree, kFixed };

// Changes the options that a TOML file names and leaves the others. A `preset` in the file is
// applied first, whatever its place; where it differs from one that is fixed, that is an error.
// Keys are those of dump_config. Errors name the file, the line and the key: unreadable file, not
// TOML, unknown key, one that only another preset has, wrong type, out of range. On error `options`
// is unchanged. Thread-safe.
// `source` takes the table [source] (source_options.hpp); where it is null, that table is unknown.
[[nodiscard]] Status load_config(const std::string& path, PresetChoice choice,
                                 DetectorOptions& options, SourceOptions* source = nullptr);
[[nodiscard]] Status load_config(const std::string& path, FrameDenoiserOptions& options,
                                 SourceOptions* source = nullptr);

// The same for text; `name` is for messages.
[[nodiscard]] Status parse_config(std::string_view toml, const std::string& name,
                                  PresetChoice choice, DetectorOptions& options);

// Applies one "stage.option=value", e.g. "graph.min_length_px=12" or "denoise.method=nlm".
// Errors name the option; an unknown one is answered with the names that are nearest.
[[nodiscard]] Status apply_setting(std::string_view setting, DetectorOptions& options);
[[nodiscard]] Status apply_setting(std::string_view setting, FrameDenoiserOptions& options);
// Of "source.option=value", e.g. "source.crop=bottom-half", which is_source_setting knows.
[[nodiscard]] Status apply_setting(std::string_view setting, SourceOptions& options);
[[nodiscard]] bool is_source_setting(std::string_view setting);

// All options that the preset has as TOML, each with its meaning as a comment; load_config reads it
// back unchanged.
[[nodiscard]] std::string dump_config(const DetectorOptions& options);
[[nodiscard]] std::string dump_config(const FrameDenoiserOptions& options);

}  // namespace thermedge::io
