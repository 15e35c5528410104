#include "thermedge/edge_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "support/edge_sets.hpp"
#include "support/images.hpp"

namespace thermedge {
namespace {

using test::add_edge;
using test::GuardedImage;

// Edges of random pixels, some outside, some shared; the last one is not kept.
EdgeSet random_edges(int width, int height, int edges, unsigned seed) {
  std::mt19937 random(seed);
  EdgeSet set;
  for (int i = 0; i < edges; ++i) {
    std::vector<std::pair<float, float>> points(1 + random() % 5);
    for (auto& [x, y] : points) {
      x = static_cast<float>(random() % static_cast<unsigned>(10 * width + 20)) / 10 - 1;
      y = static_cast<float>(random() % static_cast<unsigned>(10 * height + 20)) / 10 - 1;
    }
    add_edge(set, points, false, i + 1 < edges);
  }
  return set;
}

struct Place {
  int x;
  int y;
};
Place pixel_of(const Edgels& edgels, std::size_t i) {
  return {static_cast<int>(std::floor(edgels.x[i] + 0.5)),
          static_cast<int>(std::floor(edgels.y[i] + 0.5))};
}

// Every pixel against every kept edgel.
void expect_exact(const EdgeSet& set, int width, int height, float max_distance,
                  const DistanceField& field) {
  ASSERT_EQ(field.distance_px.width(), width);
  ASSERT_EQ(field.nearest.height(), height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int best = std::numeric_limits<int>::max();
      std::int32_t nearest = -1;
      for (std::size_t i = 0; i < set.edgels.x.size(); ++i) {
        const Place at = pixel_of(set.edgels, i);
        const bool kept = set.edges[static_cast<std::size_t>(set.edgels.edge[i])].kept;
        const int squared = (at.x - x) * (at.x - x) + (at.y - y) * (at.y - y);
        const bool inside = at.x >= 0 && at.y >= 0 && at.x < width && at.y < height;
        if (kept && inside && squared < best) {
          best = squared;
          nearest = static_cast<std::int32_t>(i);
        }
      }
      const bool far = nearest < 0 || std::sqrt(static_cast<double>(best)) > max_distance;
      ASSERT_EQ(field.nearest(x, y), far ? -1 : nearest) << x << ", " << y;
      ASSERT_EQ(field.distance_px(x, y),
                far ? max_distance : static_cast<float>(std::sqrt(static_cast<double>(best))))
          << x << ", " << y;
    }
  }
}

TEST(DistanceTransform, AgreesWithBruteForce) {
  DistanceTransform transform;
  DistanceField field;
  unsigned seed = 0;
  for (int width = 1; width <= 20; ++width) {
    for (int height = 1; height <= 20; height += 1 + width % 3) {
      for (const int edges : {1, 2, 5, 40}) {
        SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
        const EdgeSet set = random_edges(width, height, edges, ++seed);
        for (const float max_distance : {0.5F, 3.0F, 100.0F}) {
          transform.run(set, width, height, max_distance, field);
          ASSERT_NO_FATAL_FAILURE(expect_exact(set, width, height, max_distance, field));
        }
      }
    }
  }
}

// A ring around a pixel: all edgels tie there, and the first of them must win.
TEST(DistanceTransform, BreaksTiesByIndex) {
  const std::vector<std::pair<float, float>> ring = {{15, 10}, {10, 15}, {5, 10}, {10, 5},
                                                     {13, 14}, {14, 13}, {14, 7}, {13, 6},
                                                     {7, 6},   {6, 7},   {6, 13}, {7, 14}};
  for (std::size_t first = 0; first < ring.size(); ++first) {
    EdgeSet set;
    std::vector<std::pair<float, float>> points = {ring[first]};
    points.insert(points.end(), ring.begin(), ring.end());
    add_edge(set, points);
    DistanceTransform transform;
    DistanceField field;
    transform.run(set, 21, 21, 20, field);
    EXPECT_EQ(field.nearest(10, 10), 0);
    EXPECT_EQ(field.distance_px(10, 10), 5.0F);
    expect_exact(set, 21, 21, 20, field);
  }
}

TEST(DistanceTransform, OfNothingIsFarEverywhere) {
  DistanceTransform transform;
  DistanceField field;
  transform.run({}, 5, 4, 7, field);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(field.distance_px(x, y), 7.0F);
      EXPECT_EQ(field.nearest(x, y), -1);
    }
  }
}

// Two edges that cross at (3, 2), and one that is not kept.
EdgeSet cross() {
  EdgeSet set;
  add_edge(set, {{1, 2}, {2, 2}, {3.4F, 1.6F}, {4, 2}, {5, 2}}).display_strength = 1;
  add_edge(set, {{3, 0}, {3, 1}, {3, 2}, {3, 3}, {3, 400}}).display_strength = 0.5;
  add_edge(set, {{5, 2}, {6, 3}, {-1, 0}}, false, false);
  return set;
}

template <class T>
void expect_pixels(ImageView<T> image, const std::vector<std::vector<int>>& expected) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      EXPECT_EQ(image(x, y), expected[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)])
          << x << ", " << y;
    }
  }
}

TEST(Drawing, MaskShowsKeptEdges) {
  GuardedImage<std::uint8_t> mask(8, 4);
  draw_mask(cross(), mask.view());
  expect_pixels(mask.view(), {{0, 0, 0, 255, 0, 0, 0, 0},
                              {0, 0, 0, 255, 0, 0, 0, 0},
                              {0, 255, 255, 255, 255, 255, 0, 0},
                              {0, 0, 0, 255, 0, 0, 0, 0}});
  EXPECT_TRUE(mask.intact());
}

TEST(Drawing, LabelsShowTheBetterEdgeWhereTwoCross) {
  GuardedImage<std::uint16_t> labels(8, 4);
  EdgeSet set = cross();
  set.edges[0].index = 70000;
  draw_labels(set, labels.view());
  expect_pixels(labels.view(), {{0, 0, 0, 2, 0, 0, 0, 0},
                                {0, 0, 0, 2, 0, 0, 0, 0},
                                {0, 65535, 65535, 65535, 65535, 65535, 0, 0},
                                {0, 0, 0, 2, 0, 0, 0, 0}});
  EXPECT_TRUE(labels.intact());
}

TEST(Drawing, StrengthOfAllEdges) {
  GuardedImage<std::uint8_t> strength(8, 4);
  draw_strength(cross(), strength.view());
  expect_pixels(strength.view(), {{0, 0, 0, 128, 0, 0, 0, 0},
                                  {0, 0, 0, 128, 0, 0, 0, 0},
                                  {0, 255, 255, 255, 255, 255, 0, 0},
                                  {0, 0, 0, 128, 0, 0, 1, 0}});
  EXPECT_TRUE(strength.intact());
}

TEST(Drawing, OfNothingClearsTheImage) {
  Image<std::uint8_t> mask(3, 2);
  fill_pixels(mask.view(), std::uint8_t{9});
  draw_mask({}, mask);
  expect_pixels(mask.view(), {{0, 0, 0}, {0, 0, 0}});
  fill_pixels(mask.view(), std::uint8_t{9});
  draw_strength({}, mask);
  expect_pixels(mask.view(), {{0, 0, 0}, {0, 0, 0}});
}

// A map drawn as text, '#' for an edge pixel.
MapCount count(const std::vector<std::string>& rows) {
  Image<std::uint8_t> map(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      map(x, y) = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#' ? 255 : 0;
    }
  }
  return count_fragments(map);
}

TEST(Fragments, AreGroupsOfTouchingPixels) {
  const MapCount found = count({"#.#..##", ".#....#", "#......", "....#..", "...#..#"});
  EXPECT_EQ(found.edge_pixels, 10U);
  EXPECT_EQ(found.fragments, 4U);  // corners touch
  EXPECT_EQ(count({"....", "...."}).fragments, 0U);
  EXPECT_EQ(count({"###", "###"}).fragments, 1U);
  EXPECT_EQ(count({"###", "###"}).edge_pixels, 6U);
}

}  // namespace
}  // namespace thermedge
