// The fixed offsets of the columns of a frame by least squares from differences between columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "robust_line_fit.hpp"
#include "smooth_trend.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/stages/stripes.hpp"

namespace thermedge::detail {

// Offsets of the columns of one frame. One object per thread; allocates in prepare only.
class ColumnOffsets {
 public:
  explicit ColumnOffsets(const StripeTuning& tuning) : tuning_(tuning) {}

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(row_sums_, row_numbers_, sums_, numbers_, differences_, weights_, band_,
                     right_side_, profile_, offsets_, trend_, background_, rest_, sorted_,
                     cumulated_, clearness_, slopes_, medians_, shifts_, next_shifts_, down_, up_,
                     jumps_, reach_left_, reach_right_, segment_, trend_fit_);
  }

  void prepare(int columns, int rows);

  // Strong stripes are found roughly and taken off `counts`, so that they are not taken for edges.
  void start(ImageView<std::uint16_t> counts, double sigma);

  // Fills offsets(), in units of `sigma`, from pairs of pixels with no edge between them: `reach`
  // as StripeMask gives it. `counts` is the frame less what was taken off it. Returns whether there
  // are stripes.
  bool measure(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach,
               double sigma);

  // Takes the offsets off `counts`, to whole counts, in place of what was taken off before.
  void take_off(ImageView<std::uint16_t> counts, double sigma);
  [[nodiscard]] std::span<const double> offsets() const { return offsets_; }
  // The offsets, and the slope of the scene that goes on from side to side.
  [[nodiscard]] std::span<const double> background() const { return background_; }
  // What of background() was not taken off.
  [[nodiscard]] std::span<const double> rest_of_background() const { return rest_; }
  // Of the stripes together with what pixel noise makes of them, sigma.
  [[nodiscard]] double deviation() const { return deviation_; }

 private:
  // Of the pairs of columns x and x + kLags[lag_index].
  [[nodiscard]] double* differences(int lag_index) { return of_lag(differences_, lag_index); }
  [[nodiscard]] double* weights(int lag_index) { return of_lag(weights_, lag_index); }
  [[nodiscard]] double* of_lag(std::vector<double>& values, int lag_index) const {
    return &values[static_cast<std::size_t>(lag_index) * static_cast<std::size_t>(columns_)];
  }

  void shift(ImageView<std::uint16_t> counts, std::span<const int> shifts);
  void add_up(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach,
              int limit);
  void find_pairs(double sigma);
  SmoothSlope find_slope();
  void remove_trend();
  bool find_steep_trend();
  void find_jumps_and_trend(bool on_dome);
  void number_segments(std::span<const int> jumps);
  void set_up_equations(double scale, std::span<const int> jumps);
  void solve(double scale, std::span<const int> jumps, std::span<double> result);
  void find_jumps(double deviation);
  void find_clearness(double deviation);
  [[nodiscard]] double jump_z(int x, double deviation) const;
  [[nodiscard]] double strength() const;
  [[nodiscard]] double variance_of_noise();
  double white_deviation(std::span<const double> profile);

  StripeTuning tuning_;
  double deviation_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  Image<std::int16_t> row_sums_, row_numbers_;  // of some rows; a row for each lag
  Image<std::int32_t> sums_, numbers_;          // of all rows
  std::vector<double> differences_, weights_;   // of each lag
  std::vector<double> band_;                    // of the normal equations, column by column
  std::vector<double> right_side_;              // of them
  std::vector<double> profile_, offsets_, trend_, background_, rest_, sorted_, cumulated_,
      clearness_;
  TrendFit trend_fit_;
  std::vector<WeightedPoint> slopes_;
  std::vector<std::int16_t> medians_;      // of the differences between neighbours, counts
  std::vector<int> shifts_, next_shifts_;  // what is taken off, counts
  std::vector<std::uint16_t> down_, up_;   // of shifts
  std::vector<int> jumps_;                 // a jump is between a column and the next
  std::vector<int> reach_left_, reach_right_, segment_;
};

}  // namespace thermedge::detail
