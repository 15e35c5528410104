// Corners of moved, mirrored, transposed contours are the moved, mirrored, transposed corners.
#include "thermedge/stages/corners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/drawing.hpp"
#include "support/images.hpp"
#include "support/outlines.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::test {
namespace {

using Corners = std::vector<std::set<std::pair<int, int>>>;

// The corner pixels of each contour.
Corners corners_of(const ContourSet& contours, const CornerOptions& options = {}) {
  CornerSet found;
  EXPECT_TRUE(CornerFinder(options).run(contours, found));
  Corners corners;
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    corners.emplace_back();
    const auto pixels = contours.pixels(contours.items[i]);
    for (const std::uint32_t index : slice(std::as_const(found.indices), found.ranges[i])) {
      corners.back().emplace(pixels[index].x, pixels[index].y);
    }
  }
  return corners;
}

using Map = std::function<Pixel(Pixel)>;
struct Symmetry {
  std::string name;
  Map map;
};

// The eight of the square, each moved by an odd distance.
std::vector<Symmetry> symmetries() {
  return {{"moved",
           [](Pixel p) {
             return Pixel{p.x + 4001, p.y - 613};
           }},
          {"moved far",
           [](Pixel p) {
             return Pixel{p.x - 70003, p.y + 90001};
           }},
          {"mirrored in x",
           [](Pixel p) {
             return Pixel{381 - p.x, p.y};
           }},
          {"mirrored in y",
           [](Pixel p) {
             return Pixel{p.x, 287 - p.y};
           }},
          {"turned by 180",
           [](Pixel p) {
             return Pixel{7 - p.x, 19 - p.y};
           }},
          {"transposed",
           [](Pixel p) {
             return Pixel{p.y, p.x};
           }},
          {"turned by 90",
           [](Pixel p) {
             return Pixel{p.y, 381 - p.x};
           }},
          {"turned by 270",
           [](Pixel p) {
             return Pixel{287 - p.y, p.x};
           }},
          {"transposed the other way", [](Pixel p) {
             return Pixel{500 - p.y, 400 - p.x};
           }}};
}

Corners mapped(const Corners& corners, const Map& map) {
  Corners moved;
  for (const auto& set : corners) {
    moved.emplace_back();
    for (const auto& [x, y] : set) {
      const Pixel at = map({x, y});
      moved.back().emplace(at.x, at.y);
    }
  }
  return moved;
}

ContourSet mapped(const ContourSet& contours, const Map& map) {
  ContourSet moved = contours;
  std::transform(moved.points.begin(), moved.points.end(), moved.points.begin(), map);
  return moved;
}

ContourSet backwards(ContourSet contours) {
  for (const Contour& contour : contours.items) {
    const auto pixels = slice(contours.points, contour.points);
    std::reverse(pixels.begin(), pixels.end());
  }
  return contours;
}

// Closed contours begin elsewhere.
ContourSet begun_elsewhere(ContourSet contours, std::mt19937& random) {
  for (const Contour& contour : contours.items) {
    const auto pixels = slice(contours.points, contour.points);
    if (contour.closed) {
      std::rotate(pixels.begin(),
                  pixels.begin() + static_cast<std::ptrdiff_t>(random() % pixels.size()),
                  pixels.end());
    }
  }
  return contours;
}

// Returns the number of corners.
std::size_t expect_equivariant(const ContourSet& contours, const CornerOptions& options = {}) {
  std::mt19937 random(5);
  const Corners corners = corners_of(contours, options);
  for (const auto& [name, map] : symmetries()) {
    SCOPED_TRACE(name);
    const ContourSet moved = mapped(contours, map);
    const Corners wanted = mapped(corners, map);
    EXPECT_TRUE(corners_of(moved, options) == wanted);
    EXPECT_TRUE(corners_of(backwards(moved), options) == wanted) << "backwards";
    EXPECT_TRUE(corners_of(begun_elsewhere(moved, random), options) == wanted) << "begun elsewhere";
    EXPECT_TRUE(corners_of(backwards(begun_elsewhere(moved, random)), options) == wanted)
        << "begun elsewhere, backwards";
  }
  std::size_t count = 0;
  for (const auto& set : corners) {
    count += set.size();
  }
  return count;
}

// Walks that keep their direction for a while, closed or not.
ContourSet random_contours(unsigned seed) {
  constexpr Pixel kSteps[8] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                               {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  std::mt19937 random(seed);
  ContourSet contours;
  for (int i = 0; i < 300; ++i) {
    const std::size_t length = 1 + random() % (i % 3 == 0 ? 12U : 250U);
    std::size_t direction = random() % 8;
    const std::size_t restless = 2 + random() % 30;
    std::vector<Pixel> pixels{{static_cast<int>(random() % 382), static_cast<int>(random() % 288)}};
    while (pixels.size() < length) {
      direction = random() % restless == 0 ? (direction + 7 + random() % 3) % 8 : direction;
      pixels.push_back(
          {pixels.back().x + kSteps[direction].x, pixels.back().y + kSteps[direction].y});
    }
    add_contour(contours, pixels, i % 2 == 0);
  }
  return contours;
}

TEST(CornersOfMovedContours, OfRandomWalksAreMoved) {
  for (const double sigma_px : {0.5, 1.0, 3.0, 10.0}) {
    CornerOptions options;
    options.sigma_px = sigma_px;
    EXPECT_GT(expect_equivariant(random_contours(3), options), 600U) << "sigma " << sigma_px;
  }
}

// Symmetric shapes are where ties come from.
TEST(CornersOfMovedContours, OfSymmetricShapesAreMoved) {
  ContourSet contours;
  for (int size = 3; size < 30; ++size) {
    for (const double centre : {100.0, 100.5}) {
      for (const double degrees : {0.0, 22.5, 45.0}) {
        add_contour(contours, outline_pixels(polygon_points({centre, centre}, size, 4, degrees)),
                    true);
        add_contour(contours, outline_pixels(polygon_points({centre, centre}, size, 8, degrees)),
                    true);
      }
      add_contour(contours, line_pixels(bend_points({centre, centre}, size, 0, 90)));
      add_contour(contours, line_pixels(bend_points({centre, centre}, size, 45, 90)));
      add_contour(contours, line_pixels(zigzag_points({centre, centre}, size, 4, 45, 90)));
    }
  }
  EXPECT_GT(expect_equivariant(contours), 1000U);
}

TEST(CornersOfMovedContours, OfRecordedFramesAreMoved) {
  THERMEDGE_NEEDS_SHARED("data/optris_pi450");
  auto detector = Detector::create(DetectorOptions(Preset::kFast));
  ASSERT_TRUE(detector);
  std::size_t corners = 0;
  for (const char* name : {"frame000000.png", "frame000040.png", "frame000077.png"}) {
    const auto frame = io::read_picture((shared_directory() / "data/optris_pi450" / name).string());
    ASSERT_TRUE(frame);
    Detection detection;
    Intermediates steps;
    ASSERT_TRUE(detector->detect(frame->frame(), detection, {&steps, {}}));
    corners += expect_equivariant(steps.linked.contours);
  }
  EXPECT_GT(corners, 500U);
}

// Transposed maps are walked in another order; whole detector, from edge pixels on.
TEST(CornersOfMovedMaps, AreMoved) {
  auto map = blank_map(120, 90);
  for (const auto& points :
       {polygon_points({40.3, 45.2}, 25, 4, 17), polygon_points({90.4, 40.1}, 20, 3, 50)}) {
    for (const Pixel pixel : outline_pixels(points)) {
      map(pixel.x, pixel.y) = 255;
    }
  }
  for (const Pixel pixel : line_pixels(bend_points({60.5, 78.2}, 30, 10, -60))) {
    map(pixel.x, pixel.y) = 255;
  }
  auto detector = Detector::create(DetectorOptions(Preset::kRobust));
  ASSERT_TRUE(detector);
  const auto corners_in = [&](int width, int height, const Map& to) {
    auto moved = blank_map(width, height);
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const Pixel at = to({x, y});
        moved(at.x, at.y) = map(x, y);
      }
    }
    const EdgeSet set = detector->trace(moved)->edges;
    std::set<std::pair<int, int>> corners;
    for (const Edge& edge : set.edges) {
      for (const std::uint32_t corner : set.corners_of(edge)) {
        const std::size_t i = edge.edgels.first + corner;
        corners.emplace(static_cast<int>(set.edgels.x[i]), static_cast<int>(set.edgels.y[i]));
      }
    }
    return corners;
  };
  const Corners corners{corners_in(120, 90, [](Pixel p) { return p; })};
  EXPECT_GE(corners[0].size(), 9U);
  const Map moved = [](Pixel p) { return Pixel{p.x + 40, p.y + 60}; };
  const Map transposed = [](Pixel p) { return Pixel{p.y, p.x}; };
  const Map mirrored = [](Pixel p) { return Pixel{119 - p.x, p.y}; };
  EXPECT_EQ(corners_in(160, 150, moved), mapped(corners, moved)[0]);
  EXPECT_EQ(corners_in(90, 120, transposed), mapped(corners, transposed)[0]);
  EXPECT_EQ(corners_in(120, 90, mirrored), mapped(corners, mirrored)[0]);
}

}  // namespace
}  // namespace thermedge::test
