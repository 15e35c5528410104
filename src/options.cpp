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

}  // namespace detail

DetectorOptions preset_options(Preset preset) {
  DetectorOptions options;  // the defaults of the structs are those of the paper
  options.preset = preset;
  if (preset == Preset::kRobust) {
    options.edges = EdgeMethod::kOriented;
    options.nuc.stripes = true;
    options.denoise.strength = 1.2;
    options.denoise.shading = true;
    options.denoise.ripple.range_sigmas = 0.2;
    options.selection.keep_edges = 0;
    options.selection.min_score = 0.5;
    options.selection.max_false_alarms = 0.1;
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
