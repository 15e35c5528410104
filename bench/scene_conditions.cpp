#include "scene_conditions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "processing.hpp"
#include "random.hpp"
#include "shapes.hpp"

namespace thermedge::bench {
namespace {

constexpr double kCornerMarginPx = 3;
constexpr int kJpegQuality = 80;
// An 8-bit recording shows the range and some of what is beyond it.
constexpr double kShownRanges = 1.3;

double levels_per_count(const SceneCondition& condition) {
  return 255 / (kShownRanges * condition.range_counts);
}

Image<float> in_counts(const CleanScene& scene, double range_counts) {
  Image<float> clean(scene.shares.width(), scene.shares.height());
  for (int y = 0; y < clean.height(); ++y) {
    for (int x = 0; x < clean.width(); ++x) {
      clean(x, y) = static_cast<float>(kMiddleCounts + range_counts * scene.shares(x, y));
    }
  }
  return clean;
}

Image<std::uint16_t> with_uneven_noise(Image<float> clean, double sigma, std::uint64_t seed) {
  const sim::Random random(seed, 0x04E7);
  std::uint64_t index = 0;
  for (int y = 0; y < clean.height(); ++y) {
    for (int x = 0; x < clean.width(); ++x) {
      clean(x, y) +=
          static_cast<float>(sigma * uneven_noise(x, clean.width()) * random.normal(index++));
    }
  }
  return rounded(clean);
}

Image<float> to_levels(Image<float> counts, const SceneCondition& condition) {
  const double below = (kShownRanges - 1) / 2 * condition.range_counts;
  for (int y = 0; y < counts.height(); ++y) {
    for (int x = 0; x < counts.width(); ++x) {
      counts(x, y) =
          static_cast<float>((counts(x, y) - kMiddleCounts + below) * levels_per_count(condition));
    }
  }
  return counts;
}

// The frame outside an ellipse that passes near its corners, somewhat askew.
class Corners {
 public:
  Corners(int width, int height, std::uint64_t seed) : width_(width), height_(height) {
    Draws draws(seed, 0xC0F3);
    across_ = draws.uniform(0.85, 1);
    down_ = draws.uniform(0.85, 1);
    askew_ = draws.uniform(-0.15, 0.15);
    reach_ = draws.uniform(1.35, 1.6);
  }
  [[nodiscard]] bool contains(double x, double y) const {
    const double u = 2 * x / (width_ - 1) - 1;
    const double v = 2 * y / (height_ - 1) - 1;
    return across_ * u * u + down_ * v * v + askew_ * u * v > reach_;
  }
  // Any place within the margin; the outline is nearly straight there.
  [[nodiscard]] bool are_near(int x, int y) const {
    const double dx = x < width_ / 2 ? -kCornerMarginPx : kCornerMarginPx;
    const double dy = y < height_ / 2 ? -kCornerMarginPx : kCornerMarginPx;
    return contains(x, y) || contains(x + dx, y) || contains(x, y + dy);
  }

 private:
  int width_, height_;
  double across_, down_, askew_, reach_;
};

void cut_corners(TestFrame& frame, std::uint64_t seed) {
  const Corners corners(frame.counts.width(), frame.counts.height(), seed);
  for (int y = 0; y < frame.counts.height(); ++y) {
    for (int x = 0; x < frame.counts.width(); ++x) {
      if (corners.contains(x, y)) {
        frame.counts(x, y) = 0;
      }
      if (corners.are_near(x, y)) {
        frame.truth.annotators.front()(x, y) = frame.truth.accepted.front()(x, y) = 0;
      }
    }
  }
}

eval::TruthMaps truth_in_noise(eval::CurveFrame edges, const SceneCondition& condition) {
  for (eval::Curve& piece : edges.curves) {
    const double x = piece.points[piece.points.size() / 2].x;
    const double share =
        condition.circumstance == Circumstance::kUnevenNoise ? uneven_noise(x, edges.width) : 1;
    piece.contrast_counts *= condition.range_counts / (condition.sigma_counts * share);
  }
  eval::TruthMaps truth;
  truth.annotators.push_back(truth_map(edges, kAskedSigmas));
  truth.accepted.push_back(truth_map(edges, kAcceptedSigmas));
  return truth;
}

}  // namespace

TestFrame scene_under(const SceneCondition& condition, std::uint64_t seed) {
  const Circumstance circumstance = condition.circumstance;
  SceneVariation variation;
  variation.faint_steps = circumstance == Circumstance::kWideRange;
  variation.hot_things = circumstance == Circumstance::kHotThings;
  CleanScene scene = random_scene(seed, variation);
  const Image<float> clean = in_counts(scene, condition.range_counts);
  TestFrame frame;
  frame.counts = circumstance == Circumstance::kUnevenNoise
                     ? with_uneven_noise(clean.clone(), condition.sigma_counts, seed)
                     : expose(clean, {condition.sigma_counts}, seed);
  frame.truth = truth_in_noise(std::move(scene.edges), condition);
  switch (circumstance) {
    case Circumstance::kBlackCorners:
      cut_corners(frame, seed);
      break;
    case Circumstance::kHalfPixel:
      frame.counts = rounded(moved_by_half(as_float(frame.counts)));
      break;
    case Circumstance::kJpeg:
      frame.counts =
          rounded(through_jpeg(to_levels(as_float(frame.counts), condition), kJpegQuality));
      frame.bits = 8;
      break;
    case Circumstance::kCoarseSteps:
      frame.counts = rounded(in_steps(as_float(frame.counts), 2 * condition.sigma_counts));
      break;
    default:
      break;
  }
  return frame;
}

double pixel_sigma(const SceneCondition& condition) {
  const double unit =
      condition.circumstance == Circumstance::kJpeg ? levels_per_count(condition) : 1;
  return unit * condition.sigma_counts;
}

}  // namespace thermedge::bench
