// Which options of the detector suit a recording.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "thermedge/options.hpp"
#include "thermedge/probe/probe.hpp"

namespace thermedge {
namespace {

// Frames that the paper's limits on sizes are for, px.
constexpr int kPaperWidth = 382;
constexpr int kPaperHeight = 288;

std::string number(double value, int digits) {
  char text[32];
  const auto end =
      std::to_chars(std::begin(text), std::end(text), value, std::chars_format::fixed, digits).ptr;
  return {std::begin(text), end};
}

std::string shortest(double value) {
  char text[32];
  return {std::begin(text), std::to_chars(std::begin(text), std::end(text), value).ptr};
}

std::string percent(double share) { return number(100 * share, 1) + " %"; }

// The largest gain that clips little and is no finer than the noise deserves.
std::optional<double> better_gain(const RecordingReport& report, double now,
                                  const SuggestionTuning& tuning) {
  const double sigma = report.sigma_counts;
  const bool clips = report.clipped_share(now) > tuning.most_clipped_share;
  const bool is_coarse = sigma > 0 && 1 / now > tuning.coarsest_level_sigmas * sigma;
  if (!clips && !is_coarse) {
    return std::nullopt;
  }
  for (const GainClipping& entry : report.clipping) {
    if (entry.share <= tuning.most_clipped_share &&
        1 / entry.gain >= tuning.finest_level_sigmas * sigma &&
        (clips ? entry.gain < now : entry.gain > now)) {
      return entry.gain;
    }
  }
  return std::nullopt;
}

void suggest_gain(const RecordingReport& report, const SuggestionTuning& tuning,
                  std::vector<SuggestedOption>& options) {
  const double now = GreyScaleOptions{}.gain;
  if (const auto gain = better_gain(report, now, tuning)) {
    options.push_back({"grey_scale.gain", shortest(*gain),
                       "clips " + percent(report.clipped_share(*gain)) + " of the pixels, gain " +
                           shortest(now) + " would clip " + percent(report.clipped_share(now))});
  }
}

void suggest_sigma(const RecordingReport& report, const SuggestionTuning& tuning,
                   std::vector<SuggestedOption>& options) {
  const double sigma = report.pixel_sigma_counts;
  if (std::abs(sigma - report.frame_sigma_counts) > tuning.sigma_tolerance * sigma) {
    options.push_back({"denoise.sigma_counts", number(sigma, 1),
                       "noise differs over the picture; its quieter half has " +
                           number(report.frame_sigma_counts, 1) + " counts"});
  }
}

}  // namespace

std::vector<SuggestedOption> suggest_options(const RecordingReport& report, Preset preset,
                                             const SuggestionTuning& tuning) {
  std::vector<SuggestedOption> options;
  const DetectorOptions defaults(preset);
  const PaperOptions* paper = defaults.paper();
  const double pixels = static_cast<double>(report.width) * report.height;
  if (report.passing_bad_pixels > tuning.passing_share * pixels) {
    options.push_back({"bad_pixels.threshold_sigmas",
                       shortest(tuning.threshold_factor * defaults.bad_pixels.threshold_sigmas),
                       number(report.passing_bad_pixels, 0) +
                           " pixels a frame are taken for dead that soon recover"});
  }
  const double stripes = std::max(report.column_sigma_counts, report.row_sigma_counts);
  if (!defaults.stripes.remove && stripes > tuning.stripes_sigmas * report.sigma_counts) {
    options.push_back({"stripes.remove", "true",
                       "columns or rows are offset by " + number(stripes, 1) +
                           " counts, which come out as edges"});
  }
  if (paper != nullptr && report.container_bits == 16) {
    suggest_gain(report, tuning, options);
  }
  if (paper != nullptr) {  // the others have a map of the noise
    suggest_sigma(report, tuning, options);
  }
  const double scale =
      static_cast<double>(report.width + report.height) / (kPaperWidth + kPaperHeight);
  if (paper != nullptr && scale < tuning.small_frame_scale) {
    options.push_back(
        {"contours.min_component_px",
         number(std::max(std::round(paper->contours.min_component_px * scale), 1.0), 0),
         "in proportion to the size of the frames"});
  }
  return options;
}

}  // namespace thermedge
