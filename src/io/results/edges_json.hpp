// The JSON of a frame's edges, for files that have more of each frame.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "thermedge/io/edges_file.hpp"

namespace thermedge::io {

// What edges_to_json writes.
[[nodiscard]] nlohmann::ordered_json frame_json(const Detection& detection,
                                                const std::string& source,
                                                const EdgesFileOptions& options);

// As one line, with a newline.
[[nodiscard]] std::string json_line(const nlohmann::ordered_json& document);

}  // namespace thermedge::io
