#include "codecs/samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace thermedge::io {
namespace {

// IEEE 754 binary16, kept apart from whole numbers of 16 bits.
struct Half {
  std::uint16_t bits;
};

float to_float(Half half) {
  const int exponent = half.bits >> 10 & 31;
  const auto fraction = static_cast<float>(half.bits & 1023);
  const float sign = (half.bits & 0x8000) != 0 ? -1.0F : 1.0F;
  if (exponent == 31) {
    return fraction == 0 ? sign * std::numeric_limits<float>::infinity()
                         : std::numeric_limits<float>::quiet_NaN();
  }
  return sign *
         (exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25));
}

template <class T>
float to_float(T value) {
  return static_cast<float>(value);
}

template <class T>
T load(const std::byte* bytes, bool is_swapped) {
  std::byte copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof(T));
  if (is_swapped) {
    std::reverse(std::begin(copy), std::end(copy));
  }
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return value;
}

constexpr double kMostCounts = 65535;
constexpr double kMostExact = 16777216;  // whole numbers that a float holds, up to

}  // namespace

ByteOrder chosen_order(SampleOrder choice, ByteOrder order) {
  switch (choice) {
    case SampleOrder::kLittle:
      return ByteOrder::kLittle;
    case SampleOrder::kBig:
      return ByteOrder::kBig;
    case SampleOrder::kSwapped:
      return other_order(order);
    case SampleOrder::kAsFormat:
      break;
  }
  return order;
}

SampleStore::SampleStore(SampleFormat format, ByteOrder order, int width, int height,
                         bool is_inverted, SourceFrame& frame)
    : format_(format),
      is_swapped_(order != kNativeOrder),
      is_inverted_(is_inverted),
      frame_(frame),
      least_(kMostCounts) {
  frame.bits = format.kind == SampleKind::kUnsigned && format.bits == 8 ? 8 : 16;
  frame.counts.resize(width, height);
  frame.valid.resize(0, 0);
  frame.counts_model.reset();
  frame.stamp_ns.reset();
  format.are_counts() ? frame.values.resize(0, 0) : frame.values.resize(width, height);
}

void SampleStore::put(int x, int y, const std::byte* samples, std::size_t count, std::size_t step) {
  if (format_.are_counts()) {
    std::uint16_t* row = frame_.counts.row(y) + x;
    return format_.bits == 8 ? put_counts<std::uint8_t>(row, samples, count, step)
                             : put_counts<std::uint16_t>(row, samples, count, step);
  }
  float* row = frame_.values.row(y) + x;
  if (format_.kind == SampleKind::kFloat) {
    return format_.bits == 16   ? put_values<Half>(row, samples, count, step)
           : format_.bits == 32 ? put_values<float>(row, samples, count, step)
                                : put_values<double>(row, samples, count, step);
  }
  if (format_.kind == SampleKind::kSigned) {
    return format_.bits == 8    ? put_values<std::int8_t>(row, samples, count, step)
           : format_.bits == 16 ? put_values<std::int16_t>(row, samples, count, step)
           : format_.bits == 32 ? put_values<std::int32_t>(row, samples, count, step)
                                : put_values<std::int64_t>(row, samples, count, step);
  }
  return format_.bits == 32 ? put_values<std::uint32_t>(row, samples, count, step)
                            : put_values<std::uint64_t>(row, samples, count, step);
}

template <class T>
void SampleStore::put_counts(std::uint16_t* row, const std::byte* samples, std::size_t count,
                             std::size_t step) {
  constexpr T kLargest = std::numeric_limits<T>::max();
  for (std::size_t i = 0; i < count; ++i) {
    const T value = load<T>(samples + i * step, is_swapped_);
    row[i] = is_inverted_ ? static_cast<T>(kLargest - value) : value;
  }
}

template <class T>
void SampleStore::put_values(float* row, const std::byte* samples, std::size_t count,
                             std::size_t step) {
  for (std::size_t i = 0; i < count; ++i) {
    const T value = load<T>(samples + i * step, is_swapped_);
    row[i] = to_float(value);
    if constexpr (std::is_integral_v<T>) {
      least_ = std::min(least_, static_cast<double>(value));
      greatest_ = std::max(greatest_, static_cast<double>(value));
    }
  }
}

Status SampleStore::finish(const EncodedFile& file) {
  if (format_.are_counts()) {
    return {};
  }
  if (format_.kind != SampleKind::kFloat) {
    if (least_ < -kMostExact || greatest_ > kMostExact) {
      return failure(ErrorCode::kUnsupported,
                     file.name + ": whole numbers of " + std::to_string(format_.bits) +
                         " bits beyond 16777216; up to there they are read as they are");
    }
    if (least_ >= 0 && greatest_ <= kMostCounts) {
      turn_into_counts();
      return {};
    }
  }
  finish_values(frame_);
  return {};
}

void SampleStore::turn_into_counts() {
  copy_pixels(ImageView<const float>(frame_.values), frame_.counts.view());
  frame_.values.resize(0, 0);
}

Status store_packed(const EncodedFile& file, Bytes packed, SampleFormat format, ByteOrder order,
                    int width, int height, SourceFrame& frame, bool is_inverted) {
  SampleStore store(format, order, width, height, is_inverted, frame);
  const std::size_t row_bytes = static_cast<std::size_t>(width) * format.bytes();
  for (int y = 0; y < height; ++y) {
    store.put(0, y, packed.data() + static_cast<std::size_t>(y) * row_bytes,
              static_cast<std::size_t>(width), format.bytes());
  }
  return store.finish(file);
}

void finish_values(SourceFrame& frame) {
  const ImageView<const float> values = frame.values;
  frame.scale = FloatScaleChooser().choose(values, frame.scale);
  to_counts(values, frame.scale, frame.counts);
  bool is_finite = true;
  for (int y = 0; y < values.height() && is_finite; ++y) {
    is_finite = std::all_of(values.row(y), values.row(y) + values.width(),
                            [](float value) { return std::isfinite(value); });
  }
  frame.valid.resize(is_finite ? 0 : values.width(), is_finite ? 0 : values.height());
  for (int y = 0; y < frame.valid.height(); ++y) {
    std::transform(values.row(y), values.row(y) + values.width(), frame.valid.row(y),
                   [](float value) { return static_cast<std::uint8_t>(std::isfinite(value)); });
  }
}

}  // namespace thermedge::io
