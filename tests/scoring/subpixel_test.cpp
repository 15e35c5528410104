// Positions between pixels: exact on a ridge with a Gaussian profile; and on steps in noise,
// through the whole robust detector.
#include "thermedge/stages/subpixel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "thermedge/detector.hpp"

namespace thermedge {
namespace {

EdgeSet one_edgel(float x, float y, double normal_degrees) {
  EdgeSet set;
  set.edgels.resize(1);
  set.edgels.x[0] = x;
  set.edgels.y[0] = y;
  set.edgels.nx[0] = static_cast<float>(std::cos(normal_degrees * std::numbers::pi / 180));
  set.edgels.ny[0] = static_cast<float>(std::sin(normal_degrees * std::numbers::pi / 180));
  Edge edge;
  edge.edgels = {0, 1};
  set.edges.push_back(edge);
  return set;
}

Image<float> ridge(double normal_degrees, double offset) {
  Image<float> response(11, 11);
  const double nx = std::cos(normal_degrees * std::numbers::pi / 180);
  const double ny = std::sin(normal_degrees * std::numbers::pi / 180);
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 11; ++x) {
      const double distance = nx * (x - 5) + ny * (y - 5) - offset;
      response(x, y) = static_cast<float>(20 * std::exp(-distance * distance / 5));
    }
  }
  return response;
}

TEST(RefinePositions, AreExactOnAGaussianRidge) {
  for (int degrees = 0; degrees < 180; degrees += 15) {
    for (const double offset : {-0.4, -0.1, 0.0, 0.3}) {
      EdgeSet set = one_edgel(5, 5, degrees);
      refine_positions(ridge(degrees, offset), KernelSize{1.2, 2.5}, 1, set, *make_runner(1));
      const double along_normal =
          (set.edgels.x[0] - 5) * set.edgels.nx[0] + (set.edgels.y[0] - 5) * set.edgels.ny[0];
      EXPECT_NEAR(along_normal, offset, 1e-4) << degrees << " degrees";
    }
  }
}

TEST(RefinePositions, TuningScalesTheStatedDeviation) {
  const auto deviation = [](const SubpixelTuning& tuning) {
    EdgeSet set = one_edgel(5, 5, 0);
    refine_positions(ridge(0, 0), KernelSize{1.2, 2.5}, 1, set, *make_runner(1), tuning);
    return set.edgels.position_sigma_px[0];
  };
  EXPECT_FLOAT_EQ(deviation({}), 1.25F / 20);
  EXPECT_FLOAT_EQ(deviation({.sigma_times_response = 2.5}), 2.5F / 20);
  EXPECT_FLOAT_EQ(deviation({.measured_kernel = {4.8, 2.5}}), 1.25F / 40);
}

TEST(RefinePositions, NeverLeaveThePixel) {
  EdgeSet set = one_edgel(5, 5, 0);
  refine_positions(ridge(0, 3), KernelSize{1.2, 2.5}, 1, set, *make_runner(1));
  EXPECT_NEAR(set.edgels.x[0], 5.499, 1e-3);
  EXPECT_EQ(set.edgels.y[0], 5);
}

TEST(RefinePositions, StayWhereThereIsNoMaximumAndAtTheBorder) {
  Image<float> flat(11, 11);
  fill_pixels(flat.view(), 1.0F);
  EdgeSet inside = one_edgel(5, 5, 30);
  refine_positions(flat, KernelSize{1.2, 2.5}, 1, inside, *make_runner(1));
  EXPECT_EQ(inside.edgels.x[0], 5);
  EdgeSet border = one_edgel(0, 10, 30);
  refine_positions(ridge(30, 0), KernelSize{1.2, 2.5}, 1, border, *make_runner(1));
  EXPECT_EQ(border.edgels.x[0], 0);
}

struct Errors {
  double bias = 0, rms = 0, told_rms = 0;
  int edgels = 0;
};

// Of the kept edgels on a step of 240 counts whose signed distance from each pixel is given.
Errors errors_of(double snr, const std::function<double(double, double)>& distance) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 240 / snr);
  auto detector = Detector::create(DetectorOptions(Preset::kRobust));
  Errors errors;
  for (int trial = 0; trial < 4; ++trial) {
    Image<std::uint16_t> frame(200, 160);
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 200; ++x) {
        const double step = 120 * std::erf(distance(x, y) / std::numbers::sqrt2);
        frame(x, y) = static_cast<std::uint16_t>(std::lround(8000 + step + normal(random)));
      }
    }
    const EdgeSet set = detector->detect(frame)->edges;
    for (const Edge& edge : set.kept_edges()) {
      for (std::uint32_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
        const double x = set.edgels.x[i];
        const double y = set.edgels.y[i];
        if (x < 15 || y < 15 || x > 184 || y > 144) {
          continue;
        }
        const double error = distance(x, y);
        errors.bias += error;
        errors.rms += error * error;
        errors.told_rms += set.edgels.position_sigma_px[i] * set.edgels.position_sigma_px[i];
        ++errors.edgels;
      }
    }
  }
  errors.bias /= errors.edgels;
  errors.rms = std::sqrt(errors.rms / errors.edgels);
  errors.told_rms = std::sqrt(errors.told_rms / errors.edgels);
  return errors;
}

std::function<double(double, double)> line(double degrees) {
  const double nx = std::cos(degrees * std::numbers::pi / 180);
  const double ny = std::sin(degrees * std::numbers::pi / 180);
  return [=](double x, double y) { return nx * (x - 100.2) + ny * (y - 80.4); };
}

TEST(RobustPositions, OfStraightEdges) {
  // The bound of Cramer and Rao for a step of 240 counts behind optics of 1 px, seen over the 8.9
  // rows that a kernel of 2.5 px along the edge counts for (2 sqrt(pi) 2.5): sigma / contrast *
  // sqrt(2 sqrt(pi) / 8.9).
  for (const double degrees : {0.0, 10.0, 45.0, 67.0}) {
    const Errors good = errors_of(20, line(degrees));
    ASSERT_GT(good.edgels, 450);
    EXPECT_LT(std::abs(good.bias), 0.02) << degrees;
    EXPECT_LT(good.rms, 0.06) << degrees;
    EXPECT_NEAR(good.told_rms / good.rms, 1, 0.6) << degrees;
    const Errors poor = errors_of(6, line(degrees));
    EXPECT_LT(std::abs(poor.bias), 0.05) << degrees;
    EXPECT_LT(poor.rms, 1.5 * std::sqrt(2 * std::sqrt(std::numbers::pi) / 8.9) / 6) << degrees;
    EXPECT_NEAR(poor.told_rms / poor.rms, 1, 0.6) << degrees;
  }
}

TEST(RobustPositions, OfCircles) {
  for (const double radius : {20.0, 40.0}) {
    const auto circle = [=](double x, double y) {
      return std::hypot(x - 100.3, y - 79.8) - radius;
    };
    const Errors errors = errors_of(20, circle);
    ASSERT_GT(errors.edgels, 400);
    EXPECT_LT(std::abs(errors.bias), 0.03) << radius;
    EXPECT_LT(errors.rms, 0.08) << radius;
  }
}

}  // namespace
}  // namespace thermedge
