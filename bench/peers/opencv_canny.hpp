// OpenCV's Canny.
#pragma once

#include <opencv2/imgproc.hpp>

#include "mat.hpp"

namespace thermedge::bench {

// Thresholds of the Euclidean norm of the 3x3 Sobel gradient, the low one .4 of the high one.
inline void opencv_canny(ImageView<const std::uint8_t> levels, double high,
                         ImageView<std::uint8_t> map) {
  cv::Mat to = mat(map);
  cv::Canny(mat(levels), to, 0.4 * high, high, 3, true);
}

// The gradient of counts behind a Gaussian, before it is rounded to 8 bits; `high` in counts a
// pixel, the low threshold .4 of it.
inline void opencv_canny_of_counts(ImageView<const std::uint16_t> counts, double blur_px,
                                   double high, ImageView<std::uint8_t> map) {
  constexpr double kHighInt = 200;  // the high threshold in units of the integer gradient
  const cv::Mat from(counts.height(), counts.width(), CV_16U,
                     const_cast<std::uint16_t*>(counts.data()),
                     static_cast<std::size_t>(counts.stride()) * sizeof(std::uint16_t));
  cv::Mat smooth, dx, dy;
  from.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {0, 0}, blur_px);
  const double scale = kHighInt / high / 8;  // Sobel's kernel is 8 times the derivative
  cv::Sobel(smooth, dx, CV_32F, 1, 0, 3, scale);
  cv::Sobel(smooth, dy, CV_32F, 0, 1, 3, scale);
  dx.convertTo(dx, CV_16S);
  dy.convertTo(dy, CV_16S);
  cv::Mat to = mat(map);
  cv::Canny(dx, dy, to, 0.4 * kHighInt, kHighInt, true);
}

}  // namespace thermedge::bench
