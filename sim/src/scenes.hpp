// The scenes, in the coordinates of a 382x288 frame, in counts (0.01 degC each).
#pragma once

#include <cstdint>

#include "shapes.hpp"

namespace thermedge::sim {

// A desk: monitor, laptop, mug, bottle, phone, charger with its cable, keyboard.
[[nodiscard]] Scene desk_scene(std::uint64_t seed);

// A corridor in perspective: walls, doors, pipes, lamps, a radiator, a cable duct.
[[nodiscard]] Scene corridor_scene(std::uint64_t seed);

}  // namespace thermedge::sim
