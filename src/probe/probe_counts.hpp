// Order statistics of the counts of frames.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/probe/probe.hpp"

namespace thermedge::detail {

inline constexpr std::size_t kCountValues = std::numeric_limits<std::uint16_t>::max() + 1;

// Mean of what was added; 0 of nothing.
class Mean {
 public:
  void add(double value) {
    sum_ += value;
    ++count_;
  }
  [[nodiscard]] double value() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0; }
  [[nodiscard]] std::int64_t count() const { return count_; }

 private:
  double sum_ = 0;
  std::int64_t count_ = 0;
};

// The counts of one frame, sorted by counting.
class SortedCounts {
 public:
  SortedCounts() : up_to_(kCountValues) {}
  // `frame` has pixels.
  void sort(ImageView<const std::uint16_t> frame);

  [[nodiscard]] int min() const { return min_; }
  [[nodiscard]] int max() const { return max_; }
  // The count of rank floor(share (n - 1)).
  [[nodiscard]] int quantile(double share) const;
  // Share of the pixels with a count <= limit (or any below 0: none).
  [[nodiscard]] double share_up_to(double limit) const;
  // Share of the pixels that Algorithm 1 clips.
  [[nodiscard]] double clipped_share(double gain) const;
  [[nodiscard]] std::int64_t pixels(int count) const;

 private:
  std::vector<std::uint32_t> up_to_;  // pixels with this count or less
  int min_ = 0;
  int max_ = 0;
};

// The counts of all frames.
class CountTotals {
 public:
  CountTotals() : pixels_(kCountValues) {}
  void add(const SortedCounts& frame);
  [[nodiscard]] CountHistogram histogram() const;
  // The count of rank floor(share (n - 1)).
  [[nodiscard]] int quantile(double share) const;
  // How many different counts there are.
  [[nodiscard]] std::size_t distinct() const;

 private:
  std::vector<std::int64_t> pixels_;
  std::int64_t total_ = 0;
};

}  // namespace thermedge::detail
