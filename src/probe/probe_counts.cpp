#include "probe_counts.hpp"

#include <algorithm>
#include <cmath>

namespace thermedge::detail {
namespace {

constexpr int kLargestCount = static_cast<int>(kCountValues) - 1;

}  // namespace

void SortedCounts::sort(ImageView<const std::uint16_t> frame) {
  std::fill(up_to_.begin(), up_to_.end(), 0U);
  for (int y = 0; y < frame.height(); ++y) {
    const std::uint16_t* row = frame.row(y);
    for (int x = 0; x < frame.width(); ++x) {
      ++up_to_[row[x]];
    }
  }
  const auto is_used = [](std::uint32_t pixels) { return pixels > 0; };
  const auto first = std::find_if(up_to_.begin(), up_to_.end(), is_used);
  const auto last = std::find_if(up_to_.rbegin(), up_to_.rend(), is_used);
  min_ = static_cast<int>(first - up_to_.begin());
  max_ = static_cast<int>(up_to_.rend() - last) - 1;
  for (std::size_t count = 1; count < up_to_.size(); ++count) {
    up_to_[count] += up_to_[count - 1];
  }
}

int SortedCounts::quantile(double share) const {
  const auto rank = static_cast<std::uint32_t>(share * (up_to_.back() - 1));
  return static_cast<int>(std::upper_bound(up_to_.begin(), up_to_.end(), rank) - up_to_.begin());
}

double SortedCounts::share_up_to(double limit) const {
  if (limit < 0) {
    return 0;
  }
  const auto count = static_cast<std::size_t>(std::min(limit, double{kLargestCount}));
  return static_cast<double>(up_to_[count]) / up_to_.back();
}

// The level (R - M) gain + 127 rounds to less than 0 or more than 255.
double SortedCounts::clipped_share(double gain) const {
  const double median = quantile(0.5);
  const double too_dark = std::floor(median - 127.5 / gain);
  const double brightest_level = std::ceil(median + 128.5 / gain) - 1;
  return share_up_to(too_dark) + (1 - share_up_to(brightest_level));
}

std::int64_t SortedCounts::pixels(int count) const {
  const auto index = static_cast<std::size_t>(count);
  return std::int64_t{up_to_[index]} - (index > 0 ? up_to_[index - 1] : 0U);
}

void CountTotals::add(const SortedCounts& frame) {
  for (int count = frame.min(); count <= frame.max(); ++count) {
    const std::int64_t pixels = frame.pixels(count);
    pixels_[static_cast<std::size_t>(count)] += pixels;
    total_ += pixels;
  }
}

int CountTotals::quantile(double share) const {
  const auto rank = static_cast<std::int64_t>(share * static_cast<double>(total_ - 1));
  std::size_t count = 0;
  for (std::int64_t up_to = pixels_[0]; up_to <= rank; up_to += pixels_[count]) {
    ++count;
  }
  return static_cast<int>(count);
}

std::size_t CountTotals::distinct() const {
  return static_cast<std::size_t>(std::count_if(pixels_.begin(), pixels_.end(),
                                                [](std::int64_t pixels) { return pixels > 0; }));
}

CountHistogram CountTotals::histogram() const {
  constexpr int kMostBins = 256;
  constexpr int kMarginShare = 20;  // a 20th of the range on both sides
  CountHistogram histogram;
  if (total_ == 0) {
    return histogram;
  }
  const int low = quantile(0.001);
  const int high = quantile(0.999);
  const int margin = (high - low) / kMarginShare + 1;
  const int first = std::max(low - margin, 0);
  const int end = std::min(high + margin, kLargestCount) + 1;
  const int width = (end - first + kMostBins - 1) / kMostBins;
  for (int edge = first; edge < end + width; edge += width) {
    histogram.edges_counts.push_back(edge);
  }
  histogram.pixels.resize(histogram.edges_counts.size() - 1);
  for (int count = 0; count <= kLargestCount; ++count) {
    const std::int64_t pixels = pixels_[static_cast<std::size_t>(count)];
    if (count < first) {
      histogram.below += pixels;
    } else if (count >= histogram.edges_counts.back()) {
      histogram.above += pixels;
    } else {
      histogram.pixels[static_cast<std::size_t>((count - first) / width)] += pixels;
    }
  }
  return histogram;
}

}  // namespace thermedge::detail
