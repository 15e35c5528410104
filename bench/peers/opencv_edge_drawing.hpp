// Edge Drawing of OpenCV's contributed modules, with and without its test of significance (EDPF).
#pragma once

#include <opencv2/ximgproc.hpp>

#include "mat.hpp"

namespace thermedge::bench {

// `blur_px`: its own Gaussian in front.
inline void opencv_edge_drawing(ImageView<const std::uint8_t> levels, int gradient_threshold,
                                ImageView<std::uint8_t> map) {
  const auto detector = cv::ximgproc::createEdgeDrawing();
  detector->params.GradientThresholdValue = gradient_threshold;
  detector->detectEdges(mat(levels));
  cv::Mat edges;
  detector->getEdgeImage(edges);
  edges.copyTo(mat(map));
}

inline void opencv_edpf(ImageView<const std::uint8_t> levels, ImageView<std::uint8_t> map) {
  const auto detector = cv::ximgproc::createEdgeDrawing();
  detector->params.PFmode = true;
  detector->detectEdges(mat(levels));
  cv::Mat edges;
  detector->getEdgeImage(edges);
  edges.copyTo(mat(map));
}

}  // namespace thermedge::bench
