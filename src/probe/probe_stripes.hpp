// Offsets of columns and rows, averaged over a recording.
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"

namespace thermedge::detail {

class StripeProfiles {
 public:
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

  Image<std::int32_t> offsets_;
  std::vector<float> medians_;
  std::vector<double> column_sums_, row_sums_;
  std::int64_t frames_ = 0;
};

}  // namespace thermedge::detail
