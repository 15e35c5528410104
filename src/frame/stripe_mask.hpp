// Which pixels of a frame say nothing about stripes because an edge of the scene lies between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lag_sums_simd.hpp"
#include "stripe_mask_simd.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/stages/stripes.hpp"

namespace thermedge::detail {

// Edges of squares of 2x2 pixels: as good for this as those of single pixels, at a quarter of the
// time. In whole numbers, so that a transposed frame has the transposed mask.
class StripeMask {
 public:
  static constexpr std::uint16_t kNoEdge = 2 * kFarSquares - 1;
  static_assert(kNoEdge > kLargestLag);

  explicit StripeMask(const StripeMaskTuning& tuning = {}) : tuning_(tuning) {}

  void prepare(int width, int height);

  // Edges are where the gradient across the columns (for reach_right) or across the rows (for
  // reach_down) of the frame less its offsets exceeds `gradients` times what pixel noise of `sigma`
  // counts makes of it. Offsets in units of sigma. With `with_long` also those
  // that show in means along the columns (for reach_right) or the rows (for reach_down) only.
  // Reads up to a vector of 64 bytes after the frame's rows, as Image has them.
  void find(ImageView<const std::uint16_t> frame, std::span<const double> columns,
            std::span<const double> rows, double sigma, double gradients, bool with_long);

  // reach(x, y / 2): how far to the right of pixel (x, y) the next edge is, px; 0 on an edge;
  // kNoEdge or more where there is none so near.
  // Half as many rows as the frame, rounded up.
  void reach_right(ImageView<std::uint16_t> reach) const;
  // The same downwards; a picture of the transposed frame.
  void reach_down(ImageView<std::uint16_t> reach) const;

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(squares_, smoothed_, upright_steps_, level_steps_, transposed_steps_,
                     upright_sums_, level_sums_, upright_, level_, transposed_, ends_, sample_,
                     of_columns_, of_rows_);
  }

 private:
  void add_up(ImageView<const std::uint16_t> frame, std::span<const double> columns,
              std::span<const double> rows, double sigma);
  void smooth();
  void mark_gradients(double threshold);
  void find_steps(double deviation);
  void add_windows(ImageView<const std::int32_t> steps, int reach, ImageView<std::int32_t> sums);
  double usual_sum(ImageView<const std::int32_t> sums, int reach);
  void mark_long(ImageView<const std::int32_t> steps, double deviation,
                 ImageView<std::int32_t> sums, ImageView<std::uint8_t> marks);

  StripeMaskTuning tuning_;
  int across_ = 0;  // squares
  int down_ = 0;
  Image<std::int32_t> squares_, smoothed_;  // with a margin
  // Changes along a row; and along a column, of the frame and of the transposed one.
  Image<std::int32_t> upright_steps_, level_steps_, transposed_steps_;
  Image<std::int32_t> upright_sums_, level_sums_;  // of windows of them
  // Edges between columns; and between rows, of the frame and of the transposed one. With unmarked
  // squares after each row.
  Image<std::uint8_t> upright_, level_, transposed_;
  Image<std::int32_t> ends_;  // two rows for the windows: none, and their first sums
  std::vector<float> sample_;
  std::vector<std::int32_t> of_columns_, of_rows_;  // offsets of the squares
};

}  // namespace thermedge::detail
