// Every value by which a preset differs from the defaults of its stages.
#include "thermedge/presets.hpp"

#include "thermedge/options.hpp"

namespace thermedge {
namespace {

void set_paper(DetectorOptions& options) {
  options.validity.find = false;
  // ET: the text gives no number; with 60, upright edges, which ES ranks last, would be lost.
  options.selection = {
      .keep_edges = 100, .max_edgels = 0, .min_score = -1e9, .max_false_alarms = 0};
}

void set_robust(DetectorOptions& options) {
  options.stripes.remove = true;
  options.denoise.method = DenoiseMethod::kBm3d;
  options.denoise.sigma_scale = 1.2;
  options.denoise.detrend = true;
  // More blocks give a better picture, and edges that are no better.
  options.denoise.bm3d.profile = Bm3dProfile::kFastest;
  options.denoise.bm3d.adjacent_blocks = false;
  options.denoise.bm3d.keep_slopes = true;
  options.denoise.bilateral.range_sigmas = 0.2;
  options.selection = {
      .keep_edges = 0, .max_edgels = 0, .min_score = -0.6, .max_false_alarms = 0.1};
}

void set_fast(DetectorOptions& options) {
  set_robust(options);
  options.denoise = {};
  options.denoise.method = DenoiseMethod::kGaussian;
  options.denoise.gaussian.sigma_px = 1.5;
  options.denoise.detrend = true;
  options.denoise.bilateral.range_sigmas = 0.3;
  options.selection.min_score = 0;
}

}  // namespace

DetectorOptions::DetectorOptions(Preset preset) : preset_(preset) {
  switch (preset) {
    case Preset::kPaper:
      own_.emplace<PaperOptions>();
      set_paper(*this);
      break;
    case Preset::kFast:
      set_fast(*this);
      break;
    case Preset::kRobust:
      set_robust(*this);
      break;
  }
}

std::string_view preset_name(Preset preset) {
  for (const auto& known : kPresets) {
    if (known.value == preset) {
      return known.name;
    }
  }
  return "unknown";
}

std::optional<Preset> preset_named(std::string_view name) {
  for (const auto& known : kPresets) {
    if (known.name == name) {
      return known.value;
    }
  }
  return std::nullopt;
}

std::string_view preset_meaning(Preset preset) {
  switch (preset) {
    case Preset::kRobust:
      return "the default: the best edges, after BM3D denoising";
    case Preset::kFast:
      return "robust's stages after a Gaussian and a bilateral filter instead of BM3D";
    case Preset::kPaper:
      return "the algorithms of the paper as its text defines them";
  }
  return "";
}

}  // namespace thermedge
