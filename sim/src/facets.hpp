// A world taken apart: facets that rays hit, and curves along which edges may show.
#pragma once

#include <cstddef>
#include <vector>

#include "vec3.hpp"

namespace thermedge::sim {

// A patch in the coordinates of its facet, metres from the facet's middle.
struct FlatPatch {
  bool ellipse = false;
  double right = 0, up = 0;
  double half_width = 0, half_height = 0;
  double cosine = 1, sine = 0;
  Surface surface;

  [[nodiscard]] bool holds(double across, double along) const {
    const double dx = across - right;
    const double dy = along - up;
    const double x = dx * cosine + dy * sine;
    const double y = dy * cosine - dx * sine;
    if (std::abs(x) > half_width || std::abs(y) > half_height) {
      return false;
    }
    return !ellipse || x * x / (half_width * half_width) + y * y / (half_height * half_height) <= 1;
  }
};

// A part of an object with one normal form. Lengths in metres.
struct Facet {
  enum class Kind { kQuad, kDisc, kTube, kBall };
  Kind kind = Kind::kQuad;
  int object = 0;
  bool moves = false;      // with its object; it has no cuts with others
  bool one_sided = false;  // seen only from where the normal points to
  Vec3 centre;             // of tubes: the middle of the axis
  Vec3 u, v;               // quads: half sides; discs: unit vectors in the plane
  Vec3 normal;             // unit; of tubes: along the axis
  Vec3 dual_u, dual_v;     // flat ones: dot with (p - centre) gives -1..1 on the facet
  Vec3 across, along;      // quads: dot with (p - centre) gives metres from the middle
  double radius = 0;       // discs, tubes, balls
  double half_length = 0;  // tubes
  Surface surface;
  Vec3 anchor;  // where the surface has its stated temperature
  std::vector<FlatPatch> patches;

  [[nodiscard]] bool is_flat() const { return kind == Kind::kQuad || kind == Kind::kDisc; }
  // The topmost patch at p, -1 where there is none.
  [[nodiscard]] int patch_at(Vec3 p) const;
  [[nodiscard]] double temperature_at(Vec3 p, int patch) const;
  // Whether it can be seen from `eye` at all.
  [[nodiscard]] bool faces(Vec3 eye) const;
};

// p(t), t in 0..1: a straight line from centre to centre + e1, or the ellipse
// centre + e1 cos(2 pi t) + e2 sin(2 pi t).
struct SpaceCurve {
  bool closed = false;
  Vec3 centre, e1, e2;
  [[nodiscard]] Vec3 at(double t) const;
};

// A curve of the world where an edge may show. Its number in the list is the edge's identity.
struct EdgeCurve {
  enum class Kind { kFixed, kTubeOutline, kBallOutline };
  Kind kind = Kind::kFixed;
  SpaceCurve curve;        // of kFixed
  bool patch = false;      // the outline of a patch: both sides lie on the first owner
  double sign = 1;         // which of a tube's two outlines
  int owners[2] = {0, 0};  // facets that the curve bounds; the same twice where it is one
};

struct Facets {
  std::vector<Facet> facets;
  std::vector<EdgeCurve> curves;
};

[[nodiscard]] Facets tessellate(const World& world);

// Where the curve lies as seen from `eye`; false: nowhere.
[[nodiscard]] bool resolve(const EdgeCurve& edge, const std::vector<Facet>& facets, Vec3 eye,
                           SpaceCurve& curve);

}  // namespace thermedge::sim
