// Higher-order tracking accuracy of samples of curves.
#pragma once

#include <span>

#include "thermedge/eval/tracks.hpp"
#include "track_frame.hpp"

namespace thermedge::eval {

// Source: Luiten et al. (2020), with several detections of one identity in a frame, all of which
// count. The frames' assignments are tasks of `runner`.
[[nodiscard]] HotaFigures measure_hota(std::span<const FrameSamples* const> frames,
                                       ParallelRunner& runner);

}  // namespace thermedge::eval
