#include "thermedge/sequence/events.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <variant>
#include <vector>

#include "order_statistics.hpp"
#include "thermedge/memory.hpp"

namespace thermedge {
namespace {

constexpr double kSigmaOverMad = 1.4826;
constexpr double kSecond = 1e9;  // ns

// The largest counts of usual sensors, beside 65535: 8, 12 and 14 bits.
bool is_full_scale(float value) {
  return value == 255 || value == 4095 || value == 16383 || value == 65535;
}

}  // namespace

struct EventFinder::Impl {
  explicit Impl(const EventTuning& chosen) : tuning(chosen) {}

  void take(const Frame& frame);
  void compare(double sigma_counts, FrameEvents& events);
  void look_at_range(double sigma_counts, FrameEvents& events);
  void look_at_stamp(const Frame& frame, FrameEvents& events);

  EventTuning tuning;
  Image<float> last, current;
  std::vector<float> sample;
  std::vector<double> intervals, sorted;  // of the last stamps, s
  std::optional<std::int64_t> last_stamp_ns;
  std::optional<std::int64_t> shutter_ns;
  bool was_open = false;  // some frame before had contrast
  int without_motion = 0;
};

EventFinder::EventFinder(const EventTuning& tuning) : impl_(std::make_unique<Impl>(tuning)) {}
EventFinder::EventFinder(EventFinder&&) noexcept = default;
EventFinder& EventFinder::operator=(EventFinder&&) noexcept = default;
EventFinder::~EventFinder() = default;

std::size_t EventFinder::memory_bytes() const {
  const Impl& self = *impl_;
  return detail::memory_of(self.last, self.current, self.sample, self.intervals, self.sorted);
}

FrameEvents EventFinder::look(const Frame& frame, double sigma_counts) {
  Impl& self = *impl_;
  FrameEvents events;
  self.look_at_stamp(frame, events);
  if ((frame.flags & kFrameShutter) != 0) {
    events.bits |= kShutter;
  }
  self.take(frame);
  self.compare(sigma_counts, events);
  self.look_at_range(sigma_counts, events);
  events.valid = !events.has(kFrozen) && !events.has(kNearFrozen) && !events.has(kShutter);
  if (!events.valid && frame.stamp_ns) {
    self.shutter_ns = frame.stamp_ns;
  }
  if (self.shutter_ns && frame.stamp_ns) {
    events.since_shutter_s = static_cast<double>(*frame.stamp_ns - *self.shutter_ns) / kSecond;
  }
  return events;
}

void EventFinder::look_at_motion(const Motion& motion, bool is_first, double sigma_counts,
                                 FrameEvents& events) {
  Impl& self = *impl_;
  self.without_motion = motion.found || is_first ? 0 : self.without_motion + 1;
  if (self.without_motion == self.tuning.cut_frames) {
    events.bits |= kCut;
  }
  const double least = std::max(self.tuning.least_jump_sigmas * sigma_counts,
                                self.tuning.least_jump_deviations * motion.offset_sigma_counts);
  if (motion.found && std::abs(motion.offset_counts) > least &&
      motion.offset_parts >= self.tuning.least_jump_parts) {
    events.bits |= kOffsetJump;
    self.shutter_ns = self.last_stamp_ns;
    if (self.shutter_ns) {
      events.since_shutter_s = 0;
    }
  }
}

void EventFinder::Impl::take(const Frame& frame) {
  std::swap(last, current);
  current.resize(frame.width(), frame.height());
  std::visit([&](auto pixels) { copy_pixels(pixels, current.view()); }, frame.pixels);
}

// With the picture before, which stays the one to compare with while the stream is frozen.
void EventFinder::Impl::compare(double sigma_counts, FrameEvents& events) {
  if (!same_size(ImageView<const float>(last.view()), ImageView<const float>(current.view()))) {
    return;
  }
  bool equal = true;
  for (int y = 0; y < current.height() && equal; ++y) {
    equal = std::memcmp(last.view().row(y), current.view().row(y),
                        sizeof(float) * static_cast<std::size_t>(current.width())) == 0;
  }
  if (equal) {
    events.bits |= kFrozen;
    return;
  }
  if (!(sigma_counts > 0)) {
    return;
  }
  constexpr int kStep = 4;
  sample.clear();
  for (int y = kStep / 2; y < current.height(); y += kStep) {
    for (int x = kStep / 2 + y / kStep % kStep; x < current.width(); x += kStep) {
      sample.push_back(std::abs(current.view()(x, y) - last.view()(x, y)));
    }
  }
  if (sample.empty()) {  // a frame of a few pixels
    return;
  }
  const double difference =
      kSigmaOverMad * static_cast<double>(detail::nth_value(std::span(sample), sample.size() / 2));
  if (difference < tuning.near_frozen_share * std::sqrt(2.0) * sigma_counts) {
    events.bits |= kNearFrozen;
  }
}

void EventFinder::Impl::look_at_range(double sigma_counts, FrameEvents& events) {
  constexpr int kStep = 4;
  constexpr double kTail = 0.01;
  sample.clear();
  std::size_t clipped = 0;
  for (int y = kStep / 2; y < current.height(); y += kStep) {
    for (int x = kStep / 2; x < current.width(); x += kStep) {
      const float value = current.view()(x, y);
      if (std::isfinite(value)) {
        sample.push_back(value);
        clipped += value == 0 || is_full_scale(value) ? 1 : 0;
      }
    }
  }
  if (sample.empty()) {
    return;
  }
  if (static_cast<double>(clipped) > tuning.clipped_share * static_cast<double>(sample.size())) {
    events.bits |= kClipped;
  }
  if (!(sigma_counts > 0)) {
    return;
  }
  const auto rank = static_cast<std::size_t>(kTail * static_cast<double>(sample.size() - 1));
  const float low = detail::nth_value(std::span(sample), rank);
  const float high = detail::nth_value(std::span(sample), sample.size() - 1 - rank);
  const double span = static_cast<double>(high - low) / sigma_counts;
  if (span < tuning.flat_sigmas && was_open) {
    events.bits |= kShutter;
  }
  was_open = was_open || span > tuning.open_sigmas;
}

// Frames are lost where the source says so, or where stamps are too far apart.
void EventFinder::Impl::look_at_stamp(const Frame& frame, FrameEvents& events) {
  constexpr std::size_t kIntervals = 15;
  constexpr std::size_t kEnough = 5;
  const bool lost = (frame.flags & kFrameAfterLoss) != 0;
  if (frame.stamp_ns && last_stamp_ns && *frame.stamp_ns > *last_stamp_ns) {
    const double interval = static_cast<double>(*frame.stamp_ns - *last_stamp_ns) / kSecond;
    if (intervals.size() >= kEnough) {
      sorted.assign(intervals.begin(), intervals.end());
      const double usual = detail::nth_value(std::span(sorted), sorted.size() / 2);
      if (interval > tuning.gap_intervals * usual) {
        events.bits |= kDropped;
        events.gap = interval / usual;
      }
    }
    if (intervals.size() == kIntervals) {
      intervals.erase(intervals.begin());
    }
    intervals.reserve(kIntervals);
    intervals.push_back(interval);
  }
  if (lost) {
    events.bits |= kDropped;
    events.gap = std::max(events.gap, 2.0);
  }
  last_stamp_ns = frame.stamp_ns;
}

}  // namespace thermedge
