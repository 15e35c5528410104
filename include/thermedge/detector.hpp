// The whole detector: a frame of counts in, ranked smooth edges out (paper Algorithm 6).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stop_token>

#include "thermedge/detection.hpp"
#include "thermedge/frame.hpp"
#include "thermedge/image.hpp"
#include "thermedge/options.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

// Sees each frame when it is corrected (pixels that are no measurement filled, bad pixels replaced,
// stripes removed) and not yet denoised.
class CorrectedFrameListener {
 public:
  virtual ~CorrectedFrameListener() = default;
  // The views hold during the call only.
  virtual void on_corrected(ImageView<const std::uint16_t> counts,
                            const Corrections& corrections) = 0;
};

// Extras that a call may ask for besides the result.
struct DetectRequest {
  Intermediates* intermediates = nullptr;  // filled where given; costs time
  std::stop_token stop;                    // looked at between stages; the error is kCancelled then
  CorrectedFrameListener* listener = nullptr;  // called where given, by the calling thread
};

// Detects edges frame by frame. Not thread-safe: one detector per thread; it spreads the work of a
// frame over its runner's threads. Allocates nothing after the second frame of one size. Results
// are bit-identical for every runner, number of threads and instruction set.
class Detector {
 public:
  // Errors: those of DetectorOptions::check; an instruction set that this machine lacks; out of
  // memory. The detector runs on options.threads threads of its own.
  [[nodiscard]] static Result<Detector> create(const DetectorOptions& options = {});
  // The same on the caller's runner, which must outlive the detector; options.threads is unused.
  [[nodiscard]] static Result<Detector> create(const DetectorOptions& options,
                                               ParallelRunner& runner);
  Detector(Detector&&) noexcept;
  Detector& operator=(Detector&&) noexcept;
  ~Detector();

  // Errors: empty frame; a validity mask of another size; cancelled; out of memory. On error the
  // detection is unspecified.
  [[nodiscard]] Status detect(const Frame& frame, Detection& detection,
                              const DetectRequest& request = {});
  [[nodiscard]] Result<Detection> detect(const Frame& frame);

  // The second half alone, on a binary edge map of another detector (nonzero = edge). Contrast, z
  // and NFA are NaN: they need a frame.
  [[nodiscard]] Status trace(ImageView<const std::uint8_t> edge_map, Detection& detection,
                             const DetectRequest& request = {});
  [[nodiscard]] Result<Detection> trace(ImageView<const std::uint8_t> edge_map);

  [[nodiscard]] const DetectorOptions& options() const;
  [[nodiscard]] int threads() const;
  // Scratch memory held by all stages, bytes: 0 before the first frame, constant after the second
  // of a size. A Detection is the caller's.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  explicit Detector(std::unique_ptr<Impl> impl);
  [[nodiscard]] static Result<Detector> create(const DetectorOptions& options,
                                               ParallelRunner* runner);
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
