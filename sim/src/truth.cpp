#include "truth.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace thermedge::sim {
namespace {

constexpr double kSpacingPx = 0.5;
constexpr double kBesidePx = 0.01;  // how far beside the edge its sides are looked at
constexpr std::size_t kLeastPoints = 4;
constexpr double kNearestM = 0.02;

struct CurvePoint {
  double t;
  Point pixel;
};

// The image of a curve of space, and which part of it can be seen at all.
class Projector {
 public:
  explicit Projector(const RayCaster& ray_caster) : ray_caster_(ray_caster) {}

  // In the camera's axes.
  [[nodiscard]] Vec3 seen(const SpaceCurve& curve, double t) const {
    const Vec3 p = curve.at(t) - ray_caster_.eye();
    return {dot(p, ray_caster_.axes().right), dot(p, ray_caster_.axes().down),
            dot(p, ray_caster_.axes().forward)};
  }

  // Nothing outside of what the lens reaches.
  [[nodiscard]] std::optional<Point> pixel(Vec3 p) const {
    const Point reach = ray_caster_.lens().reach();
    if (p.z < kNearestM || std::abs(p.x) > reach.x * p.z || std::abs(p.y) > reach.y * p.z) {
      return std::nullopt;
    }
    return ray_caster_.lens().pixel({p.x / p.z, p.y / p.z});
  }

  // The part of a straight line that may show: cut at the five planes that bound the view.
  [[nodiscard]] bool clip(const SpaceCurve& line, double& from, double& to) const {
    const Vec3 a = seen(line, 0);
    const Vec3 b = seen(line, 1);
    const Point reach = ray_caster_.lens().reach();
    const auto distances = [&](Vec3 p) {
      return std::array{p.z - kNearestM, reach.x * p.z - p.x, reach.x * p.z + p.x,
                        reach.y * p.z - p.y, reach.y * p.z + p.y};
    };
    const auto at_a = distances(a);
    const auto at_b = distances(b);
    from = 0;
    to = 1;
    for (std::size_t i = 0; i < at_a.size(); ++i) {
      if (at_a[i] < 0 && at_b[i] < 0) {
        return false;
      }
      // A little inside, so that rounding doesn't put the end outside.
      const double cut = at_a[i] / (at_a[i] - at_b[i]);
      if (at_a[i] < 0) {
        from = std::max(from, cut + 1e-9);
      } else if (at_b[i] < 0) {
        to = std::min(to, cut - 1e-9);
      }
    }
    return from < to;
  }

 private:
  const RayCaster& ray_caster_;
};

double distance(Point a, Point b) {
  return std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
}

// Points of a curve at most kSpacingPx apart, in runs that don't leave the view.
class Tracer {
 public:
  Tracer(const RayCaster& ray_caster, const SpaceCurve& curve)
      : projector_(ray_caster), curve_(curve), intrinsics_(ray_caster.lens().intrinsics()) {}

  std::vector<std::vector<CurvePoint>> run() {
    double from = 0;
    double to = 1;
    if (!curve_.closed && !projector_.clip(curve_, from, to)) {
      return {};
    }
    // Ellipses begin as pieces that are straight enough for halving to see where they go.
    const int pieces = curve_.closed ? 32 : 1;
    std::optional<CurvePoint> last = at(from);
    add(last);
    for (int i = 1; i <= pieces; ++i) {
      const std::optional<CurvePoint> next = at(from + (to - from) * i / pieces);
      subdivide(last, next, kMostHalvings);
      add(next);
      last = next;
    }
    join_ends();
    return std::move(runs_);
  }

 private:
  static constexpr int kMostHalvings = 16;

  // A run over the point where an ellipse begins and ends is one.
  void join_ends() {
    if (curve_.closed && runs_.size() > 1 && runs_.front().front().t == 0 &&
        runs_.back().back().t == 1) {
      std::vector<CurvePoint>& last = runs_.back();
      last.insert(last.end(), runs_.front().begin() + 1, runs_.front().end());
      runs_.front() = std::move(last);
      runs_.pop_back();
    }
  }

  [[nodiscard]] std::optional<CurvePoint> at(double t) const {
    const auto pixel = projector_.pixel(projector_.seen(curve_, t));
    return pixel ? std::optional(CurvePoint{t, *pixel}) : std::nullopt;
  }

  // Whether both lie beyond the same side of the picture, and the curve between them too: neither
  // distortion nor a thirty-second part of an ellipse bends it back by a quarter of its length.
  [[nodiscard]] bool outside(Point a, Point b) const {
    const double margin = 2 + distance(a, b) / 4;
    const double right = intrinsics_.width - 1 + margin;
    const double bottom = intrinsics_.height - 1 + margin;
    return (a.x < -margin && b.x < -margin) || (a.y < -margin && b.y < -margin) ||
           (a.x > right && b.x > right) || (a.y > bottom && b.y > bottom);
  }

  void subdivide(const std::optional<CurvePoint>& a, const std::optional<CurvePoint>& b,
                 int halvings) {
    if (!a || !b || halvings == 0 || distance(a->pixel, b->pixel) <= kSpacingPx ||
        outside(a->pixel, b->pixel)) {
      return;
    }
    const std::optional<CurvePoint> middle = at((a->t + b->t) / 2);
    subdivide(a, middle, halvings - 1);
    add(middle);
    subdivide(middle, b, halvings - 1);
  }

  void add(const std::optional<CurvePoint>& point) {
    const bool inside = point && point->pixel.x >= 0 && point->pixel.y >= 0 &&
                        point->pixel.x <= intrinsics_.width - 1 &&
                        point->pixel.y <= intrinsics_.height - 1;
    if (inside && (!open_ || runs_.empty())) {
      runs_.emplace_back();
    }
    if (inside) {
      runs_.back().push_back(*point);
    }
    open_ = inside;
  }

  Projector projector_;
  const SpaceCurve& curve_;
  const Intrinsics& intrinsics_;
  std::vector<std::vector<CurvePoint>> runs_;
  bool open_ = false;
};

struct Step {
  double counts;
  EdgeKind kind;
};

// Measures the step at a point of an edge from the surfaces on its two sides.
class StepMeter {
 public:
  StepMeter(const RayCaster& ray_caster, double least_counts, double vignetting)
      : ray_caster_(ray_caster), least_counts_(least_counts), vignetting_(vignetting) {}

  // Nothing where the edge is hidden or its step too small. `along`: the curve's direction there.
  [[nodiscard]] std::optional<Step> operator()(const EdgeCurve& edge, Point p, Point along) const {
    const double length = std::sqrt(along.x * along.x + along.y * along.y);
    if (!(length > 0)) {
      return std::nullopt;
    }
    const Point normal{-along.y / length, along.x / length};
    const Point left_ray = beside(p, normal, -kBesidePx);
    const Point right_ray = beside(p, normal, kBesidePx);
    const auto among = ray_caster_.facets_near(p);
    const Hit left = ray_caster_.cast(left_ray, among);
    const Hit right = ray_caster_.cast(right_ray, among);
    if (left.same_surface(right) || (!owns(edge, left) && !owns(edge, right)) ||
        (edge.patch && left.facet != right.facet)) {
      return std::nullopt;
    }
    const double counts =
        ray_caster_.lens().light(p, vignetting_) *
        std::abs(ray_caster_.counts(left_ray, left) - ray_caster_.counts(right_ray, right));
    if (!(counts >= least_counts_)) {
      return std::nullopt;
    }
    if (left.facet == right.facet) {
      return Step{counts, EdgeKind::kMaterial};
    }
    // Two faces that the curve bounds meet there; of others, the depths tell.
    const bool meet = (owns(edge, left) && owns(edge, right)) ||
                      touch(depth_at_edge(left, p, normal, -kBesidePx),
                            depth_at_edge(right, p, normal, kBesidePx));
    return Step{counts, meet ? EdgeKind::kCrease : EdgeKind::kOccluding};
  }

 private:
  static bool owns(const EdgeCurve& edge, const Hit& hit) {
    return hit.facet >= 0 && (hit.facet == edge.owners[0] || hit.facet == edge.owners[1]);
  }

  [[nodiscard]] Point beside(Point p, Point normal, double distance) const {
    return ray_caster_.lens().ray({p.x + normal.x * distance, p.y + normal.y * distance});
  }

  // The depth that a face has at the edge itself, from two points beside it: faces that are seen at
  // a flat angle are much nearer or farther there already. 0: the sky.
  [[nodiscard]] double depth_at_edge(const Hit& near, Point p, Point normal,
                                     double distance) const {
    const Hit far = ray_caster_.cast(beside(p, normal, 2 * distance), ray_caster_.facets_near(p));
    return far.facet == near.facet ? 2 * near.depth - far.depth : near.depth;
  }

  static bool touch(double a, double b) {
    constexpr double kTouching = 1e-3;  // of the depth
    return a > 0 && b > 0 && std::abs(a - b) <= kTouching * std::min(a, b);
  }

  const RayCaster& ray_caster_;
  double least_counts_;
  double vignetting_;
};

// Collects the visible points of one curve into edges.
class Collector {
 public:
  Collector(int id, int object, std::vector<TrueEdge>& edges) : edges_(edges) {
    edge_.id = id;
    edge_.object = object;
  }
  void add(Point p, const Step& step) {
    if (!edge_.points.empty() && step.kind != edge_.kind) {
      finish(false);
    }
    edge_.kind = step.kind;
    edge_.points.push_back(p);
    sum_ += step.counts;
  }
  [[nodiscard]] std::size_t points() const { return edge_.points.size(); }
  void finish(bool closed) {
    if (edge_.points.size() >= kLeastPoints) {
      edges_.push_back(edge_);
      edges_.back().closed = closed;
      edges_.back().contrast_counts = sum_ / static_cast<double>(edge_.points.size());
    }
    edge_.points.clear();
    sum_ = 0;
  }

 private:
  std::vector<TrueEdge>& edges_;
  TrueEdge edge_;
  double sum_ = 0;
};

Point difference(Point a, Point b) { return {b.x - a.x, b.y - a.y}; }

std::vector<std::optional<Step>> steps_of(const std::vector<CurvePoint>& run, const EdgeCurve& edge,
                                          const StepMeter& step_at) {
  std::vector<std::optional<Step>> steps(run.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Point before = run[i == 0 ? 0 : i - 1].pixel;
    const Point behind = run[std::min(i + 1, run.size() - 1)].pixel;
    steps[i] = step_at(edge, run[i].pixel, difference(before, behind));
  }
  return steps;
}

void trace(const RayCaster& ray_caster, int id, const StepMeter& step_at,
           std::vector<TrueEdge>& edges) {
  const EdgeCurve& edge = ray_caster.world().curves[static_cast<std::size_t>(id)];
  const auto& facets = ray_caster.world().facets;
  SpaceCurve curve;
  const bool faces = facets[static_cast<std::size_t>(edge.owners[0])].faces(ray_caster.eye()) ||
                     facets[static_cast<std::size_t>(edge.owners[1])].faces(ray_caster.eye());
  if (!faces || !resolve(edge, facets, ray_caster.eye(), curve)) {
    return;
  }
  Collector collector(id, facets[static_cast<std::size_t>(edge.owners[0])].object, edges);
  for (std::vector<CurvePoint>& run : Tracer(ray_caster, curve).run()) {
    // A whole ellipse ends where it begins; the point is not repeated, and the run starts after a
    // gap, so that no edge is cut where the ellipse happens to begin.
    const bool whole = curve.closed && run.front().t == 0 && run.back().t == 1;
    if (whole) {
      run.pop_back();
    }
    const auto steps = steps_of(run, edge, step_at);
    const auto gap = std::find(steps.begin(), steps.end(), std::nullopt);
    const bool everywhere = gap == steps.end();
    const std::size_t start =
        whole && !everywhere ? static_cast<std::size_t>(gap - steps.begin()) : 0;
    for (std::size_t k = 0; k < run.size(); ++k) {
      const std::size_t i = (start + k) % run.size();
      if (steps[i]) {
        collector.add(run[i].pixel, *steps[i]);
      } else {
        collector.finish(false);
      }
    }
    collector.finish(whole && everywhere && collector.points() == run.size());
  }
}

}  // namespace

std::vector<TrueEdge> true_edges(const RayCaster& ray_caster, double least_contrast_counts,
                                 double vignetting, ParallelRunner& runner) {
  const StepMeter step_at(ray_caster, least_contrast_counts, vignetting);
  const std::size_t count = ray_caster.world().curves.size();
  std::vector<std::vector<TrueEdge>> found(count);
  runner.run(static_cast<int>(count),
             [&](int id) { trace(ray_caster, id, step_at, found[static_cast<std::size_t>(id)]); });
  std::vector<TrueEdge> edges;
  for (std::vector<TrueEdge>& some : found) {
    std::move(some.begin(), some.end(), std::back_inserter(edges));
  }
  return edges;
}

}  // namespace thermedge::sim
