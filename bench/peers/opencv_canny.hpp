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

}  // namespace thermedge::bench
