// Where the camera is and how its lens maps directions to pixels.
#pragma once

#include "thermedge/sim/scene.hpp"
#include "vec3.hpp"

namespace thermedge::sim {

// The camera's axes in the world: x right, y down, z forward, as OpenCV has them.
struct Axes {
  Vec3 right, down, forward;
};

[[nodiscard]] Axes axes_of(const Pose& pose);
// The pose of a camera at `position` whose axes are these.
[[nodiscard]] Pose pose_of(Vec3 position, const Axes& axes);
// The axes of a camera that looks along `forward` without roll; `forward` is not vertical.
[[nodiscard]] Axes upright(Vec3 forward);
// Turned about its own axes by small angles given as half their tangents.
[[nodiscard]] Axes turned(const Axes& axes, Vec3 half_tangents);

// Pinhole with Brown's radial distortion.
class Lens {
 public:
  explicit Lens(const Intrinsics& intrinsics);

  [[nodiscard]] const Intrinsics& intrinsics() const { return intrinsics_; }
  // x / z and y / z of the ray through a pixel position: fixed-point iteration to 1e-14.
  [[nodiscard]] Point ray(Point pixel) const;
  // Where the ray (x, y, 1) meets the picture. Rays more than a tenth outside of it must not be
  // given: Brown's polynomial may bend them back.
  [[nodiscard]] Point pixel(Point ray) const;
  // Largest |x / z| and |y / z| of the picture, with a margin.
  [[nodiscard]] Point reach() const { return reach_; }
  // Share of the light that arrives at a pixel, for a loss of `vignetting` in the corner.
  [[nodiscard]] double light(Point pixel, double vignetting) const;

 private:
  Intrinsics intrinsics_;
  Point reach_;
};

[[nodiscard]] Intrinsics intrinsics_of(const CameraOptions& camera);

}  // namespace thermedge::sim
