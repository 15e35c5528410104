#include "thermedge/stages/contrast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "support/edge_sets.hpp"
#include "support/images.hpp"

namespace thermedge {
namespace {

using test::add_edge;
using test::noise_image;
using Points = std::vector<std::pair<float, float>>;

double gaussian_step(double distance, double blur_px) {
  return 0.5 * std::erfc(-distance / (std::numbers::sqrt2 * blur_px));
}

// Counts 3000 + height * (blurred step of `distance(x, y)`) + noise.
template <class F>
Image<std::uint16_t> step_frame(int width, int height, double step, double blur_px, double sigma,
                                F&& distance) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal(0, 1);
  Image<std::uint16_t> frame(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double clean = 3000 + step * gaussian_step(distance(x, y), blur_px);
      frame(x, y) = static_cast<std::uint16_t>(std::lround(clean + sigma * normal(random)));
    }
  }
  return frame;
}

Points vertical_line(float x, int y_begin, int y_end) {
  Points points;
  for (int y = y_begin; y < y_end; ++y) {
    points.emplace_back(x, static_cast<float>(y));
  }
  return points;
}

// Nearest pixels of a circle, in walking order, each once.
Points circle(double x0, double y0, double radius) {
  Points points;
  for (int i = 0; i < 2000; ++i) {
    const double angle = i * std::numbers::pi / 1000;
    const std::pair<float, float> point{
        static_cast<float>(std::round(x0 + radius * std::cos(angle))),
        static_cast<float>(std::round(y0 + radius * std::sin(angle)))};
    if (points.empty() || (point != points.back() && point != points.front())) {
      points.push_back(point);
    }
  }
  return points;
}

TEST(Measure, GivesTheContrastOfASharpStep) {
  const auto frame = step_frame(60, 80, 200, 0.5, 5, [](int x, int) { return x - 30.0; });
  EdgeSet set;
  add_edge(set, vertical_line(30, 5, 75));
  measure_contrast(frame, 5, set);
  const Edge& edge = set.edges[0];
  EXPECT_NEAR(edge.contrast_counts, 200, 4);
  EXPECT_DOUBLE_EQ(edge.contrast_sigmas, edge.contrast_counts / 5);
  // By the three samples to each side, which the blur takes up to 2 % off.
  const double by_samples = edge.contrast_counts / (5 * std::sqrt(2 / (3 * 70.0)));
  EXPECT_LE(edge.z, by_samples * (1 + 1e-9));
  EXPECT_GE(edge.z, by_samples * 0.98);
  EXPECT_LT(edge.log10_nfa, -10000);
}

// What blur takes off near the edge, wherever in its pixel the edge lies, is put back.
TEST(Measure, GivesTheContrastBehindABlur) {
  for (const double blur_px : {0.5, 0.8, 1.0}) {
    for (const double offset : {-0.4, 0.0, 0.3, 0.5}) {
      const auto frame =
          step_frame(60, 80, 1000, blur_px, 0, [&](int x, int) { return x - 30.0 - offset; });
      EdgeSet set;
      add_edge(set, vertical_line(30, 5, 75));
      measure_contrast(frame, 0, set);
      EXPECT_NEAR(set.edges[0].contrast_counts, 1000, blur_px > 0.8 ? 40 : 10) << blur_px;
    }
  }
}

// No more is put back than blur may have taken off: a slope has no step.
TEST(Measure, DoesNotTakeASlopeForBlur) {
  Image<std::uint16_t> frame(60, 80);
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 60; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(1000 + 10 * x);
    }
  }
  EdgeSet set;
  add_edge(set, vertical_line(30, 5, 75));
  measure_contrast(frame, 0, set);
  EXPECT_NEAR(set.edges[0].contrast_counts, 1.06 * 50, 1e-9);
}

// Blur takes a known part of what is measured near the edge.
TEST(Measure, GivesTheDeviationsOfABlurredStep) {
  for (const double sign : {1.0, -1.0}) {
    const auto frame =
        step_frame(60, 80, 200, 1.0, 1, [&](int x, int) { return sign * (x - 30.0); });
    EdgeSet set;
    add_edge(set, vertical_line(30, 5, 75));
    measure_contrast(frame, 1, set);
    double expected = 0;
    for (const double distance : {1.5, 2.5, 3.5}) {
      const double ahead =
          gaussian_step(std::floor(distance), 1) + gaussian_step(std::ceil(distance), 1);
      expected += 200 * (ahead - 1) / 3;  // bilinear, half way between two columns
    }
    EXPECT_NEAR(set.edges[0].z, expected / std::sqrt(2 / (3 * 70.0)), 0.01 * set.edges[0].z);
    const double slope = 200 * (gaussian_step(1, 1) - gaussian_step(-1, 1)) / 2;
    for (std::size_t i = 0; i < 70; ++i) {
      EXPECT_EQ(set.edgels.nx[i], static_cast<float>(sign)) << "towards the warmer side";
      EXPECT_EQ(set.edgels.ny[i], 0.0F);
      EXPECT_NEAR(set.edgels.magnitude_counts[i], slope, 4);
      const double shift = 1 / set.edgels.magnitude_counts[i];
      EXPECT_NEAR(set.edgels.position_sigma_px[i], std::sqrt(1.0 / 12 + shift * shift), 1e-6);
    }
  }
}

TEST(Measure, PointsNormalsOfClosedCurvesToTheWarmSide) {
  for (const double sign : {1.0, -1.0}) {
    const auto frame = step_frame(80, 80, 300, 1.0, 2, [&](int x, int y) {
      return sign * (20 - std::hypot(x - 40.0, y - 40.0));
    });
    EdgeSet set;
    add_edge(set, circle(40, 40, 20), true);
    measure_contrast(frame, 2, set);
    for (std::size_t i = 0; i < set.edgels.x.size(); ++i) {
      const double dx = 40 - set.edgels.x[i];
      const double dy = 40 - set.edgels.y[i];
      const double inward = (set.edgels.nx[i] * dx + set.edgels.ny[i] * dy) / std::hypot(dx, dy);
      EXPECT_GT(sign * inward, std::cos(12 * std::numbers::pi / 180));
      EXPECT_NEAR(std::hypot(set.edgels.nx[i], set.edgels.ny[i]), 1, 1e-6);
    }
    EXPECT_NEAR(set.edges[0].contrast_counts, 285, 10);
  }
}

TEST(Measure, FindsLittleInPureNoise) {
  double sum_of_squares = 0;
  const int repeats = 400;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto frame = noise_image<std::uint16_t>(382, 288, 3000, 10, 5);
  EdgeSet set;
  for (int i = 0; i < repeats; ++i) {
    const double angle = uniform(random) * std::numbers::pi;
    const double x0 = 60 + uniform(random) * 260;
    const double y0 = 60 + uniform(random) * 160;
    const double step = 1 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
    Points points;
    for (int k = -20; k <= 20; ++k) {
      points.emplace_back(static_cast<float>(std::round(x0 + k * step * std::cos(angle))),
                          static_cast<float>(std::round(y0 + k * step * std::sin(angle))));
    }
    add_edge(set, points);
  }
  measure_contrast(frame, 10, set);
  double smallest_nfa = std::numeric_limits<double>::infinity();
  for (const Edge& edge : set.edges) {
    sum_of_squares += edge.z * edge.z;
    smallest_nfa = std::min(smallest_nfa, edge.log10_nfa);
  }
  const double spread = std::sqrt(sum_of_squares / repeats);
  EXPECT_GT(spread, 0.75);
  EXPECT_LT(spread, 1.05);
  EXPECT_GT(smallest_nfa, 0) << "more than one such edge is expected";
}

// A pair of points is one test, so the number of false alarms is the probability alone. The numbers
// are those of 2 Q(z) from tables of the normal distribution.
TEST(Measure, GivesProbabilitiesFarOutInTheTail) {
  const auto log10_nfa_at = [](double z) {
    Image<std::uint16_t> frame(20, 20);
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x) {
        frame(x, y) = x < 10 ? 1000 : (x > 10 ? 2000 : 1500);
      }
    }
    EdgeSet set;
    add_edge(set, {{10, 9}, {10, 10}});
    const double sigma = 1000 / z * std::sqrt(3.0);  // z = contrast / (sigma sqrt(2 / 6))
    measure_contrast(frame, sigma, set);
    const double expected_contrast = 1000;
    EXPECT_NEAR(set.edges[0].contrast_counts, expected_contrast, 1e-9);
    EXPECT_NEAR(set.edges[0].z, z, 1e-9 * z);
    return set.edges[0].log10_nfa;
  };
  EXPECT_NEAR(log10_nfa_at(1), std::log10(0.317310507863), 1e-9);
  EXPECT_NEAR(log10_nfa_at(5), std::log10(5.73303143758e-7), 1e-9);
  EXPECT_NEAR(log10_nfa_at(20), std::log10(5.5072482372e-89), 1e-8);
  EXPECT_NEAR(log10_nfa_at(40), std::log10(7.31178708183) - 350, 1e-8);
  const double below = log10_nfa_at(14.142);
  const double above = log10_nfa_at(14.143);
  EXPECT_NEAR(below - above, 14.1425 * 0.001 / std::numbers::ln10, 5e-5) << "where methods meet";
  EXPECT_NEAR(log10_nfa_at(1e5), -0.5e10 / std::numbers::ln10, 1e4);
}

TEST(Measure, CountsThePiecesOfAllCurvesAsTests) {
  Image<std::uint16_t> frame(40, 40);
  fill_pixels(frame.view(), std::uint16_t{1000});
  EdgeSet set;
  add_edge(set, vertical_line(10, 5, 15));  // 45 pieces
  add_edge(set, vertical_line(20, 5, 16));  // 55 pieces
  measure_contrast(frame, 5, set);
  for (const Edge& edge : set.edges) {
    EXPECT_EQ(edge.z, 0);
    EXPECT_DOUBLE_EQ(edge.log10_nfa, 2);
  }
}

TEST(Measure, OfAFrameWithoutNoiseIsCertain) {
  const auto frame = step_frame(30, 30, 100, 1, 0, [](int x, int) { return x - 15.0; });
  EdgeSet set;
  add_edge(set, vertical_line(15, 5, 25));
  add_edge(set, vertical_line(5, 5, 25));
  measure_contrast(frame, 0, set);
  EXPECT_EQ(set.edges[0].z, std::numeric_limits<double>::infinity());
  EXPECT_EQ(set.edges[0].log10_nfa, -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(set.edgels.position_sigma_px[0], 1 / std::sqrt(12.0), 1e-6);
  EXPECT_EQ(set.edges[0].contrast_sigmas, std::numeric_limits<double>::infinity());
  EXPECT_EQ(set.edges[1].contrast_sigmas, 0);
  EXPECT_EQ(set.edges[1].z, 0);
  EXPECT_TRUE(std::isfinite(set.edges[1].log10_nfa));
}

TEST(Measure, LeavesOutWhatLiesOutsideTheFrame) {
  const auto frame = step_frame(40, 40, 100, 0.5, 0, [](int x, int) { return x - 2.0; });
  EdgeSet set;
  add_edge(set, vertical_line(2, 5, 35));   // only the samples at 1.5 px fit
  add_edge(set, vertical_line(0, 5, 35));   // none fits
  add_edge(set, vertical_line(39, 0, 40));  // on the border, into the corners
  add_edge(set, {{-100, -100}, {-99, -100}, {1e9F, 5}});
  measure_contrast(frame, 5, set);
  EXPECT_NEAR(set.edges[0].contrast_counts, 97.7, 1);
  EXPECT_NEAR(set.edges[0].z, set.edges[0].contrast_counts / 5 * std::sqrt(30 / 2.0), 1e-9);
  for (const std::size_t i : {1U, 2U, 3U}) {
    EXPECT_EQ(set.edges[i].contrast_counts, 0);
    EXPECT_EQ(set.edges[i].z, 0);
  }
  EXPECT_EQ(set.edgels.magnitude_counts.back(), 0.0F);
  EXPECT_NEAR(set.edgels.position_sigma_px.back(), std::sqrt(1.0 / 12 + 2), 1e-6);
}

TEST(Measure, DoesNotDependOnTheWalkingDirection) {
  const auto frame = step_frame(80, 80, 300, 1.0, 4,
                                [&](int x, int y) { return 25 - std::hypot(x - 40.0, y - 40.0); });
  for (const bool closed : {false, true}) {
    Points points = circle(40, 40, 25);
    EdgeSet forward, backward;
    add_edge(forward, points, closed);
    std::reverse(points.begin(), points.end());
    add_edge(backward, points, closed);
    measure_contrast(frame, 4, forward);
    measure_contrast(frame, 4, backward);
    const std::size_t last = points.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      EXPECT_EQ(forward.edgels.nx[i], backward.edgels.nx[last - i]);
      EXPECT_EQ(forward.edgels.ny[i], backward.edgels.ny[last - i]);
    }
    EXPECT_NEAR(forward.edges[0].z, backward.edges[0].z, 1e-9 * forward.edges[0].z);
  }
}

TEST(Measure, SurvivesDegenerateEdges) {
  const auto frame = noise_image<std::uint16_t>(20, 20, 3000, 10, 1);
  EdgeSet set;
  add_edge(set, {});
  add_edge(set, {{5, 5}});
  add_edge(set, {{5, 5}}, true);
  add_edge(set, {{5, 5}, {6, 5}});
  add_edge(set, {{5, 5}, {6, 5}}, true);
  add_edge(set, {{5, 5}, {5, 5}, {5, 5}});
  measure_contrast(frame, 10, set);
  for (std::size_t i = 0; i < set.edgels.x.size(); ++i) {
    EXPECT_NEAR(std::hypot(set.edgels.nx[i], set.edgels.ny[i]), 1, 1e-6);
  }
  for (const Edge& edge : set.edges) {
    EXPECT_TRUE(std::isfinite(edge.z));
    EXPECT_TRUE(std::isfinite(edge.log10_nfa));
  }
  EdgeSet empty;
  measure_contrast(frame, 10, empty);
  set_normals_from_shape(empty);
  EXPECT_TRUE(empty.edges.empty());
}

TEST(Normals, FromShapeLieToTheRightOfTheWay) {
  EdgeSet set;
  add_edge(set, {{5, 5}, {6, 5}, {7, 5}, {8, 5}});
  add_edge(set, vertical_line(3, 0, 9));
  set_normals_from_shape(set);
  EXPECT_EQ(set.edgels.nx[1], 0.0F);
  EXPECT_EQ(set.edgels.ny[1], 1.0F) << "walking right, right-hand is down";
  EXPECT_EQ(set.edgels.nx[6], -1.0F) << "walking down, right-hand is left";
  EXPECT_EQ(set.edgels.ny[6], 0.0F);
}

// Pixel steps of a slanted line must not show in its normals.
TEST(Normals, OfSlantedLinesAreSmooth) {
  for (const double angle_deg : {10.0, 27.0, 45.0, 63.0, 80.0}) {
    const double angle = angle_deg * std::numbers::pi / 180;
    Points points;
    for (int i = 0; i < 60; ++i) {
      const double step = i / std::max(std::cos(angle), std::sin(angle));
      points.emplace_back(static_cast<float>(std::round(step * std::cos(angle))),
                          static_cast<float>(std::round(step * std::sin(angle))));
    }
    EdgeSet set;
    add_edge(set, points);
    set_normals_from_shape(set);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double cosine =
          set.edgels.nx[i] * -std::sin(angle) + set.edgels.ny[i] * std::cos(angle);
      EXPECT_GT(cosine, std::cos(10 * std::numbers::pi / 180)) << angle_deg << " at " << i;
    }
  }
}

}  // namespace
}  // namespace thermedge
