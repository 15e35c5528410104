// Things that move.
#pragma once

#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {

// How far an object is from its place.
[[nodiscard]] Vec3 moved_by(const Motion& motion, double seconds);

// The world with all objects where they are then.
[[nodiscard]] World world_at(const World& world, double seconds);

// Adds the box and the hot thing of options.moving before the camera's first place.
void add_moving_things(const SceneOptions& options, World& world);

}  // namespace thermedge::sim
