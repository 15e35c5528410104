#include "sensor.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "random.hpp"

namespace thermedge::sim {
namespace {

constexpr std::uint16_t kLargestCount = 16383;  // 14 bits

enum Stream : std::uint64_t { kColumns = 10, kRows, kDead, kTemporal = 1000 };

// Offsets of the columns or of the rows.
std::vector<double> pattern(const Random& random, int size, double sigma_counts) {
  std::vector<double> offsets(static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    offsets[i] = sigma_counts * random.normal(i);
  }
  return offsets;
}

// Kills `count` different pixels, all where there are fewer.
void kill_pixels(const Random& random, int count, ImageView<std::uint16_t> counts) {
  std::set<std::pair<int, int>> dead;
  const auto wanted = std::min(static_cast<std::size_t>(count), counts.size());
  for (std::uint64_t index = 0; dead.size() < wanted; index += 2) {
    const auto x = static_cast<int>(random.uniform(index, 0, counts.width()));
    const auto y = static_cast<int>(random.uniform(index + 1, 0, counts.height()));
    if (dead.emplace(x, y).second) {
      counts(x, y) = dead.size() % 2 == 1 ? std::uint16_t{0} : kLargestCount;
    }
  }
}

}  // namespace

Image<std::uint16_t> expose(ImageView<const float> clean, const CameraOptions& camera,
                            std::uint64_t seed, int frame) {
  const std::vector<double> columns =
      pattern(Random(seed, kColumns), clean.width(), camera.column_sigma_counts);
  const std::vector<double> rows =
      pattern(Random(seed, kRows), clean.height(), camera.row_sigma_counts);
  const Random temporal(seed, kTemporal + static_cast<std::uint64_t>(frame));
  Image<std::uint16_t> counts(clean.width(), clean.height());
  for (int y = 0; y < clean.height(); ++y) {
    const double row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < clean.width(); ++x) {
      const auto pixel = static_cast<std::uint64_t>(y) * clean.width() + x;
      const double value = clean(x, y) + row + columns[static_cast<std::size_t>(x)] +
                           camera.sigma_counts * temporal.normal(pixel);
      counts(x, y) =
          static_cast<std::uint16_t>(std::clamp(value, 0.0, double{kLargestCount}) + 0.5);
    }
  }
  kill_pixels(Random(seed, kDead), camera.dead_pixels, counts);
  return counts;
}

}  // namespace thermedge::sim
