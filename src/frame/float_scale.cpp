#include "thermedge/float_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "order_statistics.hpp"

namespace thermedge {
namespace {

constexpr double kMostCounts = std::numeric_limits<std::uint16_t>::max();
constexpr double kMiddleCounts = 32768;

// Of whole numbers, steps are kept. Those of int16 always get the same offset; others lie in the
// middle, so that nothing that is done to them is clamped.
FloatScale whole_number_scale(double least, double greatest) {
  if (least >= 0 && greatest <= kMostCounts) {
    return {};
  }
  const bool is_int16 = least >= -kMiddleCounts && greatest < kMiddleCounts;
  const double margin = std::floor((kMostCounts - (greatest - least)) / 2);
  return {.counts_per_unit = 1, .offset = is_int16 ? -kMiddleCounts : least - margin};
}

// A power of two, so that values on the grid of a sensor stay on a grid.
FloatScale spread_scale(double low, double high, double median, double sigma) {
  constexpr double kSpanCounts = 16384;
  constexpr double kLeastSigmaCounts = 8;
  const double span = high > low ? high - low : 1;
  const double by_range = std::exp2(std::floor(std::log2(kSpanCounts / span)));
  if (sigma <= 0 || sigma * by_range >= kLeastSigmaCounts) {
    return {.counts_per_unit = by_range, .offset = (low + high) / 2 - kMiddleCounts / by_range};
  }
  const double by_noise = std::exp2(std::ceil(std::log2(kLeastSigmaCounts / sigma)));
  return {.counts_per_unit = by_noise, .offset = median - kMiddleCounts / by_noise};
}

}  // namespace

FloatScaleChooser::Spread FloatScaleChooser::measure(ImageView<const float> values) {
  constexpr double kTail = 0.001;
  Spread spread;
  sample_.clear();
  sample_.reserve(values.size());
  float least = std::numeric_limits<float>::infinity();
  float greatest = -least;
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const float value = values(x, y);
      if (std::isfinite(value)) {
        sample_.push_back(value);
        least = std::min(least, value);
        greatest = std::max(greatest, value);
        spread.is_whole = spread.is_whole && std::floor(value) == value;
      }
    }
  }
  spread.is_empty = sample_.empty();
  if (spread.is_empty) {
    return spread;
  }
  spread.low = static_cast<double>(least);
  spread.high = static_cast<double>(greatest);
  spread.is_whole = spread.is_whole && spread.high - spread.low <= kMostCounts;
  if (!spread.is_whole) {
    const std::size_t last = sample_.size() - 1;
    const auto tail = static_cast<std::size_t>(kTail * static_cast<double>(last));
    spread.low = static_cast<double>(detail::nth_value(std::span(sample_), tail));
    spread.high = static_cast<double>(detail::nth_value(std::span(sample_), last - tail));
    spread.median = static_cast<double>(detail::nth_value(std::span(sample_), last / 2));
    spread.sigma = noise_of(values);
  }
  return spread;
}

// By the median of the steps between neighbours, which edges do not reach.
double FloatScaleChooser::noise_of(ImageView<const float> values) {
  constexpr double kMedianStepOfUnitNoise = 0.9539;
  sample_.clear();
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 1; x < values.width(); ++x) {
      const float step = std::abs(values(x, y) - values(x - 1, y));
      if (std::isfinite(step)) {
        sample_.push_back(step);
      }
    }
  }
  return sample_.empty()
             ? 0
             : static_cast<double>(detail::nth_value(std::span(sample_), sample_.size() / 2)) /
                   kMedianStepOfUnitNoise;
}

FloatScale FloatScaleChooser::choose(ImageView<const float> values) {
  const Spread spread = measure(values);
  if (spread.is_empty) {
    return {};
  }
  return spread.is_whole ? whole_number_scale(spread.low, spread.high)
                         : spread_scale(spread.low, spread.high, spread.median, spread.sigma);
}

FloatScale FloatScaleChooser::choose(ImageView<const float> values, const FloatScale& before) {
  constexpr double kMarginCounts = 4096;
  constexpr double kLeastSpanCounts = 4096;
  const Spread spread = measure(values);
  if (spread.is_empty) {
    return before;
  }
  const double low = (spread.low - before.offset) * before.counts_per_unit;
  const double high = (spread.high - before.offset) * before.counts_per_unit;
  if (spread.is_whole) {
    const bool suits = before.counts_per_unit == 1 && low >= 0 && high <= kMostCounts;
    return suits ? before : whole_number_scale(spread.low, spread.high);
  }
  const FloatScale fresh = spread_scale(spread.low, spread.high, spread.median, spread.sigma);
  const bool is_fine = before.counts_per_unit >= fresh.counts_per_unit / 2;
  const bool suits = low >= kMarginCounts && high <= kMostCounts - kMarginCounts &&
                     high - low >= kLeastSpanCounts && is_fine;
  return suits ? before : fresh;
}

void to_counts(ImageView<const float> values, const FloatScale& scale,
               ImageView<std::uint16_t> counts) {
  for (int y = 0; y < values.height(); ++y) {
    std::transform(values.row(y), values.row(y) + values.width(), counts.row(y), [&](float value) {
      return std::isfinite(value) ? static_cast<std::uint16_t>(
                                        std::clamp(scale.to_count(value), 0.0, kMostCounts) + 0.5)
                                  : std::uint16_t{0};
    });
  }
}

}  // namespace thermedge
