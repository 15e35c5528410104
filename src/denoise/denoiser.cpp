#include "thermedge/stages/denoiser.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>

#include "bilateral.hpp"
#include "bm3d.hpp"
#include "detrend.hpp"
#include "float_frame.hpp"
#include "gaussian.hpp"
#include "nlm.hpp"
#include "thermedge/memory.hpp"

namespace thermedge {
namespace {

Status check_odd(int value, const std::string& name) {
  return value % 2 == 1 ? Status{}
                        : failure(ErrorCode::kInvalidArgument,
                                  name + " = " + std::to_string(value) + ": must be odd");
}

Status check_sigma_px(double sigma_px) {
  return sigma_px == 0 || sigma_px >= 0.3
             ? Status{}
             : failure(ErrorCode::kInvalidArgument,
                       "denoise.gaussian.sigma_px = " + std::to_string(sigma_px) +
                           ": must be 0 (the 5x5 kernel) or 0.3 to 20");
}

Status check_input(ImageView<const float> in, ImageView<float> out) {
  if (in.empty()) {
    return failure(ErrorCode::kInvalidArgument, "frame is empty; it needs at least one pixel");
  }
  if (!same_size(in, out)) {
    return failure(ErrorCode::kInvalidArgument, "result has another size than the frame");
  }
  return detail::check_finite(in);
}

Status check_sigma(double sigma) {
  return sigma > 0 && std::isfinite(sigma)
             ? Status{}
             : failure(ErrorCode::kInvalidArgument,
                       "sigma = " + std::to_string(sigma) +
                           ": the noise must be a finite number above 0");
}

Status check_side(ImageView<const float> in) {
  return std::min(in.width(), in.height()) >= detail::kBlockPx
             ? Status{}
             : failure(ErrorCode::kInvalidArgument, "frame of " + std::to_string(in.width()) +
                                                        " x " + std::to_string(in.height()) +
                                                        " pixels: bm3d needs 8 x 8 or more");
}

}  // namespace

Status DenoiseOptions::check() const {
  if (Status status = check_ranges(*this, "denoise."); !status) {
    return status;
  }
  for (const Status& status :
       {check_sigma_px(gaussian.sigma_px), check_odd(nlm.patch_px, "denoise.nlm.patch_px"),
        check_odd(nlm.search_px, "denoise.nlm.search_px")}) {
    if (!status) {
      return status;
    }
  }
  return {};
}

void round_to_counts(ImageView<const float> in, ImageView<std::uint16_t> out) {
  for (int y = 0; y < in.height(); ++y) {
    std::transform(in.row(y), in.row(y) + in.width(), out.row(y), [](float value) {
      return static_cast<std::uint16_t>(std::clamp(value, 0.0F, 65535.0F) + 0.5F);
    });
  }
}

struct Denoiser::Impl {
  Impl(const DenoiseOptions& chosen, const DenoiseTuning& tuning)
      : options(chosen),
        options_status(chosen.check()),
        gaussian(chosen.gaussian, tuning.gaussian),
        nlm(chosen.nlm, tuning.nlm),
        bm3d(detail::bm3d_settings(chosen.bm3d, tuning.bm3d)),
        bilateral(chosen.bilateral, tuning.bilateral) {}

  // `burden`: see run_measured.
  Status run(ImageView<const float> in, double sigma, double burden, ImageView<float> out,
             ParallelRunner& runner) {
    if (!options.detrend) {
      return run_filters(in, sigma, burden, out, runner);
    }
    detrend.measure(in);
    detrend.subtract(in, out);
    return run_filters(out, sigma, burden, out, runner).map([&] { detrend.add(out); });
  }

  Status run_filters(ImageView<const float> in, double sigma, double burden, ImageView<float> out,
                     ParallelRunner& runner) {
    return run_method(in, sigma * options.sigma_scale, burden, out, runner)
        .and_then([&]() -> Status {
          const double range = burden * options.bilateral.range_sigmas;
          if (range > 0) {
            if (Status status = check_sigma(sigma); !status) {
              return status;
            }
            bilateral.run(out, range * sigma, out, runner);
          }
          return {};
        });
  }

  Status run_method(ImageView<const float> in, double sigma, double burden, ImageView<float> out,
                    ParallelRunner& runner) {
    switch (options.method) {
      case DenoiseMethod::kNone:
        copy_pixels(in, out);
        return {};
      case DenoiseMethod::kGaussian:
        gaussian.run(in, burden, out, runner);
        return {};
      case DenoiseMethod::kNlm:
        return run_in_noise_units(nlm, in, sigma, out, runner);
      case DenoiseMethod::kBm3d:
        if (Status status = check_side(in); !status) {
          return status;
        }
        return run_in_noise_units(bm3d, in, sigma, out, runner);
    }
    return failure(ErrorCode::kInvalidArgument,
                   "denoise.method: must be none, gaussian, nlm or bm3d");
  }

  // Checks what does not depend on the method, and turns bad_alloc into a Status.
  template <class Process>
  Status guarded(ImageView<const float> in, ImageView<float> out, const Process& process) {
    if (!options_status) {
      return options_status;
    }
    if (Status status = check_input(in, out); !status) {
      return status;
    }
    try {
      return process();
    } catch (const std::bad_alloc&) {
      return failure(ErrorCode::kOutOfMemory, "denoise: out of memory for a frame of " +
                                                  std::to_string(in.width()) + " x " +
                                                  std::to_string(in.height()) + " pixels");
    }
  }

  // Prepares all the same, so that a clean first frame counts as one.
  Status copy_clean(ImageView<const float> in, ImageView<float> out) {
    if (options.method == DenoiseMethod::kGaussian) {
      gaussian.prepare(in.width(), in.height());
    } else if (options.method == DenoiseMethod::kNlm) {
      nlm.prepare(in.width(), in.height());
    } else if (options.method == DenoiseMethod::kBm3d) {
      bm3d.prepare(in.width(), in.height());
    }
    bilateral.prepare(in.width(), in.height());
    detrend.prepare(in.width(), in.height());
    copy_pixels(in, out);
    return {};
  }

  template <class Filter>
  static Status run_in_noise_units(Filter& filter, ImageView<const float> in, double sigma,
                                   ImageView<float> out, ParallelRunner& runner) {
    if (Status status = check_sigma(sigma); !status) {
      return status;
    }
    // Noise far below the resolution of a float cannot be removed, only overflow.
    constexpr double kLeastNoise = 1e-15;
    const detail::FrameRange range = detail::frame_range(in);
    if (range.deviation == 0 || sigma <= kLeastNoise * range.deviation) {
      filter.prepare(in.width(), in.height());  // so that a flat first frame counts as one
      copy_pixels(in, out);
    } else {
      filter.run(in, {range.mean, sigma}, out, runner);
    }
    return {};
  }

  DenoiseOptions options;
  Status options_status;
  detail::GaussianFilter gaussian;
  detail::NonLocalMeans nlm;
  detail::Bm3d bm3d;
  detail::BilateralFilter bilateral;
  detail::Detrender detrend;
};

Denoiser::Denoiser(const DenoiseOptions& options, const DenoiseTuning& tuning)
    : impl_(std::make_unique<Impl>(options, tuning)) {}
Denoiser::Denoiser(Denoiser&&) noexcept = default;
Denoiser& Denoiser::operator=(Denoiser&&) noexcept = default;
Denoiser::~Denoiser() = default;

std::size_t Denoiser::memory_bytes() const {
  return detail::memory_of(impl_->gaussian, impl_->nlm, impl_->bm3d, impl_->bilateral,
                           impl_->detrend);
}

Status Denoiser::run(ImageView<const float> in, double sigma, ImageView<float> out,
                     ParallelRunner& runner) {
  return impl_->guarded(in, out, [&] { return impl_->run(in, sigma, 1, out, runner); });
}

Status Denoiser::run_measured(ImageView<const float> in, double sigma, ImageView<float> out,
                              ParallelRunner& runner, double burden) {
  const DenoiseMethod method = impl_->options.method;
  const bool needs_noise = method == DenoiseMethod::kNlm || method == DenoiseMethod::kBm3d ||
                           impl_->options.bilateral.range_sigmas > 0;
  if (sigma == 0 && needs_noise) {
    return impl_->guarded(in, out, [&] { return impl_->copy_clean(in, out); });
  }
  return impl_->guarded(in, out, [&] { return impl_->run(in, sigma, burden, out, runner); });
}

}  // namespace thermedge
