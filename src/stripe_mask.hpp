// Which pixels of a frame say nothing about stripes because an edge of the scene lies between them.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::detail {

// Edges of squares of 2x2 pixels: as good for this as those of single pixels, at a quarter of the
// time. In whole numbers, so that a transposed frame has the transposed mask.
class StripeMask {
 public:
  static constexpr std::uint16_t kNoEdge = std::numeric_limits<std::uint16_t>::max() / 2;

  void prepare(int width, int height);

  // Edges are where the gradient across the columns (for reach_right) or across the rows (for
  // reach_down) of the frame less its offsets exceeds `gradients` times what pixel noise of `sigma`
  // counts makes of it. Offsets in units of sigma. With `with_long` also those
  // that show in means along the columns (for reach_right) or the rows (for reach_down) only.
  void find(ImageView<const std::uint16_t> frame, std::span<const double> columns,
            std::span<const double> rows, double sigma, double gradients, bool with_long);

  // reach(x, y / 2): how far to the right of pixel (x, y) the next edge is, px; 0 on an edge;
  // kNoEdge or more where there is none.
  // Half as many rows as the frame, rounded up.
  void reach_right(ImageView<std::uint16_t> reach) const;
  // The same downwards; a picture of the transposed frame.
  void reach_down(ImageView<std::uint16_t> reach) const;

 private:
  void add_up(ImageView<const std::uint16_t> frame, std::span<const double> columns,
              std::span<const double> rows, double sigma);
  void smooth();

  void find_long(double sigma);
  void mark_long(ImageView<const std::int32_t> steps, double deviation,
                 ImageView<std::uint8_t> marks);

  Image<std::int32_t> squares_, smoothed_;  // with a margin
  // Edges that change along a row; and along a column, of the transposed frame.
  Image<std::uint8_t> upright_edges_, level_edges_;
  // Long edges along the columns, and along the rows of the transposed frame.
  Image<std::int32_t> upright_steps_, level_steps_;
  Image<std::uint8_t> upright_, level_;
  std::vector<std::int32_t> step_sums_;
  std::vector<float> sample_;
  std::vector<std::int32_t> of_columns_, of_rows_;  // offsets of the squares
};

}  // namespace thermedge::detail
