// Edges with identities, frame after frame: the whole way for a camera's stream.
#pragma once

#include <cstddef>
#include <memory>

#include "thermedge/detection.hpp"
#include "thermedge/frame.hpp"
#include "thermedge/options.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"
#include "thermedge/sequence/events.hpp"
#include "thermedge/sequence/motion.hpp"
#include "thermedge/sequence/tracker.hpp"

namespace thermedge {

struct SequenceOptions {
  DetectorOptions detector;
  TrackerOptions tracker;

  // Fails with one line that names the option.
  [[nodiscard]] Status check() const;
};

// The result of one frame. Belongs to the caller, who hands it in again.
struct TrackedFrame {
  FrameEvents events;
  Motion motion;        // since the last valid frame
  Detection detection;  // without edges where the frame is not valid
  Tracks tracks;
};

// Events, motion, detection and tracking of the frames of one camera, in their order. A frame that
// is no measurement of its own (frozen, shutter) gives no edges, and nothing ages meanwhile. Not
// thread-safe: one object per camera; it spreads the work of a frame over its runner's threads.
// Results are bit-identical for every runner, number of threads and instruction set.
class SequenceDetector {
 public:
  // Errors: as of Detector::create; an option of the tracker out of range.
  [[nodiscard]] static Result<SequenceDetector> create(const SequenceOptions& options = {});
  // On the caller's runner, which must outlive the object.
  [[nodiscard]] static Result<SequenceDetector> create(const SequenceOptions& options,
                                                       ParallelRunner& runner);
  SequenceDetector(SequenceDetector&&) noexcept;
  SequenceDetector& operator=(SequenceDetector&&) noexcept;
  ~SequenceDetector();

  // A frame of another size than the last one begins a new sequence: all identities end. Errors: as
  // of Detector::detect; the frame then counts as lost.
  [[nodiscard]] Status process(const Frame& frame, TrackedFrame& result);

  [[nodiscard]] const SequenceOptions& options() const;
  // Scratch memory and state held by all stages, bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  explicit SequenceDetector(std::unique_ptr<Impl> impl);
  [[nodiscard]] static Result<SequenceDetector> create(const SequenceOptions& options,
                                                       ParallelRunner* runner);
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
