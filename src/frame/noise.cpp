#include "thermedge/stages/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "highpass_simd.hpp"

namespace thermedge {
namespace {

constexpr double kResidualGain = 6;              // of [1 -2 1] x [1 -2 1] for white noise
constexpr double kSecondDifferenceVariance = 6;  // 1 + 4 + 1
constexpr double kSigmaOverMad = 1.4826;         // of a Gaussian
constexpr double kRoundingVariance = 1.0 / 12;   // of rounding to whole counts

double root_of_excess(double variance, double known) {
  return std::sqrt(std::max(variance - known, 0.0));
}

// Median of the integers counted in a histogram; n stands for the interval n - 0.5 .. n + 0.5, in
// which the median is interpolated. 0 stays 0, so that a frame without noise has none.
double median_of(const std::vector<std::uint32_t>& histogram) {
  std::uint64_t total = 0;
  for (const std::uint32_t count : histogram) {
    total += count;
  }
  std::uint64_t below = 0;
  std::size_t value = 0;
  while (2 * (below + histogram[value]) < total) {
    below += histogram[value];
    ++value;
  }
  if (value == 0) {
    return 0;
  }
  const double within = (static_cast<double>(total) / 2 - static_cast<double>(below)) /
                        static_cast<double>(histogram[value]);
  return static_cast<double>(value) - 0.5 + within;
}

}  // namespace

NoiseEstimate NoiseEstimator::measure(ImageView<const std::uint16_t> frame) {
  if (std::min(frame.width(), frame.height()) < tuning_.smallest_side_px) {
    return {};
  }
  filter(frame);
  NoiseEstimate noise;
  noise.sigma_counts = pixel_sigma();
  noise.column_sigma_counts = stripe_sigma(sample_along_rows(), noise.sigma_counts);
  noise.row_sigma_counts = stripe_sigma(sample_along_columns(), noise.sigma_counts);
  return noise;
}

// All rows and columns: every other row would do for the precision, but give a turned frame another
// noise.
void NoiseEstimator::filter(ImageView<const std::uint16_t> frame) {
  const int width = frame.width();
  frame_.resize(width, frame.height());
  copy_pixels(frame, frame_.view());
  const int rows = frame.height() - 2;
  residual_.resize(width - 2, rows);
  slope_.resize(width - 2, rows);
  for (int i = 0; i < rows; ++i) {
    const detail::CountRows three{frame_.row(i), frame_.row(i + 1), frame_.row(i + 2)};
    detail::highpass_row(three, width, residual_.row(i), slope_.row(i));
  }
}

// Flat is the half of the pixels with the smaller slopes. The choice does not bias the result,
// because the slope of noise says nothing about its residual.
double NoiseEstimator::pixel_sigma() {
  clear_histogram();
  for (int y = 0; y < slope_.height(); ++y) {
    const std::uint16_t* slope = slope_.row(y);
    for (int x = 0; x < slope_.width(); ++x) {
      ++histogram_[slope[x]];
    }
  }
  const double largest_flat_slope = median_of(histogram_);
  clear_histogram();
  for (int y = 0; y < slope_.height(); ++y) {
    const std::uint16_t* slope = slope_.row(y);
    const std::uint16_t* residual = residual_.row(y);
    for (int x = 0; x < slope_.width(); ++x) {
      histogram_[residual[x]] += slope[x] <= largest_flat_slope ? 1U : 0U;
    }
  }
  const double sigma = kSigmaOverMad * median_of(histogram_) / kResidualGain;
  return root_of_excess(sigma * sigma, kRoundingVariance);
}

void NoiseEstimator::clear_histogram() {
  histogram_.assign(std::numeric_limits<std::uint16_t>::max() + std::size_t{1}, 0);
}

// The median over a column of the second differences along the rows holds the second difference of
// the column offsets; edges that cross part of the column do not move it, and what whole columns of
// edges add falls to the median over the columns.
double NoiseEstimator::stripe_sigma(ImageView<const std::int32_t> second_differences,
                                    double pixel_sigma) {
  const auto columns = static_cast<std::size_t>(second_differences.width());
  profile_.resize(columns + Image<float>::kAlignmentBytes / sizeof(float));
  detail::column_medians(second_differences, profile_.data());
  const auto begin = profile_.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(columns);
  const auto middle = begin + static_cast<std::ptrdiff_t>(columns / 2);
  std::transform(begin, end, begin, [](float value) { return std::abs(value); });
  std::nth_element(begin, middle, end);
  const double spread = kSigmaOverMad * static_cast<double>(*middle);
  // The median of n values has pi / 2 times the variance of their mean.
  const double of_pixels = std::numbers::pi / 2 * (pixel_sigma * pixel_sigma + kRoundingVariance) /
                           second_differences.height();
  return root_of_excess(spread * spread / kSecondDifferenceVariance, of_pixels);
}

// Second differences along the rows, for some of the rows.
ImageView<const std::int32_t> NoiseEstimator::sample_along_rows() {
  const int step = std::max(frame_.height() / tuning_.stripe_samples, 1);
  samples_.resize(frame_.width() - 2, frame_.height() / step);
  for (int i = 0; i < samples_.height(); ++i) {
    const std::uint16_t* row = frame_.row(i * step);
    std::int32_t* out = samples_.row(i);
    for (int x = 0; x < samples_.width(); ++x) {
      out[x] = row[x] - 2 * row[x + 1] + row[x + 2];
    }
  }
  return samples_;
}

// Second differences along the columns, for some of the columns, which become rows.
ImageView<const std::int32_t> NoiseEstimator::sample_along_columns() {
  const int step = std::max(frame_.width() / tuning_.stripe_samples, 1);
  samples_.resize(frame_.height() - 2, frame_.width() / step);
  for (int y = 0; y < samples_.width(); ++y) {
    for (int i = 0; i < samples_.height(); ++i) {
      const int x = i * step;
      samples_(y, i) = frame_(x, y) - 2 * frame_(x, y + 1) + frame_(x, y + 2);
    }
  }
  return samples_;
}

}  // namespace thermedge
