// A row for the output of a kernel, between sentinels.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace thermedge::test {

// `count` elements and as many behind them as the kernel may write (`slack`); all hold the sentinel
// before the kernel runs, and so do the elements around them.
template <class T>
class SentinelRow {
 public:
  explicit SentinelRow(int count, int slack = 0, T sentinel = T(77))
      : sentinel_(sentinel),
        end_(kMargin + static_cast<std::size_t>(count) + static_cast<std::size_t>(slack)),
        elements_(end_ + kMargin, sentinel) {}

  [[nodiscard]] T* data() { return elements_.data() + kMargin; }
  [[nodiscard]] T operator[](int i) const {
    return elements_[kMargin + static_cast<std::size_t>(i)];
  }
  // Whether nothing was written in front of the row or behind its slack.
  [[nodiscard]] bool intact() const {
    const auto is_sentinel = [&](T value) { return value == sentinel_; };
    const auto end = elements_.begin() + static_cast<std::ptrdiff_t>(end_);
    return std::all_of(elements_.begin(), elements_.begin() + kMargin, is_sentinel) &&
           std::all_of(end, elements_.end(), is_sentinel);
  }

 private:
  static constexpr std::size_t kMargin = 70;
  T sentinel_;
  std::size_t end_;
  std::vector<T> elements_;
};

}  // namespace thermedge::test
