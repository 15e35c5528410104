// The built-in scenes' pictures and true edges against each other: every step of a picture has its
// edge, and every edge lies where its step is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {
namespace {

// Noise-free, with distortion and vignetting.
TrueFrame clean_frame(const std::string& scene, const std::string& path, int index) {
  auto options = parse_scene("sim:" + scene + "?camera=pi450&frames=400&least_contrast=1");
  EXPECT_TRUE(set_scene_key("path", path, *options));
  auto frame = render(*options, index);
  EXPECT_TRUE(frame) << frame.error().message;
  return std::move(*frame);
}

double at(ImageView<const float> image, double x, double y) {
  const int i = std::clamp(static_cast<int>(x), 0, image.width() - 2);
  const int j = std::clamp(static_cast<int>(y), 0, image.height() - 2);
  const double s = x - i;
  const double t = y - j;
  const auto value = [&](int dx, int dy) { return static_cast<double>(image(i + dx, j + dy)); };
  return (value(0, 0) * (1 - s) + value(1, 0) * s) * (1 - t) +
         (value(0, 1) * (1 - s) + value(1, 1) * s) * t;
}

// Marks all pixels within `reach` of a true edge.
Image<std::uint8_t> near_edges(const TrueFrame& frame, int reach) {
  Image<std::uint8_t> map(frame.clean.width(), frame.clean.height());
  fill_pixels(map.view(), std::uint8_t{0});
  for (const TrueEdge& edge : frame.edges) {
    for (const Point p : edge.points) {
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const int x = static_cast<int>(std::lround(p.x)) + dx;
          const int y = static_cast<int>(std::lround(p.y)) + dy;
          if (map.view().contains(x, y)) {
            map(x, y) = 1;
          }
        }
      }
    }
  }
  return map;
}

constexpr double kReach = 6;

// Where a profile steps from one straight line to another: there both, cut off sharply, have the
// same sum as the profile, which blur doesn't change.
double step_position(const auto& along) {
  const double low_slope = along(-kReach + 2) / 2 - along(-kReach) / 2;
  const double high_slope = along(kReach) / 2 - along(kReach - 2) / 2;
  const auto low = [&](double t) { return along(-kReach) + low_slope * (t + kReach); };
  const auto gap = [&](double t) { return along(kReach) + high_slope * (t - kReach) - low(t); };
  double sum = 0;
  constexpr int kParts = 240;
  constexpr double kStep = 2 * kReach / kParts;
  for (int i = 0; i < kParts; ++i) {
    const double t = -kReach + (i + 0.5) * kStep;
    sum += (along(t) - low(t)) * kStep;
  }
  double position = 0;
  for (int i = 0; i < 8; ++i) {
    const double behind = (gap(position) + gap(kReach)) / 2 * (kReach - position);
    position += (behind - sum) / gap(position);
  }
  return position;
}

struct Case {
  const char* scene;
  const char* path;
  int index;
};

class SceneTruth : public testing::TestWithParam<Case> {};

TEST_P(SceneTruth, HasAnEdgeForEveryStep) {
  constexpr double kSteep = 12;  // counts a pixel: more than any face's own gradient
  const TrueFrame frame = clean_frame(GetParam().scene, GetParam().path, GetParam().index);
  const Image<std::uint8_t> known = near_edges(frame, 4);
  int steep = 0;
  int unknown = 0;
  std::string places;
  constexpr int kBorder = 5;  // steps of edges beyond the border reach in
  for (int y = kBorder; y + kBorder < frame.clean.height(); ++y) {
    for (int x = kBorder; x + kBorder < frame.clean.width(); ++x) {
      const double dx = static_cast<double>(frame.clean(x + 1, y) - frame.clean(x - 1, y)) / 2;
      const double dy = static_cast<double>(frame.clean(x, y + 1) - frame.clean(x, y - 1)) / 2;
      if (std::hypot(dx, dy) > kSteep) {
        ++steep;
        if (known(x, y) == 0) {
          ++unknown;
          places += " " + std::to_string(x) + "," + std::to_string(y);
        }
      }
    }
  }
  EXPECT_GT(steep, 1000);
  EXPECT_EQ(unknown, 0) << places;
}

// The step along the normal, where no other edge is near: its middle is the edge.
TEST_P(SceneTruth, LiesWhereTheStepIs) {
  const TrueFrame frame = clean_frame(GetParam().scene, GetParam().path, GetParam().index);
  std::vector<double> offsets;
  for (const TrueEdge& edge : frame.edges) {
    if (edge.contrast_counts < 60) {
      continue;
    }
    for (std::size_t i = 20; i + 20 < edge.points.size(); i += 10) {
      const Point p = edge.points[i];
      const Point a = edge.points[i - 1];
      const Point b = edge.points[i + 1];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      const Point n{-(b.y - a.y) / length, (b.x - a.x) / length};
      const bool alone =
          std::none_of(frame.edges.begin(), frame.edges.end(), [&](const auto& other) {
            return &other != &edge &&
                   std::any_of(other.points.begin(), other.points.end(), [&](const Point q) {
                     return std::hypot(q.x - p.x, q.y - p.y) < 1.7 * kReach;
                   });
          });
      if (!alone || p.x < 8 || p.y < 8 || p.x > 373 || p.y > 279) {
        continue;
      }
      const auto along = [&](double t) { return at(frame.clean, p.x + t * n.x, p.y + t * n.y); };
      offsets.push_back(step_position(along));
    }
  }
  ASSERT_GT(offsets.size(), 30U);
  std::sort(offsets.begin(), offsets.end());
  const auto quantile = [&](double share) {
    return offsets[static_cast<std::size_t>(share * static_cast<double>(offsets.size() - 1))];
  };
  std::printf("%s: %zu places, median %.4f px, 5 %% %.3f, 95 %% %.3f\n", GetParam().scene,
              offsets.size(), quantile(0.5), quantile(0.05), quantile(0.95));
  EXPECT_NEAR(quantile(0.5), 0, 0.02);
  EXPECT_GT(quantile(0.05), -0.1);
  EXPECT_LT(quantile(0.95), 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, SceneTruth,
                         testing::Values(Case{"desk", "hand", 0}, Case{"desk", "drive", 300},
                                         Case{"corridor", "hand", 7},
                                         Case{"corridor", "drive", 399}, Case{"office", "hand", 0},
                                         Case{"office", "pan", 150}, Case{"road", "hand", 0},
                                         Case{"road", "drive", 200}),
                         [](const auto& test) {
                           return std::string(test.param.scene) + "_" + test.param.path;
                         });

}  // namespace
}  // namespace thermedge::sim
