#include "thermedge/figures/snr_sheet.hpp"

#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "frame_panels.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/stages/noise.hpp"
#include "thermedge/stages/preprocessor.hpp"

namespace thermedge::figures {
namespace {

double aspect_of(const SnrFrame& frame) {
  return static_cast<double>(frame.counts.height()) / frame.counts.width();
}

// A dead pixel would make the range.
Image<std::uint16_t> without_bad_pixels(ImageView<const std::uint16_t> counts) {
  ValidityOptions validity;
  validity.find = false;
  Preprocessor preprocessor({}, {}, validity, false);
  Corrections corrections;
  const auto runner = make_runner(1);
  const auto corrected = preprocessor.run(Frame(counts), *runner, corrections);
  Image<std::uint16_t> copy(corrected.width(), corrected.height());
  copy_pixels(corrected, copy.view());
  return copy;
}

// The text's eqs. 3 and 4: (3342 - 2217) / 100 = 11.25 degC.
Panel raw_panel(const SnrFrame& frame, double degc_per_count) {
  const CountRange range = count_range(frame.counts);
  const double sigma = NoiseEstimator().measure(frame.counts).sigma_counts;
  const std::string ratio =
      sigma > 0 ? fmt::format("range / noise = {:.0f}", (range.max - range.min) / sigma)
                : std::string("no noise was measured");
  return {
      .title = "Raw: " + frame.source,
      .note = fmt::format("counts {} to {}: ({} - {}) x {:g} = {:.2f} degC; noise {:.1f} "
                          "counts = {:.3f} degC; {}. Shown from the 0.5th to the 99.5th "
                          "percentile.",
                          range.min, range.max, range.max, range.min, degc_per_count,
                          range_degc(range, degc_per_count), sigma, sigma * degc_per_count, ratio),
      .aspect = aspect_of(frame),
      .draw = frame_picture(frame.counts)};
}

Panel grey_panel(const SnrFrame& frame, ImageView<const std::uint8_t> levels,
                 const GreyScaleOptions& grey_scale, double degc_per_count) {
  const ClippedShares clipped = clipped_shares(frame.counts, grey_scale);
  return {
      .title = "Grey: " + frame.source,
      .note = fmt::format("Algorithm 1 with {:g} levels a count: {:g} degC a level in every "
                          "frame; {:.1f} % of the pixels clipped.",
                          grey_scale.gain, degc_per_count / grey_scale.gain, 100 * clipped.both()),
      .aspect = aspect_of(frame),
      .draw = levels_picture(levels)};
}

}  // namespace

Result<Figure> draw_snr(std::span<const SnrFrame> frames, const GreyScaleOptions& grey_scale,
                        double degc_per_count, double panel_width) {
  if (frames.empty() || frames.size() > kMostSnrFrames) {
    return failure(ErrorCode::kInvalidArgument,
                   fmt::format("there should be 1 to {} frames", kMostSnrFrames));
  }
  if (!(degc_per_count > 0) || !std::isfinite(degc_per_count)) {
    return failure(ErrorCode::kInvalidArgument, "degc_per_count should be above 0");
  }
  std::vector<Image<std::uint16_t>> corrected;
  std::vector<SnrFrame> shown;
  for (const SnrFrame& frame : frames) {
    corrected.push_back(without_bad_pixels(frame.counts));
    shown.push_back({corrected.back().view(), frame.source});
  }
  std::vector<Image<std::uint8_t>> levels;
  for (const SnrFrame& frame : shown) {
    levels.emplace_back(frame.counts.width(), frame.counts.height());
    if (Status status = scale_to_8bit(frame.counts, grey_scale, levels.back()); !status) {
      return tl::unexpected(status.error());
    }
  }
  std::vector<Panel> panels;
  panels.reserve(2 * shown.size());
  for (const SnrFrame& frame : shown) {
    panels.push_back(raw_panel(frame, degc_per_count));
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    panels.push_back(grey_panel(shown[i], levels[i], grey_scale, degc_per_count));
  }
  const SheetText text = {
      .title = "High and low signal-to-noise ratio",
      .subtitle =
          "range of each frame in degrees (eqs. 3 and 4), and its 8-bit view at a constant "
          "worth of a level (Algorithm 1)",
      .footer = "After figure 5 of Vu Hoang Minh et al. 2017."};
  return make_sheet(text, panels, static_cast<int>(frames.size()),
                    panel_width_for(frames.front().counts.width(), panel_width));
}

}  // namespace thermedge::figures
