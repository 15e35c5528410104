// Decoding as a test wants it: bytes in, plain numbers out.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "thermedge/io/source.hpp"

namespace thermedge::test {

inline Result<io::SourceFrame> decoded(const std::string& bytes, std::size_t page = 0,
                                       const Limits& limits = {}) {
  io::SourceFrame frame;
  return io::decode_picture(std::as_bytes(std::span(bytes)), "file", limits, page, frame).map([&] {
    return std::move(frame);
  });
}

// All pixels, row by row; a failure where there is no frame.
inline std::vector<int> pixels_of(const Result<io::SourceFrame>& frame) {
  std::vector<int> values;
  if (!frame) {
    ADD_FAILURE() << frame.error().message;
    return values;
  }
  for (int y = 0; y < frame->counts.height(); ++y) {
    const auto* row = frame->counts.row(y);
    values.insert(values.end(), row, row + frame->counts.width());
  }
  return values;
}

inline std::string error_of(const Result<io::SourceFrame>& frame) {
  return frame ? "no error" : frame.error().message;
}

}  // namespace thermedge::test
