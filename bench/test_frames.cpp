#include "test_frames.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "optics.hpp"
#include "portable.hpp"
#include "sensor.hpp"
#include "thermedge/eval/files.hpp"
#include "thermedge/eval/thinning.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/sim/scene.hpp"
#include "value_or_exit.hpp"

namespace thermedge::bench {
namespace {

using eval::Point;

constexpr int kWidth = 382;
constexpr int kHeight = 288;
constexpr double kFadePx = 35;

// A straight line, or an arc whose centre lies on the -normal side, seen from its middle.
struct Line {
  Point middle;
  sim::SinCos direction;
  double radius = 0;  // 0: straight
  double length = 0;

  // Along the line from its middle, and beside it (positive towards the normal), px.
  [[nodiscard]] Point along_and_beside(Point at) const {
    const double dx = at.x - middle.x;
    const double dy = at.y - middle.y;
    const double u = dx * direction.cos + dy * direction.sin;
    const double v = -dx * direction.sin + dy * direction.cos;
    if (radius == 0) {
      return {u, v};
    }
    const double from_centre = v + radius;
    return {radius * std::atan2(u, from_centre),
            std::sqrt(u * u + from_centre * from_centre) - radius};
  }
  [[nodiscard]] Point at(double along) const {
    double u = along;
    double v = 0;
    if (radius > 0) {
      const auto [sine, cosine] = sim::sin_cos(along / radius);
      u = radius * sine;
      v = radius * (cosine - 1);
    }
    return {middle.x + u * direction.cos - v * direction.sin,
            middle.y + u * direction.sin + v * direction.cos};
  }
  // Height of the step's profile, -.5 .. .5.
  [[nodiscard]] double share(Point where) const {
    const Point local = along_and_beside(where);
    if (std::abs(local.x) > length / 2) {
      return 0;
    }
    return std::copysign(0.5 * std::exp(-std::abs(local.y) / kFadePx), local.y);
  }
};

// Lies inside the frame, away from its border.
Line random_line(double length_px, bool curved, Draws& draws) {
  constexpr double kMargin = 12;
  for (;;) {
    Line line;
    line.length = length_px;
    line.radius = curved ? 1.2 * length_px : 0;
    line.direction = sim::sin_cos(draws.uniform(0, 2 * std::numbers::pi));
    line.middle = {draws.uniform(0, kWidth), draws.uniform(0, kHeight)};
    const auto inside = [&](double along) {
      const Point p = line.at(along);
      return p.x > kMargin && p.y > kMargin && p.x < kWidth - kMargin && p.y < kHeight - kMargin;
    };
    if (inside(-length_px / 2) && inside(0) && inside(length_px / 2)) {
      return line;
    }
  }
}

Image<float> flat() {
  Image<float> clean(kWidth, kHeight);
  fill_pixels(clean.view(), static_cast<float>(kMiddleCounts));
  return clean;
}

}  // namespace

Image<std::uint16_t> expose(ImageView<const float> clean, const Disturbance& disturbance,
                            std::uint64_t seed) {
  sim::CameraOptions camera;
  camera.width = clean.width();
  camera.height = clean.height();
  camera.sigma_counts = disturbance.sigma_counts;
  camera.column_sigma_counts = disturbance.stripes ? disturbance.sigma_counts / 3 : 0;
  camera.row_sigma_counts = disturbance.stripes ? disturbance.sigma_counts / 4 : 0;
  camera.bad_pixels = disturbance.bad_pixels;
  Image<std::uint16_t> counts(clean.width(), clean.height());
  sim::Sensor(camera, seed).expose(clean, 0, counts, *make_runner(1));
  return counts;
}

Image<std::uint16_t> expose(const CleanScene& scene, double sigma_counts, std::uint64_t seed) {
  Image<float> clean(scene.shares.width(), scene.shares.height());
  for (int y = 0; y < clean.height(); ++y) {
    for (int x = 0; x < clean.width(); ++x) {
      clean(x, y) = static_cast<float>(kMiddleCounts + kRangeCounts * scene.shares(x, y));
    }
  }
  return expose(clean, {sigma_counts}, seed);
}

TestFrame simulated(const std::string& scene, double sigma_counts, std::uint64_t seed) {
  constexpr double kAskedCounts = 40;
  constexpr double kAcceptedCounts = 10;
  sim::SceneOptions options;
  options.name = scene;
  options.seed = seed;
  options.least_contrast_counts = kAcceptedCounts;
  options.camera.sigma_counts = sigma_counts;
  options.camera.column_sigma_counts = sigma_counts / 3;
  options.camera.row_sigma_counts = sigma_counts / 4;
  sim::TrueFrame frame = value_or_exit(sim::render(options, 0));
  eval::CurveFrame curves;
  curves.width = frame.counts.width();
  curves.height = frame.counts.height();
  for (const sim::TrueEdge& edge : frame.edges) {
    eval::Curve curve;
    for (const sim::Point& point : edge.points) {
      curve.points.push_back({point.x, point.y});
    }
    curve.closed = edge.closed;
    curve.contrast_counts = edge.contrast_counts;
    curves.curves.push_back(std::move(curve));
  }
  TestFrame test;
  test.counts = std::move(frame.counts);
  for (auto& [maps, least] : {std::pair{&test.truth.annotators, kAskedCounts},
                              std::pair{&test.truth.accepted, kAcceptedCounts}}) {
    Image<std::uint8_t> map;
    eval::draw_curves(curves, least, map);
    eval::thin(map.view());
    maps->push_back(std::move(map));
  }
  return test;
}

std::vector<std::string> conditions_of(const std::string& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory + "/raw")) {
    if (entry.is_directory()) {
      names.push_back(entry.path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<TestFrame> prepared(const std::string& directory, const std::string& condition,
                                int most) {
  const auto source = value_or_exit(io::open_files({directory + "/raw/" + condition}, {}));
  const auto truth = value_or_exit(eval::GroundTruthSet::open(directory + "/gt", {}));
  std::vector<TestFrame> frames;
  io::SourceFrame frame;
  while (static_cast<int>(frames.size()) < most && value_or_exit(source->next(frame))) {
    TestFrame test;
    test.truth = std::move(value_or_exit(truth.read(frame.stem, frames.size())).maps);
    test.counts = std::move(frame.counts);
    frames.push_back(std::move(test));
    frame = {};
  }
  return frames;
}

double uneven_noise(double x, int width) { return std::exp2(2 * x / (width - 1) - 1); }

Image<std::uint16_t> empty_frame(Emptiness kind, double sigma_counts, std::uint64_t seed) {
  Image<float> clean = flat();
  if (kind == Emptiness::kVignette) {
    const double reach = kWidth * kWidth / 4.0 + kHeight * kHeight / 4.0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double dx = x - kWidth / 2.0;
        const double dy = y - kHeight / 2.0;
        clean(x, y) -= static_cast<float>(5 * sigma_counts * (dx * dx + dy * dy) / reach);
      }
    }
  }
  Disturbance disturbance{sigma_counts};
  disturbance.stripes = kind != Emptiness::kPlain;
  return expose(clean, disturbance, seed);
}

SingleEdge single_edge(double length_px, bool curved, double contrast_counts, std::uint64_t seed) {
  Draws draws(seed, 0x51E9);
  const Line line = random_line(length_px, curved, draws);
  sim::Optics optics(kOpticsPx, 0);
  const int margin = optics.margin_px();
  Image<float> fine((kWidth + 2 * margin) * sim::kSubpixels,
                    (kHeight + 2 * margin) * sim::kSubpixels);
  for (int y = 0; y < fine.height(); ++y) {
    for (int x = 0; x < fine.width(); ++x) {
      const Point at{(x + 0.5) / sim::kSubpixels - 0.5 - margin,
                     (y + 0.5) / sim::kSubpixels - 0.5 - margin};
      fine(x, y) = static_cast<float>(kMiddleCounts + contrast_counts * line.share(at));
    }
  }
  SingleEdge edge;
  edge.clean.resize(kWidth, kHeight);
  optics.run(fine, edge.clean, *make_runner(1));
  const auto steps = static_cast<int>(2 * length_px);
  for (int i = 0; i <= steps; ++i) {
    edge.points.push_back(line.at((i - length_px) / 2));
  }
  return edge;
}

}  // namespace thermedge::bench
