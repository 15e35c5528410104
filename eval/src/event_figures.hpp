// Events that were found against those that there were.
#pragma once

#include <span>

#include "track_index.hpp"

namespace thermedge::eval {

// Sets TracksEvaluation::events and other_events.
void measure_events(std::span<const FramePair> frames, int slack, TracksEvaluation& evaluation);

}  // namespace thermedge::eval
