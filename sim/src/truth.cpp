#include <algorithm>
#include <cmath>
#include <optional>

#include "render.hpp"

namespace thermedge::sim {
namespace {

constexpr double kSpacingPx = 0.5;
constexpr std::size_t kLeastPoints = 4;

// The outline with points at most kSpacingPx apart.
Outline resampled(const Outline& outline) {
  Outline result;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point a = outline[i];
    const Point b = outline[(i + 1) % outline.size()];
    const double length = std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    const int parts = std::max(1, static_cast<int>(std::ceil(length / kSpacingPx)));
    for (int k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      result.push_back({a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t});
    }
  }
  return result;
}

// Step across the outline of `object` at p, where it is seen; nothing where it is hidden, outside
// the frame, or too small.
class StepMeter {
 public:
  StepMeter(const Scene& scene, int width, int height, double least_step_counts)
      : scene_(scene), width_(width), height_(height), least_step_counts_(least_step_counts) {}

  std::optional<double> operator()(std::size_t object, Point p) const {
    if (p.x < 0 || p.y < 0 || p.x > width_ - 1 || p.y > height_ - 1 || scene_.hidden(object, p)) {
      return std::nullopt;
    }
    const int below = scene_.topmost_below(object, p);
    const double outside =
        below < 0 ? scene_.background_at(p) : scene_.object_at(static_cast<std::size_t>(below), p);
    const double step = std::abs(scene_.object_at(object, p) - outside);
    return step >= least_step_counts_ ? std::optional(step) : std::nullopt;
  }

 private:
  const Scene& scene_;
  int width_;
  int height_;
  double least_step_counts_;
};

// Collects visible runs of one outline as edges.
class RunCollector {
 public:
  RunCollector(int object, std::vector<TrueEdge>& edges) : object_(object), edges_(edges) {}
  void add(Point p, double step) {
    points_.push_back(p);
    sum_ += step;
  }
  void finish(bool closed) {
    if (points_.size() >= kLeastPoints) {
      edges_.push_back({std::move(points_), closed, 0, object_});
      edges_.back().contrast_counts = sum_ / static_cast<double>(edges_.back().points.size());
    }
    points_.clear();
    sum_ = 0;
  }

 private:
  int object_;
  std::vector<TrueEdge>& edges_;
  std::vector<Point> points_;
  double sum_ = 0;
};

}  // namespace

std::vector<TrueEdge> true_edges(const Scene& scene, int width, int height,
                                 double least_step_counts) {
  const StepMeter step_at(scene, width, height, least_step_counts);
  std::vector<TrueEdge> edges;
  for (std::size_t object = 0; object < scene.objects().size(); ++object) {
    const Outline outline = resampled(scene.objects()[object].outline);
    std::vector<std::optional<double>> steps;
    for (const Point p : outline) {
      steps.push_back(step_at(object, p));
    }
    // Start behind a gap, so that no run is cut by the start of the outline.
    const auto gap = std::find(steps.begin(), steps.end(), std::nullopt);
    const auto start = gap == steps.end() ? 0 : static_cast<std::size_t>(gap - steps.begin());
    RunCollector run(scene.objects()[object].id, edges);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const std::size_t i = (start + k) % outline.size();
      if (steps[i]) {
        run.add(outline[i], *steps[i]);
      } else {
        run.finish(false);
      }
    }
    run.finish(gap == steps.end());
  }
  return edges;
}

}  // namespace thermedge::sim
