#include "thermedge/stages/corners.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "arm_tangent.hpp"
#include "curvature.hpp"

namespace thermedge {
namespace {

using detail::cross;
using detail::dot;
using detail::tangent;
using detail::Vector;

constexpr double kRadians = std::numbers::pi / 180;

// Curvature by sample number: that of a closed contour repeats, and beyond the ends of an open one
// there is none.
struct Curvature {
  std::span<const double> values;
  bool closed;

  [[nodiscard]] std::ptrdiff_t count() const { return static_cast<std::ptrdiff_t>(values.size()); }
  [[nodiscard]] std::ptrdiff_t wrapped(std::ptrdiff_t i) const {
    return (i % count() + count()) % count();
  }
  double operator[](std::ptrdiff_t i) const {
    if (i < 0 || i >= count()) {
      return closed ? values[static_cast<std::size_t>(wrapped(i))] : 0;
    }
    return values[static_cast<std::size_t>(i)];
  }
};

// Whether `i` is the first of the equal peaks of its hill: the samples around it down to `saddle`,
// of which none is higher. Then the last of them, not wrapped around.
std::optional<std::ptrdiff_t> last_peak_from(const Curvature& curvature, std::ptrdiff_t i,
                                             double saddle) {
  const double peak = curvature[i];
  const std::ptrdiff_t count = curvature.count();
  std::ptrdiff_t first_below = i - 1;
  while (first_below > i - count && curvature[first_below] > saddle) {
    if (curvature[first_below] >= peak) {
      return std::nullopt;
    }
    --first_below;
  }
  std::ptrdiff_t last = i;
  for (std::ptrdiff_t k = i + 1; k <= first_below + count; ++k) {
    if (curvature[k] > peak) {
      return std::nullopt;
    }
    if (curvature[k] <= saddle) {
      return last;
    }
    last = curvature[k] == peak ? k : last;
  }
  return std::nullopt;  // a closed contour without a saddle
}

// Which of two neighbours lies on the side of the larger curvature: negative the left one,
// positive the right one, 0 where both sides are mirror images.
int larger_side(const Curvature& curvature, std::ptrdiff_t left, std::ptrdiff_t right) {
  for (std::ptrdiff_t k = 0; k < curvature.count(); ++k) {
    const double on_left = curvature[left - k];
    const double on_right = curvature[right + k];
    if (on_left != on_right) {
      return on_left > on_right ? -1 : 1;
    }
  }
  return 0;
}

// How many samples besides the first lie within `distance_px` along a contour.
template <class Iterator>
std::size_t samples_within(Iterator from, Iterator end, double distance_px) {
  std::size_t samples = 0;
  double distance = 0;
  for (auto next = from + 1; next != end; ++from, ++next, ++samples) {
    distance += std::sqrt(static_cast<double>(squared_distance(*from, *next)));
    if (distance > distance_px) {
      break;
    }
  }
  return samples;
}

}  // namespace

Status CornerOptions::check() const { return check_ranges(*this, "corners."); }

void CornerSet::clear() {
  indices.clear();
  ranges.clear();
}

Status CornerFinder::run(const ContourSet& contours, CornerSet& corners) {
  corners.clear();
  if (Status status = options_.check(); !status) {
    return status;
  }
  prepare(contours, corners);
  for (const Contour& contour : contours.items) {
    const Curve curve{contours.pixels(contour), contour.closed};
    find_curvature(curve);
    find_candidates(curve);
    remove_near_ends(curve);
    remove_blunt(curve);
    append(curve, corners);
  }
  return {};
}

void CornerFinder::prepare(const ContourSet& contours, CornerSet& corners) {
  set_kernel();
  const std::size_t points = contours.points.capacity();
  padded_.reserve(points + kernel_.size());
  for (auto* values : {&x_steps_, &y_steps_, &curvature_}) {
    values->reserve(points + 1);
  }
  candidates_.reserve(points);
  sharp_.reserve(points);
  corners.indices.reserve(points);
  corners.ranges.reserve(contours.items.capacity());
}

// Sums of whole numbers are exact in any order.
void CornerFinder::set_kernel() {
  constexpr double kCentre = 16384;
  constexpr double kHalfWidthSigmas = 4;
  const double sigma = options_.sigma_px;
  const int half_width = static_cast<int>(std::ceil(kHalfWidthSigmas * sigma));
  kernel_.clear();
  kernel_sum_ = 0;
  for (int t = -half_width; t <= half_width; ++t) {
    kernel_.push_back(std::round(kCentre * std::exp(-(t * t) / (2 * sigma * sigma))));
    kernel_sum_ += kernel_.back();
  }
}

// Steps of a closed contour repeat; those of an open one are mirrored at its ends, as though the
// contour went on, reflected in its end point.
void CornerFinder::smooth_steps(const Curve& curve, std::int32_t Pixel::*coordinate,
                                std::vector<double>& smoothed) {
  const auto count = static_cast<std::ptrdiff_t>(curve.pixels.size());
  const auto margin = static_cast<std::ptrdiff_t>(kernel_.size() / 2);
  padded_.resize(static_cast<std::size_t>(count + 1 + 2 * margin));
  double* const step = padded_.data() + margin;  // step[i] leads from sample i - 1 to sample i
  const Pixel* const at = curve.pixels.data();
  for (std::ptrdiff_t i = 1; i < count; ++i) {
    step[i] = at[i].*coordinate - at[i - 1].*coordinate;
  }
  if (curve.closed) {
    step[0] = at[0].*coordinate - at[count - 1].*coordinate;
    for (std::ptrdiff_t i = 0; i <= margin; ++i) {
      step[count + i] = step[i];
    }
    for (std::ptrdiff_t i = 1; i <= margin; ++i) {
      step[-i] = step[count - i];
    }
  } else {
    for (std::ptrdiff_t i = 0; i <= margin;
         ++i) {  // in turn: on a short contour each reads the other
      step[-i] = step[i + 1];
      step[count + i] = step[count - 1 - i];
    }
  }
  smoothed.resize(static_cast<std::size_t>(count + 1));
  detail::smooth(padded_, kernel_, smoothed);
}

// Eq. 9. The first derivative at a sample is half the sum of the steps before and after it, the
// second one their difference.
void CornerFinder::find_curvature(const Curve& curve) {
  const std::size_t count = curve.pixels.size();
  curvature_.assign(count, 0.0);
  if (count < 3) {
    return;
  }
  smooth_steps(curve, &Pixel::x, x_steps_);
  smooth_steps(curve, &Pixel::y, y_steps_);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector before{x_steps_[i], y_steps_[i]};
    const Vector after{x_steps_[i + 1], y_steps_[i + 1]};
    const Vector both{before.x + after.x, before.y + after.y};
    const double square = dot(both, both);
    const double cube = square * std::sqrt(square);
    curvature_[i] = cube > 0 ? 8 * kernel_sum_ * std::abs(cross(before, after)) / cube : 0;
  }
}

// A sharp bend by the angle t between rows of pixels has the curvature 2 g tan(t/2) / cos(t/2)
// after smoothing by a Gaussian whose largest value is g.
double CornerFinder::least_curvature() const {
  const double half_turn = (180 - options_.max_angle_deg) / 2 * kRadians;
  const double largest = 1 / (options_.sigma_px * std::sqrt(2 * std::numbers::pi));
  return tuning_.least_share * 2 * largest * std::tan(half_turn) / std::cos(half_turn);
}

void CornerFinder::find_candidates(const Curve& curve) {
  candidates_.clear();
  const Curvature curvature{curvature_, curve.closed};
  const double least = least_curvature();
  for (std::ptrdiff_t i = 0; i < curvature.count(); ++i) {
    const double peak = curvature[i];
    if (peak < least || peak == 0 || curvature[i - 1] >= peak || curvature[i + 1] > peak) {
      continue;
    }
    const auto last = last_peak_from(curvature, i, tuning_.saddle_share * peak);
    if (!last) {
      continue;
    }
    const std::ptrdiff_t left = (i + *last) / 2;
    const std::ptrdiff_t right = (i + *last + 1) / 2;
    const int side = larger_side(curvature, left, right);
    candidates_.push_back(
        {static_cast<std::size_t>(curvature.wrapped(left == right || side <= 0 ? left : right)),
         static_cast<std::size_t>(curvature.wrapped(left == right || side >= 0 ? right : left))});
  }
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.first < b.first; });
}

void CornerFinder::remove_near_ends(const Curve& curve) {
  if (curve.closed) {
    return;
  }
  const auto& pixels = curve.pixels;
  const double distance_px = options_.end_distance_px;
  const std::size_t front = samples_within(pixels.begin(), pixels.end(), distance_px);
  const std::size_t back =
      pixels.size() - 1 - samples_within(pixels.rbegin(), pixels.rend(), distance_px);
  std::erase_if(candidates_, [=](const Candidate& candidate) {
    return candidate.first <= front || candidate.last >= back;
  });
}

// All at once, again and again: without its neighbour, a corner has a longer arm.
void CornerFinder::remove_blunt(const Curve& curve) {
  do {
    sharp_.clear();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const Arms arms = arms_of(curve, i);
      if (stands_out(candidates_[i], arms) && is_sharp(curve, candidates_[i], arms)) {
        sharp_.push_back(candidates_[i]);
      }
    }
    candidates_.swap(sharp_);
  } while (candidates_.size() != sharp_.size());
}

// Arms end at the neighbouring candidates and at the ends of the contour.
CornerFinder::Arms CornerFinder::arms_of(const Curve& curve, std::size_t candidate) const {
  const auto [first, last] = candidates_[candidate];
  const std::size_t count = curve.pixels.size();
  const std::size_t before = candidate == 0 ? candidates_.size() - 1 : candidate - 1;
  const std::size_t after = candidate + 1 == candidates_.size() ? 0 : candidate + 1;
  Arms arms{first, count - 1 - last};
  if (curve.closed && before == candidate) {
    arms = {(count - 1) / 2, (count - 1) / 2};
  } else if (curve.closed || before < candidate) {
    arms.before = (first + count - candidates_[before].last) % count;
  }
  if (before != candidate && (curve.closed || after > candidate)) {
    arms.after = (candidates_[after].first + count - last) % count;
  }
  const auto longest =
      static_cast<std::size_t>(std::lround(tuning_.arm_sigmas * options_.sigma_px));
  return {std::min(arms.before, longest), std::min(arms.after, longest)};
}

// Eq. 10, with the arms as the region of support.
bool CornerFinder::stands_out(const Candidate& candidate, const Arms& arms) const {
  const std::size_t count = curvature_.size();
  double before = 0;
  for (std::size_t k = 1; k <= arms.before; ++k) {
    before += curvature_[(candidate.first + count - k) % count];
  }
  double after = 0;
  for (std::size_t k = 1; k <= arms.after; ++k) {
    after += curvature_[(candidate.last + k) % count];
  }
  const double peak = curvature_[candidate.first];
  const double mean =
      (peak + (before + after)) / (1 + static_cast<double>(arms.before + arms.after));
  return peak >= options_.curvature_ratio * mean;
}

// Eq. 11.
bool CornerFinder::is_sharp(const Curve& curve, const Candidate& candidate,
                            const Arms& arms) const {
  const std::size_t count = curve.pixels.size();
  const auto offset = [&](std::size_t from, std::size_t to) {
    const Pixel a = curve.pixels[from];
    const Pixel b = curve.pixels[to % count];
    return Pixel{b.x - a.x, b.y - a.y};
  };
  const Vector before = tangent(arms.before, [&](std::size_t k) {
    return offset(candidate.first, candidate.first + count - k);
  });
  const Vector after = tangent(
      arms.after, [&](std::size_t k) { return offset(candidate.last, candidate.last + k); });
  const double cosine = std::cos(options_.max_angle_deg * kRadians);
  return dot(before, after) >= cosine * std::sqrt(dot(before, before) * dot(after, after));
}

void CornerFinder::append(const Curve& curve, CornerSet& corners) const {
  const std::size_t first = corners.indices.size();
  const auto add = [&](std::size_t i) { corners.indices.push_back(static_cast<std::uint32_t>(i)); };
  if (!curve.closed) {
    add(0);
  }
  for (const Candidate& candidate : candidates_) {
    add(candidate.first);
    if (candidate.last != candidate.first) {
      add(candidate.last);
    }
  }
  if (!curve.closed && curve.pixels.size() > 1) {
    add(curve.pixels.size() - 1);
  }
  // Two samples of one corner can lie on both sides of the seam.
  std::sort(corners.indices.begin() + static_cast<std::ptrdiff_t>(first), corners.indices.end());
  corners.ranges.push_back({static_cast<std::uint32_t>(first),
                            static_cast<std::uint32_t>(corners.indices.size() - first)});
}

}  // namespace thermedge
