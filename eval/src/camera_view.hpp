// How pictures move when their camera turns.
#pragma once

#include <optional>

#include "thermedge/eval/tracks.hpp"

namespace thermedge::eval {

// Where a far point that camera `from` sees at `point` is seen by camera `to`; nothing where it is
// behind it. Thread-safe.
[[nodiscard]] std::optional<Point> turned(Point point, const CameraView& from,
                                          const CameraView& to);

}  // namespace thermedge::eval
