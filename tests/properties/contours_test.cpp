// What holds for the contours of any edge map, and for what is built on them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "support/drawing.hpp"
#include "support/images.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/linking.hpp"

namespace thermedge::test {
namespace {

struct MapKind {
  double density;
  int gap_px;
};

class ContoursOf : public testing::TestWithParam<MapKind> {
 protected:
  [[nodiscard]] ContourSet trace(ImageView<const std::uint8_t> map, int min_length_px) const {
    ContourOptions options;
    options.gap_px = GetParam().gap_px;
    options.min_component_px = 0;
    options.min_length_px = min_length_px;
    ContourSet contours;
    EXPECT_TRUE(ContourTracer(options).run(map, contours));
    return contours;
  }
  [[nodiscard]] static Image<std::uint8_t> map(unsigned seed) {
    return random_map(61, 47, GetParam().density, seed);
  }
};

TEST_P(ContoursOf, EverySetPixelIsInExactlyOneCurveWhenNoneIsDropped) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto edges = map(seed);
    auto count = blank_map(edges.width(), edges.height());
    for (const Pixel pixel : trace(edges, 1).points) {
      ++count(pixel.x, pixel.y);
    }
    for (int y = 0; y < edges.height(); ++y) {
      for (int x = 0; x < edges.width(); ++x) {
        ASSERT_EQ(count(x, y), edges(x, y) != 0 ? 1 : 0) << x << ", " << y;
      }
    }
  }
}

TEST_P(ContoursOf, TheLongCurvesAreThoseOfAllCurves) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto edges = map(seed);
    const ContourSet all = trace(edges, 1);
    const ContourSet longer = trace(edges, 6);
    std::size_t next = 0;
    for (std::size_t i = 0; i < all.items.size(); ++i) {
      if (all.items[i].points.count >= 6) {
        ASSERT_LT(next, longer.items.size());
        ASSERT_EQ(pixels_of(longer, next), pixels_of(all, i));
        ++next;
      }
    }
    EXPECT_EQ(next, longer.items.size());
  }
}

TEST_P(ContoursOf, StepsStayWithinTheGap) {
  const ContourSet contours = trace(map(3), 1);
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    const auto pixels = pixels_of(contours, i);
    for (std::size_t k = 1; k < pixels.size(); ++k) {
      ASSERT_LE(std::abs(pixels[k].x - pixels[k - 1].x), GetParam().gap_px);
      ASSERT_LE(std::abs(pixels[k].y - pixels[k - 1].y), GetParam().gap_px);
    }
  }
}

// The map moves within a larger frame, so that no curve meets the border.
TEST_P(ContoursOf, MoveWithTheMap) {
  const auto edges = map(4);
  const auto moved_to = [&](Pixel origin) {
    auto frame = blank_map(90, 80);
    copy_pixels(edges.view(), frame.view().crop(origin.x, origin.y, edges.width(), edges.height()));
    return trace(frame, 5);
  };
  const ContourSet here = moved_to({2, 3});
  const ContourSet there = moved_to({19, 24});
  ASSERT_EQ(here.points.size(), there.points.size());
  ASSERT_EQ(here.items.size(), there.items.size());
  ASSERT_EQ(here.junctions.size(), there.junctions.size());
  for (std::size_t i = 0; i < here.points.size(); ++i) {
    ASSERT_EQ((Pixel{here.points[i].x + 17, here.points[i].y + 21}), there.points[i]);
  }
  for (std::size_t i = 0; i < here.items.size(); ++i) {
    EXPECT_EQ(here.items[i].points, there.items[i].points);
    EXPECT_EQ(here.items[i].closed, there.items[i].closed);
  }
}

TEST_P(ContoursOf, LinkingLosesNoPixel) {
  const ContourSet contours = trace(map(5), 2);
  for (const double gap_px : {0.0, 1.5, 3.0, 7.0, 32.0}) {
    LinkedContours linked;
    ASSERT_TRUE(Linker({gap_px}).run(contours, 61, 47, linked));
    auto covered = blank_map(61, 47);
    for (const Pixel pixel : linked.contours.points) {
      covered(pixel.x, pixel.y) = 1;
    }
    for (const Pixel pixel : contours.points) {
      ASSERT_EQ(covered(pixel.x, pixel.y), 1);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ContoursOf,
                         testing::Values(MapKind{0.05, 1}, MapKind{0.3, 1}, MapKind{0.9, 1},
                                         MapKind{0.1, 2}, MapKind{0.02, 8}));

}  // namespace
}  // namespace thermedge::test
