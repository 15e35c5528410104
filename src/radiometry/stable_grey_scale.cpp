#include "thermedge/radiometry/stable_grey_scale.hpp"

#include <algorithm>
#include <cmath>

#include "grey_scale_simd.hpp"
#include "thermedge/radiometry/grey_scale.hpp"

namespace thermedge {
namespace {

constexpr double kMiddleLevel = 127;
constexpr double kLargestLevel = 255;
constexpr double kLargestGain = 1000;

// One level is worth half of the noise; without noise, a count.
double gain_for(double sigma_counts) {
  return sigma_counts > 0 ? std::min(2 / sigma_counts, kLargestGain) : 1;
}

}  // namespace

Status check_options(const StableGreyScaleOptions& options) {
  return check_ranges(options, "stable_grey_scale.");
}

Result<GreyScaleState> StableGreyScale::run(ImageView<const std::uint16_t> frame,
                                            ImageView<std::uint8_t> levels) {
  if (Status status = check_options(options_); !status) {
    return tl::unexpected(status.error());
  }
  if (frame.empty() || !same_size(frame, levels)) {
    return failure(ErrorCode::kInvalidArgument,
                   "stable view: the frame is empty or the levels have another size");
  }
  const GreyScaleEvent event = place(frame);
  for (int y = 0; y < frame.height(); ++y) {
    detail::scale_row(frame.row(y), frame.width(), {anchor_counts_, base_level_, gain_},
                      levels.row(y));
  }
  const Clipped lost = clipped(frame, anchor_counts_, base_level_);
  return GreyScaleState{.gain = gain_,
                        .offset = base_level_ - anchor_counts_ * gain_,
                        .clipped_low_share = lost.low,
                        .clipped_high_share = lost.high,
                        .event = event};
}

// Where the view lies for this frame.
GreyScaleEvent StableGreyScale::place(ImageView<const std::uint16_t> frame) {
  const int median = median_counts(frame);
  if (gain_ == 0) {
    gain_ = options_.gain > 0 ? options_.gain : gain_for(noise_.measure(frame).sigma_counts);
    anchor_counts_ = median;
    base_level_ = kMiddleLevel;
    return GreyScaleEvent::kStart;
  }
  const double lost = clipped(frame, anchor_counts_, base_level_).share();
  const bool jump_would_help =
      lost > options_.cut_clipped_share && clipped(frame, median, kMiddleLevel).share() <= lost / 2;
  if (!jump_would_help) {
    clipped_frames_ = 0;
    follow(median);
    return GreyScaleEvent::kNone;
  }
  if (++clipped_frames_ < options_.cut_frames) {
    return GreyScaleEvent::kNone;  // rests: it may be a flash
  }
  anchor_counts_ = median;
  base_level_ = kMiddleLevel;
  clipped_frames_ = 0;
  return GreyScaleEvent::kSceneCut;
}

// Moves the view by no more than it must to have the median within the dead band, and by no more
// than it may.
void StableGreyScale::follow(int median_counts) {
  const double away = (median_counts - anchor_counts_) * gain_ + base_level_ - kMiddleLevel;
  const double beyond = std::max(std::abs(away) - options_.dead_band_levels, 0.0);
  base_level_ -= std::copysign(std::min(beyond, options_.slew_levels), away);
}

StableGreyScale::Clipped StableGreyScale::clipped(ImageView<const std::uint16_t> frame,
                                                  int anchor_counts, double base_level) const {
  const double darkest = anchor_counts - base_level / gain_;
  const double brightest = anchor_counts + (kLargestLevel - base_level) / gain_;
  std::size_t low = 0, high = 0;
  for (int y = 0; y < frame.height(); ++y) {
    const std::uint16_t* row = frame.row(y);
    for (int x = 0; x < frame.width(); ++x) {
      low += row[x] < darkest ? 1 : 0;
      high += row[x] > brightest ? 1 : 0;
    }
  }
  const auto pixels = static_cast<double>(frame.size());
  return {static_cast<double>(low) / pixels, static_cast<double>(high) / pixels};
}

}  // namespace thermedge
