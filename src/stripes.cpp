#include "thermedge/stripes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <span>

#include "robust_line.hpp"
#include "simd/lag_sums.hpp"
#include "stripe_mask.hpp"

namespace thermedge {
namespace {

constexpr std::array kLags = {1, 2, 3, 4, 6, 8};
constexpr int kLargestLag = kLags.back();
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

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// Offsets of the columns of one frame.
class ColumnOffsets {
 public:
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
  struct Pair {
    double difference = 0;
    double weight = 0;
  };
  struct Sum {
    std::int32_t sum = 0;
    std::int32_t number = 0;
  };

  [[nodiscard]] Sum& sum(int lag_index, int x) { return sums_[index(lag_index * columns_ + x)]; }
  [[nodiscard]] Pair& pair(int lag_index, int x) { return pairs_[index(lag_index * columns_ + x)]; }

  void add_up(ImageView<const std::uint16_t> counts, ImageView<const std::uint16_t> reach,
              int limit);
  void find_pairs(double sigma);
  detail::Line remove_slope();
  void number_segments(std::span<const int> jumps);
  void solve(double scale, std::span<const int> jumps, std::span<double> result);
  void find_jumps(double deviation);
  [[nodiscard]] double jump_z(int x, double deviation) const;
  [[nodiscard]] double variance_of_noise();
  double white_deviation(std::span<const double> profile);

  double deviation_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Sum> sums_;                             // of each lag and column
  std::vector<std::int16_t> row_sums_, row_numbers_;  // of some rows
  std::vector<Pair> pairs_;                           // of each lag
  std::vector<double> band_;                          // of the normal equations, row by row
  std::vector<double> profile_, offsets_, background_, sorted_, cumulated_, clearness_;
  std::vector<detail::WeightedPoint> slopes_;
  std::vector<int> jumps_;  // a jump is between a column and the next
  std::vector<int> reach_left_, reach_right_, segment_;
};

void ColumnOffsets::prepare(int columns, int rows) {
  columns_ = columns;
  rows_ = rows;
  const std::size_t n = index(columns);
  sums_.resize(kLags.size() * n);
  const std::size_t padded = n + Image<std::int16_t>::kAlignmentBytes;
  row_sums_.resize(padded);
  row_numbers_.resize(padded);
  pairs_.resize(kLags.size() * n);
  band_.resize((kLargestLag + 1) * n);
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
  std::fill(sums_.begin(), sums_.end(), Sum{});
  for (int i = 0; i < static_cast<int>(kLags.size()); ++i) {
    const int pairs = columns_ - kLags[index(i)];
    for (int y = 0; y < rows_; y += detail::kMostLagRows) {
      const int rows = std::min(detail::kMostLagRows, rows_ - y);
      detail::lag_sums(counts.crop(0, y, columns_, rows),
                       reach.crop(0, y / 2, columns_, (rows + 1) / 2), kLags[index(i)], limit,
                       row_sums_.data(), row_numbers_.data());
      for (int x = 0; x < pairs; ++x) {
        sum(i, x).sum += row_sums_[index(x)];
        sum(i, x).number += row_numbers_[index(x)];
      }
    }
  }
}

// The mean difference of each pair of columns. Neighbours without enough rows between which there
// is no edge are taken for equal, so that the chain does not break.
void ColumnOffsets::find_pairs(double sigma) {
  for (int i = 0; i < static_cast<int>(kLags.size()); ++i) {
    const int lag = kLags[index(i)];
    for (int x = 0; x + lag < columns_; ++x) {
      const Sum& all = sum(i, x);
      const bool enough = all.number >= kLeastShare * rows_;
      pair(i, x) = enough ? Pair{all.sum / (sigma * all.number), 1.0 * all.number / rows_}
                          : Pair{0, lag == 1 ? 1.0 : 0.0};
    }
  }
}

// What a smooth scene makes of the differences, such as that of a lens darker towards the corners:
// a slope that changes evenly from side to side, seen over the longest lag.
detail::Line ColumnOffsets::remove_slope() {
  constexpr int kLongest = static_cast<int>(kLags.size()) - 1;
  const auto middle_of = [](int x, int lag) { return x + 0.5 * lag; };
  slopes_.clear();
  for (int x = 0; x + kLargestLag < columns_; ++x) {
    const Pair& seen = pair(kLongest, x);
    if (seen.weight > 0) {
      slopes_.push_back({middle_of(x, kLargestLag), seen.difference / kLargestLag, seen.weight});
    }
  }
  const detail::Line slope = detail::robust_line(slopes_, sorted_);
  for (int i = 0; i < static_cast<int>(kLags.size()); ++i) {
    const int lag = kLags[index(i)];
    for (int x = 0; x + lag < columns_; ++x) {
      pair(i, x).difference -= lag * slope.at(middle_of(x, lag));
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

// Minimises the sum over pairs of scale * weight * (c(x + lag) - c(x) - difference)^2 and of all
// c(x)^2; pairs across a jump are left out. Banded Cholesky decomposition.
void ColumnOffsets::solve(double scale, std::span<const int> jumps, std::span<double> result) {
  constexpr int kWidth = kLargestLag + 1;
  const int n = columns_;
  number_segments(jumps);
  // band[x * kWidth + kLargestLag - l] is the element (x, x - l).
  std::fill(band_.begin(), band_.end(), 0.0);
  std::fill(result.begin(), result.end(), 0.0);
  const auto element = [&](int x, int l) -> double& {
    return band_[index(x * kWidth + kLargestLag - l)];
  };
  for (int x = 0; x < n; ++x) {
    element(x, 0) = 1;
  }
  for (int i = 0; i < static_cast<int>(kLags.size()); ++i) {
    const int lag = kLags[index(i)];
    for (int x = 0; x + lag < n; ++x) {
      if (segment_[index(x)] != segment_[index(x + lag)]) {
        continue;
      }
      const double weight = scale * pair(i, x).weight;
      element(x, 0) += weight;
      element(x + lag, 0) += weight;
      element(x + lag, lag) -= weight;
      result[index(x + lag)] += weight * pair(i, x).difference;
      result[index(x)] -= weight * pair(i, x).difference;
    }
  }
  for (int x = 0; x < n; ++x) {
    double* row = &band_[index(x * kWidth)];
    const int first = std::max(x - kLargestLag, 0);
    for (int j = first; j <= x; ++j) {
      const double* other = &band_[index(j * kWidth)];
      // Products of the elements of both rows in the columns that both have.
      const int begin = std::max(first, j - kLargestLag);
      double value = row[kLargestLag - (x - j)];
      for (int k = begin; k < j; ++k) {
        value -= row[kLargestLag - (x - k)] * other[kLargestLag - (j - k)];
      }
      row[kLargestLag - (x - j)] = j < x ? value / other[kLargestLag] : std::sqrt(value);
    }
    double value = result[index(x)];
    for (int k = first; k < x; ++k) {
      value -= row[kLargestLag - (x - k)] * result[index(k)];
    }
    result[index(x)] = value / row[kLargestLag];
  }
  for (int x = n - 1; x >= 0; --x) {
    double value = result[index(x)];
    for (int k = x + 1; k <= std::min(x + kLargestLag, n - 1); ++k) {
      value -= element(k, k - x) * result[index(k)];
    }
    result[index(x)] = value / element(x, 0);
  }
}

// Of the white part of a profile: the MAD of its second differences, of which a jump spoils two.
double ColumnOffsets::white_deviation(std::span<const double> profile) {
  sorted_.clear();
  for (std::size_t x = 0; x + 2 < profile.size(); ++x) {
    sorted_.push_back(std::abs(profile[x] - 2 * profile[x + 1] + profile[x + 2]));
  }
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
  std::nth_element(sorted_.begin(), middle, sorted_.end());
  constexpr double kSigmaOverMad = 1.4826;
  return kSigmaOverMad * *middle / std::sqrt(6.0);
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
  update(0, n - 1);
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
    best = std::max(best, std::abs(step) / (deviation * std::sqrt(1.0 / left + 1.0 / right)));
  }
  return best;
}

// What pixel noise gives the offsets, in units of it: that of the means of columns over the rows
// between whose pixels there is no edge.
double ColumnOffsets::variance_of_noise() {
  double inverse_weights = 0;
  for (int x = 0; x + 1 < columns_; ++x) {
    inverse_weights += 1 / pair(0, x).weight;
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
  for (int x = 0; x < columns_; ++x) {
    background_[index(x)] = x * slope.at(0.5 * x);  // its integral
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

void StripeFinder::measure(ImageView<const std::uint16_t> frame, double sigma_counts,
                           Runner& runner, StripeOffsets& offsets) {
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
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      impl_->transposed(y, x) = frame(x, y);
    }
  }
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
    impl_->mask.find(frame, impl_->columns.background(), impl_->rows.background(), sigma_counts,
                     gradient, gradient == kEdgeGradients.back() && weak);
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

void remove_stripes(const StripeOffsets& offsets, ImageView<std::uint16_t> frame) {
  if (offsets.columns.empty() && offsets.rows.empty()) {
    return;
  }
  for (int y = 0; y < frame.height(); ++y) {
    const float of_row = offsets.rows.empty() ? 0 : offsets.rows[index(y)];
    std::uint16_t* row = frame.row(y);
    for (int x = 0; x < frame.width(); ++x) {
      const float of_column = offsets.columns.empty() ? 0 : offsets.columns[index(x)];
      const float value = static_cast<float>(row[x]) - of_column - of_row;
      row[x] = static_cast<std::uint16_t>(std::clamp(value, 0.0F, 65535.0F) + 0.5F);
    }
  }
}

}  // namespace thermedge
