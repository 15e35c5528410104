// The tracing rule: order, closedness, what is dropped, junctions; and against a slow reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "support/drawing.hpp"
#include "support/images.hpp"
#include "thermedge/stages/contours.hpp"

namespace thermedge::test {
namespace {

// Keeps every pixel, so that a test sees the walk alone.
ContourOptions keep_all() {
  ContourOptions options;
  options.min_component_px = 0;
  options.min_length_px = 1;
  return options;
}

ContourSet trace(ImageView<const std::uint8_t> map, const ContourOptions& options) {
  ContourSet contours;
  const Status status = ContourTracer(options).run(map, contours);
  EXPECT_TRUE(status) << status.error().message;
  return contours;
}

Image<std::uint8_t> map_of(const std::vector<Pixel>& pixels, int width, int height) {
  auto map = blank_map(width, height);
  for (const Pixel pixel : pixels) {
    map(pixel.x, pixel.y) = 1;
  }
  return map;
}

std::vector<Pixel> junctions_of(const ContourSet& contours) {
  std::vector<Pixel> pixels;
  for (const Junction& junction : contours.junctions) {
    pixels.push_back(junction.at);
  }
  return pixels;
}

// The rule of the paper, in the plainest words: all candidates are looked at in every step.
class SlowTracer {
 public:
  SlowTracer(ImageView<const std::uint8_t> map, int gap_px) : gap_px_(gap_px) {
    for (int x = 0; x < map.width(); ++x) {
      for (int y = 0; y < map.height(); ++y) {
        if (map(x, y) != 0) {
          left_.push_back({x, y});
        }
      }
    }
  }

  std::vector<std::vector<Pixel>> curves() {
    std::vector<std::vector<Pixel>> found;
    while (!left_.empty()) {
      const Pixel seed = left_.front();
      left_.erase(left_.begin());
      std::vector<Pixel> curve{seed};
      while (const auto pixel = take_nearest(curve.back())) {
        curve.push_back(*pixel);
      }
      while (const auto pixel = take_nearest(curve.front())) {
        curve.insert(curve.begin(), *pixel);
      }
      found.push_back(curve);
    }
    return found;
  }

 private:
  std::optional<Pixel> take_nearest(Pixel at) {
    auto best = left_.end();
    for (auto pixel = left_.begin(); pixel != left_.end(); ++pixel) {
      const bool in_window =
          std::abs(pixel->x - at.x) <= gap_px_ && std::abs(pixel->y - at.y) <= gap_px_;
      if (in_window && (best == left_.end() || key(*pixel, at) < key(*best, at))) {
        best = pixel;
      }
    }
    if (best == left_.end()) {
      return std::nullopt;
    }
    const Pixel taken = *best;
    left_.erase(best);
    return taken;
  }
  static std::tuple<std::int64_t, int, int> key(Pixel pixel, Pixel at) {
    return {squared_distance(pixel, at), pixel.x, pixel.y};
  }

  int gap_px_;
  std::vector<Pixel> left_;  // column by column
};

void expect_like_reference(ImageView<const std::uint8_t> map, int gap_px) {
  ContourOptions options = keep_all();
  options.gap_px = gap_px;
  const ContourSet contours = trace(map, options);
  const auto expected = SlowTracer(map, gap_px).curves();
  ASSERT_EQ(contours.items.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(pixels_of(contours, i), expected[i]) << "curve " << i;
  }
}

TEST(ContourTracer, IsTheReferenceOnAllSmallMaps) {
  for (int height = 1; height <= 20; ++height) {
    for (int width = 1; width <= 20; ++width) {
      SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
      const int gap_px = 1 + (width + height) % 3;
      const double density = 0.1 + 0.2 * ((width * 7 + height) % 4);
      const auto seed = static_cast<unsigned>(width * 100 + height);
      expect_like_reference(random_map(width, height, density, seed), gap_px);
    }
  }
}

TEST(ContourTracer, IsTheReferenceWithTheLargestGap) {
  expect_like_reference(random_map(40, 31, 0.01, 5), 8);
  expect_like_reference(random_map(31, 40, 0.1, 6), 8);
}

TEST(ContourTracer, StraightLine) {
  const auto line = straight({3, 5}, {42, 5});
  const ContourSet contours = trace(map_of(line, 50, 20), keep_all());
  ASSERT_EQ(contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(contours, 0), line);
  EXPECT_FALSE(contours.items[0].closed);
  EXPECT_TRUE(contours.junctions.empty());
}

TEST(ContourTracer, AnLBeginsAtItsLeftEnd) {
  const auto shape = polyline({{4, 2}, {4, 30}, {25, 30}});
  const ContourSet contours = trace(map_of(shape, 40, 40), keep_all());
  ASSERT_EQ(contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(contours, 0), shape);
}

TEST(ContourTracer, ASeedInTheMiddleIsWalkedBothWays) {
  const auto map = drawn_map({"..#",  //
                              ".#.",  //
                              "#..",  //
                              ".#.",  //
                              "..#"});
  const ContourSet contours = trace(map, keep_all());
  ASSERT_EQ(contours.items.size(), 1U);
  // Both neighbours of the seed are equally near and in one column: the smaller row is first.
  EXPECT_EQ(pixels_of(contours, 0), (std::vector<Pixel>{{2, 4}, {1, 3}, {0, 2}, {1, 1}, {2, 0}}));
}

TEST(ContourTracer, ADirectNeighbourIsNearerThanADiagonalOne) {
  const auto map = drawn_map({"#.#",  //
                              ".##"});
  const ContourSet contours = trace(map, keep_all());
  ASSERT_EQ(contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(contours, 0), (std::vector<Pixel>{{0, 0}, {1, 1}, {2, 1}, {2, 0}}));
}

TEST(ContourTracer, ACircleIsClosed) {
  auto map = blank_map(64, 64);
  for (int degrees = 0; degrees < 3600; ++degrees) {
    const double angle = degrees * 3.14159265358979 / 1800;
    map(static_cast<int>(std::lround(32 + 20 * std::cos(angle))),
        static_cast<int>(std::lround(32 + 20 * std::sin(angle)))) = 1;
  }
  const ContourSet contours = trace(map, keep_all());
  ASSERT_GE(contours.items.size(), 1U);
  EXPECT_TRUE(contours.items[0].closed);
  EXPECT_GT(contours.items[0].points.count, 100U);
}

TEST(ContourTracer, GapOfTwoJumpsOnePixel) {
  auto line = straight({3, 5}, {42, 5});
  line.erase(line.begin() + 20);
  ContourOptions options = keep_all();
  EXPECT_EQ(trace(map_of(line, 50, 20), options).items.size(), 2U);
  options.gap_px = 2;
  const ContourSet contours = trace(map_of(line, 50, 20), options);
  ASSERT_EQ(contours.items.size(), 1U);
  EXPECT_EQ(pixels_of(contours, 0), line);
}

// Ends of a U: `dx`, `dy` apart.
bool closes(int dx, int dy, double closed_gap_px) {
  ContourOptions options = keep_all();
  options.closed_gap_px = closed_gap_px;
  const auto shape = polyline({{10, 10}, {10, 40}, {10 + dx, 40}, {10 + dx, 10 + dy}});
  const ContourSet contours = trace(map_of(shape, 60, 60), options);
  EXPECT_EQ(contours.items.size(), 1U);
  return contours.items[0].closed;
}

TEST(ContourTracer, IsClosedUpToTheSquaredDistanceOfThePublicCode) {
  EXPECT_TRUE(closes(4, 4, 5.66));   // 32
  EXPECT_TRUE(closes(5, 2, 5.66));   // 29
  EXPECT_FALSE(closes(5, 3, 5.66));  // 34
  EXPECT_FALSE(closes(6, 0, 5.66));  // 36
}

// T of 2 to 3 px, and a distance that is smaller.
TEST(ContourTracer, IsClosedByDefaultBelowTheDistanceOfThePaper) {
  const double by_default = ContourOptions{}.closed_gap_px;
  EXPECT_TRUE(closes(2, 2, by_default));
  EXPECT_FALSE(closes(3, 0, by_default));
  EXPECT_FALSE(closes(3, 1, by_default));
  EXPECT_TRUE(closes(3, 0, 3.01));
  EXPECT_FALSE(closes(2, 0, 1.9));
}

TEST(ContourTracer, ShortCurvesAreDropped) {
  auto map = blank_map(60, 40);  // more than (60 + 40) / 25 = 4 pixels stay
  for (const Pixel pixel : straight({5, 5}, {8, 5})) {
    map(pixel.x, pixel.y) = 1;
  }
  for (const Pixel pixel : straight({5, 20}, {9, 20})) {
    map(pixel.x, pixel.y) = 1;
  }
  ContourOptions options;
  options.min_component_px = 0;
  EXPECT_EQ(trace(map, options).items.size(), 1U);
  options.min_length_px = 4;
  EXPECT_EQ(trace(map, options).items.size(), 2U);
  options.min_length_px = 6;
  EXPECT_EQ(trace(map, options).items.size(), 0U);
}

TEST(ContourTracer, TheShortestCurveOfAFrameOfOddSize) {
  ContourOptions options;
  options.min_component_px = 0;
  const auto line = straight({2, 2}, {6, 2});                        // 5 pixels
  EXPECT_EQ(trace(map_of(line, 60, 64), options).items.size(), 1U);  // > 124 / 25 = 4.96
  EXPECT_EQ(trace(map_of(line, 60, 65), options).items.size(), 0U);  // = 125 / 25
}

TEST(ContourTracer, SmallComponentsAreRemovedWhole) {
  const auto spiral = polyline({{5, 5}, {25, 5}, {35, 15}, {35, 32}});  // 21 + 10 + 17 = 48 pixels
  ASSERT_EQ(spiral.size(), 48U);
  ContourOptions options = keep_all();
  options.min_component_px = 48;
  EXPECT_EQ(trace(map_of(spiral, 50, 50), options).items.size(), 1U);
  options.min_component_px = 49;
  EXPECT_EQ(trace(map_of(spiral, 50, 50), options).items.size(), 0U);
}

TEST(ContourTracer, OneComponentKeepsItsBranches) {
  auto pixels = straight({2, 10}, {41, 10});  // 40 pixels and a branch of 10
  const auto branch = straight({20, 11}, {20, 20});
  pixels.insert(pixels.end(), branch.begin(), branch.end());
  ContourOptions options = keep_all();
  options.min_component_px = 50;
  const ContourSet contours = trace(map_of(pixels, 50, 30), options);
  EXPECT_EQ(contours.points.size(), 50U);
}

TEST(ContourTracer, ATJunctionIsFoundWithinGapPlusOne) {
  for (const int space : {0, 1, 2}) {
    SCOPED_TRACE(space);
    auto pixels = straight({2, 10}, {41, 10});
    const auto stem = straight({20, 11 + space}, {20, 30});
    pixels.insert(pixels.end(), stem.begin(), stem.end());
    const auto junctions = junctions_of(trace(map_of(pixels, 50, 40), keep_all()));
    if (space == 1) {
      EXPECT_EQ(junctions, (std::vector<Pixel>{{20, 12}}));
    } else if (space == 2) {
      EXPECT_TRUE(junctions.empty());
    } else {
      // The walk along the bar may leave it at the stem: some end touches another curve anyway.
      EXPECT_FALSE(junctions.empty());
    }
  }
}

TEST(ContourTracer, ClosedCurvesHaveNoJunctions) {
  const auto ring = polyline({{10, 10}, {30, 10}, {30, 30}, {10, 30}, {10, 11}});
  auto pixels = ring;
  const auto stem = straight({0, 10}, {8, 10});
  pixels.insert(pixels.end(), stem.begin(), stem.end());
  const ContourSet contours = trace(map_of(pixels, 50, 40), keep_all());
  EXPECT_EQ(junctions_of(contours), (std::vector<Pixel>{{8, 10}}));
}

TEST(ContourTracer, ReadsThroughAStride) {
  GuardedImage<std::uint8_t> guarded(23, 17);
  const auto map = random_map(23, 17, 0.3, 9);
  copy_pixels(map.view(), guarded.view());
  const ContourSet from_view = trace(guarded.view(), keep_all());
  const ContourSet from_image = trace(map, keep_all());
  EXPECT_EQ(from_view.points, from_image.points);
  EXPECT_TRUE(guarded.intact());
  EXPECT_TRUE(same_pixels<std::uint8_t>(guarded.view(), map.view()));
}

TEST(ContourTracer, RemembersNothing) {
  ContourTracer tracer(keep_all());
  const auto first = random_map(40, 30, 0.2, 1);
  const auto second = random_map(20, 50, 0.2, 2);
  ContourSet contours;
  ASSERT_TRUE(tracer.run(first, contours));
  const ContourSet expected = contours;
  ASSERT_TRUE(tracer.run(second, contours));
  ASSERT_TRUE(tracer.run(first, contours));
  EXPECT_EQ(contours.points, expected.points);
  EXPECT_EQ(contours.items.size(), expected.items.size());
  EXPECT_EQ(junctions_of(contours), junctions_of(expected));
}

TEST(ContourTracer, NoEdgesNoContours) {
  const ContourSet contours = trace(blank_map(30, 20), ContourOptions{});
  EXPECT_TRUE(contours.points.empty());
  EXPECT_TRUE(contours.items.empty());
  EXPECT_TRUE(trace({}, ContourOptions{}).items.empty());
}

TEST(ContourTracer, MemoryIsSetByTheFrameSize) {
  ContourTracer tracer(keep_all());
  ContourSet contours;
  ASSERT_TRUE(tracer.run(blank_map(50, 40), contours));
  const Pixel* points = contours.points.data();
  const Contour* curves = contours.items.data();
  const Junction* junctions = contours.junctions.data();
  for (const double density : {0.1, 0.25, 0.5, 1.0}) {
    ASSERT_TRUE(tracer.run(random_map(50, 40, density, 3), contours));
    EXPECT_EQ(contours.points.data(), points);
    EXPECT_EQ(contours.items.data(), curves);
    EXPECT_EQ(contours.junctions.data(), junctions);
  }
}

std::string error_of(const ContourOptions& options) {
  ContourSet contours;
  const Status status = ContourTracer(options).run(blank_map(8, 8), contours);
  return status ? "" : status.error().message;
}

TEST(ContourTracer, NamesTheOptionThatIsOutOfRange) {
  ContourOptions options;
  options.gap_px = 0;
  EXPECT_NE(error_of(options).find("contours.gap_px"), std::string::npos);
  options = {};
  options.closed_gap_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of(options).find("contours.closed_gap_px"), std::string::npos);
  options = {};
  options.min_component_px = -1;
  EXPECT_NE(error_of(options).find("contours.min_component_px"), std::string::npos);
  EXPECT_EQ(error_of({}), "");
}

}  // namespace
}  // namespace thermedge::test
