#include "ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace thermedge::sim {
namespace {

constexpr double kNearestM = 0.01;
constexpr double kFarthestM = 1e6;

// The corners of the parallelogram that holds a flat facet.
std::array<Vec3, 4> corners(const Facet& facet) {
  const double scale = facet.kind == Facet::Kind::kDisc ? facet.radius : 1;
  const Vec3 u = facet.u * scale;
  const Vec3 v = facet.v * scale;
  return {facet.centre - u - v, facet.centre + u - v, facet.centre + u + v, facet.centre - u + v};
}

// The least of dot(direction, p - eye) over the facet, for a unit vector.
double least_along(const Facet& facet, Vec3 eye, Vec3 direction) {
  if (!facet.is_flat()) {
    return dot(direction, facet.centre - eye) -
           facet.half_length * std::abs(dot(direction, facet.normal)) - facet.radius;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3 corner : corners(facet)) {
    least = std::min(least, dot(direction, corner - eye));
  }
  return least;
}

// Roots of a t^2 - 2 b t + c, the smaller first; false where there are none.
bool roots(double a, double b, double c, double (&t)[2]) {
  const double square = b * b - a * c;
  if (!(square >= 0) || !(a > 0)) {
    return false;
  }
  const double root = std::sqrt(square);
  t[0] = (b - root) / a;
  t[1] = (b + root) / a;
  return true;
}

}  // namespace

SeenFacet::SeenFacet(const Facet& facet, std::int16_t number, Vec3 eye, double depth)
    : kind(facet.kind), is_flat(facet.is_flat()), index(number), least_depth(depth) {
  const Vec3 way = facet.centre - eye;
  a = facet.normal;
  a0 = dot(a, way);
  if (facet.is_flat()) {
    b = facet.dual_u;
    b0 = -dot(b, way);
    c = facet.dual_v;
    c0 = -dot(c, way);
  } else {
    b = kind == Facet::Kind::kTube ? way - a * a0 : way;
    b0 = dot(b, b) - facet.radius * facet.radius;
    c0 = facet.half_length;
  }
}

inline double SeenFacet::hit_flat(Vec3 direction) const {
  const double t = a0 / dot(a, direction);
  const double u = b0 + t * dot(b, direction);
  const double v = c0 + t * dot(c, direction);
  const bool inside =
      kind == Facet::Kind::kQuad ? std::abs(u) <= 1 && std::abs(v) <= 1 : u * u + v * v <= 1;
  return inside && t > kNearestM && t < kFarthestM ? t : 0;
}

double SeenFacet::hit_round(Vec3 direction) const {
  const bool tube = kind == Facet::Kind::kTube;
  const double along = tube ? dot(a, direction) : 0;
  const Vec3 across = direction - a * along;
  double t[2];
  if (!roots(dot(across, across), dot(across, b), b0, t)) {
    return 0;
  }
  for (const double candidate : t) {
    if (candidate > kNearestM && (!tube || std::abs(along * candidate - a0) <= c0)) {
      return candidate;
    }
  }
  return 0;
}

RayCaster::RayCaster(const World& world, const Facets& facets, const Lens& lens, int margin_px)
    : world_(world),
      facets_(facets),
      lens_(lens),
      radiometer_(world.reflected_degc),
      margin_px_(margin_px),
      tiles_x_((lens.intrinsics().width + 2 * margin_px + kTilePx) / kTilePx),
      tiles_y_((lens.intrinsics().height + 2 * margin_px + kTilePx) / kTilePx),
      tiles_(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_)) {}

void RayCaster::set_pose(const Pose& pose, ParallelRunner& runner) {
  eye_ = pose.position_m;
  axes_ = axes_of(pose);
  seen_.clear();
  for (std::size_t i = 0; i < facets_.facets.size(); ++i) {
    const Facet& facet = facets_.facets[i];
    // Behind the camera where even its farthest point is.
    const bool behind = -least_along(facet, eye_, -axes_.forward) <= kNearestM;
    if (!behind && facet.faces(eye_)) {
      seen_.emplace_back(facet, static_cast<std::int16_t>(i), eye_,
                         least_along(facet, eye_, axes_.forward));
    }
  }
  std::sort(seen_.begin(), seen_.end(), [](const SeenFacet& a, const SeenFacet& b) {
    return a.least_depth != b.least_depth ? a.least_depth < b.least_depth : a.index < b.index;
  });
  runner.run(tiles_y_, [&](int row) {
    for (int column = 0; column < tiles_x_; ++column) {
      fill_tile(row * tiles_x_ + column);
    }
  });
}

// False only where the whole facet lies beyond one of the four planes through the eye.
bool RayCaster::may_show(const SeenFacet& seen, const Vec3 (&sides)[4]) const {
  const Facet& facet = facets_.facets[static_cast<std::size_t>(seen.index)];
  return std::all_of(std::begin(sides), std::end(sides),
                     [&](Vec3 inward) { return -least_along(facet, eye_, -inward) >= 0; });
}

void RayCaster::fill_tile(int index) {
  // Distortion bends the tile's sides; by far less than this.
  constexpr double kSlackPx = 1;
  const int column = index % tiles_x_;
  const int row = index / tiles_x_;
  const double x0 = column * kTilePx - margin_px_ - 0.5 - kSlackPx;
  const double y0 = row * kTilePx - margin_px_ - 0.5 - kSlackPx;
  const double size = kTilePx + 2 * kSlackPx;
  const Vec3 rays[4] = {direction(lens_.ray({x0, y0})), direction(lens_.ray({x0 + size, y0})),
                        direction(lens_.ray({x0 + size, y0 + size})),
                        direction(lens_.ray({x0, y0 + size}))};
  Vec3 sides[4];
  for (int i = 0; i < 4; ++i) {
    sides[i] = unit(cross(rays[i], rays[(i + 1) % 4]));
  }
  std::vector<std::int16_t>& tile = tiles_[static_cast<std::size_t>(index)];
  tile.clear();
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (may_show(seen_[i], sides)) {
      tile.push_back(static_cast<std::int16_t>(i));
    }
  }
}

std::span<const std::int16_t> RayCaster::facets_near(Point pixel) const {
  const auto tile_of = [&](double position, int count) {
    const double tile = std::floor((position + margin_px_ + 0.5) / kTilePx);
    return static_cast<int>(std::clamp(tile, 0.0, count - 1.0));
  };
  const int index = tile_of(pixel.y, tiles_y_) * tiles_x_ + tile_of(pixel.x, tiles_x_);
  return tiles_[static_cast<std::size_t>(index)];
}

Hit RayCaster::cast(Point ray, std::span<const std::int16_t> among) const {
  const Vec3 towards = direction(ray);
  Hit best;
  for (const std::int16_t i : among) {
    const SeenFacet& seen = seen_[static_cast<std::size_t>(i)];
    if (best.facet >= 0 && seen.least_depth > best.depth) {
      break;  // all that follow begin farther away
    }
    const double depth = seen.is_flat ? seen.hit_flat(towards) : seen.hit_round(towards);
    if (depth > 0 && (best.facet < 0 || depth < best.depth)) {
      best.facet = seen.index;
      best.depth = depth;
    }
  }
  if (best.facet >= 0) {
    const Facet& facet = facets_.facets[static_cast<std::size_t>(best.facet)];
    best.patch = facet.patch_at(eye_ + towards * best.depth);
  }
  return best;
}

double RayCaster::counts(Vec3 p, int facet, int patch) const {
  if (facet < 0) {
    return radiometer_.counts(world_.sky_degc, 1);
  }
  const Facet& hit = facets_.facets[static_cast<std::size_t>(facet)];
  const Surface& surface =
      patch < 0 ? hit.surface : hit.patches[static_cast<std::size_t>(patch)].surface;
  return radiometer_.counts(hit.temperature_at(p, patch), surface.emissivity);
}

}  // namespace thermedge::sim
