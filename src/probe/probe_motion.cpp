#include "probe_motion.hpp"

#include <algorithm>
#include <cmath>

namespace thermedge::detail {
namespace {

constexpr int kBlock = MotionTuning::kBlockPx;

}  // namespace

bool MotionGate::moved(ImageView<const std::uint16_t> frame, double sigma_counts) {
  measure(frame);
  if (!started_) {
    started_ = true;
    last_.resize(blocks_.width(), blocks_.height());
    last_.swap(blocks_);
    changes_.reserve(last_.size());
    return true;
  }
  const auto sigma = static_cast<float>(std::max(sigma_counts, 1.0));
  const float drift = common_change();
  int structured = 0;
  int changed = 0;
  for (int y = 0; y < blocks_.height(); ++y) {
    for (int x = 0; x < blocks_.width(); ++x) {
      if (has_structure(x, y, tuning_.structure_sigmas * sigma)) {
        ++structured;
        changed +=
            std::abs(blocks_(x, y) - last_(x, y) - drift) > tuning_.change_sigmas * sigma ? 1 : 0;
      }
    }
  }
  const bool is_moved =
      structured < tuning_.least_structured || tuning_.moved_part * changed >= structured;
  if (is_moved) {
    last_.swap(blocks_);
  }
  return is_moved;
}

void MotionGate::measure(ImageView<const std::uint16_t> frame) {
  blocks_.resize(frame.width() / kBlock, frame.height() / kBlock);
  for (int y = 0; y < blocks_.height(); ++y) {
    for (int x = 0; x < blocks_.width(); ++x) {
      std::uint32_t sum = 0;
      for (int j = 0; j < kBlock; ++j) {
        const std::uint16_t* row = frame.row(y * kBlock + j) + x * kBlock;
        for (int i = 0; i < kBlock; ++i) {
          sum += row[i];
        }
      }
      blocks_(x, y) = static_cast<float>(sum) / (kBlock * kBlock);
    }
  }
}

bool MotionGate::has_structure(int x, int y, float least_step) const {
  const int left = std::max(x - 1, 0);
  const int right = std::min(x + 1, last_.width() - 1);
  const int above = std::max(y - 1, 0);
  const int under = std::min(y + 1, last_.height() - 1);
  return std::abs(last_(right, y) - last_(left, y)) > least_step ||
         std::abs(last_(x, under) - last_(x, above)) > least_step;
}

float MotionGate::common_change() {
  changes_.clear();
  for (int y = 0; y < blocks_.height(); ++y) {
    for (int x = 0; x < blocks_.width(); ++x) {
      changes_.push_back(blocks_(x, y) - last_(x, y));
    }
  }
  if (changes_.empty()) {
    return 0;
  }
  const auto middle = changes_.begin() + static_cast<std::ptrdiff_t>(changes_.size() / 2);
  std::nth_element(changes_.begin(), middle, changes_.end());
  return *middle;
}

}  // namespace thermedge::detail
