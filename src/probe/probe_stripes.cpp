#include "probe_stripes.hpp"

#include <algorithm>

#include "highpass_simd.hpp"

namespace thermedge::detail {
namespace {

constexpr int kReach = StripeProfileTuning::kReach;
constexpr std::int32_t kScale = 24;  // divisible by 2, 4, 6 and 8 neighbours: whole numbers
constexpr std::int32_t kLargest = (1 << 18) - 1;  // column_medians allows

}  // namespace

void StripeProfiles::add(ImageView<const std::uint16_t> frame) {
  ++frames_;
  add_profile(
      frame.width(), frame.height(), [&](int i, int j) { return int{frame(i, j)}; }, column_sums_);
  add_profile(
      frame.height(), frame.width(), [&](int i, int j) { return int{frame(j, i)}; }, row_sums_);
}

// `count(i, j)`: of pixel j of line i.
template <class F>
void StripeProfiles::add_profile(int size, int across, F&& count, std::vector<double>& sums) {
  const int step = std::max(across / tuning_.samples, 1);
  offsets_.resize(size, across / step);
  fill_pixels(offsets_.view(), 0);
  for (int sample = 0; sample < offsets_.height(); ++sample) {
    const int j = sample * step;
    for (int i = 1; i < size - 1; ++i) {
      const int reach = std::min({kReach, i, size - 1 - i});
      std::int32_t neighbours = 0;
      for (int k = 1; k <= reach; ++k) {
        neighbours += count(i - k, j) + count(i + k, j);
      }
      const std::int32_t offset = kScale * count(i, j) - kScale / (2 * reach) * neighbours;
      offsets_(i, sample) = std::clamp(offset, -kLargest, kLargest);
    }
  }
  medians_.resize(static_cast<std::size_t>(size) + Image<float>::kAlignmentBytes / sizeof(float));
  column_medians(offsets_, medians_.data());
  sums.resize(static_cast<std::size_t>(size));
  for (std::size_t i = 1; i + 1 < sums.size(); ++i) {
    sums[i] += static_cast<double>(medians_[i]) / kScale;
  }
}

std::vector<double> StripeProfiles::mean(const std::vector<double>& sums) const {
  std::vector<double> means;
  means.reserve(sums.size());
  for (const double sum : sums) {
    means.push_back(sum / static_cast<double>(frames_));
  }
  return means;
}

}  // namespace thermedge::detail
