#include "column_offsets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>

#include "banded_cholesky.hpp"
#include "column_shifts_simd.hpp"
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
  rest_.assign(n, 0.0);
  trend_.assign(n, 0.0);
  trend_fit_.prepare(columns);
  sorted_.reserve(n);
  slopes_.reserve(n);
  cumulated_.resize(n + 1);
  clearness_.resize(n);
  const std::size_t whole_vectors = n + Image<std::uint16_t>::kAlignmentBytes;
  medians_.resize(whole_vectors);
  down_.resize(whole_vectors);
  up_.resize(whole_vectors);
  shifts_.assign(n, 0);
  next_shifts_.assign(n, 0);
  jumps_.reserve(tuning_.most_jumps);
  reach_left_.resize(n);
  reach_right_.resize(n);
  segment_.resize(n);
}

// Makes shifts_ the given ones, of `counts` too.
void ColumnOffsets::shift(ImageView<std::uint16_t> counts, std::span<const int> shifts) {
  constexpr int kMost = 65535;
  for (int x = 0; x < columns_; ++x) {
    const int change = shifts[index(x)] - shifts_[index(x)];
    down_[index(x)] = static_cast<std::uint16_t>(std::clamp(change, 0, kMost));
    up_[index(x)] = static_cast<std::uint16_t>(std::clamp(-change, 0, kMost));
    shifts_[index(x)] = shifts[index(x)];
  }
  shift_columns(down_.data(), up_.data(), counts);
}

void ColumnOffsets::start(ImageView<std::uint16_t> counts, double sigma) {
  const int unit = static_cast<int>(
      std::clamp(tuning_.start_unit_sigmas * sigma, 1.0, 1.0 * kLargestMedianUnit));
  neighbour_medians(counts, tuning_.start_row_step, unit, medians_.data());
  sorted_.clear();
  std::transform(medians_.begin(), medians_.begin() + columns_ - 1, std::back_inserter(sorted_),
                 [](std::int16_t median) { return std::abs(1.0 * median); });
  constexpr double kSigmaOverMad = 1.4826;
  const double deviation = kSigmaOverMad * nth_value(std::span(sorted_), sorted_.size() / 2);
  deviation_ = 0;
  if (deviation < tuning_.start_deviation_sigmas * sigma) {
    return;
  }
  deviation_ = deviation / (std::numbers::sqrt2 * sigma);
  next_shifts_[0] = 0;
  for (int x = 0; x + 1 < columns_; ++x) {
    const int median = medians_[index(x)];
    const bool is_edge = std::abs(median) > tuning_.start_edge_deviations * deviation;
    next_shifts_[index(x + 1)] = next_shifts_[index(x)] + (is_edge ? 0 : median);
  }
  shift(counts, next_shifts_);
}

void ColumnOffsets::take_off(ImageView<std::uint16_t> counts, double sigma) {
  std::transform(background_.begin(), background_.end(), next_shifts_.begin(), [=](double offset) {
    const double in_counts = offset * sigma;
    return static_cast<int>(in_counts + (in_counts < 0 ? -0.5 : 0.5));
  });
  shift(counts, next_shifts_);
  std::transform(background_.begin(), background_.end(), shifts_.begin(), rest_.begin(),
                 [=](double background, int shifted) { return background - shifted / sigma; });
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

// How far stripes of deviation_ exceed usual ones; at least 1.
double ColumnOffsets::strength() const {
  return std::max(deviation_ / tuning_.usual_stripes_sigmas, 1.0);
}

// The mean difference of each pair of columns. Neighbours without enough rows between which there
// is no edge are taken for equal, so that the chain does not break; the less so the stronger the
// stripes are.
void ColumnOffsets::find_pairs(double sigma) {
  const double per_sigma = 1 / sigma;
  const double per_row = 1.0 / rows_;
  const double least = tuning_.least_pair_share * rows_;
  const double variances = strength() * strength();
  const double weight_of_equals = 1 / (variances * variances);
  for (int i = 0; i < kNumberOfLags; ++i) {
    const std::int32_t* sums = sums_.row(i);
    const std::int32_t* numbers = numbers_.row(i);
    double* difference = differences(i);
    double* weight = weights(i);
    const double weight_of_none = i == 0 ? weight_of_equals : 0;
    const int lag = kLags[index(i)];
    for (int x = 0; x + lag < columns_; ++x) {
      const double number = numbers[x];
      const bool enough = number >= least;
      const double shifted = shifts_[index(x + lag)] - shifts_[index(x)];
      const double mean = (sums[x] / (enough ? number : 1.0) + shifted) * per_sigma;
      difference[x] = enough ? mean : 0;
      weight[x] = enough ? number * per_row : weight_of_none;
    }
  }
}

// The slope of a smooth scene, such as that of a lens darker towards the corners, seen over the
// longest lag.
SmoothSlope ColumnOffsets::find_slope() {
  constexpr int kLongest = kNumberOfLags - 1;
  slopes_.clear();
  const auto add = [&](int x) {
    const double weight = weights(kLongest)[x];
    if (weight > 0) {
      slopes_.push_back({x + 0.5 * kLargestLag, differences(kLongest)[x] / kLargestLag, weight});
    }
  };
  const int last = columns_ - 1 - kLargestLag;
  for (int x = 0; 2 * x <= last; x += tuning_.slope_step_px) {  // the same from either side
    add(x);
    if (2 * x < last) {
      add(last - x);
    }
  }
  const double half = 0.5 * (columns_ - 1);
  return robust_slope(slopes_, half, half, sorted_);
}

// Takes the trend off the differences of the pairs that were seen.
void ColumnOffsets::remove_trend() {
  const double least = tuning_.least_pair_share * rows_;
  for (int i = 0; i < kNumberOfLags; ++i) {
    const int lag = kLags[index(i)];
    double* difference = differences(i);
    const std::int32_t* numbers = numbers_.row(i);
    for (int x = 0; x + lag < columns_; ++x) {
      const double change = trend_[index(x + lag)] - trend_[index(x)];
      difference[x] -= numbers[x] >= least ? change : 0;
    }
  }
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
    inverse_weights += 1 / std::max(weights(0)[x], tuning_.least_pair_share);
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
  solve(tuning_.no_prior, {}, profile_);
  const double deviation = deviation_ = white_deviation(profile_);
  const bool on_dome = find_steep_trend();
  const double of_noise = variance_of_noise();
  if (deviation * deviation < tuning_.least_variance_ratio * of_noise) {
    std::copy(trend_.begin(), trend_.end(), background_.begin());
    return false;
  }
  find_jumps_and_trend(on_dome);
  remove_trend();
  solve(tuning_.prior * strength() * strength(), jumps_, offsets_);
  const double trust = 1 - of_noise / (deviation * deviation);
  for (double& offset : offsets_) {
    offset *= trust;
  }
  std::transform(offsets_.begin(), offsets_.end(), trend_.begin(), background_.begin(),
                 std::plus<>());
  return true;
}

// The trend from slopes, which jumps do not disturb, as far as it exceeds what stripes make of it.
// Returns whether it is that of a dome.
bool ColumnOffsets::find_steep_trend() {
  const SmoothSlope slope = find_slope();
  double squares = 0;
  for (int x = 0; x < columns_; ++x) {
    const double trend = slope.trend(x);
    trend_[index(x)] = trend;
    squares += trend * trend;
  }
  const double of_stripes = tuning_.steep_trend_deviations * deviation_;
  const double share = 1 - of_stripes * of_stripes * columns_ / squares;
  const double factor = squares > 0 ? std::max(share, 0.0) : 0;
  for (double& trend : trend_) {
    trend *= factor;
  }
  const double of_dome = tuning_.dome_deviations * deviation_;
  return squares > of_dome * of_dome * columns_;
}

// Jumps are looked for in the profile less the trend, and the trend between the jumps: none where
// it does not stand out of the stripes. Twice on a dome, as some of the jumps were none but bends
// of the first trend; elsewhere that would bend the trend into edges.
void ColumnOffsets::find_jumps_and_trend(bool on_dome) {
  const int rounds = on_dome ? 2 : 1;
  for (int round = 0; round < rounds && (round == 0 || !jumps_.empty()); ++round) {
    std::transform(profile_.begin(), profile_.end(), trend_.begin(), profile_.begin(),
                   std::minus<>());
    find_jumps(deviation_);
    std::transform(profile_.begin(), profile_.end(), trend_.begin(), profile_.begin(),
                   std::plus<>());
    number_segments(jumps_);
    trend_fit_.fit(profile_, segment_, deviation_, tuning_.trend_z);
    std::copy(trend_fit_.trend().begin(), trend_fit_.trend().end(), trend_.begin());
  }
}

}  // namespace thermedge::detail
