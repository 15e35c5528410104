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
