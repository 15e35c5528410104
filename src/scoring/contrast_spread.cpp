#include "contrast_spread.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
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

// Pixels of a line, counted from its middle.
struct Span {
  // Leaves out most of those at which `start` + (i + 0.5) * step is no place of a row of `length`
  // pixels, and none other.
  void clip(double start, double step, int length) {
    const double first = -start;
    const double last = length - 1 - start;
    if (step == 0) {
      end = first <= 0.5 && last >= -0.5 ? end : begin;
      return;
    }
    const auto [low, high] = std::minmax({first / step, last / step});
    const auto within = [&](double at) { return std::clamp(at, -1.0 * kFar, 1.0 * kFar); };
    begin = std::max(begin, static_cast<int>(std::floor(within(low))) - kSpare);
    end = std::max(begin, std::min(end, static_cast<int>(std::ceil(within(high))) + kSpare));
  }

  static constexpr int kFar = 1 << 20;
  static constexpr int kSpare = 3;  // for rounding, and a pixel outside behind the last one inside
  int begin = 0;
  int end = 0;
};

}  // namespace

constexpr double kHalfRoot3 = std::numbers::sqrt3 / 2;
const std::array<ContrastSpread::Direction, 6> ContrastSpread::kDirections = {
    {{{1, 0}, kAlongColumns},
     {{0, 1}, kAlongRows},
     {{0.5, kHalfRoot3}, kOblique},
     {{kHalfRoot3, 0.5}, kOblique},
     {{-0.5, kHalfRoot3}, kOblique},
     {{-kHalfRoot3, 0.5}, kOblique}}};

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

int ContrastSpread::step_of_lines(Course course) const {
  return course == kOblique ? tuning_.oblique_step_px : tuning_.line_step_px;
}

std::size_t ContrastSpread::Lines::memory_bytes() const {
  std::size_t sum = memory_of(line.x, line.y, line.nx, line.ny, contrasts, sums);
  for (const std::vector<float>& list : samples) {
    sum += memory_of(list);
  }
  return sum;
}

void ContrastSpread::prepare(int width, int height) {
  width_ = width;
  height_ = height;
  const int reach = (width + height) / 2;
  const auto longest = static_cast<std::size_t>(2 * reach + 1);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Course course = kDirections[i].course;
    lines_[i].line.reserve(longest);
    lines_[i].contrasts.reserve(longest);
    lines_[i].sums.reserve(longest + 1);
    // The samples of all oblique lines come together in the first list.
    const int directions = i == kOblique ? static_cast<int>(kDirections.size()) - kOblique : 1;
    const auto lines =
        static_cast<std::size_t>(directions * (2 * (reach / step_of_lines(course)) + 1));
    for (std::size_t length = 0; length < kLengths; ++length) {
      lines_[i].samples[length].reserve(lines * longest / (kShortest << length));
    }
  }
}

void ContrastSpread::measure(ImageView<const std::uint16_t> frame,
                             ImageView<const std::uint8_t> busy, const NoiseModel& noise,
                             ParallelRunner& runner) {
  runner.run(static_cast<int>(kDirections.size()), [&](int task) {
    const auto i = static_cast<std::size_t>(task);
    for (std::vector<float>& list : lines_[i].samples) {
      list.clear();
    }
    lay_lines({frame, busy, noise}, kDirections[i], lines_[i]);
  });
  for (std::size_t i = kOblique + 1; i < lines_.size(); ++i) {
    for (std::size_t length = 0; length < kLengths; ++length) {
      const std::vector<float>& list = lines_[i].samples[length];
      std::copy(list.begin(), list.end(), std::back_inserter(lines_[kOblique].samples[length]));
    }
  }
  for (const Course course : {kAlongColumns, kAlongRows, kOblique}) {
    find_variances(course);
  }
}

// Parallel lines on both sides of the middle of the frame, cut where they leave what can be
// measured. Pixels are counted from the middle, as many each way, so that a mirrored frame of even
// sides has the mirrored lines and pieces.
void ContrastSpread::lay_lines(const Frame& frame, const Direction& direction, Lines& lines) const {
  const int width = frame.counts.width();
  const int height = frame.counts.height();
  const Normal normal = direction.normal;
  const int margin = static_cast<int>(std::ceil(slopes_.chord_to_px)) + 1;
  const int step = step_of_lines(direction.course);
  const double middle_x = (width - 1) / 2.0;
  const double middle_y = (height - 1) / 2.0;
  const int reach = (width + height) / 2;  // of the longest line, and the last one
  for (int k = -reach / step; k < reach / step; ++k) {
    const double aside = (k + 0.5) * step;
    const double x0 = middle_x + aside * normal.x;
    const double y0 = middle_y + aside * normal.y;
    // Where it may be in the frame; beyond, it is not looked at.
    Span on_line{-reach, reach};
    on_line.clip(x0, -normal.y, width);
    on_line.clip(y0, normal.x, height);
    for (int i = on_line.begin; i < on_line.end; ++i) {
      const double on = i + 0.5;
      const int x = nearest(x0 - on * normal.y);
      const int y = nearest(y0 + on * normal.x);
      if (x >= margin && y >= margin && x < width - margin && y < height - margin &&
          frame.busy(x, y) == 0) {
        lines.line.x.push_back(static_cast<float>(x));
        lines.line.y.push_back(static_cast<float>(y));
      } else if (!lines.line.x.empty()) {
        measure_line(frame, direction, i, lines);
      }
    }
    measure_line(frame, direction, on_line.end, lines);
  }
}

// Takes the contrasts of the pieces of the line, which ends before pixel `end`, and empties it.
// Pieces begin at multiples of their length.
void ContrastSpread::measure_line(const Frame& frame, const Direction& direction, int end,
                                  Lines& lines) const {
  const Edgels& line = lines.line;
  const auto edgels = static_cast<int>(line.x.size());
  if (edgels >= static_cast<int>(kShortest)) {
    if (direction.course == kOblique) {
      take_contrasts(frame, direction.normal, lines);
    } else {
      take_contrasts_on_axis(frame, direction.course, lines);
    }
    std::vector<double>& sums = lines.sums;
    sums.assign(1, 0);
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      const double level =
          frame.noise.map.at(static_cast<int>(line.x[i]), static_cast<int>(line.y[i]));
      sums.push_back(sums.back() + lines.contrasts[i] / (frame.noise.level_counts * level));
    }
    const int begin = end - edgels;
    for (std::size_t length = 0; length < kLengths; ++length) {
      const int size = static_cast<int>(kShortest << length);
      const int from_multiple = (begin % size + size) % size;
      const int first = from_multiple == 0 ? 0 : size - from_multiple;
      for (int i = first; i + size <= edgels; i += size) {
        const double sum =
            sums[static_cast<std::size_t>(i + size)] - sums[static_cast<std::size_t>(i)];
        lines.samples[length].push_back(static_cast<float>(std::abs(sum) / size));
      }
    }
  }
  lines.line.x.clear();
  lines.line.y.clear();
}

// Interpolating between pixels of a column or row is the same for all its points.
void ContrastSpread::take_contrasts_on_axis(const Frame& frame, Course course, Lines& lines) const {
  const Edgels& line = lines.line;
  const std::ptrdiff_t step = course == kAlongColumns ? 1 : frame.counts.stride();
  lines.contrasts.assign(line.x.size(), 0);
  for (std::size_t distance = 0; distance < weights_.size(); ++distance) {
    if (weights_[distance] == 0) {
      continue;
    }
    const auto away = static_cast<std::ptrdiff_t>(distance) * step;
    for (std::size_t i = 0; i < lines.contrasts.size(); ++i) {
      const std::uint16_t* at =
          frame.counts.row(static_cast<int>(line.y[i])) + static_cast<int>(line.x[i]);
      lines.contrasts[i] += weights_[distance] * (at[away] - at[-away]);
    }
  }
}

void ContrastSpread::take_contrasts(const Frame& frame, Normal normal, Lines& lines) const {
  Edgels& line = lines.line;
  const std::size_t edgels = line.x.size();
  line.nx.assign(edgels, static_cast<float>(normal.x));
  line.ny.assign(edgels, static_cast<float>(normal.y));
  lines.contrasts.assign(edgels, 0);
  for_each_run({0, static_cast<std::uint32_t>(edgels)}, [&](std::size_t first, std::size_t count) {
    RunOfDoubles part;
    const auto add = [&](double weight) {
      for (std::size_t i = 0; i < count; ++i) {
        lines.contrasts[first + i] += weight * part[i];
      }
    };
    for (int k = 0; k < steps(); ++k) {
      differences(frame.counts, line, first, count, contrast_.nearest_px + k, part);
      add(1.0 / steps());
    }
    for (const double side : {1.0, -1.0}) {
      slopes_beside(frame.counts, line, first, count,
                    {side, slopes_.chord_from_px, slopes_.chord_to_px}, part);
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
    std::vector<float>& list = lines_[course].samples[length];
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
