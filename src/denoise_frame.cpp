#include "denoise_frame.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace thermedge::detail {

float NoiseUnits::to_counts(float value) const {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(offset + sigma * value, -kLargest, kLargest));
}

Status check_finite(ImageView<const float> frame) {
  for (int y = 0; y < frame.height(); ++y) {
    const float* row = frame.row(y);
    // On the bits: a loop that the compiler can turn into vector code.
    std::uint32_t exponents_full = 0;
    for (int x = 0; x < frame.width(); ++x) {
      exponents_full |= (std::bit_cast<std::uint32_t>(row[x]) & 0x7fffffffU) >= 0x7f800000U;
    }
    if (exponents_full != 0) {
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
  double sum = 0;
  float low = frame(0, 0);
  float high = low;
  for (int y = 0; y < frame.height(); ++y) {
    const float* row = frame.row(y);
    for (int x = 0; x < frame.width(); ++x) {
      sum += row[x];
      low = std::min(low, row[x]);
      high = std::max(high, row[x]);
    }
  }
  const double mean = sum / static_cast<double>(frame.size());
  return {mean, std::max(high - mean, mean - low)};
}

void mirrored_row(ImageView<const float> frame, const NoiseUnits& units, int y, int margin,
                  int out_width, float* out) {
  const int width = frame.width();
  const float* row = frame.row(mirrored(y, frame.height()));
  for (int i = 0; i < width; ++i) {
    out[margin + i] = units.from_counts(row[i]);
  }
  for (int i = 0; i < margin; ++i) {
    out[i] = out[margin + mirrored(i - margin, width)];
  }
  for (int i = margin + width; i < out_width; ++i) {
    out[i] = out[margin + mirrored(i - margin, width)];
  }
}

}  // namespace thermedge::detail
