#include "stripe_mask.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <span>

#include "order_statistics.hpp"
#include "transpose.hpp"

namespace thermedge::detail {
namespace {

constexpr int kRadius = 2;            // of the smoothing
constexpr int kMargin = kRadius + 1;  // and one pixel for the gradient
constexpr int kUnit = 2;              // steps of a count, for the offsets; as square_row has it

// Standard deviation of a gradient where that of a pixel is 1: 2 kUnit for a square, and the root
// of the sum of the squared weights of the binomial kernel of order 4 and Sobel's, together
// (1 4 5 0 -5 -4 -1) across (1 6 15 20 15 6 1).
const double kNoiseGain = 2 * kUnit * std::sqrt(84.0 * 924.0);

// Sums of two offsets each, in units; the last one of an odd number counts twice.
void add_pairs(std::span<const double> offsets, double sigma, std::span<std::int32_t> sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double first = offsets[2 * i];
    const double second = offsets[std::min(2 * i + 1, offsets.size() - 1)];
    sums[i] = static_cast<std::int32_t>(std::lround(kUnit * sigma * (first + second)));
  }
}

void repeat_border(ImageView<std::int32_t> picture) {
  const int last_x = picture.width() - 1 - kMargin;
  const int last_y = picture.height() - 1 - kMargin;
  for (int y = kMargin; y <= last_y; ++y) {
    std::int32_t* row = picture.row(y);
    std::fill_n(row, kMargin, row[kMargin]);
    std::fill_n(row + last_x + 1, kMargin, row[last_x]);
  }
  for (int i = 0; i < kMargin; ++i) {
    std::copy_n(picture.row(kMargin), picture.width(), picture.row(i));
    std::copy_n(picture.row(last_y), picture.width(), picture.row(last_y + 1 + i));
  }
}

void unmark(ImageView<std::uint8_t> marks) { fill_pixels(marks, std::uint8_t{0}); }

// Of a window of `reach` rows to either side of row y.
int window_rows(int y, int reach, int height) {
  return std::min(y + reach + 1, height) - std::max(y - reach, 0);
}

}  // namespace

void StripeMask::prepare(int width, int height) {
  across_ = (width + 1) / 2;
  down_ = (height + 1) / 2;
  squares_.resize(across_ + 2 * kMargin, down_ + 2 * kMargin);
  smoothed_.resize(squares_.width(), squares_.height());
  upright_steps_.resize(across_, down_);
  level_steps_.resize(across_, down_);
  transposed_steps_.resize(down_, across_);
  upright_sums_.resize(across_, down_);
  level_sums_.resize(down_, across_);
  upright_.resize(across_ + kFarSquares, down_);
  level_.resize(across_, down_);
  transposed_.resize(down_ + kFarSquares, across_);
  ends_.resize(std::max(across_, down_), 2);
  sample_.reserve(upright_steps_.size());
  // With a vector after the last, as kernels read it.
  of_columns_.resize(static_cast<std::size_t>(across_) + Image<float>::kAlignmentBytes);
  of_rows_.resize(static_cast<std::size_t>(down_));
}

void StripeMask::add_up(ImageView<const std::uint16_t> frame, std::span<const double> columns,
                        std::span<const double> rows, double sigma) {
  add_pairs(columns, sigma, std::span(of_columns_).first(static_cast<std::size_t>(across_)));
  add_pairs(rows, sigma, of_rows_);
  const int last_x = frame.width() - 1;
  for (int y = 0; y < down_; ++y) {
    const std::uint16_t* upper = frame.row(2 * y);
    const std::uint16_t* lower = frame.row(std::min(2 * y + 1, frame.height() - 1));
    std::int32_t* sums = squares_.row(y + kMargin) + kMargin;
    const std::int32_t of_row = 2 * of_rows_[static_cast<std::size_t>(y)];
    square_row(upper, lower, of_columns_.data(), of_row, across_, sums);
    if (frame.width() % 2 != 0) {  // the last column counts twice
      sums[across_ - 1] = 2 * kUnit * (upper[last_x] + lower[last_x]) -
                          2 * of_columns_[static_cast<std::size_t>(across_ - 1)] - of_row;
    }
  }
  repeat_border(squares_);
}

// At most 256 times the largest square, within 32 bits even after Sobel's sums.
void StripeMask::smooth() {
  for (int y = kRadius; y < squares_.height() - kRadius; ++y) {
    binomial_row(squares_.row(y), squares_.stride(), squares_.width(), smoothed_.row(y));
  }
  for (int y = kRadius; y < squares_.height() - kRadius; ++y) {
    binomial_row(smoothed_.row(y) + kRadius, 1, squares_.width() - 2 * kRadius,
                 squares_.row(y) + kRadius);
  }
}

void StripeMask::mark_gradients(double threshold) {
  constexpr double kLargest = std::numeric_limits<std::int32_t>::max();
  const auto limit = static_cast<std::int32_t>(std::min(std::floor(threshold), kLargest));
  for (int y = 0; y < down_; ++y) {
    mark_gradients_row(squares_.row(y + kMargin) + kMargin, squares_.stride(), limit, across_,
                       upright_.row(y), level_.row(y));
  }
  transpose<std::uint8_t>(level_.view(), transposed_.view().crop(0, 0, down_, across_));
}

void StripeMask::find_steps(double deviation) {
  const auto most = static_cast<std::int32_t>(std::lround(tuning_.most_step_sigmas * deviation));
  const std::ptrdiff_t stride = squares_.stride();
  for (int y = 0; y < down_; ++y) {
    const std::int32_t* at = squares_.row(y + kMargin) + kMargin;
    clamped_difference_row(at + 1, at - 1, most, across_, upright_steps_.row(y));
    clamped_difference_row(at + stride, at - stride, most, across_, level_steps_.row(y));
  }
  transpose<std::int32_t>(level_steps_.view(), transposed_steps_.view());
}

// Fills `sums` with those of the rows of `steps` up to `reach` to either side.
void StripeMask::add_windows(ImageView<const std::int32_t> steps, int reach,
                             ImageView<std::int32_t> sums) {
  const int width = steps.width();
  const int height = steps.height();
  fill_pixels(ends_.view(), 0);
  const std::int32_t* none = ends_.row(0);
  std::int32_t* first = ends_.row(1);
  for (int y = 0; y < std::min(reach, height); ++y) {
    slide_row(first, steps.row(y), none, width, first);
  }
  for (int y = 0; y < height; ++y) {
    slide_row(y == 0 ? first : sums.row(y - 1), y + reach < height ? steps.row(y + reach) : none,
              y - reach - 1 >= 0 ? steps.row(y - reach - 1) : none, width, sums.row(y));
  }
}

// Over the root of the number of rows: what the edgeless share of the windows is below.
double StripeMask::usual_sum(ImageView<const std::int32_t> sums, int reach) {
  sample_.clear();
  for (int y = 0; y < sums.height(); ++y) {
    if (std::min(y, sums.height() - 1 - y) % tuning_.sample_step_squares != 0) {
      continue;  // the same rows from either side
    }
    const auto scale = static_cast<float>(1 / std::sqrt(window_rows(y, reach, sums.height())));
    const std::size_t first = sample_.size();
    const std::int32_t* row = sums.row(y);
    sample_.resize(first + static_cast<std::size_t>(sums.width()));
    std::transform(row, row + sums.width(), sample_.data() + first,
                   [=](std::int32_t sum) { return scale * static_cast<float>(std::abs(sum)); });
  }
  return nth_value(
      std::span(sample_),
      static_cast<std::size_t>(tuning_.edgeless_quantile * static_cast<double>(sample_.size())));
}

// Marks where the mean of `steps`, of which noise has this deviation, over a window of rows stands
// out, and the columns beside it. What most windows have is no edge: stripes that are still there.
void StripeMask::mark_long(ImageView<const std::int32_t> steps, double deviation,
                           ImageView<std::int32_t> sums, ImageView<std::uint8_t> marks) {
  for (const int reach : tuning_.long_reach_squares) {
    add_windows(steps, reach, sums);
    const double usual = std::max(deviation, usual_sum(sums, reach) / tuning_.edgeless_quantile_z);
    for (int y = 0; y < sums.height(); ++y) {
      const double rows = window_rows(y, reach, sums.height());
      const auto limit =
          static_cast<std::int32_t>(std::lround(tuning_.long_z * usual * std::sqrt(rows)));
      mark_beyond_row(sums.row(y), limit, sums.width(), marks.row(y));
    }
  }
}

void StripeMask::find(ImageView<const std::uint16_t> frame, std::span<const double> columns,
                      std::span<const double> rows, double sigma, double gradients,
                      bool with_long) {
  const double deviation = 2 * kUnit * std::numbers::sqrt2 * sigma;  // of a step
  add_up(frame, columns, rows, sigma);
  if (with_long) {
    find_steps(deviation);  // before they are smoothed
  }
  smooth();
  mark_gradients(gradients * kNoiseGain * sigma);
  if (with_long) {
    mark_long(upright_steps_, deviation, upright_sums_, upright_);
    mark_long(transposed_steps_, deviation, level_sums_, transposed_);
  }
  unmark(upright_.view().crop(across_, 0, kFarSquares, down_));
  unmark(transposed_.view().crop(down_, 0, kFarSquares, across_));
}

void StripeMask::reach_right(ImageView<std::uint16_t> reach) const {
  for (int y = 0; y < reach.height(); ++y) {
    reach_row(upright_.row(y), across_, reach.row(y));
  }
}

void StripeMask::reach_down(ImageView<std::uint16_t> reach) const {
  for (int x = 0; x < reach.height(); ++x) {
    reach_row(transposed_.row(x), down_, reach.row(x));
  }
}

}  // namespace thermedge::detail
