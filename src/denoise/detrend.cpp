#include "detrend.hpp"

#include <cstddef>

namespace thermedge::detail {
void Detrender::prepare(int width, int height) {
  blocks_.resize(width / kBlockPx, height / kBlockPx);
  slopes_.reserve(blocks_.size());
  distances_.reserve(blocks_.size());
  columns_.resize(static_cast<std::size_t>(width));
  rows_.resize(static_cast<std::size_t>(height));
}

void Detrender::measure(ImageView<const float> frame) {
  prepare(frame.width(), frame.height());
  fill_pixels(blocks_.view(), 0.0);
  const int left = (frame.width() - kBlockPx * blocks_.width()) / 2;
  const int top = (frame.height() - kBlockPx * blocks_.height()) / 2;
  for (int y = 0; y < kBlockPx * blocks_.height(); ++y) {
    const float* row = frame.row(top + y) + left;
    double* sums = blocks_.row(y / kBlockPx);
    for (int x = 0; x < kBlockPx * blocks_.width(); ++x) {
      sums[x / kBlockPx] += row[x];
    }
  }
  const auto add_slope = [&](int place, double difference) {
    slopes_.push_back({1.0 * place, difference / (kBlockPx * kBlockPx * kBlockPx), 1});
  };
  slopes_.clear();
  for (int y = 0; y < blocks_.height(); ++y) {
    for (int x = 1; x < blocks_.width(); ++x) {
      add_slope(left + kBlockPx * x, blocks_(x, y) - blocks_(x - 1, y));
    }
  }
  fill(robust_line(slopes_, distances_), columns_);
  slopes_.clear();
  for (int y = 1; y < blocks_.height(); ++y) {
    for (int x = 0; x < blocks_.width(); ++x) {
      add_slope(top + kBlockPx * y, blocks_(x, y) - blocks_(x, y - 1));
    }
  }
  fill(robust_line(slopes_, distances_), rows_);
}

// The parabola of this slope, 0 in the middle.
void Detrender::fill(const Line& slope, std::vector<float>& profile) {
  const double middle = (static_cast<double>(profile.size()) - 1) / 2;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double mean_place = (static_cast<double>(i) + middle) / 2;
    profile[i] = static_cast<float>((static_cast<double>(i) - middle) * slope.at(mean_place + 0.5));
  }
}

void Detrender::apply(ImageView<const float> in, float sign, ImageView<float> out) const {
  for (int y = 0; y < in.height(); ++y) {
    const float of_row = sign * rows_[static_cast<std::size_t>(y)];
    const float* from = in.row(y);
    float* to = out.row(y);
    for (int x = 0; x < in.width(); ++x) {
      to[x] = from[x] + (sign * columns_[static_cast<std::size_t>(x)] + of_row);
    }
  }
}

void Detrender::subtract(ImageView<const float> in, ImageView<float> out) const {
  apply(in, -1, out);
}

void Detrender::add(ImageView<float> frame) const { apply(frame, 1, frame); }

}  // namespace thermedge::detail
