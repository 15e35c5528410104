// Where the camera is in each frame.
#pragma once

#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {

// The pose of frame `index`. hand: looks about by up to 6 px of the plain camera and sways by
// 1.5 cm; starts at the viewpoint. drive: along the waypoints there and back, or straight ahead for
// 3 m and back, eyes in the direction of the way out, with the bumps of a floor. pan: turns by 20
// degrees to both sides, once in 8 s. shake: looks about by up to 80 px of the plain camera to the
// sides and 48 px up and down, in jerks; at 80 Hz by 4 px a frame (median) and 28 px at the most.
// still: the viewpoint.
[[nodiscard]] Pose pose_at(const Viewpoint& view, const SceneOptions& options, int index);

}  // namespace thermedge::sim
