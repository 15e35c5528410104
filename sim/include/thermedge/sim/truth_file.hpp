// Ground truth as text.
#pragma once

#include <string>

#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {

// One line of JSON with everything but the pictures; docs/scenes.md lists the fields. Ends with a
// newline. Points are rounded to 1/10000 px.
[[nodiscard]] std::string truth_line(const TrueFrame& frame);

// One line of a trajectory in the TUM format: seconds tx ty tz qx qy qz qw.
[[nodiscard]] std::string trajectory_line(const TrueFrame& frame);

}  // namespace thermedge::sim
