// OpenCV's non-local means, which works on 8 bits.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/photo.hpp>

#include "thermedge/image.hpp"

namespace thermedge::bench {

// Grey levels 0..255 in and out; the filter strength is sigma, as OpenCV's documentation has it.
inline void opencv_nlm(ImageView<const float> in, double sigma, int threads, ImageView<float> out) {
  cv::setNumThreads(threads);
  const cv::Mat source(in.height(), in.width(), CV_32F, const_cast<float*>(in.data()),
                       static_cast<std::size_t>(in.stride()) * sizeof(float));
  cv::Mat result(out.height(), out.width(), CV_32F, out.data(),
                 static_cast<std::size_t>(out.stride()) * sizeof(float));
  cv::Mat levels, denoised;
  source.convertTo(levels, CV_8U);
  cv::fastNlMeansDenoising(levels, denoised, static_cast<float>(sigma), 7, 21);
  denoised.convertTo(result, CV_32F);
}

}  // namespace thermedge::bench
