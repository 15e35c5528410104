#include "thermedge/radiometry/grey_scale.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "count_quantiles.hpp"
#include "grey_scale_simd.hpp"

namespace thermedge {
namespace {

constexpr double kMiddleLevel = 127;  // of the median (Algorithm 1)
constexpr double kLargestLevel = 255;

template <class T>
std::string size_text(ImageView<T> image) {
  return std::to_string(image.width()) + "x" + std::to_string(image.height());
}

}  // namespace

Status GreyScaleOptions::check() const { return check_ranges(*this, "grey_scale."); }

int median_counts(ImageView<const std::uint16_t> frame) {
  if (frame.empty()) {
    return 0;
  }
  return detail::count_quantiles(frame, std::array{0.5})[0];
}

Status scale_to_8bit(ImageView<const std::uint16_t> frame, const GreyScaleOptions& options,
                     ImageView<std::uint8_t> levels) {
  if (!same_size(frame, levels)) {
    return failure(ErrorCode::kInvalidArgument, "levels: " + size_text(levels) +
                                                    " pixels for a frame of " + size_text(frame) +
                                                    "; both must have the same size");
  }
  if (Status status = options.check(); !status) {
    return status;
  }
  const int median = median_counts(frame);
  for (int y = 0; y < frame.height(); ++y) {
    detail::scale_row(frame.row(y), frame.width(), {median, kMiddleLevel, options.gain},
                      levels.row(y));
  }
  return {};
}

ClippedShares clipped_shares(ImageView<const std::uint16_t> frame, const GreyScaleOptions& options,
                             ImageView<const std::uint8_t> valid) {
  const int median = median_counts(frame);
  // Levels are rounded away from zero before they are clamped.
  const double too_low = median - (kMiddleLevel + 0.5) / options.gain;
  const double too_high = median + (kLargestLevel + 0.5 - kMiddleLevel) / options.gain;
  std::size_t pixels = 0;
  std::size_t low = 0;
  std::size_t high = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (!valid.empty() && valid(x, y) == 0) {
        continue;
      }
      ++pixels;
      low += frame(x, y) <= too_low ? 1 : 0;
      high += frame(x, y) >= too_high ? 1 : 0;
    }
  }
  const auto share = [&](std::size_t number) {
    return pixels > 0 ? static_cast<double>(number) / static_cast<double>(pixels) : 0;
  };
  return {share(low), share(high)};
}

CountRange count_range(ImageView<const std::uint16_t> frame) {
  if (frame.empty()) {
    return {};
  }
  std::uint16_t smallest = std::numeric_limits<std::uint16_t>::max();
  std::uint16_t largest = 0;
  for (int y = 0; y < frame.height(); ++y) {
    const std::uint16_t* row = frame.row(y);
    for (int x = 0; x < frame.width(); ++x) {
      smallest = std::min(smallest, row[x]);
      largest = std::max(largest, row[x]);
    }
  }
  return {smallest, largest};
}

double range_degc(CountRange range, double degc_per_count) {
  return (range.max - range.min) * degc_per_count;
}

double degc_per_level(double range_degc, int bits) {
  return range_degc / (static_cast<double>(std::uint64_t{1} << bits) - 1);
}

}  // namespace thermedge
