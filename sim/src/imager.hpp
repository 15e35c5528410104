// The clean picture of a world: rays through sub-pixels, many of them where surfaces meet.
#pragma once

#include <cstdint>
#include <vector>

#include "optics.hpp"
#include "ray_caster.hpp"
#include "thermedge/image.hpp"

namespace thermedge::sim {

class Imager {
 public:
  Imager(const Lens& lens, const CameraOptions& camera);

  [[nodiscard]] int margin_px() const { return margin_px_; }
  // Counts without noise into `clean`, of the camera's size.
  void run(const RayCaster& ray_caster, ImageView<float> clean, ParallelRunner& runner);

 private:
  struct Key {
    std::int16_t facet, patch;
    friend bool operator==(const Key&, const Key&) = default;
  };
  [[nodiscard]] Point position(int x, int y) const;
  void cast_row(const RayCaster& ray_caster, int y);
  void refine_row(const RayCaster& ray_caster, int y);
  [[nodiscard]] bool on_boundary(int x, int y) const;
  [[nodiscard]] double mean_counts(const RayCaster& ray_caster, int x, int y) const;

  double vignetting_;
  Optics optics_;
  int margin_px_;
  int width_, height_;  // of the picture and its margin, sub-pixels
  std::vector<Point> rays_;
  Image<float> fine_;
  Image<Key> keys_;
  std::vector<std::vector<Point>> samples_;  // places within a sub-pixel, in -0.5..0.5
};

// Depth along the optical axis through each pixel's centre, mm, as TrueFrame has it.
void render_depth(const RayCaster& ray_caster, ImageView<std::uint16_t> depth_mm,
                  ParallelRunner& runner);

}  // namespace thermedge::sim
