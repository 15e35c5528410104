#include "thermedge/stages/corners_paper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corner_angle.hpp"
#include "curvature.hpp"

namespace thermedge {
namespace {

constexpr std::int32_t kNone = -1;

// One more than the largest y.
std::size_t count_rows(const std::vector<Pixel>& points) {
  std::int32_t rows = 0;
  for (const Pixel point : points) {
    rows = std::max(rows, point.y + 1);
  }
  return static_cast<std::size_t>(rows);
}

// How many steps from `from` towards `to` the first smallest value lies. NaN is larger than any.
std::size_t steps_to_minimum(const std::vector<double>& values, std::size_t from, std::size_t to) {
  const bool forward = to >= from;
  const std::size_t count = forward ? to - from : from - to;
  std::size_t best = 0;
  double smallest = values[from];
  for (std::size_t i = 1; i <= count; ++i) {
    const double value = forward ? values[from + i] : values[from - i];
    if (value < smallest || (std::isnan(smallest) && !std::isnan(value))) {
      smallest = value;
      best = i;
    }
  }
  return best;
}

double mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

}  // namespace

Status PaperCornerOptions::check() const { return check_ranges(*this, "corners."); }

// Algorithm 4.
Status PaperCornerFinder::run(const ContourSet& contours, CornerSet& corners) {
  corners.clear();
  if (Status status = options_.check(); !status) {
    return status;
  }
  prepare(contours, corners);
  find_curvature_corners(contours);
  add_end_points(contours, corners);
  return {};
}

void PaperCornerFinder::prepare(const ContourSet& contours, CornerSet& corners) {
  detail::gaussian_kernel(options_.sigma_px, kernel_);
  const std::size_t points = contours.points.capacity();
  const std::size_t samples = points + kernel_.size();
  padded_.reserve(points + 2 * kernel_.size());
  for (auto* values : {&rows_, &columns_, &curvature_}) {
    values->reserve(samples);
  }
  for (auto* places : {&extrema_, &candidates_, &sharp_}) {
    places->reserve(samples);
  }
  found_.reserve(points);
  found_.clear();
  last_in_row_.reserve(points);
  last_in_row_.assign(count_rows(contours.points), kNone);
  inner_.clear();
  for (CornerSet* set : {&inner_, &corners}) {
    set->indices.reserve(points);
    set->ranges.reserve(contours.items.capacity());
  }
}

void PaperCornerFinder::find_curvature_corners(const ContourSet& contours) {
  const std::size_t margin = kernel_.size() / 2;
  for (const Contour& contour : contours.items) {
    const auto pixels = contours.pixels(contour);
    const auto first = static_cast<std::uint32_t>(inner_.indices.size());
    if (pixels.size() > margin) {
      smooth_curve(pixels, contour.closed);
      detail::rounded_curvature(rows_, columns_, curvature_);
      find_extrema();
      find_candidates();
      remove_wide_angles();
      for (const std::size_t sample : candidates_) {
        if (sample >= margin && sample - margin < pixels.size()) {
          inner_.indices.push_back(static_cast<std::uint32_t>(sample - margin));
          remember(pixels[sample - margin]);
        }
      }
    }
    inner_.ranges.push_back({first, static_cast<std::uint32_t>(inner_.indices.size()) - first});
  }
}

// Margins: the other end of a closed curve, the curve reflected at its end otherwise. The public
// code counts pixels from 1 and convolves in full, as though zeros followed: the margins bend
// towards its origin, and they stay part of the curve.
void PaperCornerFinder::smooth_curve(std::span<const Pixel> pixels, bool closed) {
  const std::size_t margin = kernel_.size() / 2;
  const std::size_t count = pixels.size();
  const auto smooth_coordinate = [&](std::int32_t Pixel::*coordinate,
                                     std::vector<double>& smoothed) {
    const auto value = [&](std::size_t i) { return 1.0 + pixels[i].*coordinate; };
    padded_.assign(count + 4 * margin, 0.0);
    double* before = padded_.data() + margin;
    double* inside = before + margin;
    double* behind = inside + count;
    for (std::size_t i = 0; i < count; ++i) {
      inside[i] = value(i);
    }
    for (std::size_t i = 0; i < margin; ++i) {
      before[i] = closed ? value(count - margin + i) : 2 * value(0) - value(margin - i);
      behind[i] = closed ? value(i) : 2 * value(count - 1) - value(count - 2 - i);
    }
    smoothed.resize(count + 2 * margin);
    detail::smooth(padded_, kernel_, smoothed);
  };
  smooth_coordinate(&Pixel::y, rows_);
  smooth_coordinate(&Pixel::x, columns_);
  curvature_.resize(rows_.size());
}

// The last sample of a plateau counts as the extremum.
void PaperCornerFinder::find_extrema() {
  extrema_.clear();
  bool rising = true;  // what ends the search for a minimum
  for (std::size_t i = 0; i + 1 < curvature_.size(); ++i) {
    const double step = curvature_[i + 1] - curvature_[i];
    if (rising ? step > 0 : step < 0) {
      extrema_.push_back(i);
      rising = !rising;
    }
  }
  if (extrema_.size() % 2 == 0) {
    extrema_.push_back(curvature_.size() - 1);
  }
}

// Maxima that stand out of their region of support, which runs to the nearest smallest curvature on
// both sides (eq. 10). A maximum next to NaN stays: the comparison with it is false.
void PaperCornerFinder::find_candidates() {
  candidates_.clear();
  for (std::size_t i = 1; i + 1 < extrema_.size(); i += 2) {
    const std::size_t at = extrema_[i];
    const std::size_t left = at - steps_to_minimum(curvature_, at, extrema_[i - 1]);
    const std::size_t right = at + steps_to_minimum(curvature_, at, extrema_[i + 1]);
    const double threshold =
        options_.curvature_ratio * mean(std::span(curvature_).subspan(left, right - left + 1));
    if (!(curvature_[at] < threshold)) {
      candidates_.push_back(at);
    }
  }
}

// Eq. 11, again and again: without its neighbour, a corner's arm is longer and its angle another.
void PaperCornerFinder::remove_wide_angles() {
  const double widest = options_.max_angle_deg;
  std::size_t before = 0;
  do {
    before = candidates_.size();
    sharp_.clear();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const std::size_t first = i > 0 ? candidates_[i - 1] : 0;
      const std::size_t last = i + 1 < candidates_.size() ? candidates_[i + 1] : rows_.size() - 1;
      const double angle = detail::corner_angle_deg(
          std::span(rows_).subspan(first, last - first + 1),
          std::span(columns_).subspan(first, last - first + 1), candidates_[i] - first);
      if (!(angle > widest && angle < 360 - widest)) {
        sharp_.push_back(candidates_[i]);
      }
    }
    candidates_.swap(sharp_);
  } while (candidates_.size() != before);
}

void PaperCornerFinder::add_end_points(const ContourSet& contours, CornerSet& corners) {
  const auto add_if_far = [&](Pixel end, std::size_t index) {
    if (is_far_from_corners(end)) {
      remember(end);
      corners.indices.push_back(static_cast<std::uint32_t>(index));
    }
  };
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    const auto pixels = contours.pixels(contours.items[i]);
    const bool has_ends = options_.end_points && !contours.items[i].closed;
    const auto first = static_cast<std::uint32_t>(corners.indices.size());
    if (has_ends) {
      add_if_far(pixels.front(), 0);
    }
    for (const std::uint32_t index : slice(std::as_const(inner_.indices), inner_.ranges[i])) {
      corners.indices.push_back(index);
    }
    if (has_ends) {
      add_if_far(pixels.back(), pixels.size() - 1);
    }
    corners.ranges.push_back({first, static_cast<std::uint32_t>(corners.indices.size()) - first});
  }
}

void PaperCornerFinder::remember(Pixel corner) {
  found_.push_back({corner, last_in_row_[corner.y]});
  last_in_row_[corner.y] = static_cast<std::int32_t>(found_.size()) - 1;
}

// A frame without any corner gets none: the fault of the public code.
bool PaperCornerFinder::is_far_from_corners(Pixel end) const {
  const double distance_px = options_.end_distance_px;
  const auto reach = static_cast<std::int32_t>(distance_px);
  const auto rows = static_cast<std::int32_t>(last_in_row_.size());
  for (std::int32_t row = std::max(end.y - reach, 0); row <= std::min(end.y + reach, rows - 1);
       ++row) {
    for (std::int32_t i = last_in_row_[row]; i != kNone; i = found_[i].next) {
      if (static_cast<double>(squared_distance(found_[i].at, end)) <= distance_px * distance_px) {
        return false;
      }
    }
  }
  return !found_.empty();
}

}  // namespace thermedge
