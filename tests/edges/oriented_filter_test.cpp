// Oriented kernels: their gain, what they find, and what they are blind to.
#include "thermedge/stages/oriented_filter.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "support/images.hpp"

namespace thermedge {
namespace {

struct Found {
  Image<float> response, suppressed_response;
  Image<std::int32_t> direction;
  Image<std::uint8_t> edges;
};

Found find(ImageView<const float> frame, double sigma, const OrientedFilterOptions& options = {},
           int threads = 1) {
  const auto runner = make_runner(threads);
  OrientedFilterBank detector(options);
  const auto result = detector.run(frame, sigma, 1, *runner);
  EXPECT_TRUE(result) << result.error().message;
  Found found;
  const auto take = [&](auto view, auto& image) {
    image.resize(view.width(), view.height());
    copy_pixels(view, image.view());
  };
  take(result->response, found.response);
  take(result->direction, found.direction);
  take(result->edges, found.edges);
  found.suppressed_response.resize(frame.width(), frame.height());
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      found.suppressed_response(x, y) =
          found.edges(x, y) != 0 ? result->suppressed_response(x, y) : 0;
    }
  }
  return found;
}

// A step of `contrast` across a line through (50.3, 50.2) whose normal has this angle, blurred by
// the optics (sigma 1 px).
Image<float> step(double degrees, double contrast) {
  const double nx = std::cos(degrees * std::numbers::pi / 180);
  const double ny = std::sin(degrees * std::numbers::pi / 180);
  Image<float> frame(101, 101);
  for (int y = 0; y < 101; ++y) {
    for (int x = 0; x < 101; ++x) {
      const double distance = nx * (x - 50.3) + ny * (y - 50.2);
      frame(x, y) =
          static_cast<float>(3000 + contrast / 2 * std::erf(distance / std::numbers::sqrt2));
    }
  }
  return frame;
}

TEST(OrientedFilterBank, FindStepsOfAnyDirectionWhereTheyAre) {
  for (int degrees = 0; degrees < 360; degrees += 10) {
    const Found found = find(step(degrees, 20), 10);
    const double nx = std::cos(degrees * std::numbers::pi / 180);
    const double ny = std::sin(degrees * std::numbers::pi / 180);
    int number = 0;
    for (int y = 15; y < 86; ++y) {
      for (int x = 15; x < 86; ++x) {
        if (found.edges(x, y) == 0) {
          continue;
        }
        ++number;
        EXPECT_LE(std::abs(nx * (x - 50.3) + ny * (y - 50.2)), 0.9) << degrees << " degrees";
        // The kernel looks along the edge; which side is warmer tells the half turn.
        const double along = found.direction(x, y) * std::numbers::pi / 12;
        EXPECT_GE(-std::sin(along) * nx + std::cos(along) * ny, std::cos(0.2));
      }
    }
    EXPECT_GE(number, 68) << degrees << " degrees";
  }
}

TEST(OrientedFilterBank, NoiseOfOneSigmaGivesResponsesOfOneSigma) {
  const auto noise = test::noise_image<float>(300, 300, 3000, 7, 4);
  OrientedFilterOptions options;
  options.low = options.high = 1e-3;
  const Found found = find(noise, 7, options);
  // Mean of the largest of twelve correlated responses, each of deviation 1.
  double sum = 0;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 300; ++x) {
      sum += found.response(x, y);
    }
  }
  EXPECT_NEAR(sum / 90000, 1.45, 0.1);
}

TEST(OrientedFilterBank, AStepAnswersInUnitsOfTheNoise) {
  const Found ten = find(step(0, 100), 10);
  const Found five = find(step(0, 100), 5);
  EXPECT_NEAR(five.response(50, 50), 2 * ten.response(50, 50), 1e-3);
  EXPECT_NEAR(ten.response(50, 50) / 10, 2.4, 0.3);
}

TEST(OrientedFilterBank, TuningSaysWhereTheSidesOfAnEdgeLie) {
  const Image<float> frame = step(0, 100);
  const auto response_over_sides = [&](std::array<int, 2> sides) {
    OrientedFilterBank filter({}, {.side_distances_px = sides});
    const auto runner = make_runner(1);
    const auto found = filter.run(frame, 10, 1, *runner);
    return found ? found->suppressed_response(50, 50) : 0.0F;
  };
  EXPECT_LT(response_over_sides({1, 1}), 0.5F * response_over_sides({4, 8}));
}

TEST(OrientedFilterBank, ASlopeIsNoEdge) {
  Image<float> slope(120, 90);
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) {
      slope(x, y) = static_cast<float>(std::lround(3000 + 0.5 * x + 0.2 * y));
    }
  }
  const Found found = find(slope, 1);
  int edges = 0;
  for (int y = 12; y < 78; ++y) {
    for (int x = 12; x < 108; ++x) {
      edges += found.edges(x, y) != 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(edges, 0);
}

TEST(OrientedFilterBank, TransposingAFrameTransposesTheEdges) {
  auto frame = step(33, 30);
  const auto noise = test::noise_image<float>(101, 101, 0, 4, 9);
  Image<float> transposed(101, 101);
  for (int y = 0; y < 101; ++y) {
    for (int x = 0; x < 101; ++x) {
      frame(x, y) += noise(x, y);
      transposed(y, x) = frame(x, y);
    }
  }
  const Found a = find(frame, 10);
  const Found b = find(transposed, 10);
  int differ = 0;
  int edges = 0;
  for (int y = 0; y < 101; ++y) {
    for (int x = 0; x < 101; ++x) {
      EXPECT_NEAR(a.response(x, y), b.response(y, x), 1e-3);
      edges += a.edges(x, y) != 0 ? 1 : 0;
      differ += a.edges(x, y) != b.edges(y, x) ? 1 : 0;
    }
  }
  EXPECT_GT(edges, 100);
  EXPECT_LE(differ, edges / 50);
}

TEST(OrientedFilterBank, AreTheSameOnEveryTargetAndRunner) {
  const auto frame = test::noise_image<float>(157, 93, 3000, 20, 2);
  Found expected;
  test::for_each_simd_target([&](const std::string&) {
    for (const int threads : {1, 3}) {
      Found found = find(frame, 15, {}, threads);
      if (expected.response.empty()) {
        expected = std::move(found);
        continue;
      }
      EXPECT_TRUE(test::same_pixels<float>(found.response, expected.response));
      EXPECT_TRUE(test::same_pixels<std::uint8_t>(found.edges, expected.edges));
      EXPECT_TRUE(test::same_pixels<std::int32_t>(found.direction, expected.direction));
    }
  });
}

TEST(OrientedFilterBank, TakeAnySize) {
  for (int height = 1; height < 30; height += 4) {
    for (int width = 1; width < 30; ++width) {
      find(test::noise_image<float>(width, height, 100, 5, 3), 5);
    }
  }
}

TEST(OrientedFilterBank, RefuseWhatTheyCannotDo) {
  const auto runner = make_runner(1);
  const auto frame = test::noise_image<float>(20, 20, 100, 5, 3);
  const auto message = [&](ImageView<const float> in, double sigma,
                           const OrientedFilterOptions& options) {
    OrientedFilterBank detector(options);
    const auto result = detector.run(in, sigma, 1, *runner);
    return result ? std::string("none") : result.error().message;
  };
  EXPECT_NE(message({}, 1, {}).find("no pixels"), std::string::npos);
  EXPECT_NE(message(frame, 0, {}).find("noise"), std::string::npos);
  EXPECT_NE(message(frame, std::nan(""), {}).find("noise"), std::string::npos);
  OrientedFilterOptions options;
  options.along_px = 1;
  EXPECT_NE(message(frame, 1, options).find("oriented_filter.along_px"), std::string::npos);
  options = {};
  options.low = 2;
  EXPECT_NE(message(frame, 1, options).find("oriented_filter.high"), std::string::npos);
  options = {};
  options.across_px = 5;
  EXPECT_NE(message(frame, 1, options).find("oriented_filter.a"), std::string::npos);
  auto broken = frame.clone();
  broken(3, 4) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(message(broken, 1, {}).find("(3, 4)"), std::string::npos);
}

}  // namespace
}  // namespace thermedge
