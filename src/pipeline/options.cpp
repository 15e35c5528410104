#include "thermedge/options.hpp"

#include <charconv>

namespace thermedge {
namespace {

std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  return {std::begin(text), end};
}

}  // namespace

namespace detail {

std::string out_of_range(const std::string& name, double value, Bounds bounds) {
  return name + " = " + shortest(value) + " is out of range: " + shortest(bounds.min) + " to " +
         shortest(bounds.max);
}

BadPixelOptions robust_nuc() {
  BadPixelOptions options;
  options.stripes = true;
  return options;
}

DenoiseOptions robust_denoise() {
  DenoiseOptions options;
  options.sigma_scale = 1.2;
  options.detrend = true;
  options.bilateral.range_sigmas = 0.2;
  return options;
}

SelectionOptions robust_selection() {
  SelectionOptions options;
  options.keep_edges = 0;
  options.min_score = -0.6;
  options.max_false_alarms = 0.1;
  return options;
}

}  // namespace detail

DetectorOptions preset_options(Preset preset) {
  DetectorOptions options;
  options.preset = preset;
  if (preset == Preset::kFast) {
    options.denoise = {};
    options.denoise.method = DenoiseMethod::kGaussian;
    options.denoise.gaussian.sigma_px = 2;
    options.denoise.bilateral.range_sigmas = 0.3;
    options.denoise.detrend = true;
    options.selection.min_score = 0.15;
  } else if (preset == Preset::kPaper) {
    options.edges = EdgeMethod::kCanny;
    options.nuc = {};
    options.denoise = {};
    options.selection = {};
  }
  return options;
}

std::string_view preset_name(Preset preset) {
  for (const auto& known : kPresets) {
    if (known.value == preset) {
      return known.name;
    }
  }
  return "unknown";
}

Status check_options(const DetectorOptions& options) { return check_ranges(options, ""); }

}  // namespace thermedge
