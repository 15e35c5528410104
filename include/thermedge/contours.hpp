// From edge pixels to curves (paper Algorithm 3, CSS).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct Pixel {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

// A run of elements in one of the flat arrays of a result.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  friend bool operator==(const Range&, const Range&) = default;
};

template <class T>
[[nodiscard]] std::span<const T> slice(const std::vector<T>& values, Range range) {
  return {values.data() + range.first, range.count};
}
template <class T>
[[nodiscard]] std::span<T> slice(std::vector<T>& values, Range range) {
  return {values.data() + range.first, range.count};
}

struct Contour {
  Range points;         // in ContourSet::points, in walking order
  bool closed = false;  // the ends meet; the last point is not repeated
};

// An end of a curve that touches the middle or the end of another one.
struct Junction {
  Pixel at;
};

// Curves in the order in which they were found. Flat arrays: no allocation per curve.
struct ContourSet {
  std::vector<Pixel> points;
  std::vector<Contour> contours;
  std::vector<Junction> junctions;

  [[nodiscard]] std::span<const Pixel> pixels(const Contour& contour) const {
    return slice(points, contour.points);
  }
  void clear();
};

struct ContourOptions {
  int min_component_px = 50;  // 8-connected components with fewer pixels are removed first; 0: off
  int gap_px = 1;             // reach of a walking step, 1..8 px (1: neighbours; 2 jumps one pixel)
  int min_length_px = 0;      // shortest curve kept, px; 0: more than (width + height) / 25 pixels
  double closed_gap_px = 5.66;  // a curve is closed where its ends are this near, px (the text says
                                // 2-3; the public code that the paper used: squared distance <= 32)
};

// Walks the edge map column by column: seed = next set pixel; from there, within the window of
// `gap_px`, always to the nearest set pixel (ties: smaller column, then smaller row), clearing what
// it visits, until the window is empty; then again from the seed, prepending.
// Paper: Algorithm 3, eq. 13; the order is that of the public code of He & Yung.
// One object per thread; allocates on the first frame of a size only.
class ContourTracer {
 public:
  explicit ContourTracer(const ContourOptions& options) : options_(options) {}

  // `edges`: nonzero = edge. `contours` is cleared first.
  // Errors: an option out of range. Junctions: ends within gap_px + 1 of a pixel of another curve.
  [[nodiscard]] Status run(ImageView<const std::uint8_t> edges, ContourSet& contours);

 private:
  ContourOptions options_;
  Image<std::uint8_t> map_;        // edges with a border, cleared while walking
  Image<std::int32_t> owner_;      // curve of each pixel, for the junctions
  std::vector<std::int32_t> stack_;
  std::vector<Pixel> backward_;
};

}  // namespace thermedge
