#include "thermedge/sequence/sequence_detector.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "thermedge/detector.hpp"
#include "try.hpp"

namespace thermedge {

Status SequenceOptions::check() const {
  THERMEDGE_TRY(detector.check());
  return tracker.check();
}

struct SequenceDetector::Impl final : CorrectedFrameListener {
  Impl(const SequenceOptions& chosen, Detector made, Tracker follower)
      : options(chosen), detector(std::move(made)), tracker(std::move(follower)) {}

  // Where the detector has corrected the frame and not yet denoised it.
  void on_corrected(ImageView<const std::uint16_t> counts,
                    const Corrections& corrections) override {
    sigma_counts = corrections.noise.sigma_counts;
    is_first = is_first || counts.width() != width || counts.height() != height;
    width = counts.width();
    height = counts.height();
    motion = motion_estimator.update(counts, corrections.noise_model.level_counts, gap);
  }

  void pass_over(const Frame& frame, TrackedFrame& result);

  SequenceOptions options;
  Detector detector;
  Tracker tracker;
  EventFinder event_finder;
  MotionEstimator motion_estimator;
  Motion motion;
  double sigma_counts = 0;  // of a pixel of the last valid frame; counts of the detector
  double counts_per_unit = 1;
  double gap = 1;   // to be told to the motion estimator
  double lost = 0;  // frame times of invalid frames since the last valid one
  int width = 0, height = 0;
  bool is_first = true;
};

Result<SequenceDetector> SequenceDetector::create(const SequenceOptions& options,
                                                  ParallelRunner* runner) {
  THERMEDGE_TRY(options.check());
  Result<Detector> detector = runner == nullptr ? Detector::create(options.detector)
                                                : Detector::create(options.detector, *runner);
  if (!detector) {
    return tl::unexpected(detector.error());
  }
  Result<Tracker> tracker = Tracker::create(options.tracker);
  if (!tracker) {
    return tl::unexpected(tracker.error());
  }
  return SequenceDetector(
      std::make_unique<Impl>(options, *std::move(detector), *std::move(tracker)));
}

Result<SequenceDetector> SequenceDetector::create(const SequenceOptions& options) {
  return create(options, nullptr);
}

Result<SequenceDetector> SequenceDetector::create(const SequenceOptions& options,
                                                  ParallelRunner& runner) {
  return create(options, &runner);
}

SequenceDetector::SequenceDetector(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SequenceDetector::SequenceDetector(SequenceDetector&&) noexcept = default;
SequenceDetector& SequenceDetector::operator=(SequenceDetector&&) noexcept = default;
SequenceDetector::~SequenceDetector() = default;

const SequenceOptions& SequenceDetector::options() const { return impl_->options; }

std::size_t SequenceDetector::memory_bytes() const {
  return impl_->detector.memory_bytes() + impl_->tracker.memory_bytes() +
         impl_->event_finder.memory_bytes() + impl_->motion_estimator.memory_bytes();
}

// A frame that tells nothing of the scene.
void SequenceDetector::Impl::pass_over(const Frame& frame, TrackedFrame& result) {
  result.motion = {};
  result.detection.width = frame.width();
  result.detection.height = frame.height();
  result.detection.preset = options.detector.preset();
  result.detection.stamp_ns = frame.stamp_ns;
  result.detection.index = frame.index;
  result.detection.flags = frame.flags;
  result.detection.edges.clear();
  result.detection.times.clear();
  tracker.pass_over(frame.stamp_ns, result.tracks);
  lost += result.events.gap;
}

Status SequenceDetector::process(const Frame& frame, TrackedFrame& result) {
  using Clock = std::chrono::steady_clock;
  Impl& self = *impl_;
  result.events = self.event_finder.look(frame, self.sigma_counts / self.counts_per_unit);
  if (!result.events.valid) {
    self.pass_over(frame, result);
    return {};
  }
  self.gap = result.events.gap + self.lost;
  DetectRequest request;
  request.listener = &self;
  if (Status status = self.detector.detect(frame, result.detection, request); !status) {
    self.lost += result.events.gap;
    return status;
  }
  self.lost = 0;
  self.counts_per_unit = result.detection.corrections.counts_per_unit;
  self.event_finder.look_at_motion(self.motion, self.is_first, self.sigma_counts, result.events);
  self.is_first = false;
  result.motion = self.motion;
  const Clock::time_point start = Clock::now();
  self.tracker.update(result.detection, self.motion, result.tracks);
  if (result.events.has(kCut)) {
    self.tracker.restart(result.tracks);
  }
  result.detection.times.push_back(
      {"tracks", std::chrono::duration<double, std::milli>(Clock::now() - start).count()});
  return {};
}

}  // namespace thermedge
