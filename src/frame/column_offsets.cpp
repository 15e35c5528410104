#include "column_offsets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "banded_cholesky.hpp"
#include "lag_sums_simd.hpp"
#include "order_statistics.hpp"

namespace thermedge::detail {
namespace {

constexpr auto& kJumpWindows = StripeTuning::kJumpWindows;
constexpr int kBandWidth = kLargestLag + 1;
constexpr int kNumberOfLags = static_cast<int>(kLags.size());

constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

// Standard deviations of the difference between the means of `left` and of `right` samples.
class JumpRoots {
 public:
  JumpRoots() {
    for (int left = 1; left <= kMost; ++left) {
      for (int right = 1; right <= kMost; ++right) {
        roots_[index(left * kSide + right)] = std::sqrt(1.0 / left + 1.0 / right);
      }
    }
  }
  [[nodiscard]] double of(int left, int right) const { return roots_[index(left * kSide + right)]; }

 private:
  static constexpr int kMost = kJumpWindows.back();
  static constexpr int kSide = kMost + 1;
  std::array<double, index(kSide* kSide)> roots_{};
};
const JumpRoots kJumpRoots;

}  // namespace

void ColumnOffsets::prepare(int columns, int rows) {
  columns_ = columns;
  rows_ = rows;
  const std::size_t n = index(columns);
  row_sums_.resize(columns, kNumberOfLags);
  row_numbers_.resize(columns, kNumberOfLags);
  sums_.resize(columns, kNumberOfLags);
  numbers_.resize(columns, kNumberOfLags);
  differences_.resize(kLags.size() * n);
  weights_.resize(kLags.size() * n);
  band_.resize(kBandWidth * (n + kLargestLag));
  right_side_.resize(n + kLargestLag);
  profile_.resize(n);
  offsets_.assign(n, 0.0);
  background_.assign(n, 0.0);
  sorted_.reserve(n);
  slopes_.reserve(n);
  cumulated_.resize(n + 1);
  clearness_.resize(n);
  jumps_.reserve(tuning_.most_jumps);
  reach_left_.resize(n);
  reach_right_.resize(n);
  segment_.resize(n);
}

void ColumnOffsets::add_up(ImageView<const std::uint16_t> counts,
                           ImageView<const std::uint16_t> reach, int limit) {
  fill_pixels(sums_.view(), 0);
  fill_pixels(numbers_.view(), 0);
  const int most_rows = most_lag_rows(limit);
  for (int y = 0; y < rows_; y += most_rows) {
    const int rows = std::min(most_rows, rows_ - y);
    lag_sums(counts.crop(0, y, columns_, rows), reach.crop(0, y / 2, columns_, (rows + 1) / 2),
             limit, row_sums_, row_numbers_);
    for (int i = 0; i < kNumberOfLags; ++i) {
      std::transform(row_sums_.row(i), row_sums_.row(i) + columns_, sums_.row(i), sums_.row(i),
                     std::plus<>());
      std::transform(row_numbers_.row(i), row_numbers_.row(i) + columns_, numbers_.row(i),
                     numbers_.row(i), std::plus<>());
    }
  }
}

// The mean difference of each pair of columns. Neighbours without enough rows between which there
// is no edge are taken for equal, so that the chain does not break.
void ColumnOffsets::find_pairs(double sigma) {
  for (int i = 0; i < kNumberOfLags; ++i) {
    const std::int32_t* sums = sums_.row(i);
    const std::int32_t* numbers = numbers_.row(i);
    double* difference = differences(i);
    double* weight = weights(i);
    const double weight_of_none = i == 0 ? 1 : 0;
    const double rows = rows_;
    const double least = tuning_.least_pair_share * rows;
    for (int x = 0; x + kLags[index(i)] < columns_; ++x) {
      const double number = numbers[x];
      const bool enough = number >= least;
      const double mean = sums[x] / (sigma * (enough ? number : 1.0));
      difference[x] = enough ? mean : 0;
      weight[x] = enough ? number / rows : weight_of_none;
    }
  }
}

// What a smooth scene makes of the differences, such as that of a lens darker towards the corners:
// a slope that changes evenly from side to side, seen over the longest lag.
Line ColumnOffsets::remove_slope() {
  constexpr int kLongest = kNumberOfLags - 1;
  const auto middle_of = [](int x, int lag) { return x + 0.5 * lag; };
  slopes_.clear();
  for (int x = 0; x + kLargestLag < columns_; ++x) {
    const double weight = weights(kLongest)[x];
    if (weight > 0) {
      slopes_.push_back(
          {middle_of(x, kLargestLag), differences(kLongest)[x] / kLargestLag, weight});
    }
  }
  const Line slope = robust_line(slopes_, sorted_);
  for (int i = 0; i < kNumberOfLags; ++i) {
    const int lag = kLags[index(i)];
    double* difference = differences(i);
    for (int x = 0; x + lag < columns_; ++x) {
      difference[x] -= lag * slope.at(middle_of(x, lag));
    }
  }
  return slope;
}

void ColumnOffsets::number_segments(std::span<const int> jumps) {
  std::fill(segment_.begin(), segment_.end(), 0);
  for (const int jump : jumps) {
    for (int x = jump + 1; x < columns_; ++x) {
      ++segment_[index(x)];
    }
  }
}

// Fills the lower half of the matrix into band_, element (x + l, x) at x * kBandWidth + l, and
// right_side_. Behind the last column there are kLargestLag empty ones.
void ColumnOffsets::set_up_equations(double scale, std::span<const int> jumps) {
  number_segments(jumps);
  std::fill(band_.begin(), band_.end(), 0.0);
  std::fill(right_side_.begin(), right_side_.end(), 0.0);
  for (int x = 0; x < columns_; ++x) {
    band_[index(x * kBandWidth)] = 1;
  }
  for (int i = 0; i < kNumberOfLags; ++i) {
    const int lag = kLags[index(i)];
    for (int x = 0; x + lag < columns_; ++x) {
      const bool same = segment_[index(x)] == segment_[index(x + lag)];
      const double weight = same ? scale * weights(i)[x] : 0;
      double* column = &band_[index(x * kBandWidth)];
      column[0] += weight;
      column[lag * kBandWidth] += weight;
      column[lag] -= weight;
      const double moment = weight * differences(i)[x];
      right_side_[index(x + lag)] += moment;
      right_side_[index(x)] -= moment;
    }
  }
}

// Minimises the sum over pairs of scale * weight * (c(x + lag) - c(x) - difference)^2 and of all
// c(x)^2; pairs across a jump are left out.
void ColumnOffsets::solve(double scale, std::span<const int> jumps, std::span<double> result) {
  set_up_equations(scale, jumps);
  solve_banded<kLargestLag>(band_, right_side_);
  std::copy_n(right_side_.begin(), columns_, result.begin());
}

// Of the white part of a profile: the MAD of its second differences, of which a jump spoils two.
double ColumnOffsets::white_deviation(std::span<const double> profile) {
  sorted_.clear();
  for (std::size_t x = 0; x + 2 < profile.size(); ++x) {
    sorted_.push_back(std::abs(profile[x] - 2 * profile[x + 1] + profile[x + 2]));
  }
  constexpr double kSigmaOverMad = 1.4826;
  const double middle = nth_value(std::span(sorted_), sorted_.size() / 2);
  return kSigmaOverMad * middle / std::sqrt(6.0);
}

// Lasting jumps of profile_, whose white part has this deviation, one after the other, the clearest
// first. Windows end at the jumps found before.
void ColumnOffsets::find_jumps(double deviation) {
  const int n = columns_;
  cumulated_[0] = 0;
  for (int x = 0; x < n; ++x) {
    cumulated_[index(x + 1)] = cumulated_[index(x)] + profile_[index(x)];
  }
  std::fill(reach_left_.begin(), reach_left_.end(), 0);
  std::fill(reach_right_.begin(), reach_right_.end(), n);
  jumps_.clear();
  const auto update = [&](int begin, int end) {
    for (int x = std::max(begin, 0); x < std::min(end, n - 1); ++x) {
      clearness_[index(x)] = jump_z(x, deviation);
    }
  };
  find_clearness(deviation);
  while (jumps_.size() < tuning_.most_jumps) {
    const auto best = std::max_element(clearness_.begin(), clearness_.end() - 1);
    if (*best < tuning_.jump_z) {
      break;
    }
    const int at = static_cast<int>(best - clearness_.begin());
    jumps_.push_back(at);
    for (int x = reach_left_[index(at)]; x <= at; ++x) {
      reach_right_[index(x)] = std::min(reach_right_[index(x)], at + 1);
    }
    for (int x = at + 1; x < n; ++x) {
      reach_left_[index(x)] = std::max(reach_left_[index(x)], at + 1);
    }
    update(at - kJumpWindows.back(), at + kJumpWindows.back() + 1);
  }
}

// jump_z of all samples where no jump is known yet.
void ColumnOffsets::find_clearness(double deviation) {
  const int last = columns_ - 2;
  const int margin = kJumpWindows.back() - 1;  // where windows are cut off
  for (int x = 0; x <= last; ++x) {
    const bool whole = x >= margin && x + margin < last;
    clearness_[index(x)] = whole ? 0 : jump_z(x, deviation);
  }
  for (const int window : kJumpWindows) {
    const double noise = deviation * kJumpRoots.of(window, window);
    for (int x = margin; x + margin < last; ++x) {
      const double* at = &cumulated_[index(x + 1)];
      const double step = (at[window] - at[0]) / window - (at[0] - at[-window]) / window;
      const double z = std::abs(step) / noise;
      clearness_[index(x)] = clearness_[index(x)] < z ? z : clearness_[index(x)];
    }
  }
}

// How clearly the profile jumps behind sample `x`: the largest z of all windows.
double ColumnOffsets::jump_z(int x, double deviation) const {
  const int shortest_side = tuning_.shortest_jump_side;
  double best = 0;
  for (const int window : kJumpWindows) {
    const int begin = std::max(x + 1 - window, reach_left_[index(x)]);
    const int end = std::min(x + 1 + window, reach_right_[index(x)]);
    const int left = x + 1 - begin;
    const int right = end - x - 1;
    if (left < shortest_side || right < shortest_side) {
      continue;
    }
    const double step = (cumulated_[index(end)] - cumulated_[index(x + 1)]) / right -
                        (cumulated_[index(x + 1)] - cumulated_[index(begin)]) / left;
    best = std::max(best, std::abs(step) / (deviation * kJumpRoots.of(left, right)));
  }
  return best;
}

// What pixel noise gives the offsets, in units of it: that of the means of columns over the rows
// between whose pixels there is no edge.
double ColumnOffsets::variance_of_noise() {
  double inverse_weights = 0;
  for (int x = 0; x + 1 < columns_; ++x) {
    inverse_weights += 1 / weights(0)[x];
  }
  return inverse_weights / (1.0 * rows_ * (columns_ - 1));
}

bool ColumnOffsets::measure(ImageView<const std::uint16_t> counts,
                            ImageView<const std::uint16_t> reach, double sigma) {
  const auto limit =
      static_cast<int>(std::clamp(tuning_.edge_sigmas * sigma, 1.0, 1.0 * kLargestLagDifference));
  add_up(counts, reach, limit);
  std::fill(offsets_.begin(), offsets_.end(), 0.0);
  find_pairs(sigma);
  const Line slope = remove_slope();
  const double middle = 0.5 * (columns_ - 1);
  for (int x = 0; x < columns_; ++x) {  // its integral, 0 in the middle
    background_[index(x)] = (x - middle) * slope.at(0.5 * (x + middle));
  }
  solve(tuning_.no_prior, {}, profile_);
  const double deviation = deviation_ = white_deviation(profile_);
  const double of_noise = variance_of_noise();
  if (deviation * deviation < tuning_.least_variance_ratio * of_noise) {
    return false;
  }
  find_jumps(deviation);
  const double strength = std::max(deviation / tuning_.usual_stripes_sigmas, 1.0);
  solve(tuning_.prior * strength * strength, jumps_, offsets_);
  const double trust = 1 - of_noise / (deviation * deviation);
  for (double& offset : offsets_) {
    offset *= trust;
  }
  std::transform(offsets_.begin(), offsets_.end(), background_.begin(), background_.begin(),
                 std::plus<>());
  return true;
}

}  // namespace thermedge::detail
