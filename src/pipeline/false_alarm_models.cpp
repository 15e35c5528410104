#include "false_alarm_models.hpp"

#include <vector>

#include "option_values.hpp"
#include "thermedge/options.hpp"

namespace thermedge::detail {
namespace {

// Options of a denoiser that is not the chosen one have no effect.
DenoiseOptions without_unused(DenoiseOptions options) {
  options.sigma_counts = 0;
  if (options.method != DenoiseMethod::kGaussian) {
    options.gaussian = {};
  }
  if (options.method != DenoiseMethod::kNlm) {
    options.nlm = {};
  }
  if (options.method != DenoiseMethod::kBm3d) {
    options.bm3d = {};
  }
  return options;
}

struct Measured {
  DenoiseOptions denoise;
  OrientedFilterOptions filter;
  FalseAlarmModel model;
};

// Presets robust and fast: 450 frames of noise of 1 to 100 counts, plain, with stripes, and with
// vignetting (docs/tuning.md); the same model fits both.
std::vector<Measured> measured_models() {
  std::vector<Measured> models;
  for (const Preset preset : {Preset::kRobust, Preset::kFast}) {
    const DetectorOptions options(preset);
    models.push_back({without_unused(options.denoise), options.robust()->oriented_filter, {}});
  }
  return models;
}

}  // namespace

FalseAlarmLookup look_up_false_alarms(const DenoiseOptions& denoise,
                                      const OrientedFilterOptions& filter) {
  bool denoiser_known = false;
  for (const Measured& measured : measured_models()) {
    const bool same_denoiser =
        OptionValues(without_unused(denoise)) == OptionValues(measured.denoise);
    denoiser_known = denoiser_known || same_denoiser;
    if (same_denoiser && OptionValues(filter) == OptionValues(measured.filter)) {
      return {measured.model, {}};
    }
  }
  return {std::nullopt, denoiser_known ? "not measured with these options of oriented_filter"
                                       : "not measured with these options of denoise"};
}

}  // namespace thermedge::detail
