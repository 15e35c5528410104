// Views of our images as OpenCV's, without a copy.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "thermedge/image.hpp"

namespace thermedge::bench {

// OpenCV has no constant views; who gets this one only reads.
inline cv::Mat mat(ImageView<const std::uint8_t> image) {
  return {image.height(), image.width(), CV_8U, const_cast<std::uint8_t*>(image.data()),
          static_cast<std::size_t>(image.stride())};
}

}  // namespace thermedge::bench
