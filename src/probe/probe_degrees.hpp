// Whether temperatures that a camera's response gives can be those of a recording.
#pragma once

#include "thermedge/probe/probe.hpp"

namespace thermedge::detail {

// Fills the degrees of a report whose counts and noise are known. `low_counts` and `high_counts`:
// between which most of the pixels lie.
void fill_degrees(const ProbeOptions& options, int low_counts, int high_counts,
                  RecordingReport& report);

}  // namespace thermedge::detail
