#include "sensor.hpp"

#include <algorithm>
#include <cmath>

#include "random.hpp"

namespace thermedge::sim {
namespace {

constexpr std::uint16_t kLargestCount = 16383;  // 14 bits

enum Stream : std::uint64_t { kColumns = 10, kRows, kDead, kTemporal = 1000 };

void kill_pixels(const Random& random, int count, ImageView<std::uint16_t> counts) {
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::uint64_t>(i) * 2;
    const auto x = static_cast<int>(random.uniform(index, 0, counts.width()));
    const auto y = static_cast<int>(random.uniform(index + 1, 0, counts.height()));
    counts(x, y) = i % 2 == 0 ? std::uint16_t{0} : kLargestCount;
  }
}

}  // namespace

Image<std::uint16_t> expose(ImageView<const float> clean, const CameraOptions& camera,
                            std::uint64_t seed, int frame) {
  const Random columns(seed, kColumns);
  const Random rows(seed, kRows);
  const Random temporal(seed, kTemporal + static_cast<std::uint64_t>(frame));
  Image<std::uint16_t> counts(clean.width(), clean.height());
  for (int y = 0; y < clean.height(); ++y) {
    const double row = camera.row_sigma_counts * rows.normal(static_cast<std::uint64_t>(y));
    for (int x = 0; x < clean.width(); ++x) {
      const double column =
          camera.column_sigma_counts * columns.normal(static_cast<std::uint64_t>(x));
      const auto pixel = static_cast<std::uint64_t>(y) * clean.width() + x;
      const double value =
          clean(x, y) + row + column + camera.sigma_counts * temporal.normal(pixel);
      counts(x, y) =
          static_cast<std::uint16_t>(std::clamp(value, 0.0, double{kLargestCount}) + 0.5);
    }
  }
  kill_pixels(Random(seed, kDead), camera.dead_pixels, counts);
  return counts;
}

}  // namespace thermedge::sim
