#include "stripe_mask.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <span>

namespace thermedge::detail {
namespace {

constexpr int kRadius = 2;            // of the smoothing
constexpr int kMargin = kRadius + 1;  // and one pixel for the gradient
// Half the heights of the windows in which long edges show, squares; what they have to be over
// noise; and the largest step that counts, so that a short strong edge is no long faint one.
constexpr std::array kLongReach = {5, 13};
constexpr double kLongZ = 2.5;
constexpr double kMostStep = 2.5;
constexpr int kUnit = 2;  // steps of a count, for the offsets

// Standard deviation of a gradient where that of a pixel is 1: 2 kUnit for a square, and the root
// of the sum of the squared weights of the binomial kernel of order 4 and Sobel's, together
// (1 4 5 0 -5 -4 -1) across (1 6 15 20 15 6 1).
const double kNoiseGain = 2 * kUnit * std::sqrt(84.0 * 924.0);

// [1 4 6 4 1]
std::int32_t binomial(const std::int32_t* at, std::ptrdiff_t step) {
  return at[-2 * step] + at[2 * step] + 4 * (at[-step] + at[step]) + 6 * at[0];
}

// Sums of two offsets each, in units; the last one of an odd number counts twice.
void add_pairs(std::span<const double> offsets, double sigma, std::vector<std::int32_t>& sums) {
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

// task(y, sums, rows): of the `rows` rows around y, `reach` to either side.
template <class F>
void for_each_window(ImageView<const std::int32_t> steps, int reach,
                     std::vector<std::int32_t>& sums, F&& task) {
  const int width = steps.width();
  const int height = steps.height();
  std::fill(sums.begin(), sums.begin() + width, 0);
  const auto add = [&](int y, int sign) {
    const std::int32_t* row = steps.row(y);
    for (int x = 0; x < width; ++x) {
      sums[static_cast<std::size_t>(x)] += sign * row[x];
    }
  };
  for (int y = 0; y < std::min(reach, height); ++y) {
    add(y, 1);
  }
  for (int y = 0; y < height; ++y) {
    if (y + reach < height) {
      add(y + reach, 1);
    }
    if (y - reach - 1 >= 0) {
      add(y - reach - 1, -1);
    }
    task(y, std::span<const std::int32_t>(sums).first(static_cast<std::size_t>(width)),
         std::min(y + reach + 1, height) - std::max(y - reach, 0));
  }
}

}  // namespace

// Marks where the mean of `steps`, of which noise has this deviation, over a window of rows stands
// out, and the columns beside it. What most windows have is no edge: stripes that are still there.
void StripeMask::mark_long(ImageView<const std::int32_t> steps, double deviation,
                           ImageView<std::uint8_t> marks) {
  constexpr double kQuantile = 0.2;
  constexpr double kQuantileOfNoise = 0.2533;  // P(|Z| < this) = 0.2
  constexpr int kSampleRows = 5;
  for (const int reach : kLongReach) {
    sample_.clear();
    for_each_window(steps, reach, step_sums_,
                    [&](int y, std::span<const std::int32_t> sums, int rows) {
                      if (y % kSampleRows == 0) {
                        const auto scale = static_cast<float>(1 / std::sqrt(rows));
                        for (const std::int32_t sum : sums) {
                          sample_.push_back(scale * static_cast<float>(std::abs(sum)));
                        }
                      }
                    });
    const auto at = sample_.begin() +
                    static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(sample_.size()));
    std::nth_element(sample_.begin(), at, sample_.end());
    const double usual = std::max(deviation, *at / kQuantileOfNoise);
    for_each_window(steps, reach, step_sums_,
                    [&](int y, std::span<const std::int32_t> sums, int rows) {
                      const auto threshold =
                          static_cast<std::int32_t>(std::lround(kLongZ * usual * std::sqrt(rows)));
                      std::uint8_t* marked = marks.row(y);
                      for (std::size_t x = 0; x < sums.size(); ++x) {
                        if (std::abs(sums[x]) > threshold) {
                          marked[x] = 1;
                        }
                      }
                    });
  }
}

void StripeMask::prepare(int width, int height) {
  const int across = (width + 1) / 2;
  const int down = (height + 1) / 2;
  squares_.resize(across + 2 * kMargin, down + 2 * kMargin);
  smoothed_.resize(squares_.width(), squares_.height());
  upright_edges_.resize(across, down);
  level_edges_.resize(down, across);
  upright_steps_.resize(across, down);
  upright_.resize(across, down);
  level_steps_.resize(down, across);
  level_.resize(down, across);
  sample_.reserve(upright_edges_.size());
  step_sums_.resize(static_cast<std::size_t>(std::max(across, down)));
  of_columns_.resize(static_cast<std::size_t>(across));
  of_rows_.resize(static_cast<std::size_t>(down));
}

void StripeMask::add_up(ImageView<const std::uint16_t> frame, std::span<const double> columns,
                        std::span<const double> rows, double sigma) {
  add_pairs(columns, sigma, of_columns_);
  add_pairs(rows, sigma, of_rows_);
  const int last_x = frame.width() - 1;
  for (int y = 0; y < upright_edges_.height(); ++y) {
    const std::uint16_t* upper = frame.row(2 * y);
    const std::uint16_t* lower = frame.row(std::min(2 * y + 1, frame.height() - 1));
    std::int32_t* sums = squares_.row(y + kMargin) + kMargin;
    const std::int32_t of_row = 2 * of_rows_[static_cast<std::size_t>(y)];
    const auto square = [&](int x, int left, int right) {
      const int counts = upper[left] + upper[right] + lower[left] + lower[right];
      sums[x] = kUnit * counts - 2 * of_columns_[static_cast<std::size_t>(x)] - of_row;
    };
    for (int x = 0; x < frame.width() / 2; ++x) {
      square(x, 2 * x, 2 * x + 1);
    }
    if (frame.width() % 2 != 0) {
      square(frame.width() / 2, last_x, last_x);
    }
  }
  repeat_border(squares_);
}

// At most 256 times the largest square, within 32 bits even after Sobel's sums.
void StripeMask::smooth() {
  for (int y = kRadius; y < squares_.height() - kRadius; ++y) {
    const std::int32_t* from = squares_.row(y);
    std::int32_t* to = smoothed_.row(y);
    for (int x = 0; x < squares_.width(); ++x) {
      to[x] = binomial(from + x, squares_.stride());
    }
  }
  for (int y = kRadius; y < squares_.height() - kRadius; ++y) {
    const std::int32_t* from = smoothed_.row(y);
    std::int32_t* to = squares_.row(y);
    for (int x = kRadius; x < squares_.width() - kRadius; ++x) {
      to[x] = binomial(from + x, 1);
    }
  }
}

void StripeMask::find_long(double sigma) {
  const double deviation = 2 * kUnit * std::numbers::sqrt2 * sigma;
  const auto most = static_cast<std::int32_t>(std::lround(kMostStep * deviation));
  for (int y = 0; y < upright_edges_.height(); ++y) {
    const std::int32_t* at = squares_.row(y + kMargin) + kMargin;
    for (int x = 0; x < upright_edges_.width(); ++x) {
      upright_steps_(x, y) = std::clamp(at[x + 1] - at[x - 1], -most, most);
      level_steps_(y, x) =
          std::clamp(at[x + squares_.stride()] - at[x - squares_.stride()], -most, most);
    }
  }
  mark_long(upright_steps_, deviation, upright_);
  mark_long(level_steps_, deviation, level_);
}

void StripeMask::find(ImageView<const std::uint16_t> frame, std::span<const double> columns,
                      std::span<const double> rows, double sigma, double gradients,
                      bool with_long) {
  add_up(frame, columns, rows, sigma);
  fill_pixels(upright_.view(), std::uint8_t{0});
  fill_pixels(level_.view(), std::uint8_t{0});
  if (with_long) {
    find_long(sigma);
  }
  smooth();
  const double threshold = gradients * kNoiseGain * sigma;
  const auto is_edge = [=](double gradient) -> std::uint8_t {
    return std::abs(gradient) > threshold ? 1 : 0;
  };
  for (int y = 0; y < upright_edges_.height(); ++y) {
    const std::int32_t* above = squares_.row(y + kMargin - 1) + kMargin;
    const std::int32_t* row = squares_.row(y + kMargin) + kMargin;
    const std::int32_t* below = squares_.row(y + kMargin + 1) + kMargin;
    for (int x = 0; x < upright_edges_.width(); ++x) {
      const double gx = (above[x + 1] - above[x - 1]) + 2 * (row[x + 1] - row[x - 1]) +
                        (below[x + 1] - below[x - 1]);
      const double gy =
          (below[x - 1] - above[x - 1]) + 2 * (below[x] - above[x]) + (below[x + 1] - above[x + 1]);
      upright_edges_(x, y) = is_edge(gx);
      level_edges_(y, x) = is_edge(gy);
    }
  }
}

void StripeMask::reach_right(ImageView<std::uint16_t> reach) const {
  for (int y = 0; y < reach.height(); ++y) {
    const std::uint8_t* edges = upright_edges_.row(y);
    std::uint16_t* row = reach.row(y);
    std::uint16_t distance = kNoEdge;
    for (int x = reach.width() - 1; x >= 0; --x) {
      distance = edges[x / 2] != 0 || upright_(x / 2, y) != 0
                     ? 0
                     : static_cast<std::uint16_t>(distance + 1);
      row[x] = distance;
    }
  }
}

void StripeMask::reach_down(ImageView<std::uint16_t> reach) const {
  for (int x = 0; x < reach.height(); ++x) {
    std::uint16_t* row = reach.row(x);
    std::uint16_t distance = kNoEdge;
    for (int y = reach.width() - 1; y >= 0; --y) {
      distance = level_edges_(y / 2, x) != 0 || level_(y / 2, x) != 0
                     ? 0
                     : static_cast<std::uint16_t>(distance + 1);
      row[y] = distance;
    }
  }
}

}  // namespace thermedge::detail
