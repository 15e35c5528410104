#include "thermedge/frame_denoiser.hpp"

#include <algorithm>
#include <new>

#include "try.hpp"

namespace thermedge {
namespace {

// Noise whose level at the scale of edges is this many times that of its pixels has been smoothed:
// resampled, enlarged, compressed. Below it texture of the scene may be what makes the difference
// (photographs have up to 2), and noise is taken for white.
constexpr double kSmoothNoise = 2.5;

}  // namespace

Status FrameDenoiserOptions::check() const {
  return validity.check()
      .and_then([&] { return bad_pixels.check(); })
      .and_then([&] { return stripes.check(); })
      .and_then([&] { return denoise.check(); });
}

FrameDenoiser::FrameDenoiser(const FrameDenoiserOptions& options)
    : options_(options),
      preprocessor_(options.bad_pixels, options.stripes, options.validity, true),
      denoiser_(options.denoise) {}

Result<ImageView<const std::uint16_t>> FrameDenoiser::run(const Frame& frame,
                                                          ParallelRunner& runner) {
  THERMEDGE_TRY(options_.check());
  if (frame.empty()) {
    return failure(ErrorCode::kInvalidArgument, "frame: it has no pixels");
  }
  try {
    working_.resize(frame.width(), frame.height());
    counts_.resize(frame.width(), frame.height());
    preprocessor_.run(frame, runner, corrections_);
    preprocessor_.copy_corrected(working_);
    const double told = options_.denoise.sigma_counts * corrections_.counts_per_unit;
    const double pixels = corrections_.noise.sigma_counts;
    const bool is_smooth = corrections_.noise_model.level_counts > kSmoothNoise * pixels;
    THERMEDGE_TRY(
        told <= 0 && is_smooth
            ? denoiser_.run_measured(working_, corrections_.noise_model, working_, runner)
            : denoiser_.run_measured(working_, told > 0 ? told : pixels, working_, runner));
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory, "frame: out of memory");
  }
  round_to_counts(working_, counts_);
  return ImageView<const std::uint16_t>(counts_.view());
}

void FrameDenoiser::copy_values(ImageView<float> out) const {
  const FloatScale scale{corrections_.counts_per_unit, corrections_.offset};
  for (int y = 0; y < out.height(); ++y) {
    std::transform(working_.row(y), working_.row(y) + out.width(), out.row(y), [&](float count) {
      return static_cast<float>(scale.to_value(static_cast<double>(count)));
    });
  }
}

}  // namespace thermedge
