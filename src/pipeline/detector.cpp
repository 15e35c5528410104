#include "thermedge/detector.hpp"

#include <new>
#include <string>
#include <utility>

#include "pipeline.hpp"
#include "thermedge/simd.hpp"
#include "try.hpp"

namespace thermedge {
namespace {

// Runs tasks on the caller's runner with the detector's instruction set.
class SimdRunner final : public ParallelRunner {
 public:
  SimdRunner(ParallelRunner& runner, SimdTarget simd) : runner_(runner), simd_(simd) {}
  void run(int count, FunctionRef task) override {
    runner_.run(count, [&](int index) {
      const SimdScope scope(simd_);
      task(index);
    });
  }
  [[nodiscard]] int threads() const override { return runner_.threads(); }

 private:
  ParallelRunner& runner_;
  SimdTarget simd_;
};

// Clears the result of the frame before.
void begin(Detection& found, Preset preset, int width, int height) {
  found.preset = preset;
  found.width = width;
  found.height = height;
  found.stamp_ns.reset();
  found.index = 0;
  found.flags = 0;
  found.corrections.invalid = {};
  found.corrections.noise = {};
  found.corrections.noise_model.set_white(0);
  found.corrections.bad_pixels.clear();
  found.corrections.stripes.columns.clear();
  found.corrections.stripes.rows.clear();
  found.corrections.counts_per_unit = 1;
  found.corrections.offset = 0;
  found.sigma_counts = found.threshold_low = found.threshold_high = 0;
  found.clipped = {};
  found.unit_counts = 0;
  found.kernel_px = {0, 0};
  found.edges.clear();
}

Status check_frame(const Frame& frame) {
  if (frame.empty()) {
    return failure(ErrorCode::kInvalidArgument, "frame: it has no pixels");
  }
  if (!frame.valid.empty() &&
      (frame.valid.width() != frame.width() || frame.valid.height() != frame.height())) {
    return failure(ErrorCode::kInvalidArgument,
                   "frame: its validity mask has " + std::to_string(frame.valid.width()) + "x" +
                       std::to_string(frame.valid.height()) + " pixels, the frame " +
                       std::to_string(frame.width()) + "x" + std::to_string(frame.height()));
  }
  return {};
}

}  // namespace

struct Detector::Impl {
  Impl(const DetectorOptions& chosen, SimdTarget target, ParallelRunner* injected)
      : options(chosen),
        simd(target),
        own_runner(injected == nullptr ? make_runner(chosen.threads) : nullptr),
        runner(injected == nullptr ? *own_runner : *injected, target),
        pipeline(detail::make_pipeline(options)) {}

  // `run(call)` with the detector's instruction set; running out of memory becomes a Status.
  template <class Run>
  Status guarded(const Detection& found, const DetectRequest& request, Run&& run) {
    const SimdScope scope(simd);
    try {
      return run(detail::Call{runner, request.stop, request.intermediates, request.listener});
    } catch (const std::bad_alloc&) {
      return failure(ErrorCode::kOutOfMemory, "frame of " + std::to_string(found.width) + "x" +
                                                  std::to_string(found.height) +
                                                  " pixels: out of memory");
    }
  }

  DetectorOptions options;
  SimdTarget simd;
  std::unique_ptr<ParallelRunner> own_runner;
  SimdRunner runner;
  std::unique_ptr<detail::Pipeline> pipeline;
};

Result<Detector> Detector::create(const DetectorOptions& options, ParallelRunner* runner) {
  THERMEDGE_TRY(options.check());
  const Result<SimdTarget> simd = SimdTarget::named(options.simd);
  THERMEDGE_TRY(simd);
  try {
    return Detector(std::make_unique<Impl>(options, *simd, runner));
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, "detector: out of memory");
  }
}

Result<Detector> Detector::create(const DetectorOptions& options) {
  return create(options, nullptr);
}

Result<Detector> Detector::create(const DetectorOptions& options, ParallelRunner& runner) {
  return create(options, &runner);
}

Detector::Detector(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;
Detector::~Detector() = default;

const DetectorOptions& Detector::options() const { return impl_->options; }
int Detector::threads() const { return impl_->runner.threads(); }
std::size_t Detector::memory_bytes() const { return impl_->pipeline->memory_bytes(); }

Status Detector::detect(const Frame& frame, Detection& detection, const DetectRequest& request) {
  THERMEDGE_TRY(check_frame(frame));
  begin(detection, impl_->options.preset(), frame.width(), frame.height());
  detection.stamp_ns = frame.stamp_ns;
  detection.index = frame.index;
  detection.flags = frame.flags;
  return impl_->guarded(detection, request, [&](const detail::Call& call) {
    return impl_->pipeline->detect(frame, call, detection);
  });
}

Status Detector::trace(ImageView<const std::uint8_t> edge_map, Detection& detection,
                       const DetectRequest& request) {
  THERMEDGE_TRY(check_frame(edge_map));
  begin(detection, impl_->options.preset(), edge_map.width(), edge_map.height());
  return impl_->guarded(detection, request, [&](const detail::Call& call) {
    return impl_->pipeline->trace(edge_map, call, detection);
  });
}

Result<Detection> Detector::detect(const Frame& frame) {
  Detection detection;
  return detect(frame, detection).map([&] { return std::move(detection); });
}

Result<Detection> Detector::trace(ImageView<const std::uint8_t> edge_map) {
  Detection detection;
  return trace(edge_map, detection).map([&] { return std::move(detection); });
}

}  // namespace thermedge
