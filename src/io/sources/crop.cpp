#include "thermedge/io/crop.hpp"

#include <array>
#include <charconv>

namespace thermedge::io {
namespace {

struct PartName {
  std::string_view name;
  Crop::Part part;
};
constexpr std::array kParts = {PartName{"all", Crop::Part::kAll},
                               PartName{"top-half", Crop::Part::kTopHalf},
                               PartName{"bottom-half", Crop::Part::kBottomHalf}};

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

Result<Rectangle> Crop::within(int width, int height) const {
  const int half = height / 2;
  switch (part) {
    case Part::kAll:
      return Rectangle{0, 0, width, height};
    case Part::kTopHalf:
    case Part::kBottomHalf:
      if (half == 0) {
        return failure(ErrorCode::kInvalidArgument,
                       "crop " + crop_text(*this) + ": the frame has a single row");
      }
      return Rectangle{0, part == Part::kTopHalf ? 0 : height - half, width, half};
    case Part::kRectangle:
      break;
  }
  const Rectangle& r = rectangle;
  const bool fits = r.x >= 0 && r.y >= 0 && r.width > 0 && r.height > 0 && r.x < width &&
                    r.y < height && r.width <= width - r.x && r.height <= height - r.y;
  if (!fits) {
    return failure(ErrorCode::kInvalidArgument,
                   "crop " + crop_text(*this) + ": " + size_text(r.width, r.height) +
                       " pixels from (" + std::to_string(r.x) + ", " + std::to_string(r.y) +
                       ") do not lie within the frame of " + size_text(width, height));
  }
  return r;
}

Result<Crop> parse_crop(std::string_view text) {
  for (const PartName& known : kParts) {
    if (known.name == text) {
      return Crop{known.part, {}};
    }
  }
  std::array<int, 4> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  bool is_good = true;
  for (std::size_t i = 0; i < numbers.size() && is_good; ++i) {
    const auto [stop, error] = std::from_chars(at, end, numbers[i]);
    const bool is_last = i + 1 == numbers.size();
    is_good = error == std::errc{} && numbers[i] >= 0 &&
              (is_last ? stop == end : stop != end && *stop == ',');
    at = is_good && !is_last ? stop + 1 : stop;
  }
  if (!is_good || numbers[2] == 0 || numbers[3] == 0) {
    return failure(ErrorCode::kInvalidArgument,
                   "crop " + std::string(text) +
                       ": should be X,Y,WIDTH,HEIGHT in pixels, top-half, bottom-half or all");
  }
  return Crop{Crop::Part::kRectangle, {numbers[0], numbers[1], numbers[2], numbers[3]}};
}

std::string crop_text(const Crop& crop) {
  for (const PartName& known : kParts) {
    if (known.part == crop.part) {
      return std::string(known.name);
    }
  }
  const Rectangle& r = crop.rectangle;
  return std::to_string(r.x) + "," + std::to_string(r.y) + "," + std::to_string(r.width) + "," +
         std::to_string(r.height);
}

}  // namespace thermedge::io
