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

  // What is told about the noise: `sigma` in the units of the frame, `burden` as in run_measured.
  struct Told {
    double sigma = 0;
    NoiseSpectrum spectrum = white_spectrum();
    double burden = 1;
  };

  Status run(ImageView<const float> in, const Told& noise, ImageView<float> out,
             ParallelRunner& runner) {
    if (!options.detrend) {
      return run_filters(in, noise, out, runner);
    }
    detrend.measure(in);
    detrend.subtract(in, out);
    return run_filters(out, noise, out, runner).map([&] { detrend.add(out); });
  }

  // Filters a copy in which the noise is even: distances from the mean of the frame over the map.
  Status run_evened(ImageView<const float> in, const Told& noise, const NoiseLevelMap& map,
                    ImageView<float> out, ParallelRunner& runner) {
    const auto mean = static_cast<float>(detail::frame_range(in).mean);
    map.even_out(in, mean, 0, out);
    return run(out, noise, out, runner).map([&] { map.undo_even_out(mean, out); });
  }

  Status run_filters(ImageView<const float> in, const Told& noise, ImageView<float> out,
                     ParallelRunner& runner) {
    return run_method(in, noise, out, runner).and_then([&]() -> Status {
      const double range = noise.burden * options.bilateral.range_sigmas;
      if (range > 0) {
        if (Status status = check_sigma(noise.sigma); !status) {
          return status;
        }
        bilateral.run(out, range * noise.sigma, out, runner);
      }
      return {};
    });
  }

  Status run_method(ImageView<const float> in, const Told& noise, ImageView<float> out,
                    ParallelRunner& runner) {
    switch (options.method) {
      case DenoiseMethod::kNone:
        copy_pixels(in, out);
        return {};
      case DenoiseMethod::kGaussian:
        gaussian.run(in, noise.burden, out, runner);
        return {};
      case DenoiseMethod::kNlm:
        return run_in_noise_units(nlm, in, noise, out, runner);
      case DenoiseMethod::kBm3d:
        if (Status status = check_side(in); !status) {
          return status;
        }
        return run_in_noise_units(bm3d, in, noise, out, runner);
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
  Status run_in_noise_units(Filter& filter, ImageView<const float> in, const Told& noise,
                            ImageView<float> out, ParallelRunner& runner) {
    const double sigma = noise.sigma * options.sigma_scale;
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
      filter.run(in, {range.mean, sigma, noise.spectrum}, out, runner);
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
  return impl_->guarded(in, out, [&] { return impl_->run(in, {.sigma = sigma}, out, runner); });
}

Status Denoiser::run_measured(ImageView<const float> in, double sigma, ImageView<float> out,
                              ParallelRunner& runner) {
  NoiseModel white;
  white.level_counts = sigma;
  return run_measured(in, white, out, runner);
}

Status Denoiser::run_measured(ImageView<const float> in, const NoiseModel& noise,
                              ImageView<float> out, ParallelRunner& runner, double burden) {
  const DenoiseMethod method = impl_->options.method;
  const bool needs_noise = method == DenoiseMethod::kNlm || method == DenoiseMethod::kBm3d ||
                           impl_->options.bilateral.range_sigmas > 0;
  return impl_->guarded(in, out, [&] {
    if (noise.level_counts == 0 && needs_noise) {
      return impl_->copy_clean(in, out);
    }
    const Impl::Told told{noise.level_counts, noise.spectrum, burden};
    return noise.map.is_even() ? impl_->run(in, told, out, runner)
                               : impl_->run_evened(in, told, noise.map, out, runner);
  });
}

}  // namespace thermedge
