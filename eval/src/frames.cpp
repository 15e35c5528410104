#include "frames.hpp"

#include <algorithm>
#include <bitset>

namespace thermedge::eval {
namespace {

// The values that occur in the first few maps: whether they are binary.
std::bitset<256> values_of(const PredictionSet& found) {
  constexpr std::size_t kLookedAt = 5;
  std::bitset<256> values;
  for (std::size_t i = 0; i < std::min(found.names().size(), kLookedAt); ++i) {
    const auto edges = found.read(i);
    for (int y = 0; edges && y < edges->map.height(); ++y) {
      const std::uint8_t* row = edges->map.row(y);
      std::for_each(row, row + edges->map.width(), [&](std::uint8_t value) { values.set(value); });
    }
  }
  return values;
}

int highest(const std::bitset<256>& values) {
  int value = 255;
  while (value > 1 && !values[static_cast<std::size_t>(value)]) {
    --value;
  }
  return value;
}

}  // namespace

Status check(const EvaluationOptions& options) {
  const auto range = [](const char* name, const char* values) -> Status {
    return failure(ErrorCode::kInvalidArgument, std::string(name) + " should be " + values);
  };
  if (!(options.count.max_distance >= 0 && options.count.max_distance <= 0.1)) {
    return range("max_distance", "0 to 0.1 of the diagonal");
  }
  if (options.thresholds < 1 || options.thresholds > 254) {
    return range("thresholds", "1 to 254");
  }
  if (options.at < 0 || options.at > 255) {
    return range("at", "1 to 255, or 0 for a sweep");
  }
  if (options.short_px < 1 || options.short_px > 10000) {
    return range("short_px", "1 to 10000");
  }
  if (!(options.sigma_counts >= 0 && options.sigma_counts <= 65535)) {
    return range("sigma_counts", "0 to 65535");
  }
  if (!(options.repeat_reach_px > 0 && options.repeat_reach_px <= 100)) {
    return range("repeat_reach_px", "above 0, up to 100");
  }
  if (options.most_shift_px < 0 || options.most_shift_px > 64) {
    return range("most_shift_px", "0 to 64");
  }
  return {};
}

Thresholds choose_thresholds(const PredictionSet& found, const EvaluationOptions& options) {
  const auto values = values_of(found);
  Thresholds thresholds;
  thresholds.binary = values.count() <= 2;
  thresholds.values = options.at > 0      ? std::vector<int>{options.at}
                      : thresholds.binary ? std::vector<int>{highest(values)}
                                          : spread_thresholds(options.thresholds);
  return thresholds;
}

}  // namespace thermedge::eval
