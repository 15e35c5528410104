// The nearest of a set of points with normals, for every pixel close to one of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"

namespace thermedge::detail {

// Points are painted along their normals to either side, up to kReachPx; where two meet, the nearer
// one wins, of two as near the one that was painted first.
class NearestField {
 public:
  static constexpr int kReachPx = 4;
  static constexpr std::int32_t kNone = -1;

  void start(int width, int height) {
    nearest_.resize(width, height);
    steps_.resize(width, height);
    fill_pixels(nearest_.view(), kNone);
    fill_pixels(steps_.view(), std::numeric_limits<std::uint8_t>::max());
  }

  void paint(std::int32_t point, float x, float y, float nx, float ny) {
    put(point, x, y, 0);
    for (int step = 1; step <= kReachPx; ++step) {
      const auto far = static_cast<float>(step);
      put(point, x + far * nx, y + far * ny, step);
      put(point, x - far * nx, y - far * ny, step);
    }
  }

  // kNone outside the picture.
  [[nodiscard]] std::int32_t at(float x, float y) const {
    const Place place = place_of(x, y);
    return place.is_inside ? nearest_(place.x, place.y) : kNone;
  }

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const { return memory_of(nearest_, steps_); }

 private:
  struct Place {
    int x = 0, y = 0;
    bool is_inside = false;
  };
  [[nodiscard]] Place place_of(float x, float y) const {
    if (!(x > -0.5F && y > -0.5F && x < static_cast<float>(nearest_.width()) - 0.5F &&
          y < static_cast<float>(nearest_.height()) - 0.5F)) {
      return {};
    }
    return {static_cast<int>(x + 0.5F), static_cast<int>(y + 0.5F), true};
  }
  void put(std::int32_t point, float x, float y, int step) {
    const Place place = place_of(x, y);
    if (place.is_inside && step < steps_(place.x, place.y)) {
      steps_(place.x, place.y) = static_cast<std::uint8_t>(step);
      nearest_(place.x, place.y) = point;
    }
  }

  Image<std::int32_t> nearest_;
  Image<std::uint8_t> steps_;
};

}  // namespace thermedge::detail
