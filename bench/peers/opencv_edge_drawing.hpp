// Edge Drawing of OpenCV's contributed modules, with and without its test of significance (EDPF).
#pragma once

#include <opencv2/ximgproc.hpp>

#include "mat.hpp"

namespace thermedge::bench {

inline void draw_edges(const cv::ximgproc::EdgeDrawing::Params& params,
                       ImageView<const std::uint8_t> levels, ImageView<std::uint8_t> map) {
  const auto detector = cv::ximgproc::createEdgeDrawing();
  detector->params = params;
  detector->detectEdges(mat(levels));
  cv::Mat edges;
  detector->getEdgeImage(edges);
  edges.copyTo(mat(map));
}

inline void opencv_edge_drawing(ImageView<const std::uint8_t> levels, int gradient_threshold,
                                ImageView<std::uint8_t> map) {
  cv::ximgproc::EdgeDrawing::Params params;
  params.GradientThresholdValue = gradient_threshold;
  draw_edges(params, levels, map);
}

inline void opencv_edpf(ImageView<const std::uint8_t> levels, ImageView<std::uint8_t> map) {
  cv::ximgproc::EdgeDrawing::Params params;
  params.PFmode = true;
  draw_edges(params, levels, map);
}

}  // namespace thermedge::bench
