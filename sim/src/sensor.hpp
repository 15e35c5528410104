// What the sensor adds to a clean picture.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {

// Temporal noise, fixed column and row pattern, dead pixels, rounding to 14 bits.
[[nodiscard]] Image<std::uint16_t> expose(ImageView<const float> clean, const CameraOptions& camera,
                                          std::uint64_t seed, int frame);

}  // namespace thermedge::sim
