#include "intersections.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace thermedge::sim {
namespace {

// Nearer than this, things touch and don't pierce.
constexpr double kTouchM = 1e-6;

// From the plane of `plane` to a ball's centre, along the normal.
double height_over(const Facet& plane, Vec3 p) { return dot(plane.normal, p - plane.centre); }

// The part of the line p + t d, between two values of t, that lies on the facet.
struct Interval {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

// Cut by |a + t b| <= 1.
void cut_strip(double a, double b, Interval& interval) {
  if (std::abs(b) < 1e-12) {
    if (std::abs(a) > 1) {
      interval.to = interval.from;
    }
    return;
  }
  const double first = (-1 - a) / b;
  const double second = (1 - a) / b;
  interval.from = std::max(interval.from, std::min(first, second));
  interval.to = std::min(interval.to, std::max(first, second));
}

void cut_facet(const Facet& facet, Vec3 p, Vec3 d, Interval& interval) {
  const Vec3 q = p - facet.centre;
  if (facet.kind == Facet::Kind::kQuad) {
    cut_strip(dot(facet.dual_u, q), dot(facet.dual_u, d), interval);
    cut_strip(dot(facet.dual_v, q), dot(facet.dual_v, d), interval);
    return;
  }
  const double b = dot(q, d);
  const double square = b * b - dot(q, q) + facet.radius * facet.radius;
  const double root = std::sqrt(std::max(square, 0.0));
  interval.from = std::max(interval.from, -b - root);
  interval.to = std::min(interval.to, -b + root);
}

// Whether the facet lies on both sides of a plane.
bool straddles(const Facet& facet, const Facet& plane) {
  const double middle = height_over(plane, facet.centre);
  const double scale = facet.kind == Facet::Kind::kDisc ? facet.radius : 1;
  const double u = scale * dot(plane.normal, facet.u);
  const double v = scale * dot(plane.normal, facet.v);
  const double reach =
      facet.kind == Facet::Kind::kDisc ? std::sqrt(u * u + v * v) : std::abs(u) + std::abs(v);
  return std::abs(middle) < reach - kTouchM;
}

std::optional<SpaceCurve> flat_with_flat(const Facet& a, const Facet& b) {
  const Vec3 along = cross(a.normal, b.normal);
  if (norm(along) < 1e-9 || !straddles(a, b) || !straddles(b, a)) {
    return std::nullopt;
  }
  // The point on both planes that is nearest to a's centre.
  const double height = height_over(b, a.centre);
  const Vec3 down = b.normal - a.normal * dot(a.normal, b.normal);
  const Vec3 p = a.centre - down * (height / dot(down, down));
  const Vec3 d = unit(along);
  Interval interval;
  cut_facet(a, p, d, interval);
  cut_facet(b, p, d, interval);
  if (!(interval.to - interval.from > kTouchM)) {
    return std::nullopt;
  }
  return SpaceCurve{false, p + d * interval.from, d * (interval.to - interval.from), {}};
}

SpaceCurve circle(Vec3 centre, Vec3 axis, double radius) {
  const Vec3 u = perpendicular(axis) * radius;
  return {true, centre, u, cross(axis, u)};
}

std::optional<SpaceCurve> flat_with_ball(const Facet& flat, const Facet& ball) {
  const double height = height_over(flat, ball.centre);
  if (std::abs(height) > ball.radius - kTouchM) {
    return std::nullopt;
  }
  return circle(ball.centre - flat.normal * height, flat.normal,
                std::sqrt(ball.radius * ball.radius - height * height));
}

// An ellipse; where the plane runs along the axis there are two lines, which are left to users.
std::optional<SpaceCurve> flat_with_tube(const Facet& flat, const Facet& tube) {
  const double cosine = dot(flat.normal, tube.normal);
  const double height = height_over(flat, tube.centre);
  const double reach = std::abs(cosine) * tube.half_length +
                       tube.radius * std::sqrt(std::max(0.0, 1 - cosine * cosine));
  if (std::abs(cosine) < 1e-3 || std::abs(height) > reach - kTouchM) {
    return std::nullopt;
  }
  const Vec3 centre = tube.centre - tube.normal * (height / cosine);
  const Vec3 level = cross(tube.normal, flat.normal);
  if (norm(level) < 1e-9) {
    return circle(centre, flat.normal, tube.radius);
  }
  const Vec3 minor = unit(level) * tube.radius;
  const Vec3 major = cross(flat.normal, unit(level)) * (tube.radius / cosine);
  return SpaceCurve{true, centre, minor, major};
}

std::optional<SpaceCurve> ball_with_ball(const Facet& a, const Facet& b) {
  const Vec3 way = b.centre - a.centre;
  const double distance = norm(way);
  if (distance > a.radius + b.radius - kTouchM ||
      distance < std::abs(a.radius - b.radius) + kTouchM) {
    return std::nullopt;
  }
  const double along =
      (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
  const Vec3 axis = way * (1 / distance);
  return circle(a.centre + axis * along, axis,
                std::sqrt(std::max(0.0, a.radius * a.radius - along * along)));
}

// The circle on the side of the tube's middle; where the ball lies within the tube's length, on
// both sides of the ball.
void add_ball_with_tube(const Facet& ball, const Facet& tube, const auto& add) {
  const Vec3 way = ball.centre - tube.centre;
  const double along = dot(way, tube.normal);
  const bool on_axis = norm(way - tube.normal * along) < kTouchM;
  if (!on_axis || tube.radius > ball.radius + kTouchM) {
    return;
  }
  const double reach =
      std::sqrt(std::max(0.0, ball.radius * ball.radius - tube.radius * tube.radius));
  for (const double at : {along - reach, along + reach}) {
    if (std::abs(at) <= tube.half_length + kTouchM) {
      add(circle(tube.centre + tube.normal * at, tube.normal, tube.radius));
    }
    if (reach < kTouchM) {
      return;  // both are one
    }
  }
}

// Calls `add(curve)` for what two facets have in common.
void cut(const Facet& a, const Facet& b, const auto& add) {
  using Kind = Facet::Kind;
  std::optional<SpaceCurve> curve;
  if (a.is_flat() && b.is_flat()) {
    curve = flat_with_flat(a, b);
  } else if (a.is_flat() && b.kind == Kind::kBall) {
    curve = flat_with_ball(a, b);
  } else if (a.is_flat() && b.kind == Kind::kTube) {
    curve = flat_with_tube(a, b);
  } else if (a.kind == Kind::kBall && b.kind == Kind::kBall) {
    curve = ball_with_ball(a, b);
  } else if (a.kind == Kind::kBall && b.kind == Kind::kTube) {
    add_ball_with_tube(a, b, add);
  }
  if (curve) {
    add(*curve);
  }
}

double reach_of(const Facet& facet) {
  switch (facet.kind) {
    case Facet::Kind::kQuad:
      return norm(facet.u) + norm(facet.v);
    case Facet::Kind::kTube:
      return facet.radius + facet.half_length;
    default:
      return facet.radius;
  }
}

}  // namespace

void add_intersections(Facets& world) {
  const std::vector<Facet>& facets = world.facets;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (std::size_t j = 0; j < facets.size(); ++j) {
      const Facet& a = facets[i];
      const Facet& b = facets[j];
      // Pairs of one kind come once; others in the order that cut() knows.
      const bool alike = a.kind == b.kind || (a.is_flat() && b.is_flat());
      // A tube and its own round ends meet in a seam; else objects don't cut themselves.
      const bool seam =
          a.object == b.object && a.kind == Facet::Kind::kBall && b.kind == Facet::Kind::kTube;
      // Cuts that come and go would give the edges behind them other numbers.
      const bool apart = a.object != b.object && (a.moves || b.moves);
      if (i == j || (alike && j < i) || (a.object == b.object && !seam) || apart ||
          norm(a.centre - b.centre) > reach_of(a) + reach_of(b)) {
        continue;
      }
      cut(a, b, [&](const SpaceCurve& curve) {
        EdgeCurve edge;
        edge.curve = curve;
        edge.owners[0] = static_cast<int>(i);
        edge.owners[1] = static_cast<int>(j);
        world.curves.push_back(edge);
      });
    }
  }
}

}  // namespace thermedge::sim
