#include "thermedge/sequence/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "motion_pyramid.hpp"
#include "normal_equations.hpp"
#include "order_statistics.hpp"
#include "thermedge/memory.hpp"

namespace thermedge {
namespace {

using detail::MotionPyramid;

constexpr int kLevels = MotionPyramid::kLevels;
constexpr int kParameters = 9;  // eight of the homography, and the offset
constexpr int kOffset = 8;
constexpr double kSigmaOverMad = 1.4826;
using Vector = detail::Vector<kParameters>;
using Matrix = detail::LowerMatrix<kParameters>;

// A homography near the identity. A point at (u, v), in units of half the frame's longer side from
// its middle, goes to (u + d0 + d1 u + d2 v, v + d3 + d4 u + d5 v) / (1 - d6 u - d7 v), where d is
// p over half the longer side: so p is in px of the frame. p[8] is the offset, counts.
struct Warp {
  Vector p{};
};

// A point that is compared: of the last frame's picture at one size.
struct ComparedPoint {
  float x, y;    // px of the level
  float u, v;    // as in Warp
  float value;   // counts
  float gx, gy;  // gradient, counts per px of the level
};

// The coordinates of a frame and of the levels of its pyramid.
struct Geometry {
  double middle_x = 0, middle_y = 0, half = 1;  // px of the frame
  Geometry() = default;
  Geometry(int width, int height)
      : middle_x((width - 1) / 2.0),
        middle_y((height - 1) / 2.0),
        half(std::max(width, height) / 2.0) {}
  [[nodiscard]] static double px_of_level(int level) { return static_cast<double>(2 << level); }
};

// The gradient of a picture, counts per px; at its border of the pixels that there are.
struct Gradient {
  float x, y;
};
Gradient gradient_at(ImageView<const float> picture, int x, int y) {
  const int left = std::max(x - 1, 0);
  const int right = std::min(x + 1, picture.width() - 1);
  const int up = std::max(y - 1, 0);
  const int down = std::min(y + 1, picture.height() - 1);
  return {(picture(right, y) - picture(left, y)) / 2, (picture(x, down) - picture(x, up)) / 2};
}

}  // namespace

struct MotionEstimator::Impl {
  explicit Impl(const MotionTuning& chosen) : tuning(chosen) {}

  void estimate(double level_counts, double gap);
  void choose_points(int level, double level_counts);
  [[nodiscard]] Warp search_shift() const;
  [[nodiscard]] double agreement(const Warp& warp, int level, double level_counts);
  void refine(Warp& warp, int level, double level_counts);
  void note_result(const Warp& warp, double level_counts);
  void set_homography(const Warp& warp);
  [[nodiscard]] int count_offset_parts(const Warp& warp) const;
  [[nodiscard]] Warp last_motion(double gap) const;

  // The residual of a point, counts; NaN outside the picture. Without the offset.
  [[nodiscard]] float residual(const ComparedPoint& point, const Warp& warp, int level) const;
  // Standard deviation of a residual, counts.
  [[nodiscard]] double deviation(const ComparedPoint& point, double noise) const;
  [[nodiscard]] static double noise_of_residual(double level_counts) {
    constexpr double kOfDifference = 1.41421356237309505;
    return std::max(level_counts, 1e-3) * MotionPyramid::kPixelGain * kOfDifference;
  }

  MotionTuning tuning;
  MotionPyramid last, current;
  Geometry geometry;
  int width = 0, height = 0;
  std::array<std::vector<ComparedPoint>, kLevels> points;
  std::vector<float> residuals;  // of the points of a level
  std::vector<float> present;    // those that are numbers
  Motion motion;
  Warp last_warp;   // that of `motion`
  Matrix factor{};  // of the normal equations at the last step
};

MotionEstimator::MotionEstimator(const MotionTuning& tuning)
    : impl_(std::make_unique<Impl>(tuning)) {}
MotionEstimator::MotionEstimator(MotionEstimator&&) noexcept = default;
MotionEstimator& MotionEstimator::operator=(MotionEstimator&&) noexcept = default;
MotionEstimator::~MotionEstimator() = default;

const Motion& MotionEstimator::motion() const { return impl_->motion; }

void MotionEstimator::restart() {
  impl_->current.clear();
  impl_->motion = {};
}

std::size_t MotionEstimator::memory_bytes() const {
  const Impl& self = *impl_;
  return detail::memory_of(self.last, self.current, self.points[0], self.points[1], self.points[2],
                           self.residuals, self.present);
}

const Motion& MotionEstimator::update(ImageView<const std::uint16_t> counts, double level_counts,
                                      double gap) {
  constexpr int kSmallestSide = 32;
  Impl& self = *impl_;
  const bool same = counts.width() == self.width && counts.height() == self.height;
  self.width = counts.width();
  self.height = counts.height();
  if (std::min(counts.width(), counts.height()) < kSmallestSide) {
    restart();
    return self.motion;
  }
  self.geometry = Geometry(counts.width(), counts.height());
  std::swap(self.last, self.current);
  self.current.build(counts);
  if (!same || self.last.empty()) {
    self.motion = {};
  } else {
    self.estimate(level_counts, gap);
  }
  return self.motion;
}

void MotionEstimator::Impl::estimate(double level_counts, double gap) {
  for (int level = 0; level < kLevels; ++level) {
    choose_points(level, level_counts);
  }
  if (points[0].size() < tuning.fewest_points) {
    motion = {};
    return;
  }
  constexpr int kCoarsest = kLevels - 1;
  Warp best;
  double best_agreement = -1;
  for (int attempt = 0; attempt < 3; ++attempt) {
    Warp start = attempt == 0 ? last_motion(gap) : attempt == 1 ? Warp{} : search_shift();
    refine(start, kCoarsest, level_counts);
    const double agreed = agreement(start, 1, level_counts);
    if (agreed > best_agreement) {
      best = start;
      best_agreement = agreed;
    }
    if (best_agreement >= tuning.good_start) {
      break;
    }
  }
  for (int level = kCoarsest - 1; level >= 0; --level) {
    refine(best, level, level_counts);
  }
  note_result(best, level_counts);
}

// The strongest gradient of each cell, where it stands out of the noise.
void MotionEstimator::Impl::choose_points(int level, double level_counts) {
  const ImageView<const float> picture = last.level(level);
  const int cell = tuning.cell_px[static_cast<std::size_t>(level)];
  std::vector<ComparedPoint>& chosen = points[static_cast<std::size_t>(level)];
  chosen.clear();
  chosen.reserve(
      static_cast<std::size_t>((picture.width() / cell + 1) * (picture.height() / cell + 1)));
  // Coarser levels have less noise, and as much of it as level 0 is demanded.
  const double least =
      tuning.least_gradient_sigmas * MotionPyramid::kGradientGain * std::max(level_counts, 1e-3);
  const auto least_square = static_cast<float>(least * least);
  const double scale = Geometry::px_of_level(level);
  for (int top = 1; top + cell < picture.height(); top += cell) {
    for (int left = 1; left + cell < picture.width(); left += cell) {
      float best = least_square;
      ComparedPoint point{};
      for (int y = top; y < top + cell; ++y) {
        for (int x = left; x < left + cell; ++x) {
          const Gradient g = gradient_at(picture, x, y);
          const float square = g.x * g.x + g.y * g.y;
          if (square > best) {
            best = square;
            point = {static_cast<float>(x), static_cast<float>(y), 0, 0, picture(x, y), g.x, g.y};
          }
        }
      }
      if (best > least_square) {
        point.u = static_cast<float>((scale * static_cast<double>(point.x) - geometry.middle_x) /
                                     geometry.half);
        point.v = static_cast<float>((scale * static_cast<double>(point.y) - geometry.middle_y) /
                                     geometry.half);
        chosen.push_back(point);
      }
    }
  }
}

// The shift at which the smallest pictures, each less its mean, fit best.
Warp MotionEstimator::Impl::search_shift() const {
  constexpr int kLevel = kLevels - 1;
  const ImageView<const float> a = last.level(kLevel);
  const ImageView<const float> b = current.level(kLevel);
  const double scale = Geometry::px_of_level(kLevel);
  const int reach =
      std::min({static_cast<int>(tuning.search_px / scale), a.width() / 3, a.height() / 3});
  const auto mean = [](ImageView<const float> picture) {
    double sum = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        sum += static_cast<double>(picture(x, y));
      }
    }
    return sum / static_cast<double>(picture.size());
  };
  const auto offset = static_cast<float>(mean(b) - mean(a));
  float best = std::numeric_limits<float>::max();
  Warp warp;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const int top = std::max(0, -dy);
      const int bottom = std::min(a.height(), a.height() - dy);
      const int left = std::max(0, -dx);
      const int right = std::min(a.width(), a.width() - dx);
      float sum = 0;
      for (int y = top; y < bottom; ++y) {
        const float* from = a.row(y);
        const float* to = b.row(y + dy) + dx;
        for (int x = left; x < right; ++x) {
          sum += std::abs(to[x] - from[x] - offset);
        }
      }
      const float mean_difference = sum / static_cast<float>((bottom - top) * (right - left));
      if (mean_difference < best) {
        best = mean_difference;
        warp.p[0] = scale * dx;
        warp.p[3] = scale * dy;
      }
    }
  }
  warp.p[kOffset] = static_cast<double>(offset);
  return warp;
}

// Each of its parts in proportion to the time.
Warp MotionEstimator::Impl::last_motion(double gap) const {
  Warp warp = last_warp;
  warp.p[kOffset] = 0;
  for (double& p : warp.p) {
    p *= gap;
  }
  return warp;
}

float MotionEstimator::Impl::residual(const ComparedPoint& point, const Warp& warp,
                                      int level) const {
  const auto per_px = 1 / Geometry::px_of_level(level);
  const auto u = static_cast<double>(point.u);
  const auto v = static_cast<double>(point.v);
  const auto& p = warp.p;
  const double bend = p[6] * u + p[7] * v;
  const double scale = 1 / (1 - bend / geometry.half);
  const auto x = static_cast<float>(static_cast<double>(point.x) +
                                    per_px * scale * (p[0] + (p[1] + bend) * u + p[2] * v));
  const auto y = static_cast<float>(static_cast<double>(point.y) +
                                    per_px * scale * (p[3] + p[4] * u + (p[5] + bend) * v));
  const ImageView<const float> picture = current.level(level);
  if (!(x >= 0 && y >= 0 && x < static_cast<float>(picture.width() - 1) &&
        y < static_cast<float>(picture.height() - 1))) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const float across = x - static_cast<float>(left);
  const float down = y - static_cast<float>(top);
  const float* upper = picture.row(top) + left;
  const float* lower = picture.row(top + 1) + left;
  const float on_top = upper[0] + across * (upper[1] - upper[0]);
  const float below = lower[0] + across * (lower[1] - lower[0]);
  return on_top + down * (below - on_top) - point.value;
}

double MotionEstimator::Impl::deviation(const ComparedPoint& point, double noise) const {
  const double error = tuning.model_error_px *
                       std::hypot(static_cast<double>(point.gx), static_cast<double>(point.gy));
  return std::sqrt(noise * noise + error * error);
}

// The share of points of a level whose residuals are within the noise of the usual one.
double MotionEstimator::Impl::agreement(const Warp& warp, int level, double level_counts) {
  const std::vector<ComparedPoint>& compared = points[static_cast<std::size_t>(level)];
  residuals.clear();
  residuals.reserve(compared.size());
  present.clear();
  present.reserve(compared.size());
  for (const ComparedPoint& point : compared) {
    residuals.push_back(residual(point, warp, level));
    if (!std::isnan(residuals.back())) {
      present.push_back(residuals.back());
    }
  }
  if (present.size() < tuning.fewest_points) {
    return 0;
  }
  const float offset = detail::nth_value(std::span(present), present.size() / 2);
  const double noise = noise_of_residual(level_counts);
  std::size_t agreeing = 0;
  for (std::size_t i = 0; i < compared.size(); ++i) {
    const double limit = tuning.inlier_sigmas * deviation(compared[i], noise);
    // Not a number, so never within, where the point left the picture.
    agreeing += std::abs(static_cast<double>(residuals[i] - offset)) <= limit ? 1 : 0;
  }
  return static_cast<double>(agreeing) / static_cast<double>(compared.size());
}

// Steps of Gauss and Newton on the points of one level; a shift alone at the coarsest one.
void MotionEstimator::Impl::refine(Warp& warp, int level, double level_counts) {
  const std::vector<ComparedPoint>& compared = points[static_cast<std::size_t>(level)];
  const bool shift_only = level == kLevels - 1;
  const double per_px = 1 / Geometry::px_of_level(level);
  const double noise = noise_of_residual(level_counts);
  constexpr double kHundredPx = 100;
  constexpr double kTight = 1e-6;
  const double prior_sigma =
      shift_only ? kTight : tuning.bend_prior_px * geometry.half / kHundredPx;
  double scale = 1;  // by which residuals exceed what they should be, as in a scene with parallax
  for (int step = 0; step < tuning.most_steps[static_cast<std::size_t>(level)]; ++step) {
    Matrix matrix{};
    Vector right_side{};
    residuals.clear();
    for (const ComparedPoint& point : compared) {
      const float found = residual(point, warp, level);
      if (std::isnan(found)) {
        continue;
      }
      const double rest = static_cast<double>(found) - warp.p[kOffset];
      const double sigma = deviation(point, noise);
      residuals.push_back(static_cast<float>(std::abs(rest) / sigma));
      const double beyond = std::abs(rest) / (tuning.huber_sigmas * scale * sigma);
      const double weight = 1 / (sigma * sigma * std::max(beyond, 1.0));
      const auto u = static_cast<double>(point.u);
      const auto v = static_cast<double>(point.v);
      const double gx = per_px * static_cast<double>(point.gx);
      const double gy = per_px * static_cast<double>(point.gy);
      const double outward = gx * u + gy * v;
      detail::add_outer_product(
          {gx, gx * u, gx * v, gy, gy * u, gy * v, outward * u, outward * v, -1}, weight, rest,
          matrix, right_side);
    }
    if (residuals.size() < tuning.fewest_points) {
      return;
    }
    for (const std::size_t bend : {1U, 2U, 4U, 5U, 6U, 7U}) {
      matrix[bend][bend] += 1 / (prior_sigma * prior_sigma);
      right_side[bend] -= warp.p[bend] / (prior_sigma * prior_sigma);
    }
    // Where edges have one direction only, the shift along them stays as it was.
    constexpr double kRidge = 1e-6;
    for (const int shift : {0, 3, kOffset}) {
      double& diagonal = matrix[static_cast<std::size_t>(shift)][static_cast<std::size_t>(shift)];
      diagonal += kRidge * (matrix[0][0] + matrix[3][3]) + 1e-12;
    }
    if (!detail::factorise(matrix)) {
      return;
    }
    factor = matrix;
    const Vector change = detail::solve(matrix, right_side);
    double largest = 0;
    for (std::size_t i = 0; i < change.size(); ++i) {
      warp.p[i] += change[i];
      largest = i != kOffset ? std::max(largest, std::abs(change[i])) : largest;
    }
    scale = std::max(1.0, kSigmaOverMad * static_cast<double>(detail::nth_value(
                                              std::span(residuals), residuals.size() / 2)));
    if (largest < tuning.settled_px) {
      return;
    }
  }
}

// From (u, v) to pixels: both sides of the homography are moved and scaled.
void MotionEstimator::Impl::set_homography(const Warp& warp) {
  const double half = geometry.half;
  const double x0 = geometry.middle_x;
  const double y0 = geometry.middle_y;
  std::array<double, kParameters> d{};
  std::transform(warp.p.begin(), warp.p.end(), d.begin(), [=](double p) { return p / half; });
  // Numerators and denominator as functions of x - x0 and y - y0, px.
  const std::array across = {1 + d[1], d[2], half * d[0]};
  const std::array down = {d[4], 1 + d[5], half * d[3]};
  const std::array under = {-d[6] / half, -d[7] / half, 1.0};
  const auto row = [&](const std::array<double, 3>& numerator, double middle) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] = numerator[i] + middle * under[i];
    }
    sum[2] -= sum[0] * x0 + sum[1] * y0;
    return sum;
  };
  const std::array<std::array<double, 3>, 3> rows = {row(across, x0), row(down, y0), row(under, 0)};
  for (std::size_t i = 0; i < 9; ++i) {
    motion.homography[i] = rows[i / 3][i % 3] / rows[2][2];
  }
}

// All pixels of the smallest picture, in 4 x 4 parts.
int MotionEstimator::Impl::count_offset_parts(const Warp& warp) const {
  constexpr int kLevel = kLevels - 1;
  constexpr int kSide = 4;
  const ImageView<const float> picture = last.level(kLevel);
  const double scale = Geometry::px_of_level(kLevel);
  std::array<double, kSide * kSide> sums{};
  std::array<double, kSide * kSide> counts{};
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const ComparedPoint point{static_cast<float>(x),
                                static_cast<float>(y),
                                static_cast<float>((scale * x - geometry.middle_x) / geometry.half),
                                static_cast<float>((scale * y - geometry.middle_y) / geometry.half),
                                picture(x, y),
                                0,
                                0};
      const float rest = residual(point, warp, kLevel);
      if (!std::isnan(rest)) {
        const auto part = static_cast<std::size_t>(kSide * (kSide * y / picture.height()) +
                                                   kSide * x / picture.width());
        sums[part] += static_cast<double>(rest);
        ++counts[part];
      }
    }
  }
  int parts = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double half = warp.p[kOffset] / 2;
    parts += counts[i] > 0 && sums[i] / counts[i] / half >= 1 ? 1 : 0;
  }
  return parts;
}

void MotionEstimator::Impl::note_result(const Warp& warp, double level_counts) {
  motion = {};
  last_warp = {};
  motion.inliers = agreement(warp, 0, level_counts);
  motion.found = motion.inliers >= tuning.least_inliers;
  if (!motion.found) {
    return;
  }
  last_warp = warp;
  set_homography(warp);
  motion.offset_counts = warp.p[kOffset];
  Vector of_offset{};
  of_offset[kOffset] = 1;
  motion.offset_sigma_counts = std::sqrt(detail::solve(factor, of_offset)[kOffset]);
  motion.offset_parts = count_offset_parts(warp);
  // Mean over the frame of the variances of both coordinates: u^2 and v^2 have a mean of a third of
  // that at the border, u^4 and v^4 of a fifth.
  const double u2 = std::pow(geometry.middle_x / geometry.half, 2) / 3;
  const double v2 = std::pow(geometry.middle_y / geometry.half, 2) / 3;
  const double u4 = u2 * u2 * 9 / 5;
  const double v4 = v2 * v2 * 9 / 5;
  const Vector means = {1, u2, v2, 1, u2, v2, u4 + u2 * v2, v4 + u2 * v2, 0};
  double variance = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    Vector unit{};
    unit[i] = 1;
    variance += means[i] * detail::solve(factor, unit)[i];
  }
  motion.sigma_px = std::sqrt(variance / 2);
}

}  // namespace thermedge
