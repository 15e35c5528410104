// The line segment detector as OpenCV has it.
#pragma once

#include <opencv2/imgproc.hpp>
#include <vector>

#include "mat.hpp"

namespace thermedge::bench {

// Its segments, drawn one pixel wide.
inline void opencv_lsd(ImageView<const std::uint8_t> levels, ImageView<std::uint8_t> map) {
  const auto detector = cv::createLineSegmentDetector(cv::LSD_REFINE_ADV);
  std::vector<cv::Vec4f> segments;
  detector->detect(mat(levels), segments);
  cv::Mat to = mat(map);
  to.setTo(0);
  for (const cv::Vec4f& s : segments) {
    cv::line(to, cv::Point(cvRound(s[0]), cvRound(s[1])), cv::Point(cvRound(s[2]), cvRound(s[3])),
             255);
  }
}

}  // namespace thermedge::bench
