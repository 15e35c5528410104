#include "float_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>

#include "extent_simd.hpp"

namespace thermedge::detail {
namespace {

// Continues out[margin ... margin + width) to both sides.
void mirror_sides(int width, int margin, int out_width, float* out) {
  for (int i = 0; i < margin; ++i) {
    out[i] = out[margin + mirrored(i - margin, width)];
  }
  for (int i = margin + width; i < out_width; ++i) {
    out[i] = out[margin + mirrored(i - margin, width)];
  }
}

}  // namespace

float NoiseUnits::to_counts(float value) const {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(offset + sigma * value, -kLargest, kLargest));
}

Status check_finite(ImageView<const float> frame) {
  for (int y = 0; y < frame.height(); ++y) {
    const float* row = frame.row(y);
    if (!extent_of(row, frame.width()).finite) {
      const auto* bad =
          std::find_if(row, row + frame.width(), [](float v) { return !std::isfinite(v); });
      return failure(ErrorCode::kInvalidArgument,
                     "frame: pixel (" + std::to_string(bad - row) + ", " + std::to_string(y) +
                         ") is NaN or infinite; a denoiser needs finite pixels");
    }
  }
  return {};
}

FrameRange frame_range(ImageView<const float> frame) {
  // Sums side by side: no addition waits for the one before it.
  constexpr std::size_t kSums = 8;
  std::array<double, kSums> sums{};
  float low = frame(0, 0);
  float high = low;
  for (int y = 0; y < frame.height(); ++y) {
    const float* row = frame.row(y);
    const Extent extent = extent_of(row, frame.width());
    low = std::min(low, extent.low);
    high = std::max(high, extent.high);
    const auto width = static_cast<std::size_t>(frame.width());
    std::size_t x = 0;
    for (; x + kSums <= width; x += kSums) {
      for (std::size_t i = 0; i < kSums; ++i) {
        sums[i] += row[x + i];
      }
    }
    for (; x < width; ++x) {
      sums[0] += row[x];
    }
  }
  const double mean =
      std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(frame.size());
  return {mean, std::max(high - mean, mean - low)};
}

void mirrored_row(ImageView<const float> frame, int y, int margin, int out_width, float* out) {
  const float* row = frame.row(mirrored(y, frame.height()));
  std::copy_n(row, frame.width(), out + margin);
  mirror_sides(frame.width(), margin, out_width, out);
}

void mirrored_row(ImageView<const float> frame, const NoiseUnits& units, int y, int margin,
                  int out_width, float* out) {
  const float* row = frame.row(mirrored(y, frame.height()));
  std::transform(row, row + frame.width(), out + margin,
                 [&](float counts) { return units.from_counts(counts); });
  mirror_sides(frame.width(), margin, out_width, out);
}

}  // namespace thermedge::detail
