#include "contrast_spread.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "order_statistics.hpp"
#include "thermedge/stages/oriented_filter.hpp"

namespace thermedge::detail {
namespace {

// Of a normal, in steps of 15 degrees from the x axis; which way it points makes no difference.
std::size_t orientation_of(float nx, float ny) {
  // Tangents of the angles half way between two orientations.
  constexpr std::array kBounds = {0.1316525F, 0.4142136F, 0.7673270F,
                                  1.3032254F, 2.4142136F, 7.5957541F};
  const auto* bound = std::find_if(kBounds.begin(), kBounds.end(), [=](float tangent) {
    return std::abs(ny) < tangent * std::abs(nx);
  });
  const auto steps = static_cast<std::size_t>(bound - kBounds.begin());
  return steps > 0 && (nx < 0) != (ny < 0) ? (kEdgeOrientations - steps) % kEdgeOrientations
                                           : steps;
}

// The nearest whole number, of those half way the larger one; for values from -kOffset on.
int nearest(double value) {
  constexpr int kOffset = 1 << 20;
  return static_cast<int>(value + (kOffset + 0.5)) - kOffset;
}

}  // namespace

ContrastSpread::ContrastSpread(const ContrastSpreadTuning& tuning, const SideSlopeTuning& slopes,
                               const ContrastTuning& contrast)
    : tuning_(tuning), slopes_(slopes), contrast_(contrast) {
  weights_.assign(static_cast<std::size_t>(std::ceil(slopes.chord_to_px)) + 1, 0);
  const auto add = [&](double distance_px, double weight) {
    const auto below = static_cast<std::size_t>(distance_px);
    const double share = distance_px - static_cast<double>(below);
    weights_[below] += weight * (1 - share);
    weights_[std::min(below + 1, weights_.size() - 1)] += weight * share;
  };
  const int steps = this->steps();
  for (int k = 0; k < steps; ++k) {
    add(contrast.nearest_px + k, 1.0 / steps);
  }
  const double of_slope = kContrastPx / (slopes.chord_to_px - slopes.chord_from_px) / 2;
  add(slopes.chord_from_px, of_slope);
  add(slopes.chord_to_px, -of_slope);
}

int ContrastSpread::steps() const {
  return static_cast<int>(contrast_.farthest_px - contrast_.nearest_px) + 1;
}

void ContrastSpread::prepare(int width, int height) {
  width_ = width;
  height_ = height;
  const int reach = (width + height) / 2;
  const auto longest = static_cast<std::size_t>(2 * reach + 1);
  line_.reserve(longest);
  contrasts_.reserve(longest);
  sums_.reserve(longest + 1);
  for (const Course course : {kAlongColumns, kAlongRows, kOblique}) {
    const int step = course == kOblique ? tuning_.oblique_step_px : tuning_.line_step_px;
    const int directions = course == kOblique ? 4 : 1;
    const auto lines = static_cast<std::size_t>(directions * (2 * (reach / step) + 1));
    for (std::size_t length = 0; length < kLengths; ++length) {
      samples(course, length).reserve(lines * longest / (kShortest << length));
    }
  }
}

void ContrastSpread::measure(ImageView<const std::uint16_t> frame,
                             ImageView<const std::uint8_t> busy, const NoiseModel& noise) {
  for (std::vector<float>& list : samples_) {
    list.clear();
  }
  lay_lines(frame, busy, noise, {1, 0}, kAlongColumns);
  lay_lines(frame, busy, noise, {0, 1}, kAlongRows);
  constexpr double kHalfRoot3 = std::numbers::sqrt3 / 2;
  for (const Normal normal : {Normal{0.5, kHalfRoot3}, Normal{kHalfRoot3, 0.5},
                              Normal{-0.5, kHalfRoot3}, Normal{-kHalfRoot3, 0.5}}) {
    lay_lines(frame, busy, noise, normal, kOblique);
  }
  for (const Course course : {kAlongColumns, kAlongRows, kOblique}) {
    find_variances(course);
  }
}

// Parallel lines on both sides of the middle of the frame, cut where they leave what can be
// measured. Pixels are counted from the middle, as many each way, so that a mirrored frame of even
// sides has the mirrored lines and pieces.
void ContrastSpread::lay_lines(ImageView<const std::uint16_t> frame,
                               ImageView<const std::uint8_t> busy, const NoiseModel& noise,
                               Normal normal, Course course) {
  const int margin = static_cast<int>(std::ceil(slopes_.chord_to_px)) + 1;
  const int step = course == kOblique ? tuning_.oblique_step_px : tuning_.line_step_px;
  const double middle_x = (frame.width() - 1) / 2.0;
  const double middle_y = (frame.height() - 1) / 2.0;
  const int reach = (frame.width() + frame.height()) / 2;  // of the longest line, and the last one
  for (int k = -reach / step; k < reach / step; ++k) {
    const double aside = (k + 0.5) * step;
    for (int i = -reach; i < reach; ++i) {
      const double on = i + 0.5;
      const int x = nearest(middle_x + aside * normal.x - on * normal.y);
      const int y = nearest(middle_y + aside * normal.y + on * normal.x);
      if (x >= margin && y >= margin && x < frame.width() - margin && y < frame.height() - margin &&
          busy(x, y) == 0) {
        line_.x.push_back(static_cast<float>(x));
        line_.y.push_back(static_cast<float>(y));
      } else if (!line_.x.empty()) {
        measure_line(frame, noise, normal, course, i);
      }
    }
    measure_line(frame, noise, normal, course, reach);
  }
}

// Takes the contrasts of the pieces of the line, which ends before pixel `end`, and empties it.
// Pieces begin at multiples of their length.
void ContrastSpread::measure_line(ImageView<const std::uint16_t> frame, const NoiseModel& noise,
                                  Normal normal, Course course, int end) {
  const auto edgels = static_cast<int>(line_.x.size());
  if (edgels >= static_cast<int>(kShortest)) {
    course == kOblique ? take_contrasts(frame, normal) : take_contrasts_on_axis(frame, course);
    sums_.assign(1, 0);
    for (std::size_t i = 0; i < line_.x.size(); ++i) {
      const double level = noise.map.at(static_cast<int>(line_.x[i]), static_cast<int>(line_.y[i]));
      sums_.push_back(sums_.back() + contrasts_[i] / (noise.level_counts * level));
    }
    const int begin = end - edgels;
    for (std::size_t length = 0; length < kLengths; ++length) {
      const int size = static_cast<int>(kShortest << length);
      const int from_multiple = (begin % size + size) % size;
      const int first = from_multiple == 0 ? 0 : size - from_multiple;
      for (int i = first; i + size <= edgels; i += size) {
        const double sum =
            sums_[static_cast<std::size_t>(i + size)] - sums_[static_cast<std::size_t>(i)];
        samples(course, length).push_back(static_cast<float>(std::abs(sum) / size));
      }
    }
  }
  line_.x.clear();
  line_.y.clear();
}

// Interpolating between pixels of a column or row is the same for all its points.
void ContrastSpread::take_contrasts_on_axis(ImageView<const std::uint16_t> frame, Course course) {
  const std::ptrdiff_t step = course == kAlongColumns ? 1 : frame.stride();
  contrasts_.assign(line_.x.size(), 0);
  for (std::size_t distance = 0; distance < weights_.size(); ++distance) {
    if (weights_[distance] == 0) {
      continue;
    }
    const auto away = static_cast<std::ptrdiff_t>(distance) * step;
    for (std::size_t i = 0; i < contrasts_.size(); ++i) {
      const std::uint16_t* at =
          frame.row(static_cast<int>(line_.y[i])) + static_cast<int>(line_.x[i]);
      contrasts_[i] += weights_[distance] * (at[away] - at[-away]);
    }
  }
}

void ContrastSpread::take_contrasts(ImageView<const std::uint16_t> frame, Normal normal) {
  const std::size_t edgels = line_.x.size();
  line_.nx.assign(edgels, static_cast<float>(normal.x));
  line_.ny.assign(edgels, static_cast<float>(normal.y));
  contrasts_.assign(edgels, 0);
  for_each_run({0, static_cast<std::uint32_t>(edgels)}, [&](std::size_t first, std::size_t count) {
    RunOfDoubles part;
    const auto add = [&](double weight) {
      for (std::size_t i = 0; i < count; ++i) {
        contrasts_[first + i] += weight * part[i];
      }
    };
    for (int k = 0; k < steps(); ++k) {
      differences(frame, line_, first, count, contrast_.nearest_px + k, part);
      add(1.0 / steps());
    }
    for (const double side : {1.0, -1.0}) {
      slopes_beside(frame, line_, first, count, {side, slopes_.chord_from_px, slopes_.chord_to_px},
                    part);
      add(-0.5);
    }
  });
}

// A longer length has another variance than half of it only as far as its samples are sure of it.
void ContrastSpread::find_variances(Course course) {
  auto& variances = variances_[course];
  double before = tuning_.white_variance;
  double growth = 1;
  for (std::size_t length = 0; length < kLengths; ++length) {
    std::vector<float>& list = samples(course, length);
    if (list.size() >= tuning_.fewest) {
      const auto rank =
          static_cast<std::size_t>(tuning_.quantile * static_cast<double>(list.size()));
      const double deviation = nth_value(std::span(list), rank) / tuning_.quantile_z;
      const double variance = deviation * deviation * static_cast<double>(kShortest << length);
      const double doubt =
          length > 0 ? tuning_.doubt / std::sqrt(static_cast<double>(list.size())) : 0;
      const double ratio = variance / before;
      growth = ratio > 1 + doubt   ? ratio / (1 + doubt)
               : ratio < 1 - doubt ? ratio / (1 - doubt)
                                   : 1;
    } else if (length == 0) {
      growth = 1;
    } else {
      growth = std::max(growth, 1.0);  // goes on as it did
    }
    if (length > 0) {
      growth = std::min(growth, 2.0);  // noise that is the same all along has no more
    }
    before = std::max(before * growth, tuning_.least_variance);
    variances[length] = before;
  }
}

double ContrastSpread::at(std::size_t course, double edgels) const {
  const double place =
      std::clamp(std::log2(edgels / kShortest), 0.0, static_cast<double>(kLengths - 1));
  const std::size_t below = std::min(static_cast<std::size_t>(place), kLengths - 2);
  const auto& variances = variances_[course];
  return variances[below] +
         (place - static_cast<double>(below)) * (variances[below + 1] - variances[below]);
}

// The map is smooth: beside a jump of the level it says less than there is.
double ContrastSpread::level_at(const NoiseLevelMap& map, int x, int y) const {
  if (map.is_even()) {
    return 1;
  }
  const int reach = tuning_.level_reach_px;
  const double largest =
      std::max({map.at(std::max(x - reach, 0), y), map.at(std::min(x + reach, width_ - 1), y),
                map.at(x, std::max(y - reach, 0)), map.at(x, std::min(y + reach, height_ - 1))});
  return std::max(map.at(x, y), largest / tuning_.smooth_level_growth);
}

// The edgels of each orientation as a curve of their own.
double ContrastSpread::variance(const Edgels& edgels, Range range, const NoiseLevelMap& map) const {
  std::array<double, kEdgeOrientations> counts{};
  double levels = 0;
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    counts[orientation_of(edgels.nx[i], edgels.ny[i])] += 1;
    const double level =
        level_at(map, static_cast<int>(edgels.x[i]), static_cast<int>(edgels.y[i]));
    levels += level * level;
  }
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Course course = i == 0                       ? kAlongColumns
                          : i == kEdgeOrientations / 2 ? kAlongRows
                                                       : kOblique;
    sum += counts[i] > 0 ? counts[i] * at(course, counts[i]) : 0;
  }
  const double count = range.count;
  return sum / (count * count) * levels / count;
}

}  // namespace thermedge::detail
