// Vectors in space.
#pragma once

#include <cmath>

#include "thermedge/sim/world.hpp"

namespace thermedge::sim {

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 unit(Vec3 a) { return a * (1 / norm(a)); }
// Some unit vector at right angles to the unit vector `a`.
inline Vec3 perpendicular(Vec3 a) {
  return unit(std::abs(a.z) < 0.7 ? cross(a, {0, 0, 1}) : cross(a, {1, 0, 0}));
}

}  // namespace thermedge::sim
