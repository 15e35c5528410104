#include "thermedge/limits.hpp"

namespace thermedge {

Status check_limits(const Limits& limits, const std::string& what, std::uint64_t width,
                    std::uint64_t height, std::uint64_t bytes_per_pixel) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width == 0 || height == 0) {
    return failure(ErrorCode::kBadData, what + ": the picture has no pixels (" + size + ")");
  }
  const auto side = static_cast<std::uint64_t>(limits.max_side_px);
  if (width > side || height > side) {
    return failure(ErrorCode::kLimitExceeded, what + ": " + size + " is larger than " +
                                                  std::to_string(limits.max_side_px) +
                                                  " pixels a side");
  }
  if (width * height > limits.max_bytes / bytes_per_pixel) {
    return failure(ErrorCode::kLimitExceeded, what + ": " + size + " needs more than " +
                                                  std::to_string(limits.max_bytes) + " bytes");
  }
  return {};
}

}  // namespace thermedge
