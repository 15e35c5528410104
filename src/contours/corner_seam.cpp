#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "thermedge/stages/corners_paper.hpp"

namespace thermedge {
namespace {

double step(Pixel a, Pixel b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  return std::sqrt(dx * dx + dy * dy);
}

// Along the closed curve from point `last` over its seam to point `first`.
double distance_over_seam(std::span<const Pixel> pixels, std::size_t last, std::size_t first) {
  double distance = step(pixels.back(), pixels.front());
  for (std::size_t i = last; i + 1 < pixels.size(); ++i) {
    distance += step(pixels[i], pixels[i + 1]);
  }
  for (std::size_t i = 0; i < first; ++i) {
    distance += step(pixels[i], pixels[i + 1]);
  }
  return distance;
}

}  // namespace

void merge_seam_corners(const ContourSet& contours, double distance_px, CornerSet& corners) {
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    Range& range = corners.ranges[i];
    if (!contours.items[i].closed || range.count < 2) {
      continue;
    }
    const auto indices = slice(std::as_const(corners.indices), range);
    const auto pixels = contours.pixels(contours.items[i]);
    if (distance_over_seam(pixels, indices.back(), indices.front()) <= distance_px) {
      --range.count;
    }
  }
}

}  // namespace thermedge
