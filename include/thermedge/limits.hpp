// Bounds that decoders check after a file's header and before they allocate.
#pragma once

#include <cstdint>
#include <string>

#include "thermedge/result.hpp"

namespace thermedge {

struct Limits {
  int max_side_px = 16384;                         // width and height, px
  std::uint64_t max_bytes = 512ULL * 1024 * 1024;  // one decoded picture, or one file in memory
};

// Fails where a picture of this size breaks the limits, or has no pixels.
// `what` names the file in the message.
[[nodiscard]] Status check_limits(const Limits& limits, const std::string& what,
                                  std::uint64_t width, std::uint64_t height,
                                  std::uint64_t bytes_per_pixel);

}  // namespace thermedge
