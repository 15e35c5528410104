// The properties of a recording in plain words.
#pragma once

#include <string>

#include "thermedge/probe/probe.hpp"

namespace thermedge::cli {

// A page of at most 100 columns (a long `name` apart) that ends with the suggested options.
[[nodiscard]] std::string probe_page(const RecordingReport& report, const std::string& name);

}  // namespace thermedge::cli
