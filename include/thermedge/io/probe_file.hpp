// The properties of a recording as text: JSON, and the suggested options as TOML.
#pragma once

#include <string>
#include <vector>

#include "thermedge/probe/probe.hpp"

namespace thermedge::io {

// One object with everything in the report; units are in the names, shares are parts of 1, null
// stands for what the recording can't tell. `inputs`: what was looked at, as the user named it.
[[nodiscard]] std::string probe_to_json(const RecordingReport& report,
                                        const std::vector<std::string>& inputs);

// The suggested options, each with its reason as a comment, as load_config reads them. Valid, and
// without options, where the defaults suit.
[[nodiscard]] std::string suggested_toml(const RecordingReport& report);

}  // namespace thermedge::io
