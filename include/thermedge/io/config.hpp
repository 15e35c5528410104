// Options as text: TOML files and "stage.option=value".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "thermedge/frame_denoiser.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/options.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// Whether a file may choose the preset, or the caller has done so already.
enum class PresetChoice { kFree, kFixed };

// Changes the options that a TOML file names and leaves the others. A `preset` in the file is
// applied first, whatever its place. Where another preset is fixed, the file changes of that one
// what it changes of its own: a file of dump_config, which holds every option, then leaves the
// fixed preset as it is but for the options that were changed before the dump.
// Keys are those of dump_config. Errors name the file, the line and the key: unreadable file, not
// TOML, unknown key, one that only another preset has, wrong type, out of range. Whether options go
// together is left to DetectorOptions::check(), as more of them may follow. On error `options` is
// unchanged. An empty file changes nothing. Thread-safe.
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

// An option as `--set name=value` takes it.
struct OptionInfo {
  std::string name;                  // "denoise.method"
  std::string value;                 // the default
  std::string help;                  // its meaning, unit and range
  std::vector<std::string> choices;  // all values, where they are names; else empty
};

// The options of the detector under any preset, with the defaults of the first preset that has
// them.
[[nodiscard]] std::vector<OptionInfo> list_options();

// All options that the preset has as TOML, each with its meaning as a comment; load_config reads it
// back unchanged.
[[nodiscard]] std::string dump_config(const DetectorOptions& options);
[[nodiscard]] std::string dump_config(const FrameDenoiserOptions& options);

}  // namespace thermedge::io
