// OpenCV's filters of 8-bit levels.
#pragma once

#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>

#include "mat.hpp"

namespace thermedge::bench {

inline void opencv_blur(ImageView<const std::uint8_t> in, double sigma_px,
                        ImageView<std::uint8_t> out) {
  cv::Mat to = mat(out);
  cv::GaussianBlur(mat(in), to, {0, 0}, sigma_px);
}

// `size_px`: odd.
inline void opencv_median(ImageView<const std::uint8_t> in, int size_px,
                          ImageView<std::uint8_t> out) {
  cv::Mat to = mat(out);
  cv::medianBlur(mat(in), to, size_px);
}

inline void opencv_bilateral(ImageView<const std::uint8_t> in, double range_levels, double space_px,
                             ImageView<std::uint8_t> out) {
  cv::Mat to = mat(out);
  cv::bilateralFilter(mat(in), to, 0, range_levels, space_px);
}

inline void opencv_nlm_of_levels(ImageView<const std::uint8_t> in, double h_levels,
                                 ImageView<std::uint8_t> out) {
  cv::Mat to = mat(out);
  cv::fastNlMeansDenoising(mat(in), to, static_cast<float>(h_levels), 7, 21);
}

}  // namespace thermedge::bench
