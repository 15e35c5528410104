#include "thermedge/stripes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "simd/lag_sums.hpp"

namespace thermedge {
namespace {

constexpr std::array kLags = {1, 2, 3, 4, 6, 8, 12};
constexpr int kLargestLag = kLags.back();
constexpr int kSmallestSide = 64;
constexpr int kPartRows = 2 * detail::kMostLagRows;  // height of a part of a column
// Differences beyond this many sigma are edges of the scene.
constexpr double kEdgeSigmas = 5;
constexpr double kEdgeZ = 3.5;  // of an edge within a part, or two parts together
constexpr double kJumpZ = 4.5;  // of a lasting jump of the profile
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
constexpr double kPrior = 4;
constexpr double kUsualStripes = 1.0 / 3;
constexpr int kSlopeReach = 40;  // columns to either side whose slopes count
constexpr int kRounds = 3;       // of: edges from the corrected frame, offsets from what is no edge

std::size_t index(int i) { return static_cast<std::size_t>(i); }

// Offsets of the columns of one frame.
class ColumnOffsets {
 public:
  void prepare(int columns, int rows);

  // Fills offsets() in units of `sigma`; returns whether there are stripes.
  bool measure(ImageView<const std::uint16_t> counts, double sigma, Runner& runner);
  [[nodiscard]] std::span<const double> offsets() const { return offsets_; }

 private:
  struct Pair {
    double difference = 0;
    double weight = 0;
  };
  struct Sum {
    std::int32_t sum = 0;
    std::int32_t number = 0;
  };

  [[nodiscard]] Sum& sum(int part, int lag_index, int x) {
    return sums_[index((part * static_cast<int>(kLags.size()) + lag_index) * columns_ + x)];
  }
  [[nodiscard]] Pair& pair(int lag_index, int x) { return pairs_[index(lag_index * columns_ + x)]; }

  void add_up(ImageView<const std::uint16_t> counts, int part, int limit);
  void find_edges(double sigma);
  void mark_edges(std::span<const double> steps, double deviation, int first_part, int parts);
  void find_pairs(double sigma);
  void find_slopes();
  void remove_slopes();
  void number_segments(std::span<const int> jumps);
  void solve(double scale, std::span<const int> jumps, std::span<double> result);
  void find_jumps(double deviation);
  [[nodiscard]] double jump_z(int x, double deviation) const;
  double white_deviation(std::span<const double> profile);

  int columns_ = 0;
  int rows_ = 0;
  int parts_ = 0;
  std::vector<Sum> sums_;                             // of each part, lag and column
  std::vector<std::int16_t> row_sums_, row_numbers_;  // of the tasks
  std::vector<int> edges_before_;                     // of each part: edge columns before column x
  std::vector<std::uint8_t> is_edge_;
  std::vector<double> steps_;  // of each part
  std::vector<Pair> pairs_;    // of each lag
  std::vector<double> band_;   // of the normal equations, row by row
  std::vector<double> profile_, offsets_, slopes_, sorted_, cumulated_, clearness_;
  std::vector<int> jumps_;  // a jump is between a column and the next
  std::vector<int> reach_left_, reach_right_, segment_;
};

void ColumnOffsets::prepare(int columns, int rows) {
  columns_ = columns;
  rows_ = rows;
  parts_ = (rows + kPartRows - 1) / kPartRows;
  const std::size_t n = index(columns);
  sums_.resize(index(parts_) * kLags.size() * n);
  const std::size_t padded = n + Image<std::int16_t>::kAlignmentBytes;
  row_sums_.resize(index(parts_) * padded);
  row_numbers_.resize(index(parts_) * padded);
  edges_before_.resize(index(parts_) * (n + 1));
  is_edge_.resize(index(parts_) * n);
  steps_.resize(index(parts_) * n);
  pairs_.resize(kLags.size() * n);
  band_.resize((kLargestLag + 1) * n);
  profile_.resize(n);
  offsets_.resize(n);
  slopes_.resize(n);
  sorted_.resize(n);
  cumulated_.resize(n + 1);
  clearness_.resize(n);
  jumps_.reserve(kMostJumps);
  reach_left_.resize(n);
  reach_right_.resize(n);
  segment_.resize(n);
}

void ColumnOffsets::add_up(ImageView<const std::uint16_t> counts, int part, int limit) {
  const std::size_t padded = row_sums_.size() / index(parts_);
  std::int16_t* sums = row_sums_.data() + index(part) * padded;
  std::int16_t* numbers = row_numbers_.data() + index(part) * padded;
  const int end = std::min((part + 1) * kPartRows, rows_);
  for (int i = 0; i < static_cast<int>(kLags.size()); ++i) {
    const int pairs = columns_ - kLags[index(i)];
    std::fill_n(&sum(part, i, 0), columns_, Sum{});
    for (int y = part * kPartRows; y < end; y += detail::kMostLagRows) {
      const int rows = std::min(detail::kMostLagRows, end - y);
      detail::lag_sums(counts.crop(0, y, columns_, rows), kLags[index(i)], limit, sums, numbers);
      for (int x = 0; x < pairs; ++x) {
        sum(part, i, x).sum += sums[x];
        sum(part, i, x).number += numbers[x];
      }
    }
  }
}

void ColumnOffsets::mark_edges(std::span<const double> steps, double deviation, int first_part,
                               int parts) {
  for (int x = 0; x < columns_; ++x) {
    if (std::abs(steps[index(x)]) <= kEdgeZ * deviation) {
      continue;
    }
    for (int part = first_part; part < first_part + parts; ++part) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns_ - 1); ++i) {
        is_edge_[index(part * columns_ + i)] = 1;
      }
    }
  }
}

// Columns at which a part, or two of them together, steps: the mean of the two columns before
// against that of the two behind, less the offsets known so far.
void ColumnOffsets::find_edges(double sigma) {
  constexpr int kLag2 = 1;  // indices of these lags
  constexpr int kLag4 = 3;
  const auto mean = [&](const Sum& sum) {
    return sum.number > 0 ? sum.sum / (sigma * sum.number) : 0;
  };
  std::fill(is_edge_.begin(), is_edge_.end(), std::uint8_t{0});
  std::fill(steps_.begin(), steps_.end(), 0.0);
  for (int part = 0; part < parts_; ++part) {
    for (int x = 2; x < columns_ - 2; ++x) {
      const double near =
          mean(sum(part, kLag2, x - 1)) - (offsets_[index(x + 1)] - offsets_[index(x - 1)]);
      const double far =
          mean(sum(part, kLag4, x - 2)) - (offsets_[index(x + 2)] - offsets_[index(x - 2)]);
      steps_[index(part * columns_ + x)] = (near + far) / 2;
    }
  }
  const auto steps_of = [&](int part) {
    return std::span(steps_).subspan(index(part * columns_), index(columns_));
  };
  const double deviation = 1 / std::sqrt(static_cast<double>(kPartRows));
  for (int part = 0; part < parts_; ++part) {
    mark_edges(steps_of(part), deviation, part, 1);
    if (part + 1 < parts_) {
      const auto next = steps_of(part + 1);
      std::transform(next.begin(), next.end(), steps_of(part).begin(), profile_.begin(),
                     [](double a, double b) { return (a + b) / 2; });
      mark_edges(profile_, deviation / std::sqrt(2.0), part, 2);
    }
  }
}

// The mean difference of each pair of columns over the parts without an edge between them. A pair
// of neighbours without enough of these takes all parts, so that the chain does not break.
void ColumnOffsets::find_pairs(double sigma) {
  for (int part = 0; part < parts_; ++part) {
    int* before = &edges_before_[index(part * (columns_ + 1))];
    before[0] = 0;
    for (int x = 0; x < columns_; ++x) {
      before[x + 1] = before[x] + is_edge_[index(part * columns_ + x)];
    }
  }
  for (int i = 0; i < static_cast<int>(kLags.size()); ++i) {
    const int lag = kLags[index(i)];
    for (int x = 0; x + lag < columns_; ++x) {
      Sum clean;
      Sum all;
      for (int part = 0; part < parts_; ++part) {
        const Sum& of_part = sum(part, i, x);
        const int* before = &edges_before_[index(part * (columns_ + 1))];
        const bool is_clean = before[x + lag + 1] == before[x];
        clean.sum += is_clean ? of_part.sum : 0;
        clean.number += is_clean ? of_part.number : 0;
        all.sum += of_part.sum;
        all.number += of_part.number;
      }
      const bool enough = clean.number >= kLeastShare * rows_;
      const Sum& used = enough || lag > 1 ? clean : all;
      Pair& found = pair(i, x);
      found.difference = used.number > 0 ? used.sum / (sigma * used.number) : 0;
      found.weight = enough ? static_cast<double>(clean.number) / rows_ : lag == 1 ? 1 : 0;
    }
  }
}

// What a smooth scene makes of the differences: the median of the slopes around over the longest
// lag, those across jumps left out.
void ColumnOffsets::find_slopes() {
  number_segments(jumps_);
  constexpr int kLongest = static_cast<int>(kLags.size()) - 1;
  const int count = columns_ - kLargestLag;  // pairs of the longest lag
  for (int x = 0; x < count; ++x) {
    const int begin = std::max(x - kSlopeReach, 0);
    const int end = std::min(x + kSlopeReach + 1, count);
    std::size_t size = 0;
    for (int i = begin; i < end; ++i) {
      if (pair(kLongest, i).weight > 0 && segment_[index(i)] == segment_[index(i + kLargestLag)]) {
        sorted_[size++] = pair(kLongest, i).difference / kLargestLag;
      }
    }
    const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(size / 2);
    std::nth_element(sorted_.begin(), middle, sorted_.begin() + static_cast<std::ptrdiff_t>(size));
    slopes_[index(x)] = size > 0 ? *middle : x > 0 ? slopes_[index(x - 1)] : 0;
  }
}

void ColumnOffsets::remove_slopes() {
  const int count = columns_ - kLargestLag;
  for (int i = 0; i < static_cast<int>(kLags.size()); ++i) {
    const int lag = kLags[index(i)];
    for (int x = 0; x + lag < columns_; ++x) {
      const int centre = x + (lag - kLargestLag) / 2;
      pair(i, x).difference -= lag * slopes_[index(std::clamp(centre, 0, count - 1))];
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
  const std::size_t count = profile.size() - 2;
  for (std::size_t x = 0; x < count; ++x) {
    sorted_[x] = std::abs(profile[x] - 2 * profile[x + 1] + profile[x + 2]);
  }
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sorted_.begin(), middle, sorted_.begin() + static_cast<std::ptrdiff_t>(count));
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

bool ColumnOffsets::measure(ImageView<const std::uint16_t> counts, double sigma, Runner& runner) {
  const auto limit =
      static_cast<int>(std::clamp(kEdgeSigmas * sigma, 1.0, 1.0 * detail::kLargestLagDifference));
  runner.run(parts_, [&](int part) { add_up(counts, part, limit); });
  std::fill(offsets_.begin(), offsets_.end(), 0.0);
  std::fill(is_edge_.begin(), is_edge_.end(), std::uint8_t{0});
  const double of_noise = 1.0 / rows_;  // variance that pixel noise gives the mean of a column
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) {
      find_edges(sigma);
    }
    find_pairs(sigma);
    if (round == 0) {
      solve(kNoPrior, {}, profile_);
      find_jumps(white_deviation(profile_));
      find_slopes();
    }
    remove_slopes();
    solve(kNoPrior, {}, profile_);
    const double deviation = white_deviation(profile_);
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
  }
  return true;
}

}  // namespace

struct StripeFinder::Impl {
  void prepare(int width, int height) {
    columns.prepare(width, height);
    rows.prepare(height, width);
    copy.resize(width, height);
    transposed.resize(height, width);
  }

  ColumnOffsets columns, rows;
  Image<std::uint16_t> copy;  // whose rows may be read past their end
  Image<std::uint16_t> transposed;
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
  const auto measure_axis = [&](ColumnOffsets& axis, ImageView<const std::uint16_t> counts,
                                std::vector<float>& found) {
    if (axis.measure(counts, sigma_counts, runner)) {
      for (const double offset : axis.offsets()) {
        found.push_back(static_cast<float>(offset * sigma_counts));
      }
    }
  };
  measure_axis(impl_->columns, impl_->copy, offsets.columns);
  measure_axis(impl_->rows, impl_->transposed, offsets.rows);
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
