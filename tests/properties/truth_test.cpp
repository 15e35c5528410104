// How much of the true edges of simulated frames is found, and how much of what is found is true.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "thermedge/detector.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

constexpr int kReachPx = 2;

// Marks everything within kReachPx of the given points.
class Neighbourhood {
 public:
  Neighbourhood(int width, int height) : map_(width, height) {
    fill_pixels(map_.view(), std::uint8_t{0});
  }
  void add(double x, double y) {
    const int cx = static_cast<int>(std::lround(x));
    const int cy = static_cast<int>(std::lround(y));
    for (int dy = -kReachPx; dy <= kReachPx; ++dy) {
      for (int dx = -kReachPx; dx <= kReachPx; ++dx) {
        if (dx * dx + dy * dy <= kReachPx * kReachPx && map_.view().contains(cx + dx, cy + dy)) {
          map_(cx + dx, cy + dy) = 1;
        }
      }
    }
  }
  [[nodiscard]] bool holds(double x, double y) const {
    const int cx = static_cast<int>(std::lround(x));
    const int cy = static_cast<int>(std::lround(y));
    return map_.view().contains(cx, cy) && map_(cx, cy) != 0;
  }

 private:
  Image<std::uint8_t> map_;
};

struct Quality {
  double recall = 0;     // share of the true edge points of >= kLeastContrast counts
  double precision = 0;  // share of the edgels that lie on a true edge of any contrast
};

Quality measure(const std::string& spec) {
  constexpr double kLeastContrast = 40;  // counts: 20 grey levels, 2 sigma of the noisier frames
  const auto scene = sim::parse_scene(spec);
  const auto frame = sim::render(*scene, 0);
  auto detector = Detector::create({});
  const EdgeSet found = detector->detect(frame->counts)->edges;
  Neighbourhood near_truth(frame->counts.width(), frame->counts.height());
  Neighbourhood near_found(frame->counts.width(), frame->counts.height());
  std::size_t on_truth = 0;
  std::size_t edgels = 0;
  std::size_t truth_found = 0;
  std::size_t truth = 0;
  for (const sim::TrueEdge& edge : frame->edges) {
    for (const sim::Point p : edge.points) {
      near_truth.add(p.x, p.y);
    }
  }
  for (const Edge& edge : found.kept_edges()) {
    for (std::size_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
      near_found.add(found.edgels.x[i], found.edgels.y[i]);
      on_truth += near_truth.holds(found.edgels.x[i], found.edgels.y[i]) ? 1 : 0;
      ++edgels;
    }
  }
  for (const sim::TrueEdge& edge : frame->edges) {
    for (const sim::Point p : edge.points) {
      if (edge.contrast_counts >= kLeastContrast) {
        truth_found += near_found.holds(p.x, p.y) ? 1 : 0;
        ++truth;
      }
    }
  }
  return {static_cast<double>(truth_found) / static_cast<double>(truth),
          static_cast<double>(on_truth) / static_cast<double>(edgels)};
}

struct Scene {
  const char* name;
  const char* spec;
  Quality least;
};

class TrueEdges : public testing::TestWithParam<Scene> {};

TEST_P(TrueEdges, AreFoundAndFewOthers) {
  Quality sum;
  constexpr int kSeeds = 5;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Quality quality = measure(GetParam().spec + ("&seed=" + std::to_string(seed)));
    sum.recall += quality.recall / kSeeds;
    sum.precision += quality.precision / kSeeds;
  }
  std::printf("%s: recall %.3f, precision %.3f\n", GetParam().spec, sum.recall, sum.precision);
  EXPECT_GE(sum.recall, GetParam().least.recall);
  EXPECT_GE(sum.precision, GetParam().least.precision);
}

INSTANTIATE_TEST_SUITE_P(
    All, TrueEdges,
    testing::Values(Scene{"desk_sigma6", "sim:desk?sigma=6", {0.9, 0.98}},
                    Scene{"desk_sigma20", "sim:desk?sigma=20", {0.88, 0.97}},
                    Scene{"corridor_sigma6", "sim:corridor?sigma=6", {0.97, 0.96}},
                    Scene{"corridor_sigma20", "sim:corridor?sigma=20", {0.96, 0.98}}),
    [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace thermedge
