#include "facets.hpp"

#include <algorithm>

#include "intersections.hpp"
#include "portable.hpp"
#include "random.hpp"

namespace thermedge::sim {
namespace {

// Value noise in -1..1: random numbers at whole coordinates, smooth between.
double value_noise(double x, double y) {
  static const Random kSpots(7, 7);
  const double x0 = std::floor(x);
  const double y0 = std::floor(y);
  const auto at = [&](double i, double j) {
    const auto column = static_cast<std::int64_t>(x0 + i);
    const auto row = static_cast<std::int64_t>(y0 + j);
    return kSpots.uniform(static_cast<std::uint64_t>(column * 1000003 + row), -1, 1);
  };
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double s = smooth(x - x0);
  const double t = smooth(y - y0);
  const double upper = at(0, 0) + (at(1, 0) - at(0, 0)) * s;
  const double lower = at(0, 1) + (at(1, 1) - at(0, 1)) * s;
  return upper + (lower - upper) * t;
}

class Builder {
 public:
  explicit Builder(Facets& result) : result_(result) {}

  void object(const Object& object) {
    moves_ = object.moves();
    std::visit([&](const auto& shape) { add(shape); }, object.shape);
    ++object_;
  }

 private:
  int add_facet(Facet facet) {
    facet.object = object_;
    facet.moves = moves_;
    result_.facets.push_back(std::move(facet));
    return static_cast<int>(result_.facets.size()) - 1;
  }

  void add_curve(const SpaceCurve& curve, int first, int second, bool patch = false) {
    EdgeCurve edge;
    edge.curve = curve;
    edge.patch = patch;
    edge.owners[0] = first;
    edge.owners[1] = second;
    result_.curves.push_back(edge);
  }

  // `u` and `v` are half sides.
  int add_quad(Vec3 centre, Vec3 u, Vec3 v, const Surface& surface,
               const std::vector<Patch>& patches) {
    Facet facet;
    facet.centre = centre;
    facet.anchor = centre;
    facet.u = u;
    facet.v = v;
    facet.normal = unit(cross(u, v));
    const Vec3 across_v = cross(v, facet.normal);
    const Vec3 across_u = cross(facet.normal, u);
    facet.dual_u = across_v * (1 / dot(across_v, u));
    facet.dual_v = across_u * (1 / dot(across_u, v));
    // Oblique quads have oblique coordinates, along their sides.
    facet.across = facet.dual_u * norm(u);
    facet.along = facet.dual_v * norm(v);
    facet.surface = surface;
    for (const Patch& patch : patches) {
      const SinCos turn = sin_cos(patch.turn_rad);
      facet.patches.push_back({patch.shape == Patch::Shape::kEllipse, patch.right_m, patch.up_m,
                               patch.width_m / 2, patch.height_m / 2, turn.cos, turn.sin,
                               patch.surface});
    }
    const int index = add_facet(facet);
    for (const FlatPatch& patch : facet.patches) {
      add_outline(patch, facet, index);
    }
    return index;
  }

  void add_outline(const FlatPatch& patch, const Facet& facet, int index) {
    const Vec3 right = unit(facet.u);
    const Vec3 up = unit(facet.v);
    const Vec3 centre = facet.centre + right * patch.right + up * patch.up;
    const Vec3 e1 = (right * patch.cosine + up * patch.sine) * patch.half_width;
    const Vec3 e2 = (up * patch.cosine - right * patch.sine) * patch.half_height;
    if (patch.ellipse) {
      add_curve({true, centre, e1, e2}, index, index, true);
      return;
    }
    add_curve({false, centre - e1 - e2, e1 * 2, {}}, index, index, true);
    add_curve({false, centre + e1 - e2, e2 * 2, {}}, index, index, true);
    add_curve({false, centre + e1 + e2, e1 * -2, {}}, index, index, true);
    add_curve({false, centre - e1 + e2, e2 * -2, {}}, index, index, true);
  }

  void add(const Quad& quad) {
    const Vec3 u = quad.u * 0.5;
    const Vec3 v = quad.v * 0.5;
    const int index = add_quad(quad.corner + u + v, u, v, quad.surface, quad.patches);
    const Vec3 corners[] = {quad.corner, quad.corner + quad.u, quad.corner + quad.u + quad.v,
                            quad.corner + quad.v};
    for (int i = 0; i < 4; ++i) {
      add_curve({false, corners[i], corners[(i + 1) % 4] - corners[i], {}}, index, index);
    }
  }

  void add(const Box& box) {
    const SinCos yaw = sin_cos(box.yaw_rad);
    const SinCos pitch = sin_cos(box.pitch_rad);
    const auto turned = [&](Vec3 p) {
      const Vec3 q{p.x, p.y * pitch.cos + p.z * pitch.sin, p.z * pitch.cos - p.y * pitch.sin};
      return Vec3{q.x * yaw.cos - q.y * yaw.sin, q.x * yaw.sin + q.y * yaw.cos, q.z};
    };
    const Vec3 x = turned({box.size.x / 2, 0, 0});
    const Vec3 y = turned({0, box.size.y / 2, 0});
    const Vec3 z = turned({0, 0, box.size.z / 2});
    // Outward direction, right and up of each side, in the order of Side.
    const Vec3 sides[kSides][3] = {{-y, x, z}, {y, -x, z}, {-x, -y, z},
                                   {x, y, z},  {z, x, y},  {-z, x, -y}};
    int faces[kSides];
    for (int i = 0; i < kSides; ++i) {
      const auto side = static_cast<std::size_t>(i);
      const auto& [out, right, up] = sides[i];
      faces[i] = add_quad(box.centre + out, box.inside ? -right : right, up, box.surfaces[side],
                          box.patches[side]);
      Facet& facet = result_.facets[static_cast<std::size_t>(faces[i])];
      facet.one_sided = true;
      facet.anchor = box.centre;
    }
    // Each pair of sides that are not opposite meets in one edge.
    for (int i = 0; i < kSides; ++i) {
      for (int j = (i / 2 + 1) * 2; j < kSides; ++j) {
        const int third = 3 - i / 2 - j / 2;
        const Vec3 along = sides[2 * third][0];
        const Vec3 middle = box.centre + sides[i][0] + sides[j][0];
        add_curve({false, middle - along, along * 2, {}}, faces[i], faces[j]);
      }
    }
  }

  int add_ball(Vec3 centre, double radius, const Surface& surface) {
    Facet facet;
    facet.kind = Facet::Kind::kBall;
    facet.centre = centre;
    facet.anchor = centre;
    facet.radius = radius;
    facet.surface = surface;
    const int index = add_facet(facet);
    add_curve({}, index, index);
    result_.curves.back().kind = EdgeCurve::Kind::kBallOutline;
    return index;
  }

  void add(const Sphere& sphere) { add_ball(sphere.centre, sphere.radius, sphere.surface); }

  int add_disc(Vec3 centre, Vec3 normal, double radius, const Surface& surface, Vec3 anchor) {
    Facet facet;
    facet.kind = Facet::Kind::kDisc;
    facet.one_sided = true;
    facet.centre = centre;
    facet.anchor = anchor;
    facet.normal = normal;
    facet.u = perpendicular(normal);
    facet.v = cross(normal, facet.u);
    facet.dual_u = facet.u * (1 / radius);
    facet.dual_v = facet.v * (1 / radius);
    facet.radius = radius;
    facet.surface = surface;
    return add_facet(facet);
  }

  void add(const Cylinder& cylinder) {
    Facet tube;
    tube.kind = Facet::Kind::kTube;
    tube.centre = (cylinder.from + cylinder.to) * 0.5;
    tube.anchor = tube.centre;
    tube.normal = unit(cylinder.to - cylinder.from);
    tube.radius = cylinder.radius;
    tube.half_length = norm(cylinder.to - cylinder.from) / 2;
    tube.surface = cylinder.surface;
    const int side = add_facet(tube);
    for (const double sign : {-1.0, 1.0}) {
      add_curve({}, side, side);
      result_.curves.back().kind = EdgeCurve::Kind::kTubeOutline;
      result_.curves.back().sign = sign;
    }
    for (const std::size_t end : {0U, 1U}) {
      const Vec3 centre = end == 0 ? cylinder.from : cylinder.to;
      if (cylinder.round) {
        add_ball(centre, cylinder.radius, cylinder.ends[end]);
        result_.facets.back().anchor = tube.centre;
        continue;
      }
      const int disc = add_disc(centre, end == 0 ? -tube.normal : tube.normal, cylinder.radius,
                                cylinder.ends[end], tube.centre);
      const Facet& facet = result_.facets.back();
      add_curve({true, centre, facet.u * facet.radius, facet.v * facet.radius}, side, disc);
    }
  }

  Facets& result_;
  int object_ = 0;
  bool moves_ = false;
};

}  // namespace

int Facet::patch_at(Vec3 p) const {
  if (patches.empty()) {
    return -1;
  }
  const Vec3 q = p - centre;
  const double x = dot(across, q);
  const double y = dot(along, q);
  for (std::size_t i = patches.size(); i-- > 0;) {
    if (patches[i].holds(x, y)) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

double Facet::temperature_at(Vec3 p, int patch) const {
  const Surface& s = patch < 0 ? surface : patches[static_cast<std::size_t>(patch)].surface;
  double degc = s.temperature_degc + dot(s.gradient_degc_per_m, p - anchor);
  if (s.value_noise_degc > 0 && kind == Kind::kQuad) {
    const Vec3 q = p - centre;
    degc += s.value_noise_degc *
            value_noise(dot(across, q) / s.value_noise_m, dot(along, q) / s.value_noise_m);
  }
  return degc;
}

bool Facet::faces(Vec3 eye) const { return !one_sided || dot(normal, eye - centre) > 0; }

Vec3 SpaceCurve::at(double t) const {
  if (!closed) {
    return centre + e1 * t;
  }
  // Quarter by quarter through the rational form of the circle.
  const int quarter = std::clamp(static_cast<int>(t * 4), 0, 3);
  const double s = t * 4 - quarter;
  const double c = (1 - s * s) / (1 + s * s);
  const double d = 2 * s / (1 + s * s);
  const double cosine[] = {c, -d, -c, d};
  const double sine[] = {d, c, -d, -c};
  return centre + e1 * cosine[quarter] + e2 * sine[quarter];
}

Facets tessellate(const World& world) {
  Facets result;
  Builder builder(result);
  for (const Object& object : world.objects) {
    builder.object(object);
  }
  add_intersections(result);
  return result;
}

bool resolve(const EdgeCurve& edge, const std::vector<Facet>& facets, Vec3 eye, SpaceCurve& curve) {
  curve = edge.curve;
  if (edge.kind == EdgeCurve::Kind::kFixed) {
    return true;
  }
  const Facet& facet = facets[static_cast<std::size_t>(edge.owners[0])];
  const Vec3 from = eye - facet.centre;
  const double r = facet.radius;
  if (edge.kind == EdgeCurve::Kind::kBallOutline) {
    // Tangents from the eye touch the ball along a circle.
    const double distance = norm(from);
    if (distance <= r) {
      return false;
    }
    const Vec3 axis = from * (1 / distance);
    const double share = r / distance;
    const Vec3 u = perpendicular(axis) * (r * std::sqrt(1 - share * share));
    curve = {true, facet.centre + axis * (r * share), u, cross(axis, u)};
    return true;
  }
  const Vec3 outward = from - facet.normal * dot(from, facet.normal);
  const double distance = norm(outward);
  if (distance <= r) {
    return false;
  }
  const double cosine = r / distance;
  const double sine = edge.sign * std::sqrt(1 - cosine * cosine);
  const Vec3 e1 = outward * (1 / distance);
  const Vec3 touch = e1 * (r * cosine) + cross(facet.normal, e1) * (r * sine);
  curve = {false,
           facet.centre + touch - facet.normal * facet.half_length,
           facet.normal * (2 * facet.half_length),
           {}};
  return true;
}

}  // namespace thermedge::sim
