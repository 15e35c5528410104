#include "thermedge/options.hpp"

#include "option_values.hpp"

namespace thermedge {
namespace {

// Fails where an option of a denoiser that is not the chosen one differs from the preset's.
template <class Group>
Status check_unused(DenoiseMethod owner, DenoiseMethod chosen, const Group& options,
                    const Group& of_preset) {
  if (owner == chosen) {
    return {};
  }
  const detail::OptionValues set(options);
  const detail::OptionValues usual(of_preset);
  const auto name_of = [](DenoiseMethod method) {
    return std::string(kDenoiseMethods[static_cast<std::size_t>(method)].name);
  };
  for (std::size_t i = 0; i < set.values.size(); ++i) {
    if (set.values[i] != usual.values[i]) {
      return failure(ErrorCode::kInvalidArgument,
                     "denoise." + name_of(owner) + "." + std::string(set.names[i]) +
                         " is used with denoise.method = \"" + name_of(owner) +
                         "\" only; it is \"" + name_of(chosen) + "\"");
    }
  }
  return {};
}

// Preset paper drops no edge by its contrast.
Status check_contrast(const SelectionOptions& options, Preset preset) {
  const SelectionOptions usual;
  const bool is_set = options.min_contrast != usual.min_contrast;
  if (preset != Preset::kPaper || (!is_set && options.degc_per_count == usual.degc_per_count)) {
    return {};
  }
  const std::string name = is_set ? "selection.min_contrast" : "selection.degc_per_count";
  return failure(ErrorCode::kInvalidArgument,
                 name + " is used with presets robust and fast only; the preset is paper", name);
}

Status check_denoisers(const DenoiseOptions& options, const DenoiseOptions& of_preset) {
  const DenoiseMethod chosen = options.method;
  const bool is_told_noise = chosen == DenoiseMethod::kNlm || chosen == DenoiseMethod::kBm3d;
  if (!is_told_noise && options.sigma_scale != of_preset.sigma_scale) {
    return failure(ErrorCode::kInvalidArgument,
                   "denoise.sigma_scale is used with denoise.method = \"nlm\" or \"bm3d\" only",
                   "denoise.sigma_scale");
  }
  return check_unused(DenoiseMethod::kGaussian, chosen, options.gaussian, of_preset.gaussian)
      .and_then(
          [&] { return check_unused(DenoiseMethod::kNlm, chosen, options.nlm, of_preset.nlm); })
      .and_then(
          [&] { return check_unused(DenoiseMethod::kBm3d, chosen, options.bm3d, of_preset.bm3d); });
}

// The first failure.
template <class... Options>
Status check_each(const Options&... options) {
  Status first;
  ((first = first.and_then([&] { return options.check(); })), ...);
  return first;
}

}  // namespace

Status RobustOptions::check() const {
  return check_each(oriented_filter, graph, gap_closing, corners);
}

Status PaperOptions::check() const {
  return check_each(grey_scale, canny, contours, linking, corners, scoring);
}

Status DetectorOptions::check() const {
  return check_ranges(*this, "")
      .and_then([&] { return check_each(validity, bad_pixels, stripes, denoise, selection); })
      .and_then([&] { return std::visit([](const auto& own) { return own.check(); }, own_); })
      .and_then([&] { return check_denoisers(denoise, DetectorOptions(preset_).denoise); })
      .and_then([&] { return check_contrast(selection, preset_); });
}

}  // namespace thermedge
