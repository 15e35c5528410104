// Offsets of columns and rows, averaged over a recording.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::detail {

struct StripeProfileTuning {
  int samples = 96;  // along a column (row), spread over its length: precision against time
  // Neighbours to each side that an offset is measured against: more see the scene's slopes, fewer
  // have more noise. A constant, as sums are whole numbers for up to 4 of them.
  static constexpr int kReach = 4;
};

class StripeProfiles {
 public:
  explicit StripeProfiles(const StripeProfileTuning& tuning = {}) : tuning_(tuning) {}

  // Frames have one size.
  void add(ImageView<const std::uint16_t> frame);
  // Offset of each column (row) against its up to 8 nearest, counts; mean over the frames of the
  // median along the column (row). 0 for the first and the last.
  [[nodiscard]] std::vector<double> columns() const { return mean(column_sums_); }
  [[nodiscard]] std::vector<double> rows() const { return mean(row_sums_); }

 private:
  template <class F>
  void add_profile(int size, int across, F&& count, std::vector<double>& sums);
  [[nodiscard]] std::vector<double> mean(const std::vector<double>& sums) const;

  StripeProfileTuning tuning_;
  Image<std::int32_t> offsets_;
  std::vector<float> medians_;
  std::vector<double> column_sums_, row_sums_;
  std::int64_t frames_ = 0;
};

}  // namespace thermedge::detail
