#include "false_alarm_models.hpp"

#include <vector>

#include "thermedge/options.hpp"

namespace thermedge::detail {
namespace {

// Whether two sets of options have the same values.
class Values {
 public:
  template <class T, class Limits>
  void operator()(std::string_view, const T& value, const Limits&, std::string_view) {
    values_.push_back(static_cast<double>(value));
  }
  template <class O>
  void group(std::string_view, const O& options) {
    visit_options(options, *this);
  }
  friend bool operator==(const Values&, const Values&) = default;

 private:
  std::vector<double> values_;
};

template <class O>
bool same_values(const O& a, const O& b) {
  Values of_a;
  Values of_b;
  visit_options(a, of_a);
  visit_options(b, of_b);
  return of_a == of_b;
}

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
    const bool same_denoiser = same_values(without_unused(denoise), measured.denoise);
    denoiser_known = denoiser_known || same_denoiser;
    if (same_denoiser && same_values(filter, measured.filter)) {
      return {measured.model, {}};
    }
  }
  return {std::nullopt, denoiser_known ? "not measured with these options of oriented_filter"
                                       : "not measured with these options of denoise"};
}

}  // namespace thermedge::detail
