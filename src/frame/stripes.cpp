#include "thermedge/stages/stripes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <span>

#include "banded_cholesky.hpp"
#include "lag_sums_simd.hpp"
#include "order_statistics.hpp"
#include "robust_line_fit.hpp"
#include "stripe_mask.hpp"
#include "stripe_mask_simd.hpp"
#include "transpose.hpp"

namespace thermedge {
namespace {

using detail::kLags;
using detail::kLargestLag;
constexpr int kBandWidth = kLargestLag + 1;
constexpr int kNumberOfLags = static_cast<int>(kLags.size());
constexpr int kSmallestSide = 64;
// Differences beyond this many sigma are edges of the scene, whatever lies between.
constexpr double kEdgeSigmas = 5;
// Gradients, in units of what pixel noise makes of them, that are edges, in the rounds behind the
// first, in which the stripes are still in the way.
constexpr std::array kEdgeGradients = {5.0, 4.5};
constexpr double kJumpZ = 6;  // of a lasting jump of the profile
constexpr int kMostJumps = 24;
constexpr std::array kJumpWindows = {5, 8, 12, 18, 26};
constexpr int kShortestJumpSide = 3;  // samples on either side of a jump
constexpr double kLeastShare = 0.1;   // of the height that a pair must have
// Offsets stand out where their variance is this many times what pixel noise makes of them.
constexpr double kStandOut = 1.5;
// Weights of the differences against the prior that offsets are small: as good as no prior, to see
// jumps; and for the result, where stripes have a third of the noise. Stronger ones have a weaker
// prior.
constexpr double kNoPrior = 1e4;
constexpr double kPrior = 2;
constexpr double kUsualStripes = 1.0 / 3;
// Of stripes beyond this many sigma so much is left before the last round that it looks like long
// faint edges.
constexpr double kStrong = 0.6;

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

// Offsets of the columns of one frame.
class ColumnOffsets {
 public:
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(row_sums_, row_numbers_, sums_, numbers_, differences_, weights_,
                             profile_, offsets_, background_, sorted_, cumulated_, clearness_,
                             slopes_, jumps_, reach_left_, reach_right_, segment_);
  }

  void prepare(int columns, int rows);

  // Fills offsets(), in units of `sigma`, from pairs of pixels with no edge between them: `reach`
  // as StripeMask gives it. Returns whether there are stripes.
  bool measure(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach,
               double sigma);
  [[nodiscard]] std::span<const double> offsets() const { return offsets_; }
  // The offsets, and the slope of the scene that goes on from side to side.
  [[nodiscard]] std::span<const double> background() const { return background_; }
  // Of the stripes together with what pixel noise makes of them, sigma.
  [[nodiscard]] double deviation() const { return deviation_; }

 private:
  // Of the pairs of columns x and x + kLags[lag_index].
  [[nodiscard]] double* differences(int lag_index) {
    return &differences_[index(lag_index * columns_)];
  }
  [[nodiscard]] double* weights(int lag_index) { return &weights_[index(lag_index * columns_)]; }

  void add_up(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach,
              int limit);
  void find_pairs(double sigma);
  detail::Line remove_slope();
  void number_segments(std::span<const int> jumps);
  void set_up_equations(double scale, std::span<const int> jumps);
  void solve(double scale, std::span<const int> jumps, std::span<double> result);
  void find_jumps(double deviation);
  void find_clearness(double deviation);
  [[nodiscard]] double jump_z(int x, double deviation) const;
  [[nodiscard]] double variance_of_noise();
  double white_deviation(std::span<const double> profile);

  double deviation_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  Image<std::int16_t> row_sums_, row_numbers_;  // of some rows; a row for each lag
  Image<std::int32_t> sums_, numbers_;          // of all rows
  std::vector<double> differences_, weights_;   // of each lag
  std::vector<double> band_;                    // of the normal equations, column by column
  std::vector<double> right_side_;              // of them
  std::vector<double> profile_, offsets_, background_, sorted_, cumulated_, clearness_;
  std::vector<detail::WeightedPoint> slopes_;
  std::vector<int> jumps_;  // a jump is between a column and the next
  std::vector<int> reach_left_, reach_right_, segment_;
};

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
  jumps_.reserve(kMostJumps);
  reach_left_.resize(n);
  reach_right_.resize(n);
  segment_.resize(n);
}

void ColumnOffsets::add_up(ImageView<const std::uint16_t> counts,
                           ImageView<const std::uint16_t> reach, int limit) {
  fill_pixels(sums_.view(), 0);
  fill_pixels(numbers_.view(), 0);
  const int most_rows = detail::most_lag_rows(limit);
  for (int y = 0; y < rows_; y += most_rows) {
    const int rows = std::min(most_rows, rows_ - y);
    detail::lag_sums(counts.crop(0, y, columns_, rows),
                     reach.crop(0, y / 2, columns_, (rows + 1) / 2), limit, row_sums_,
                     row_numbers_);
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
    const double least = kLeastShare * rows;
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
detail::Line ColumnOffsets::remove_slope() {
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
  const detail::Line slope = detail::robust_line(slopes_, sorted_);
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
  detail::solve_banded<kLargestLag>(band_, right_side_);
  std::copy_n(right_side_.begin(), columns_, result.begin());
}

// Of the white part of a profile: the MAD of its second differences, of which a jump spoils two.
double ColumnOffsets::white_deviation(std::span<const double> profile) {
  sorted_.clear();
  for (std::size_t x = 0; x + 2 < profile.size(); ++x) {
    sorted_.push_back(std::abs(profile[x] - 2 * profile[x + 1] + profile[x + 2]));
  }
  constexpr double kSigmaOverMad = 1.4826;
  const double middle = detail::nth_value(std::span(sorted_), sorted_.size() / 2);
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
  while (jumps_.size() < kMostJumps) {
    const auto best = std::max_element(clearness_.begin(), clearness_.end() - 1);
    if (*best < kJumpZ) {
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
  double best = 0;
  for (const int window : kJumpWindows) {
    const int begin = std::max(x + 1 - window, reach_left_[index(x)]);
    const int end = std::min(x + 1 + window, reach_right_[index(x)]);
    const int left = x + 1 - begin;
    const int right = end - x - 1;
    if (left < kShortestJumpSide || right < kShortestJumpSide) {
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
      static_cast<int>(std::clamp(kEdgeSigmas * sigma, 1.0, 1.0 * detail::kLargestLagDifference));
  add_up(counts, reach, limit);
  std::fill(offsets_.begin(), offsets_.end(), 0.0);
  find_pairs(sigma);
  const detail::Line slope = remove_slope();
  const double middle = 0.5 * (columns_ - 1);
  for (int x = 0; x < columns_; ++x) {  // its integral, 0 in the middle
    background_[index(x)] = (x - middle) * slope.at(0.5 * (x + middle));
  }
  solve(kNoPrior, {}, profile_);
  const double deviation = deviation_ = white_deviation(profile_);
  const double of_noise = variance_of_noise();
  if (deviation * deviation < kStandOut * of_noise) {
    return false;
  }
  find_jumps(deviation);
  const double strength = std::max(deviation / kUsualStripes, 1.0);
  solve(kPrior * strength * strength, jumps_, offsets_);
  const double trust = 1 - of_noise / (deviation * deviation);
  for (double& offset : offsets_) {
    offset *= trust;
  }
  std::transform(offsets_.begin(), offsets_.end(), background_.begin(), background_.begin(),
                 std::plus<>());
  return true;
}

}  // namespace

struct StripeFinder::Impl {
  void prepare(int width, int height) {
    columns.prepare(width, height);
    rows.prepare(height, width);
    mask.prepare(width, height);
    copy.resize(width, height);
    transposed.resize(height, width);
    reach.resize(width, (height + 1) / 2);
    transposed_reach.resize(height, (width + 1) / 2);
  }

  ColumnOffsets columns, rows;
  detail::StripeMask mask;
  Image<std::uint16_t> copy;  // whose rows may be read past their end
  Image<std::uint16_t> transposed;
  Image<std::uint16_t> reach, transposed_reach;
};

StripeFinder::StripeFinder() : impl_(std::make_unique<Impl>()) {}
StripeFinder::StripeFinder(StripeFinder&&) noexcept = default;
StripeFinder& StripeFinder::operator=(StripeFinder&&) noexcept = default;
StripeFinder::~StripeFinder() = default;

std::size_t StripeFinder::memory_bytes() const {
  const Impl& self = *impl_;
  return detail::memory_of(self.columns, self.rows, self.mask, self.copy, self.transposed,
                           self.reach, self.transposed_reach);
}

void StripeFinder::measure(ImageView<const std::uint16_t> frame, double sigma_counts,
                           ParallelRunner& runner, StripeOffsets& offsets) {
  offsets.columns.clear();
  offsets.rows.clear();
  if (std::min(frame.width(), frame.height()) < kSmallestSide) {
    return;
  }
  impl_->prepare(frame.width(), frame.height());
  offsets.columns.reserve(index(frame.width()));
  offsets.rows.reserve(index(frame.height()));
  if (!(sigma_counts > 0)) {
    return;
  }
  copy_pixels(frame, impl_->copy.view());
  detail::transpose(frame, impl_->transposed.view());
  bool in_columns = false;
  bool in_rows = false;
  const auto measure_both = [&] {
    runner.run(2, [&](int i) {
      if (i == 0) {
        in_columns = impl_->columns.measure(impl_->copy, impl_->reach, sigma_counts);
      } else {
        in_rows = impl_->rows.measure(impl_->transposed, impl_->transposed_reach, sigma_counts);
      }
    });
  };
  fill_pixels(impl_->reach.view(), detail::StripeMask::kNoEdge);
  fill_pixels(impl_->transposed_reach.view(), detail::StripeMask::kNoEdge);
  measure_both();
  for (const double gradient : kEdgeGradients) {
    const bool weak = std::max(impl_->columns.deviation(), impl_->rows.deviation()) < kStrong;
    impl_->mask.find(impl_->copy, impl_->columns.background(), impl_->rows.background(),
                     sigma_counts, gradient, gradient == kEdgeGradients.back() && weak);
    impl_->mask.reach_right(impl_->reach);
    impl_->mask.reach_down(impl_->transposed_reach);
    measure_both();
  }
  const auto in_counts = [&](double offset) { return static_cast<float>(offset * sigma_counts); };
  if (in_columns) {
    std::transform(impl_->columns.offsets().begin(), impl_->columns.offsets().end(),
                   std::back_inserter(offsets.columns), in_counts);
  }
  if (in_rows) {
    std::transform(impl_->rows.offsets().begin(), impl_->rows.offsets().end(),
                   std::back_inserter(offsets.rows), in_counts);
  }
}

Status StripeOptions::check() const { return check_ranges(*this, "stripes."); }

void remove_stripes(const StripeOffsets& offsets, ImageView<std::uint16_t> frame) {
  if (offsets.columns.empty() && offsets.rows.empty()) {
    return;
  }
  for (int y = 0; y < frame.height(); ++y) {
    const float of_row = offsets.rows.empty() ? 0 : offsets.rows[index(y)];
    if (offsets.columns.empty()) {
      detail::subtract_offset_row(of_row, frame.width(), frame.row(y));
    } else {
      detail::subtract_offsets_row(offsets.columns.data(), of_row, frame.width(), frame.row(y));
    }
  }
}

}  // namespace thermedge
