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
  kLevels,
  kTemporal = 1000,   // and as many more as there are frames
  kRepeats = 2000000  // likewise
};
constexpr double kLeastJumpCounts = 2;  // that is an event

// Frames since the last beginning of what comes every `every` frames; nothing before the first.
std::optional<int> frames_since(int every, int frame) {
  return every > 0 && frame >= every ? std::optional(frame % every) : std::nullopt;
}

// Which of the fixed patterns that follow each other.
std::uint64_t pattern_number(const CameraOptions& camera, int frame) {
  return camera.pattern_every > 0 ? static_cast<std::uint64_t>(frame / camera.pattern_every) : 0;
}

bool has_pattern(const CameraOptions& camera) {
  return camera.pixel_sigma_counts > 0 || camera.gain_sigma > 0 || camera.column_sigma_counts > 0 ||
         camera.row_sigma_counts > 0;
}

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

std::int64_t camera_number(const CameraOptions& camera, std::int64_t index) {
  if (camera.drop_every <= 0 || index < camera.drop_every) {
    return index;
  }
  const std::int64_t kept = camera.drop_every - camera.drop_frames;
  const std::int64_t after = index - camera.drop_every;
  return camera.drop_every + after / kept * camera.drop_every + camera.drop_frames + after % kept;
}

std::optional<FreezeState> freeze_at(const CameraOptions& camera, int frame) {
  const auto since = frames_since(camera.freeze_every, frame);
  if (!since || *since >= camera.freeze_frames) {
    return std::nullopt;
  }
  return FreezeState{shown_at(camera, frame - *since - 1),
                     camera.freeze_noise * camera.sigma_counts};
}

int shown_at(const CameraOptions& camera, int frame) {
  if (const auto freeze = freeze_at(camera, frame)) {
    return freeze->shows_frame;
  }
  const auto since = frames_since(camera.shutter_every, frame);
  return since && *since < camera.shutter_frames ? shown_at(camera, frame - *since - 1) : frame;
}

double offset_at(const CameraOptions& camera, std::uint64_t seed, int frame) {
  const int jumps = camera.jump_every > 0 ? frame / camera.jump_every : 0;
  double level = 0;
  if (jumps % 2 == 1) {
    const Random random(seed, kLevels);
    const auto jump = static_cast<std::uint64_t>(jumps);
    level = camera.jump_counts * random.uniform(2 * jump, 0.5, 1.5) *
            (random.uniform(2 * jump + 1) < 0.5 ? -1 : 1);
  }
  return level + offset_after(camera, seed, events_before(camera, frame));
}

std::vector<StreamEvent> events_at(const CameraOptions& camera, std::uint64_t seed, int index) {
  std::vector<StreamEvent> events;
  if (index == 0) {
    return events;
  }
  const auto frame = static_cast<int>(camera_number(camera, index));
  const auto before = static_cast<int>(camera_number(camera, index - 1));
  const int shown = shown_at(camera, frame);
  const int shown_before = shown_at(camera, before);
  if (frame != before + 1) {
    events.push_back(StreamEvent::kDropped);
  }
  if (shown == shown_before) {
    const auto freeze = freeze_at(camera, frame);
    events.push_back(freeze && freeze->noise_counts > 0 ? StreamEvent::kNearFrozen
                                                        : StreamEvent::kFrozen);
  }
  if (std::abs(offset_at(camera, seed, shown) - offset_at(camera, seed, shown_before)) >=
      kLeastJumpCounts) {
    events.push_back(StreamEvent::kOffsetJump);
  }
  if (has_pattern(camera) &&
      pattern_number(camera, shown) != pattern_number(camera, shown_before)) {
    events.push_back(StreamEvent::kPatternChanged);
  }
  return events;
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
  const std::uint64_t number = pattern_number(camera_, frame);
  if (pattern.knot != knot || pattern.number != number) {
    const Random random(seed_, pattern.stream + (number << 32));
    const auto first = static_cast<std::uint64_t>(knot) * pattern.size;
    pattern.from.resize(pattern.size);
    pattern.to.resize(pattern.size);
    pattern.values.resize(pattern.size);
    for (std::size_t i = 0; i < pattern.size; ++i) {
      pattern.from[i] = random.normal(first + i);
      pattern.to[i] = random.normal(first + pattern.size + i);
    }
    pattern.knot = knot;
    pattern.number = number;
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
  if (pattern_frame_ < 0 ||
      ((camera_.drift_s > 0 || camera_.pattern_every > 0) && pattern_frame_ != frame)) {
    for (Pattern* pattern : {&columns_, &rows_, &offsets_, &gains_}) {
      update(*pattern, frame);
    }
    pattern_frame_ = frame;
  }
  const Random temporal(seed_, kTemporal + static_cast<std::uint64_t>(frame));
  const double jump = offset_at(camera_, seed_, frame);
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

void Sensor::repeat(double noise_counts, int frame, ImageView<std::uint16_t> counts) const {
  const Random random(seed_, kRepeats + static_cast<std::uint64_t>(frame));
  std::uint64_t pixel = 0;
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      counts(x, y) = to_count(counts(x, y) + noise_counts * random.normal(pixel++));
    }
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
