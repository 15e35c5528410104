// Least and largest pixels of a row.
#pragma once

namespace thermedge::detail {

struct Extent {
  float low = 0;
  float high = 0;
  bool finite = true;  // no pixel is NaN or infinite; if not, low and high mean nothing
};

// `width` at least 1.
[[nodiscard]] Extent extent_of(const float* row, int width);

}  // namespace thermedge::detail
