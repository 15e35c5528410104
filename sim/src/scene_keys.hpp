// The options of a scene by name, with their ranges.
#pragma once

#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {

// Every number in range and the scene's name known. Errors name the option.
[[nodiscard]] Status check(const SceneOptions& options);

// Whether the name is that of a scene file.
[[nodiscard]] bool is_scene_file(std::string_view name);

}  // namespace thermedge::sim
