#include "thermedge/radiometry/stable_grey_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "count_quantiles.hpp"
#include "grey_scale_simd.hpp"
#include "thermedge/radiometry/grey_scale.hpp"

namespace thermedge {
namespace {

constexpr double kMiddleLevel = 127;
constexpr double kLargestLevel = 255;
constexpr double kLargestGain = 1000;
// Of the levels, that a range fills: when it is chosen, and when a view that clipped has been
// moved.
constexpr double kChosenFill = 0.8;
constexpr double kFittedFill = 0.9;
constexpr double kFitSlewLevels = 10;
constexpr double kFitGainStep = 0.94;
// A range that fills less than this for some frames gets a higher gain, step by step, until it
// fills more.
constexpr double kNarrowFill = 0.4;
constexpr double kWidenedFill = 0.6;
constexpr int kNarrowFrames = 50;
constexpr double kRaiseGainStep = 1.02;

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
    detail::scale_row(frame.row(y), frame.width(),
                      {view_.anchor_counts, view_.base_level, view_.gain}, levels.row(y));
  }
  const Clipped lost = clipped(frame, view_);
  return GreyScaleState{.gain = view_.gain,
                        .offset = view_.base_level - view_.anchor_counts * view_.gain,
                        .clipped_low_share = lost.low,
                        .clipped_high_share = lost.high,
                        .event = event};
}

// Where the view lies for this frame.
GreyScaleEvent StableGreyScale::place(ImageView<const std::uint16_t> frame) {
  const auto [low, median, high] = detail::count_quantiles(frame, std::array{0.005, 0.5, 0.995});
  const Extent extent{low, median, high};
  if (view_.gain == 0) {
    view_ = chosen_for(frame, extent);
    home_level_ = view_.level(median);
    return GreyScaleEvent::kStart;
  }
  const double lost = clipped(frame, view_).share();
  clipped_frames_ = lost > options_.cut_clipped_share ? clipped_frames_ + 1 : 0;
  if (clipped_frames_ >= options_.cut_frames) {
    const View anew = chosen_for(frame, extent);
    if (clipped(frame, anew).share() <= lost / 2) {
      view_ = anew;
      home_level_ = view_.level(median);
      clipped_frames_ = narrow_frames_ = 0;
      is_fitting_ = false;
      return GreyScaleEvent::kSceneCut;
    }
  }
  if (is_resting(lost)) {
    return GreyScaleEvent::kNone;
  }
  is_fitting_ = lost > options_.fit_clipped_share && may_fit(extent);
  if (is_fitting_) {
    fit(extent);
  } else {
    follow(extent);
    raise_gain(extent);
  }
  return GreyScaleEvent::kNone;
}

// Much is clipped all of a sudden: it may be a flash, which should leave the view as it is.
bool StableGreyScale::is_resting(double lost) {
  return clipped_frames_ > 0 && clipped_frames_ < options_.cut_frames && !is_fitting_ &&
         lost > options_.cut_clipped_share;
}

// As on a first frame.
StableGreyScale::View StableGreyScale::chosen_for(ImageView<const std::uint16_t> frame,
                                                  const Extent& extent) {
  if (options_.gain > 0) {
    return {options_.gain, extent.median, kMiddleLevel};
  }
  largest_gain_ = gain_for(noise_.measure(frame).sigma_counts);
  const double fitting = kChosenFill * kLargestLevel / std::max(extent.range(), 1);
  const double gain = std::min(largest_gain_, fitting);
  const double middle_counts = (extent.low + extent.high) / 2.0;
  const double median_level = kMiddleLevel + (extent.median - middle_counts) * gain;
  return {gain, extent.median, median_level};
}

// Whether a view of some gain, or of the one that is given, holds the range.
bool StableGreyScale::may_fit(const Extent& extent) const {
  return options_.gain == 0 || extent.range() * view_.gain <= kLargestLevel;
}

// The median keeps its level.
void StableGreyScale::set_gain(double gain, const Extent& extent) {
  view_ = {gain, extent.median, view_.level(extent.median)};
}

// Moves the view towards one that holds the range of the frame.
void StableGreyScale::fit(const Extent& extent) {
  if (options_.gain == 0) {
    const double fitting = kFittedFill * kLargestLevel / std::max(extent.range(), 1);
    set_gain(std::min(view_.gain, std::max(fitting, kFitGainStep * view_.gain)), extent);
  }
  const double low = view_.level(extent.low);
  const double high = view_.level(extent.high);
  constexpr double kMargin = (1 - kFittedFill) / 2 * kLargestLevel;
  // Neither end leaves the view so that the other one may come in.
  const double room_below = std::max(low, 0.0);
  const double room_above = std::max(kLargestLevel - high, 0.0);
  const double down = std::min(std::max(high - (kLargestLevel - kMargin), 0.0), room_below);
  const double up = std::min(std::max(kMargin - low, 0.0), room_above);
  view_.base_level += std::clamp(up - down, -kFitSlewLevels, kFitSlewLevels);
}

// Moves the view by no more than it must to have the median within the dead band, by no more than
// it may, and by no more than leaves the range of the frame in view.
void StableGreyScale::follow(const Extent& extent) {
  const double away = view_.level(extent.median) - home_level_;
  const double beyond = std::max(std::abs(away) - options_.dead_band_levels, 0.0);
  double step = std::min(beyond, options_.slew_levels);
  if (extent.range() * view_.gain <= kLargestLevel) {
    const double room =
        away > 0 ? view_.level(extent.low) : kLargestLevel - view_.level(extent.high);
    step = std::min(step, std::max(room, 0.0));
  }
  view_.base_level -= std::copysign(step, away);
}

// Gives a chosen gain back what it lost to something that is gone.
void StableGreyScale::raise_gain(const Extent& extent) {
  if (options_.gain > 0 || view_.gain >= largest_gain_) {
    return;
  }
  const double fill = extent.range() * view_.gain / kLargestLevel;
  narrow_frames_ =
      fill < (narrow_frames_ > kNarrowFrames ? kWidenedFill : kNarrowFill) ? narrow_frames_ + 1 : 0;
  if (narrow_frames_ > kNarrowFrames) {
    set_gain(std::min(view_.gain * kRaiseGainStep, largest_gain_), extent);
  }
}

StableGreyScale::Clipped StableGreyScale::clipped(ImageView<const std::uint16_t> frame,
                                                  const View& view) {
  const double darkest = view.anchor_counts - view.base_level / view.gain;
  const double brightest = view.anchor_counts + (kLargestLevel - view.base_level) / view.gain;
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
