// One frame of a camera as the detector takes it: pixels, and what is known about them.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>

#include "thermedge/image.hpp"

namespace thermedge {

// Bits of Frame::flags: facts that a source knows about a frame.
enum FrameFlag : std::uint32_t {
  kFrameShutter = 1U << 0U,     // the shutter is closed, or has just moved: not the scene
  kFrameAfterLoss = 1U << 1U,   // frames before this one were lost
  kFrameEndsStream = 1U << 2U,  // the last frame of its source
};

// A view of pixels that the caller owns, with any row stride, without a copy.
//   uint8    grey levels, taken as they are (`bits` is 8)
//   uint16   raw counts; with `bits` = 8 grey levels that were widened
//   float32  any unit, such as degC; NaN and infinite pixels are no measurement. Everything that is
//            reported in counts is in the frame's unit then.
struct Frame {
  using Pixels = std::variant<ImageView<const std::uint8_t>, ImageView<const std::uint16_t>,
                              ImageView<const float>>;

  Frame() = default;
  Frame(ImageView<const std::uint8_t> levels)  // NOLINT(google-explicit-constructor)
      : pixels(levels), bits(8) {}
  Frame(ImageView<const std::uint16_t> counts,  // NOLINT(google-explicit-constructor)
        int counts_bits = 16)
      : pixels(counts), bits(counts_bits) {}
  Frame(ImageView<const float> values)  // NOLINT(google-explicit-constructor)
      : pixels(values) {}
  template <class T>
  requires(!std::is_const_v<T>) Frame(ImageView<T> view)  // NOLINT(google-explicit-constructor)
      : Frame(ImageView<const T>(view)) {}
  template <class T>
  Frame(const Image<T>& image)  // NOLINT(google-explicit-constructor)
      : Frame(ImageView<const T>(image.view())) {}

  Pixels pixels;
  int bits = 16;  // 8: grey levels, which preset paper does not scale by Algorithm 1; else 16
  // As large as the frame, nonzero where a pixel is a measurement; empty: everywhere. Other
  // pixels are filled smoothly from those around them, and no edge lies on them or beside them.
  ImageView<const std::uint8_t> valid;
  std::optional<std::int64_t> stamp_ns;  // when it was taken, of the source's clock; handed on
  std::int64_t index = 0;                // number within its source; handed on
  std::uint32_t flags = 0;               // FrameFlag bits; handed on

  [[nodiscard]] int width() const {
    return std::visit([](auto view) { return view.width(); }, pixels);
  }
  [[nodiscard]] int height() const {
    return std::visit([](auto view) { return view.height(); }, pixels);
  }
  [[nodiscard]] bool empty() const {
    return std::visit([](auto view) { return view.empty(); }, pixels);
  }
};

}  // namespace thermedge
