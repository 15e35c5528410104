// Frames of the benchmarks: their truth is where the pictures have their edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random_scene.hpp"
#include "test_frames.hpp"
#include "thermedge/stages/noise.hpp"

namespace thermedge::bench {
namespace {

constexpr int kWidth = 120;
constexpr int kHeight = 90;

Polygon box(double left, double top, double right, double bottom) {
  return Polygon({{left, top}, {right, top}, {right, bottom}, {left, bottom}});
}

double length_px(const eval::Curve& curve) {
  double sum = 0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    sum += std::hypot(curve.points[i].x - curve.points[i - 1].x,
                      curve.points[i].y - curve.points[i - 1].y);
  }
  return sum;
}

double length_px(const eval::CurveFrame& frame) {
  double sum = 0;
  for (const eval::Curve& curve : frame.curves) {
    sum += length_px(curve);
  }
  return sum;
}

// Largest less smallest value around a pixel.
double swing(ImageView<const float> image, int x, int y, int radius) {
  float low = image(x, y);
  float high = low;
  for (int v = std::max(0, y - radius); v <= std::min(image.height() - 1, y + radius); ++v) {
    for (int u = std::max(0, x - radius); u <= std::min(image.width() - 1, x + radius); ++u) {
      low = std::min(low, image(u, v));
      high = std::max(high, image(u, v));
    }
  }
  return high - low;
}

TEST(Painting, EdgesOfABoxAreItsOutlineWithItsStep) {
  Painting painting(kWidth, kHeight, {});
  painting.add(box(20.3, 15, 80.3, 60), 0.5, 0, 0);
  const eval::CurveFrame edges = painting.edges();
  EXPECT_NEAR(length_px(edges), 2 * (60 + 45), 2);
  for (const eval::Curve& curve : edges.curves) {
    EXPECT_NEAR(curve.contrast_counts, 0.5, 1e-12);
    EXPECT_LE(length_px(curve), 4.01);
    for (const eval::Point p : curve.points) {
      const double off = std::min(
          {std::abs(p.x - 20.3), std::abs(p.x - 80.3), std::abs(p.y - 15.0), std::abs(p.y - 60.0)});
      EXPECT_LT(off, 1e-9);
    }
  }
}

TEST(Painting, PictureCrossesHalfTheStepOnTheEdge) {
  constexpr int kPlaces = 16;  // samples lie a quarter of a pixel apart: errors average out
  double errors = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double edge = 20 + (i + 0.5) / kPlaces;
    Painting painting(kWidth, kHeight, {});
    painting.add(box(edge, -50, 200, 200), 2, 0, 0);
    const Image<float> picture = painting.render(*make_runner(1));
    int x = 0;
    while (picture(x + 1, 45) < 1.0F) {
      ++x;
    }
    const double before = picture(x, 45);
    const double error = x + (1 - before) / (picture(x + 1, 45) - before) - edge;
    EXPECT_LT(std::abs(error), 0.14);
    errors += error;
    EXPECT_NEAR(picture(60, 45), 2, 1e-5);
    EXPECT_NEAR(picture(5, 45), 0, 1e-5);
  }
  EXPECT_NEAR(errors / kPlaces, 0, 0.01);
}

TEST(Painting, HiddenOutlinesAreNoEdges) {
  Painting painting(kWidth, kHeight, {});
  painting.add(box(20, 20, 60, 60), 1, 0, 0);
  painting.add(box(40, 10, 80, 70), -0.25, 0, 0);  // on the ground: its first corner is
  double of_lower = 0;
  for (const eval::Curve& curve : painting.edges().curves) {
    const bool lies_under = std::all_of(curve.points.begin(), curve.points.end(), [](auto p) {
      return p.x > 40.01 && p.x < 79.99 && p.y > 10.01 && p.y < 69.99;
    });
    EXPECT_FALSE(lies_under);
    if (std::abs(curve.contrast_counts - 1) < 1e-9) {
      of_lower += length_px(curve);
    }
  }
  EXPECT_NEAR(of_lower, 20 + 40 + 20, 2);
}

TEST(Painting, StepAcrossTwoThingsIsTheDifferenceOfTheirSurfaces) {
  Painting painting(kWidth, kHeight, {});
  painting.add(box(20, 20, 80, 60), 1, 0, 0);
  painting.add(box(40, 30, 60, 50), 0.3, 0.6, 0);  // slope: 0.6 over the width of the frame
  double sum = 0;
  int pieces = 0;
  for (const eval::Curve& curve : painting.edges().curves) {
    const bool left_side = std::all_of(curve.points.begin(), curve.points.end(),
                                       [](auto p) { return std::abs(p.x - 40) < 1e-9; });
    if (left_side) {
      sum += curve.contrast_counts;
      ++pieces;
    }
  }
  ASSERT_GT(pieces, 2);
  EXPECT_NEAR(sum / pieces, std::abs(0.3 + 0.6 * (40.0 / kWidth - 0.5)), 1e-9);
}

TEST(RandomScene, ShowsAStepAtEveryTrueEdgeAndNoneElsewhere) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const CleanScene scene = random_scene(seed);
    const auto& asked = scene.truth.annotators.front();
    const auto& accepted = scene.truth.accepted.front();
    std::vector<double> at_edges, elsewhere;
    const eval::CurveFrame marks = eval::pixels_as_curves(accepted);
    const eval::NearestOnCurves near(marks.curves, 7);
    for (int y = 8; y < asked.height() - 8; ++y) {
      for (int x = 8; x < asked.width() - 8; ++x) {
        if (asked(x, y) != 0) {
          at_edges.push_back(swing(scene.shares, x, y, 3));
        } else if (!near.is_near({double(x), double(y)})) {
          elsewhere.push_back(swing(scene.shares, x, y, 1));
        }
      }
    }
    double asked_px = 0;
    for (const eval::Curve& curve : scene.edges.curves) {
      const eval::Point at = curve.points.front();
      const bool inside = at.x > 8 && at.y > 8 && at.x < 374 && at.y < 280;
      asked_px += inside && curve.contrast_counts >= 0.04 ? length_px(curve) : 0;
    }
    EXPECT_NEAR(static_cast<double>(at_edges.size()), 0.9 * asked_px, 0.1 * asked_px);
    ASSERT_GT(elsewhere.size(), 5000U);
    // Where edges cross, blur may hide one.
    std::sort(at_edges.begin(), at_edges.end());
    EXPECT_GT(at_edges[at_edges.size() / 50], 0.6 * kLeastAskedShare);
    EXPECT_LT(*std::max_element(elsewhere.begin(), elsewhere.end()), 0.007);
  }
}

TEST(RandomScene, SpansItsRangeAndIsTheSameEveryTime) {
  const CleanScene one = random_scene(5);
  const CleanScene again = random_scene(5);
  const CleanScene other = random_scene(6);
  std::size_t within = 0;
  bool equal = true;
  bool differs = false;
  for (int y = 0; y < one.shares.height(); ++y) {
    for (int x = 0; x < one.shares.width(); ++x) {
      within += one.shares(x, y) >= 0 && one.shares(x, y) <= 1 ? 1 : 0;
      equal = equal && one.shares(x, y) == again.shares(x, y);
      differs = differs || one.shares(x, y) != other.shares(x, y);
    }
  }
  EXPECT_NEAR(static_cast<double>(within) / static_cast<double>(one.shares.size()), 0.99, 1e-3);
  EXPECT_TRUE(equal);
  EXPECT_TRUE(differs);
}

TEST(ExposedFrames, HaveTheNoiseAndStripesThatWereAskedFor) {
  const Image<std::uint16_t> striped = empty_frame(Emptiness::kStripes, 20, 3);
  const Image<std::uint16_t> plain = empty_frame(Emptiness::kPlain, 20, 3);
  const NoiseEstimate noise = NoiseEstimator().measure(striped);
  EXPECT_NEAR(noise.sigma_counts, 20, 0.6);
  EXPECT_NEAR(noise.column_sigma_counts, 20.0 / 3, 1.2);
  EXPECT_NEAR(noise.row_sigma_counts, 20.0 / 4, 1.2);
  EXPECT_LT(NoiseEstimator().measure(plain).column_sigma_counts, 1.5);
}

// The value half a pixel's width around a place.
double value_at(ImageView<const float> image, eval::Point at) {
  return image(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
}

TEST(SingleEdge, IsAStepOfItsContrastAlongItsPoints) {
  for (const double length : {16.0, 64.0, 200.0}) {
    for (const bool curved : {false, true}) {
      const SingleEdge edge = single_edge(length, curved, 100, 11);
      ASSERT_EQ(edge.points.size(), static_cast<std::size_t>(2 * length) + 1);
      const eval::Point middle = edge.points[edge.points.size() / 2];
      EXPECT_NEAR(value_at(edge.clean, middle), kMiddleCounts, 35);
      const double chord = std::hypot(edge.points.back().x - edge.points.front().x,
                                      edge.points.back().y - edge.points.front().y);
      EXPECT_NEAR(chord, curved ? 2.4 * length * std::sin(1 / 2.4) : length, 0.01);
    }
  }
}

// Half of the step stands on either side, along the whole edge, and fades over 35 px.
TEST(SingleEdge, HasStraightEndsAndFadesToBothSides) {
  constexpr double kLength = 64;
  const SingleEdge edge = single_edge(kLength, false, 100, 11);
  const eval::Point first = edge.points.front();
  const eval::Point last = edge.points.back();
  const eval::Point along{(last.x - first.x) / kLength, (last.y - first.y) / kLength};
  // Steps a way along the edge and beside it, less what the frame has.
  const auto height = [&](double way, double beside) {
    const eval::Point at{first.x + way * along.x - beside * along.y,
                         first.y + way * along.y + beside * along.x};
    return value_at(edge.clean, at) - kMiddleCounts;
  };
  for (const double way : {4.0, 32.0, 60.0}) {
    EXPECT_NEAR(height(way, 4), 50 * std::exp(-4 / 35.0), 2.5) << way;
    EXPECT_NEAR(height(way, -4), -50 * std::exp(-4 / 35.0), 2.5) << way;
  }
  EXPECT_NEAR(height(32, 20), 50 * std::exp(-20 / 35.0), 1.5);
  EXPECT_NEAR(height(32, -20), -50 * std::exp(-20 / 35.0), 1.5);
  EXPECT_NEAR(height(-4, 4), 0, 0.5);
  EXPECT_NEAR(height(kLength + 4, -4), 0, 0.5);
}

}  // namespace
}  // namespace thermedge::bench
