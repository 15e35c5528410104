// Worlds of a few surfaces before a camera, for closed forms.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "imager.hpp"
#include "ray_caster.hpp"
#include "truth.hpp"

namespace thermedge::test {

inline sim::Surface black(double degc) {
  sim::Surface surface;
  surface.temperature_degc = degc;
  surface.emissivity = 1;
  return surface;
}

// A square of `size_m` metres that faces the camera at `depth_m`, its lower left corner at (x, z).
inline sim::Quad facing(double depth_m, double x, double z, double size_m, double degc) {
  sim::Quad quad;
  quad.corner = {x, depth_m, z};
  quad.u = {size_m, 0, 0};
  quad.v = {0, 0, size_m};
  quad.surface = black(degc);
  return quad;
}

inline sim::Sphere ball(sim::Vec3 centre, double radius, double degc) {
  sim::Sphere sphere;
  sphere.centre = centre;
  sphere.radius = radius;
  sphere.surface = black(degc);
  return sphere;
}

// What a camera at the origin that looks along +y makes of some shapes before a sky.
class SmallWorld {
 public:
  template <class... Shapes>
  SmallWorld(const sim::CameraOptions& camera, double sky_degc, Shapes... shapes)
      : lens_(sim::intrinsics_of(camera)), imager_(lens_, camera), runner_(make_runner(1)) {
    world_.sky_degc = sky_degc;
    (world_.objects.push_back({"", std::move(shapes)}), ...);
    facets_ = sim::tessellate(world_);
    ray_caster_ = std::make_unique<sim::RayCaster>(world_, facets_, lens_, imager_.margin_px());
    ray_caster_->set_pose(sim::pose_of({}, sim::upright({0, 1, 0})), *runner_);
    clean.resize(camera.width, camera.height);
    imager_.run(*ray_caster_, clean, *runner_);
    edges = sim::true_edges(*ray_caster_, 1, camera.vignetting, *runner_);
  }

  [[nodiscard]] const sim::Lens& lens() const { return lens_; }
  [[nodiscard]] const sim::RayCaster& ray_caster() const { return *ray_caster_; }
  // Metres at `depth_m` from the axis to a column of the picture, without distortion.
  [[nodiscard]] static double metres(const sim::CameraOptions& camera, double column,
                                     double depth_m) {
    const sim::Intrinsics i = sim::intrinsics_of(camera);
    return (column - i.cx_px) / i.fx_px * depth_m;
  }

  Image<float> clean;
  std::vector<sim::TrueEdge> edges;

 private:
  sim::World world_;
  sim::Facets facets_;
  sim::Lens lens_;
  sim::Imager imager_;
  std::unique_ptr<ParallelRunner> runner_;
  std::unique_ptr<sim::RayCaster> ray_caster_;
};

// Where a row of the picture crosses `level` upwards from column `x` on, between pixels.
inline double crossing(ImageView<const float> image, int y, double level, int x = 0) {
  while (x + 2 < image.width() && static_cast<double>(image(x + 1, y)) < level) {
    ++x;
  }
  const double here = static_cast<double>(image(x, y));
  return x + (level - here) / (static_cast<double>(image(x + 1, y)) - here);
}

}  // namespace thermedge::test
