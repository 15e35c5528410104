#include "sensor.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "radiometer.hpp"
#include "random.hpp"

namespace thermedge::sim {
namespace {

enum Stream : std::uint64_t {
  kColumns = 10,
  kRows,
  kDead,
  kOffsets,
  kGains,
  kJumps,
  kFlickering,
  kFlicker,
  kTemporal = 1000
};

// Number of shutter events that are over before `frame`.
int events_before(const CameraOptions& camera, int frame) {
  if (camera.shutter_every <= 0 || frame < camera.shutter_every + camera.shutter_frames) {
    return 0;
  }
  return (frame - camera.shutter_frames) / camera.shutter_every;
}

// Offset of the whole picture after a number of events.
double offset_after(const CameraOptions& camera, std::uint64_t seed, int events) {
  return events == 0 ? 0
                     : camera.shutter_jump_counts *
                           Random(seed, kJumps).normal(static_cast<std::uint64_t>(events));
}

std::uint16_t to_count(double value) {
  return static_cast<std::uint16_t>(std::clamp(value, 0.0, double{kLargestCount}) + 0.5);
}

// `count` different pixels of the picture, all where there are fewer, in the order of drawing.
std::vector<std::pair<int, int>> draw_pixels(const Random& random, int count, int width,
                                             int height) {
  std::set<std::pair<int, int>> known;
  std::vector<std::pair<int, int>> drawn;
  const auto wanted = std::min(static_cast<std::size_t>(count),
                               static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::uint64_t index = 0; drawn.size() < wanted; index += 2) {
    const std::pair pixel{static_cast<int>(random.uniform(index, 0, width)),
                          static_cast<int>(random.uniform(index + 1, 0, height))};
    if (known.insert(pixel).second) {
      drawn.push_back(pixel);
    }
  }
  return drawn;
}

}  // namespace

std::optional<ShutterState> shutter_at(const CameraOptions& camera, std::uint64_t seed, int frame) {
  if (camera.shutter_every <= 0 || frame < camera.shutter_every) {
    return std::nullopt;
  }
  const int since = frame % camera.shutter_every;
  if (since < camera.shutter_frames) {
    return ShutterState{true, frame - since - 1, 0};
  }
  if (since == camera.shutter_frames) {
    const int events = events_before(camera, frame);
    return ShutterState{
        false, frame, offset_after(camera, seed, events) - offset_after(camera, seed, events - 1)};
  }
  return std::nullopt;
}

Sensor::Sensor(const CameraOptions& camera, std::uint64_t seed)
    : camera_(camera),
      seed_(seed),
      columns_{kColumns, camera.column_sigma_counts, static_cast<std::size_t>(camera.width)},
      rows_{kRows, camera.row_sigma_counts, static_cast<std::size_t>(camera.height)},
      offsets_{kOffsets, camera.pixel_sigma_counts,
               static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height)},
      gains_{kGains, camera.gain_sigma, offsets_.size} {}

// Between two independent patterns on a circular arc, which keeps the variance.
void Sensor::update(Pattern& pattern, int frame) const {
  if (pattern.sigma <= 0) {
    return;
  }
  const double age = camera_.drift_s > 0 ? frame / (camera_.rate_hz * camera_.drift_s) : 0.0;
  const double knot = std::floor(age);
  if (pattern.knot != knot) {
    const Random random(seed_, pattern.stream);
    const auto first = static_cast<std::uint64_t>(knot) * pattern.size;
    pattern.from.resize(pattern.size);
    pattern.to.resize(pattern.size);
    pattern.values.resize(pattern.size);
    for (std::size_t i = 0; i < pattern.size; ++i) {
      pattern.from[i] = random.normal(first + i);
      pattern.to[i] = random.normal(first + pattern.size + i);
    }
    pattern.knot = knot;
  }
  const double t = age - knot;
  const double length = std::sqrt(t * t + (1 - t) * (1 - t));
  for (std::size_t i = 0; i < pattern.size; ++i) {
    const double value = (1 - t) * pattern.from[i] + t * pattern.to[i];
    pattern.values[i] = pattern.sigma * value / length;
  }
}

void Sensor::expose(ImageView<const float> clean, int frame, ImageView<std::uint16_t> counts,
                    ParallelRunner& runner) {
  if (pattern_frame_ < 0 || (camera_.drift_s > 0 && pattern_frame_ != frame)) {
    for (Pattern* pattern : {&columns_, &rows_, &offsets_, &gains_}) {
      update(*pattern, frame);
    }
    pattern_frame_ = frame;
  }
  const Random temporal(seed_, kTemporal + static_cast<std::uint64_t>(frame));
  const double jump = offset_after(camera_, seed_, events_before(camera_, frame));
  const auto value_of = [](const Pattern& pattern, std::size_t i) {
    return pattern.sigma > 0 ? pattern.values[i] : 0.0;
  };
  runner.run(clean.height(), [&](int y) {
    const double row = jump + value_of(rows_, static_cast<std::size_t>(y));
    for (int x = 0; x < clean.width(); ++x) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(clean.width()) +
                         static_cast<std::size_t>(x);
      const double seen = double{clean(x, y)};
      counts(x, y) =
          to_count(seen + (seen - kCountsAt25DegC) * value_of(gains_, pixel) + row +
                   value_of(columns_, static_cast<std::size_t>(x)) + value_of(offsets_, pixel) +
                   camera_.sigma_counts * temporal.normal(pixel));
    }
  });
  flicker(frame, counts);
  bool low = true;
  for (const auto& [x, y] :
       draw_pixels(Random(seed_, kDead), camera_.bad_pixels, clean.width(), clean.height())) {
    counts(x, y) = low ? std::uint16_t{0} : kLargestCount;
    low = !low;
  }
}

// Pixels that jump between two levels.
void Sensor::flicker(int frame, ImageView<std::uint16_t> counts) const {
  const Random random(seed_, kFlicker);
  const auto pixels = draw_pixels(Random(seed_, kFlickering), camera_.flickering_pixels,
                                  counts.width(), counts.height());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto [x, y] = pixels[i];
    const double height = random.uniform(i, 10, 40) * std::max(camera_.sigma_counts, 1.0);
    const bool up = random.bits((static_cast<std::uint64_t>(frame) + 1) * 65536 + i) % 2 == 0;
    counts(x, y) = to_count(counts(x, y) + (up ? height : 0));
  }
}

}  // namespace thermedge::sim
