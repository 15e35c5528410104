#include "imager.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace thermedge::sim {
namespace {

// Rays through a sub-pixel where surfaces meet. An edge along the pixels' rows or columns, the
// worst case, lies within 1/64 of a sub-pixel, and the shifts below leave a quarter of that on the
// average.
constexpr int kSamples = 32;
constexpr int kShifts = 4;
constexpr int kTaskRows = 8;

// Hammersley's points: any strip of the square holds its share of them, to about one point. Each of
// kShifts sets lies between the points of the others.
std::vector<Point> hammersley(int shift_x, int shift_y) {
  const auto shifted = [](double value, int shift) {
    return value + (shift - (kShifts - 1) / 2.0) / (kShifts * kSamples);
  };
  std::vector<Point> points;
  for (int i = 0; i < kSamples; ++i) {
    double inverse = 0;
    double step = 0.5;
    for (int bits = i; bits > 0; bits /= 2, step /= 2) {
      inverse += bits % 2 * step;
    }
    points.push_back({shifted((i + 0.5) / kSamples - 0.5, shift_x),
                      shifted(inverse + 0.5 / kSamples - 0.5, shift_y)});
  }
  return points;
}

// Where rays met each surface, on the average. Over a sub-pixel temperatures are as good as linear,
// so what a surface gives there is that of the average place.
class SurfaceMeans {
 public:
  void add(const Hit& hit, Vec3 p) {
    std::size_t i = 0;
    while (i < used_ && !means_[i].hit.same_surface(hit)) {
      ++i;
    }
    if (i == used_) {
      means_[used_++] = {hit, {}, 0};
    }
    means_[i].sum = means_[i].sum + p;
    ++means_[i].rays;
  }

  // The sum over all rays.
  [[nodiscard]] double counts(const RayCaster& ray_caster) const {
    double sum = 0;
    for (std::size_t i = 0; i < used_; ++i) {
      const Mean& mean = means_[i];
      sum += mean.rays *
             ray_caster.counts(mean.sum * (1.0 / mean.rays), mean.hit.facet, mean.hit.patch);
    }
    return sum;
  }

 private:
  struct Mean {
    Hit hit;
    Vec3 sum;
    int rays = 0;
  };
  std::array<Mean, kSamples> means_;
  std::size_t used_ = 0;
};

void run_rows(int rows, ParallelRunner& runner, const auto& task) {
  runner.run((rows + kTaskRows - 1) / kTaskRows, [&](int index) {
    for (int y = index * kTaskRows; y < std::min((index + 1) * kTaskRows, rows); ++y) {
      task(y);
    }
  });
}

}  // namespace

Imager::Imager(const Lens& lens, const CameraOptions& camera)
    : vignetting_(camera.vignetting),
      optics_(camera.blur_px, camera.airy_px),
      margin_px_(optics_.margin_px()),
      width_((camera.width + 2 * margin_px_) * kSubpixels),
      height_((camera.height + 2 * margin_px_) * kSubpixels),
      fine_(width_, height_),
      keys_(width_, height_) {
  for (int i = 0; i < kShifts * kShifts; ++i) {
    samples_.push_back(hammersley(i / kShifts, i % kShifts));
  }
  rays_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      rays_.push_back(lens.ray(position(x, y)));
    }
  }
}

Point Imager::position(int x, int y) const {
  const auto centre = [&](int i) { return (i + 0.5) / kSubpixels - 0.5 - margin_px_; };
  return {centre(x), centre(y)};
}

void Imager::run(const RayCaster& ray_caster, ImageView<float> clean, ParallelRunner& runner) {
  run_rows(height_, runner, [&](int y) { cast_row(ray_caster, y); });
  run_rows(height_, runner, [&](int y) { refine_row(ray_caster, y); });
  optics_.run(fine_, clean, runner);
  if (vignetting_ > 0) {
    for (int y = 0; y < clean.height(); ++y) {
      for (int x = 0; x < clean.width(); ++x) {
        const double light =
            ray_caster.lens().light({static_cast<double>(x), static_cast<double>(y)}, vignetting_);
        clean(x, y) =
            static_cast<float>(kCountsAt25DegC + light * (double{clean(x, y)} - kCountsAt25DegC));
      }
    }
  }
}

void Imager::cast_row(const RayCaster& ray_caster, int y) {
  const Point* rays = &rays_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_)];
  for (int x = 0; x < width_; ++x) {
    const Hit hit = ray_caster.cast(rays[x], ray_caster.facets_near(position(x, y)));
    keys_(x, y) = {static_cast<std::int16_t>(hit.facet), static_cast<std::int16_t>(hit.patch)};
    fine_(x, y) = static_cast<float>(ray_caster.counts(rays[x], hit));
  }
}

bool Imager::on_boundary(int x, int y) const {
  const Key key = keys_(x, y);
  for (int j = std::max(0, y - 1); j <= std::min(height_ - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(width_ - 1, x + 1); ++i) {
      if (keys_(i, j) != key) {
        return true;
      }
    }
  }
  return false;
}

void Imager::refine_row(const RayCaster& ray_caster, int y) {
  for (int x = 0; x < width_; ++x) {
    if (on_boundary(x, y)) {
      fine_(x, y) = static_cast<float>(mean_counts(ray_caster, x, y));
    }
  }
}

// Within a sub-pixel the rays change as between its neighbours.
double Imager::mean_counts(const RayCaster& ray_caster, int x, int y) const {
  const auto ray = [&](int i, int j) {
    i = std::clamp(i, 0, width_ - 1);
    j = std::clamp(j, 0, height_ - 1);
    return rays_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(i)];
  };
  const int left = std::max(0, x - 1);
  const int right = std::min(width_ - 1, x + 1);
  const int top = std::max(0, y - 1);
  const int bottom = std::min(height_ - 1, y + 1);
  const Point across{(ray(right, y).x - ray(left, y).x) / (right - left),
                     (ray(right, y).y - ray(left, y).y) / (right - left)};
  const Point down{(ray(x, bottom).x - ray(x, top).x) / (bottom - top),
                   (ray(x, bottom).y - ray(x, top).y) / (bottom - top)};
  const Point middle = ray(x, y);
  const auto among = ray_caster.facets_near(position(x, y));
  SurfaceMeans means;
  const int shift = y % kShifts * kShifts + x % kShifts;
  for (const Point s : samples_[static_cast<std::size_t>(shift)]) {
    const Point p{middle.x + s.x * across.x + s.y * down.x,
                  middle.y + s.x * across.y + s.y * down.y};
    const Hit hit = ray_caster.cast(p, among);
    means.add(hit, ray_caster.point(p, hit.depth));
  }
  return means.counts(ray_caster) / kSamples;
}

void render_depth(const RayCaster& ray_caster, ImageView<std::uint16_t> depth_mm,
                  ParallelRunner& runner) {
  run_rows(depth_mm.height(), runner, [&](int y) {
    for (int x = 0; x < depth_mm.width(); ++x) {
      const Hit hit = ray_caster.cast({static_cast<double>(x), static_cast<double>(y)});
      constexpr double kMost = 65535;
      depth_mm(x, y) = static_cast<std::uint16_t>(std::min(hit.depth * 1000 + 0.5, kMost));
    }
  });
}

}  // namespace thermedge::sim
