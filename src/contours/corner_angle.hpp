// The angle of a curve at a corner (paper eq. 11).
#pragma once

#include <cstddef>
#include <span>

namespace thermedge::detail {

// Angle between the tangents of the two arms of a smoothed curve at sample `corner`, degrees: 180
// where the curve goes straight on. The tangent of an arm is that of the circle through its first,
// middle and last sample. The two directions are subtracted as they are, so that the result lies in
// 0..540: the public code of He & Yung does not reduce it either.
[[nodiscard]] double corner_angle_deg(std::span<const double> rows, std::span<const double> columns,
                                      std::size_t corner);

}  // namespace thermedge::detail
