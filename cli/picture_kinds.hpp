// Pictures that several commands write.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "thermedge/edge_fields.hpp"
#include "thermedge/image.hpp"

namespace thermedge::cli {

// The distance picture holds 1/256 px in 16 bits, so it reaches 255 px.
inline constexpr float kDistanceUnitsPerPx = 256;
inline constexpr float kMaxDistancePx = 255;

inline void draw_distance(const DistanceField& field, Image<std::uint16_t>& picture) {
  const ImageView<const float> distances = field.distance_px.view();
  picture.resize(distances.width(), distances.height());
  for (int y = 0; y < distances.height(); ++y) {
    std::transform(
        distances.row(y), distances.row(y) + distances.width(), picture.row(y),
        [](float px) { return static_cast<std::uint16_t>(std::lround(px * kDistanceUnitsPerPx)); });
  }
}

}  // namespace thermedge::cli
