// OpenCV's Gaussian blur of floats.
#pragma once

#include <opencv2/imgproc.hpp>

#include "thermedge/image.hpp"

namespace thermedge::bench {

// `size_px` 0: OpenCV's own choice for the sigma.
inline void opencv_gaussian(ImageView<const float> in, double sigma_px, int size_px, int threads,
                            ImageView<float> out) {
  cv::setNumThreads(threads);
  const cv::Mat source(in.height(), in.width(), CV_32F, const_cast<float*>(in.data()),
                       static_cast<std::size_t>(in.stride()) * sizeof(float));
  cv::Mat result(out.height(), out.width(), CV_32F, out.data(),
                 static_cast<std::size_t>(out.stride()) * sizeof(float));
  cv::GaussianBlur(source, result, {size_px, size_px}, sigma_px, sigma_px, cv::BORDER_REFLECT);
}

}  // namespace thermedge::bench
