// The part of each frame that is used: without telemetry rows, or one half of a double picture.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "thermedge/result.hpp"

namespace thermedge::io {

struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;  // px
  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

struct Crop {
  enum class Part : std::uint8_t { kAll, kRectangle, kTopHalf, kBottomHalf };
  Part part = Part::kAll;
  Rectangle rectangle;  // for kRectangle

  // The rectangle that is used of a frame of this size; halves of an odd height leave out the row
  // in the middle. Fails where it does not lie within the frame, with a line that tells both.
  [[nodiscard]] Result<Rectangle> within(int width, int height) const;

  friend bool operator==(const Crop&, const Crop&) = default;
};

// "all", "top-half", "bottom-half" or "X,Y,WIDTH,HEIGHT" in pixels. Fails with a line that says so.
[[nodiscard]] Result<Crop> parse_crop(std::string_view text);
// The words that parse_crop reads back.
[[nodiscard]] std::string crop_text(const Crop& crop);

}  // namespace thermedge::io
