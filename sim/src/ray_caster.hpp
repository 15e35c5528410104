// Rays through pixels: what they hit, and how many counts that is worth.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "facets.hpp"
#include "radiometer.hpp"
#include "thermedge/parallel_runner.hpp"
#include "view.hpp"

namespace thermedge::sim {

struct Hit {
  int facet = -1;    // -1: the sky
  int patch = -1;    // -1: beside all patches
  double depth = 0;  // along the optical axis, m

  // Whether two rays met the same surface.
  [[nodiscard]] bool same_surface(const Hit& other) const {
    return facet == other.facet && patch == other.patch;
  }
};

// A facet before the eye: what the intersection with a ray needs, worked out once.
struct SeenFacet {
  Facet::Kind kind = Facet::Kind::kQuad;
  bool is_flat = true;
  std::int16_t index = 0;
  double least_depth = 0;  // nothing of it is nearer
  // Flat ones: the normal, and both coordinates on the facet along a ray, each as a slope and what
  // it is at the eye. Tubes: the axis and the way to it. Balls: `b`, the way to the centre.
  Vec3 a, b, c;
  double a0 = 0, b0 = 0, c0 = 0;

  SeenFacet(const Facet& facet, std::int16_t number, Vec3 eye, double depth);
  // How many `direction`s away the ray's first hit beyond kNearestM is; 0: no hit.
  [[nodiscard]] double hit_flat(Vec3 direction) const;   // quads and discs
  [[nodiscard]] double hit_round(Vec3 direction) const;  // tubes and balls
};

// The facets of a world before one camera. Sorted into tiles of the picture, so that a ray meets
// few of them. const functions are thread-safe.
class RayCaster {
 public:
  // The picture and `margin_px` around it can be asked for. All arguments outlive the ray_caster.
  RayCaster(const World& world, const Facets& facets, const Lens& lens, int margin_px);

  // For each frame, before the rest.
  void set_pose(const Pose& pose, ParallelRunner& runner);

  [[nodiscard]] Vec3 eye() const { return eye_; }
  [[nodiscard]] const Axes& axes() const { return axes_; }
  [[nodiscard]] const Lens& lens() const { return lens_; }
  [[nodiscard]] const Facets& world() const { return facets_; }

  // Facets that may show near a pixel position, for cast().
  [[nodiscard]] std::span<const std::int16_t> facets_near(Point pixel) const;
  // The nearest hit of the ray (x, y, 1).
  [[nodiscard]] Hit cast(Point ray, std::span<const std::int16_t> among) const;
  [[nodiscard]] Hit cast(Point pixel) const { return cast(lens_.ray(pixel), facets_near(pixel)); }
  [[nodiscard]] Vec3 point(Point ray, double depth) const { return eye_ + direction(ray) * depth; }
  // Counts of a surface that was hit at `p`, before the optics.
  [[nodiscard]] double counts(Vec3 p, int facet, int patch) const;
  [[nodiscard]] double counts(Point ray, const Hit& hit) const {
    return counts(point(ray, hit.depth), hit.facet, hit.patch);
  }

 private:
  static constexpr int kTilePx = 16;
  [[nodiscard]] Vec3 direction(Point ray) const {
    return axes_.right * ray.x + axes_.down * ray.y + axes_.forward;
  }
  [[nodiscard]] bool may_show(const SeenFacet& seen, const Vec3 (&sides)[4]) const;
  void fill_tile(int index);

  const World& world_;
  const Facets& facets_;
  const Lens& lens_;
  Radiometer radiometer_;
  int margin_px_;
  int tiles_x_, tiles_y_;
  Vec3 eye_;
  Axes axes_;
  std::vector<SeenFacet> seen_;                   // facets that face the camera, nearest first
  std::vector<std::vector<std::int16_t>> tiles_;  // which of seen_ may show in each
};

}  // namespace thermedge::sim
