#include "thermedge/stages/subpixel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace thermedge {
namespace {

constexpr double kLeastResponse = 1e-6;  // so that logarithms and quotients are finite
constexpr std::size_t kEdgelsPerTask = 512;
constexpr std::size_t kEdgesPerTask = 16;
constexpr double kHalfPixel = 0.499;  // less than half, so that rounding finds the same pixel

int tasks_for(std::size_t number, std::size_t per_task) {
  return static_cast<int>((number + per_task - 1) / per_task);
}

// Least-squares quadratic through 3 x 3 values: its derivatives at the middle one.
struct Facet {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

// Logarithms of the 3 x 3 values around a pixel. From edgel to edgel of an edge most of them are
// the same.
class LogWindow {
 public:
  explicit LogWindow(ImageView<const float> values) : values_(values) {}

  // The pixel is none of the border.
  void move_to(int x, int y) {
    const int dx = x - x_;
    const int dy = y - y_;
    x_ = x;
    y_ = y;
    const bool overlaps = std::abs(dx) <= 2 && std::abs(dy) <= 2;
    const Logs before = logs_;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        const bool known = overlaps && i + dx >= 0 && i + dx < 3 && j + dy >= 0 && j + dy < 3;
        logs_[j][i] = known ? before[j + dy][i + dx] : log_at(x + i - 1, y + j - 1);
      }
    }
  }

  [[nodiscard]] Facet facet() const {
    const auto column = [&](int i) { return logs_[0][i] + logs_[1][i] + logs_[2][i]; };
    const auto row = [&](int j) { return logs_[j][0] + logs_[j][1] + logs_[j][2]; };
    return {(column(2) - column(0)) / 6, (row(2) - row(0)) / 6,
            (column(2) - 2 * column(1) + column(0)) / 3,
            (logs_[2][2] - logs_[2][0] - logs_[0][2] + logs_[0][0]) / 4,
            (row(2) - 2 * row(1) + row(0)) / 3};
  }

 private:
  using Logs = std::array<std::array<double, 3>, 3>;

  [[nodiscard]] double log_at(int x, int y) const {
    return std::log(std::max(static_cast<double>(values_(x, y)), kLeastResponse));
  }

  ImageView<const float> values_;
  int x_ = -8;  // nowhere near
  int y_ = -8;
  Logs logs_{};
};

// To the ridge, within the pixel.
void move_to_ridge(ImageView<const float> response, double sigma_times_strength,
                   double least_sigma_px, LogWindow& window, Edgels& edgels, std::size_t i) {
  const int x = static_cast<int>(edgels.x[i] + 0.5F);  // not negative
  const int y = static_cast<int>(edgels.y[i] + 0.5F);
  if (x < 1 || y < 1 || x >= response.width() - 1 || y >= response.height() - 1) {
    return;
  }
  window.move_to(x, y);
  const Facet facet = window.facet();
  const double nx = edgels.nx[i];
  const double ny = edgels.ny[i];
  const double slope = facet.x * nx + facet.y * ny;
  const double curvature = facet.xx * nx * nx + 2 * facet.xy * nx * ny + facet.yy * ny * ny;
  if (curvature < 0) {
    const double limit = kHalfPixel / std::max(std::abs(nx), std::abs(ny));
    const double shift = std::clamp(-slope / curvature, -limit, limit);
    edgels.x[i] = static_cast<float>(x + shift * nx);
    edgels.y[i] = static_cast<float>(y + shift * ny);
  }
  edgels.position_sigma_px[i] = static_cast<float>(
      std::max(sigma_times_strength / std::max(static_cast<double>(response(x, y)), kLeastResponse),
               least_sigma_px));
}

constexpr std::size_t kReach = SubpixelTuning::kCurvatureReach;

// The edgels of one edge as they were before the first was moved.
class PreviousPositions {
 public:
  struct Point {
    double x, y;
  };

  PreviousPositions(const Edgels& edgels, const Edge& edge)
      : edgels_(edgels), first_(edge.edgels.first), count_(edge.edgels.count) {
    for (std::size_t k = 0; k < kReach; ++k) {
      begin_[k] = now(k);
    }
  }
  // Called with 0, 1, 2 ... in turn, before the edgel is moved.
  void remember(std::size_t i) { last_[i % kReach] = now(i); }
  [[nodiscard]] Point ahead(std::size_t i) const {  // of edgel i + kReach
    return i + kReach < count_ ? now(i + kReach) : begin_[i + kReach - count_];
  }
  [[nodiscard]] Point behind(std::size_t i) const {  // before remember(i)
    return i >= kReach ? last_[i % kReach] : now(i + count_ - kReach);
  }
  [[nodiscard]] Point now(std::size_t i) const {
    return {edgels_.x[first_ + i], edgels_.y[first_ + i]};
  }

 private:
  const Edgels& edgels_;
  std::size_t first_;
  std::size_t count_;
  std::array<Point, kReach> begin_{};
  std::array<Point, kReach> last_{};
};

// Outwards, by half the variance of the kernel over the radius.
void compensate_curvature_bias(double along_px, double bias_share, const Edge& edge,
                               Edgels& edgels) {
  const std::size_t count = edge.edgels.count;
  if (count <= 2 * kReach) {
    return;
  }
  PreviousPositions previous_positions(edgels, edge);
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_both = edge.closed || (i >= kReach && i + kReach < count);
    const PreviousPositions::Point here = previous_positions.now(i);
    const PreviousPositions::Point behind = has_both ? previous_positions.behind(i) : here;
    const PreviousPositions::Point ahead = has_both ? previous_positions.ahead(i) : here;
    previous_positions.remember(i);
    const double chord_x = ahead.x - behind.x;
    const double chord_y = ahead.y - behind.y;
    const double squared_half = (chord_x * chord_x + chord_y * chord_y) / 4;
    if (!has_both || !(squared_half > 1)) {
      continue;
    }
    const std::size_t at = edge.edgels.first + i;
    const double nx = edgels.nx[at];
    const double ny = edgels.ny[at];
    const double sagitta =
        ((ahead.x + behind.x) / 2 - here.x) * nx + ((ahead.y + behind.y) / 2 - here.y) * ny;
    const double inwards = bias_share * along_px * along_px * 2 * sagitta / squared_half;
    const double limit = kHalfPixel / std::max(std::abs(nx), std::abs(ny));
    const double shift = std::clamp(inwards, -limit, limit);
    const double x = std::floor(here.x + 0.5);
    const double y = std::floor(here.y + 0.5);
    edgels.x[at] =
        static_cast<float>(std::clamp(here.x - shift * nx, x - kHalfPixel, x + kHalfPixel));
    edgels.y[at] =
        static_cast<float>(std::clamp(here.y - shift * ny, y - kHalfPixel, y + kHalfPixel));
  }
}

}  // namespace

void refine_positions(ImageView<const float> response, KernelSize kernel, double noise,
                      EdgeSet& edges, ParallelRunner& runner, const SubpixelTuning& tuning) {
  const double measured_area_px =
      tuning.measured_kernel.across_px * tuning.measured_kernel.along_px;
  const double sigma_times_strength =
      tuning.sigma_times_response * noise *
      std::sqrt(kernel.across_px * kernel.along_px / measured_area_px);
  const std::size_t edgels = edges.edgels.size();
  runner.run(tasks_for(edgels, kEdgelsPerTask), [&](int task) {
    LogWindow window(response);
    const std::size_t first = static_cast<std::size_t>(task) * kEdgelsPerTask;
    for (std::size_t i = first; i < std::min(first + kEdgelsPerTask, edgels); ++i) {
      move_to_ridge(response, sigma_times_strength, tuning.least_sigma_px, window, edges.edgels, i);
    }
  });
  runner.run(tasks_for(edges.edges.size(), kEdgesPerTask), [&](int task) {
    const std::size_t first = static_cast<std::size_t>(task) * kEdgesPerTask;
    for (std::size_t i = first; i < std::min(first + kEdgesPerTask, edges.edges.size()); ++i) {
      compensate_curvature_bias(kernel.along_px, tuning.curvature_bias_share, edges.edges[i],
                                edges.edgels);
    }
  });
}

}  // namespace thermedge
