#include "edgel_contrast.hpp"

#include <limits>
#include <numbers>
#include <optional>

namespace thermedge::detail {
namespace {

struct Vector {
  double x = 0;
  double y = 0;
};

// Points of one edge as a curve that goes on beyond its ends: closed ones wrap, open ones are
// reflected at their end point, so that the end keeps its direction.
class Curve {
 public:
  Curve(const Edgels& edgels, const Edge& edge)
      : x_(edgels.x.data() + edge.edgels.first),
        y_(edgels.y.data() + edge.edgels.first),
        count_(edge.edgels.count),
        closed_(edge.closed) {}

  [[nodiscard]] Vector at(std::ptrdiff_t index) const {
    const std::ptrdiff_t last = count_ - 1;
    if (closed_) {
      return point((index % count_ + count_) % count_);
    }
    if (index < 0) {
      return reflected(0, std::min(-index, last));
    }
    if (index > last) {
      return reflected(last, std::max(2 * last - index, std::ptrdiff_t{0}));
    }
    return point(index);
  }

  // As tangents has it.
  [[nodiscard]] Vector tangent(std::ptrdiff_t index) const {
    Vector tangent;
    for (int k = 1; k <= kTangentReach; ++k) {
      const Vector ahead = at(index + k);
      const Vector behind = at(index - k);
      tangent.x += kTangentWeights[k - 1] * (ahead.x - behind.x);
      tangent.y += kTangentWeights[k - 1] * (ahead.y - behind.y);
    }
    return tangent;
  }

 private:
  [[nodiscard]] Vector point(std::ptrdiff_t index) const { return {x_[index], y_[index]}; }
  [[nodiscard]] Vector reflected(std::ptrdiff_t end, std::ptrdiff_t index) const {
    const Vector centre = point(end);
    const Vector other = point(index);
    return {2 * centre.x - other.x, 2 * centre.y - other.y};
  }

  const float* x_;
  const float* y_;
  std::ptrdiff_t count_;
  bool closed_;
};

// Unit normal, to the right of the walking direction.
void set_normal(Vector tangent, std::size_t i, Edgels& edgels) {
  const double length = std::sqrt(tangent.x * tangent.x + tangent.y * tangent.y);
  edgels.nx[i] = length > 0 ? static_cast<float>(-tangent.y / length) : 1;
  edgels.ny[i] = length > 0 ? static_cast<float>(tangent.x / length) : 0;
}

// Bilinear; nothing outside the frame.
std::optional<double> sample(ImageView<const std::uint16_t> frame, Vector at) {
  const int last_x = frame.width() - 1;
  const int last_y = frame.height() - 1;
  if (!(at.x >= 0 && at.y >= 0 && at.x <= last_x && at.y <= last_y)) {
    return std::nullopt;
  }
  const int x = static_cast<int>(at.x);
  const int y = static_cast<int>(at.y);
  const std::uint16_t* row = frame.row(y) + x;
  const std::uint16_t* below = y < last_y ? row + frame.stride() : row;
  const int right = x < last_x ? 1 : 0;
  const double fx = at.x - x;
  const double fy = at.y - y;
  const double upper = row[0] + fx * (row[right] - row[0]);
  const double lower = below[0] + fx * (below[right] - below[0]);
  return upper + fy * (lower - upper);
}

// Counts `distance` px ahead along the normal of an edgel less those as far behind it; NaN where
// one lies outside the frame.
double difference(ImageView<const std::uint16_t> frame, const Edgels& edgels, std::size_t i,
                  double distance) {
  const Vector step{distance * edgels.nx[i], distance * edgels.ny[i]};
  const auto ahead = sample(frame, {edgels.x[i] + step.x, edgels.y[i] + step.y});
  const auto behind = sample(frame, {edgels.x[i] - step.x, edgels.y[i] - step.y});
  return ahead && behind ? *ahead - *behind : std::numeric_limits<double>::quiet_NaN();
}

// What the blur of the optics takes off a contrast is put back up to this factor: so much is
// missing behind a blur of 1.1 px. What a slope adds farther out is more.
constexpr double kMostBlurred = 1.06;

// Standard deviation of a position in whole pixels, found on a slope in noise.
double position_sigma(double sigma_counts, double slope) {
  constexpr double kOfWholePixels = 1.0 / 12;
  if (!(sigma_counts > 0)) {
    return std::sqrt(kOfWholePixels);
  }
  const double shift = sigma_counts / std::max(slope, sigma_counts / std::numbers::sqrt2);
  return std::sqrt(kOfWholePixels + shift * shift);
}

}  // namespace

void set_normals(Edgels& edgels, const Edge& edge) {
  constexpr std::uint32_t kReach = kTangentReach;
  const auto [first, count] = edge.edgels;
  const bool is_long = count > 2 * kReach;
  const Curve curve(edgels, edge);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!is_long || i < kReach || i >= count - kReach) {
      set_normal(curve.tangent(i), first + i, edgels);
    } else {
      i = count - kReach - 1;  // the middle follows
    }
  }
  if (!is_long) {
    return;
  }
  for_each_run({first + kReach, count - 2 * kReach}, [&](std::size_t begin, std::size_t run) {
    RunOfDoubles along_x;
    RunOfDoubles along_y;
    tangents(&edgels.x[begin], static_cast<int>(run), along_x.data());
    tangents(&edgels.y[begin], static_cast<int>(run), along_y.data());
    for (std::size_t i = 0; i < run; ++i) {
      set_normal({along_x[i], along_y[i]}, begin + i, edgels);
    }
  });
}

void differences(ImageView<const std::uint16_t> frame, const Edgels& edgels, std::size_t first,
                 std::size_t count, double distance, RunOfDoubles& out) {
  differences_across(frame,
                     {&edgels.x[first], &edgels.y[first], &edgels.nx[first], &edgels.ny[first],
                      static_cast<int>(count)},
                     distance, out.data());
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(out[i])) {  // next to the border, or outside
      out[i] = difference(frame, edgels, first + i, distance);
    }
  }
}

void slopes_beside(ImageView<const std::uint16_t> frame, const Edgels& edgels, std::size_t first,
                   std::size_t count, const Beside& where, RunOfDoubles& out) {
  const double middle = where.side * (where.from_px + where.to_px) / 2;
  const double half = (where.to_px - where.from_px) / 2;
  std::array<float, kMostEdgels> x;
  std::array<float, kMostEdgels> y;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = first + i;
    x[i] = static_cast<float>(edgels.x[at] + middle * edgels.nx[at]);
    y[i] = static_cast<float>(edgels.y[at] + middle * edgels.ny[at]);
  }
  const EdgelRun run{x.data(), y.data(), &edgels.nx[first], &edgels.ny[first],
                     static_cast<int>(count)};
  differences_across(frame, run, half, out.data());
  const double scale = kContrastPx / (2 * half);
  std::transform(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count), out.begin(),
                 [=](double difference) { return scale * difference; });
}

void contrasts_across(ImageView<const std::uint16_t> frame, const Edgels& edgels, std::size_t first,
                      std::size_t count, const ContrastTuning& tuning, RunOfContrasts& out) {
  const auto per_edgel =
      std::min(static_cast<std::size_t>(tuning.farthest_px - tuning.nearest_px) + 1,
               ContrastTuning::kMostSteps);
  out.sums.fill(0);
  out.samples.fill(0);
  for (std::size_t k = 0; k < per_edgel; ++k) {
    RunOfDoubles step;
    differences(frame, edgels, first, count, tuning.nearest_px + static_cast<double>(k), step);
    if (k == 0) {
      out.nearest = step;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const bool seen = !std::isnan(step[i]);
      out.sums[i] += seen ? step[i] : 0;
      out.samples[i] += seen ? 1 : 0;
    }
  }
}

Contrast contrast_across(ImageView<const std::uint16_t> frame, const Edgels& edgels, Range range,
                         const ContrastTuning& tuning) {
  double sum = 0;
  int samples = 0;
  double beyond_sum = 0;
  int seen = 0;
  for_each_run(range, [&](std::size_t first, std::size_t count) {
    RunOfContrasts part;
    contrasts_across(frame, edgels, first, count, tuning, part);
    for (std::size_t i = 0; i < count; ++i) {
      sum += part.sums[i];
      samples += part.samples[i];
      if (part.samples[i] > 0) {
        beyond_sum += part.mean_beyond_flank(i);
        ++seen;
      }
    }
  });
  return {samples > 0 ? sum / samples : 0, samples, seen > 0 ? beyond_sum / seen : 0};
}

void flip_normals(Edgels& edgels, Range range) {
  for (std::size_t i = range.first; i < range.first + range.count; ++i) {
    edgels.nx[i] = -edgels.nx[i];
    edgels.ny[i] = -edgels.ny[i];
  }
}

void measure_edgels(ImageView<const std::uint16_t> frame, double sigma_counts, Range range,
                    Edgels& edgels) {
  for_each_run(range, [&](std::size_t first, std::size_t count) {
    RunOfDoubles steps;
    differences(frame, edgels, first, count, 1, steps);
    for (std::size_t i = 0; i < count; ++i) {
      const double slope = std::isnan(steps[i]) ? 0 : std::abs(steps[i]) / 2;
      edgels.magnitude_counts[first + i] = static_cast<float>(slope);
      edgels.position_sigma_px[first + i] = static_cast<float>(position_sigma(sigma_counts, slope));
    }
  });
}

void take_contrast(ImageView<const std::uint16_t> frame, double sigma_counts, Edgels& edgels,
                   Edge& edge, Contrast& contrast) {
  if (contrast.counts < 0) {
    flip_normals(edgels, edge.edgels);
    contrast.counts = -contrast.counts;
    contrast.beyond_flank = -contrast.beyond_flank;
  }
  measure_edgels(frame, sigma_counts, edge.edgels, edgels);
  edge.contrast_counts =
      std::clamp(contrast.beyond_flank, contrast.counts, kMostBlurred * contrast.counts);
}

double in_sigmas(double contrast_counts, double sigma_counts) {
  if (contrast_counts == 0) {
    return 0;
  }
  return sigma_counts > 0 ? contrast_counts / sigma_counts
                          : std::numeric_limits<double>::infinity();
}

double z_of(const Contrast& contrast, double sigma_counts) {
  return in_sigmas(contrast.counts, sigma_counts * std::sqrt(2.0 / contrast.samples));
}

// Far out, where the probability itself would underflow,
// by the asymptotic series erfc(x) = exp(-x^2) / (x sqrt(pi)) (1 - 1/(2 x^2) + 3/(4 x^4) - ...).
double log10_tail(double z) {
  const double x = z / std::numbers::sqrt2;
  if (x < 10) {
    return std::log10(std::erfc(x) / 2);
  }
  const double inverse = 1 / (2 * x * x);
  const double series = 1 - inverse * (1 - 3 * inverse * (1 - 5 * inverse));
  return std::log10(series * std::numbers::inv_sqrtpi / (2 * x)) - x * x * std::numbers::log10e;
}

}  // namespace thermedge::detail
