// Which true edge carries which identity, over a sequence.
#pragma once

#include <span>

#include "track_frame.hpp"

namespace thermedge::eval {

[[nodiscard]] IdentityFigures measure_identities(std::span<const FrameFigures> frames,
                                                 const TrackIndex& index);

// `counts`: whether each of the frames is a measurement.
[[nodiscard]] GapFigures measure_gaps(std::span<const FrameFigures> frames,
                                      const std::vector<bool>& counts);

}  // namespace thermedge::eval
