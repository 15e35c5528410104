// The drawing surface: shapes, pictures and text lie where they were asked for, to the pixel.
#include "canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "raster.hpp"

namespace thermedge::figures {
namespace {

constexpr Rgb kRed = {200, 10, 20};
constexpr Rgb kBlue = {10, 30, 210};

TEST(Box, InsetKeepsTheMiddle) {
  const Box box = Box{10, 20, 40, 30}.inset(4);
  EXPECT_EQ(box.x, 14);
  EXPECT_EQ(box.y, 24);
  EXPECT_EQ(box.right(), 46);
  EXPECT_EQ(box.bottom(), 46);
}

TEST(Canvas, FillsExactlyTheBox) {
  const auto picture = drawn(40, 30, [](Canvas& canvas) { canvas.fill({7, 5, 11, 13}, kRed); });
  const Extent red = extent_of(picture, kRed);
  EXPECT_EQ(red.pixels, 11 * 13);
  EXPECT_EQ(drawn_extent(picture).pixels, 11 * 13);
  EXPECT_EQ(red.left, 7);
  EXPECT_EQ(red.top, 5);
  EXPECT_EQ(red.right, 17);
  EXPECT_EQ(red.bottom, 17);
}

TEST(Canvas, FramesLieAcrossTheBorderOfTheBox) {
  const auto picture = drawn(40, 30, [](Canvas& canvas) { canvas.frame({8, 6, 20, 12}, kRed, 2); });
  const Extent red = extent_of(picture, kRed);
  EXPECT_EQ(red.left, 7);
  EXPECT_EQ(red.top, 5);
  EXPECT_EQ(red.right, 28);
  EXPECT_EQ(red.bottom, 18);
  EXPECT_EQ(picture(8, 12), kRed);
  EXPECT_EQ(picture(9, 12), kPaper) << "inside";
  EXPECT_EQ(picture(18, 12), kPaper) << "inside";
}

TEST(Canvas, ClosesLinesOnlyWhereAsked) {
  const Point corner[] = {{5, 5}, {35, 5}, {35, 25}};
  for (const bool closed : {false, true}) {
    const auto picture =
        drawn(40, 30, [&](Canvas& canvas) { canvas.line(corner, closed, kRed, 2); });
    EXPECT_EQ(picture(20, 5), kRed);
    EXPECT_EQ(picture(35, 15), kRed);
    EXPECT_EQ(picture(20, 15), closed ? kRed : kPaper) << "middle of the closing side";
  }
}

TEST(Canvas, StartsEveryLineAnew) {
  const auto picture = drawn(40, 40, [](Canvas& canvas) {
    const Point below[] = {{25, 35}, {35, 35}};
    canvas.text({5, 8}, "A", {.size = 6, .colour = kBlue});
    canvas.line(below, false, kRed, 2);
    canvas.area(std::vector<Point>{}, kRed);
  });
  const Extent red = extent_of(picture, kRed);
  EXPECT_GE(red.top, 33) << "no line from the end of the text";
  EXPECT_GE(red.left, 24);
}

TEST(Canvas, FillsAreasToTheirCorners) {
  const Point triangle[] = {{4, 4}, {24, 4}, {4, 24}};
  const auto picture = drawn(30, 30, [&](Canvas& canvas) { canvas.area(triangle, kRed); });
  EXPECT_NEAR(extent_of(picture, kRed).pixels, 20 * 20 / 2, 15);
  EXPECT_EQ(picture(5, 5), kRed);
  EXPECT_EQ(picture(20, 20), kPaper);
}

struct MarkShape {
  Mark mark;
  const char* name;
  double share;         // of the square around it that is covered
  bool middle, corner;  // covered
};

TEST(Canvas, MarksCanBeToldApartByTheirShape) {
  const double disc = std::atan(1.0);  // pi / 4
  for (const MarkShape& shape : {MarkShape{Mark::kDisc, "disc", disc, true, false},
                                 {Mark::kRing, "ring", disc, false, false},
                                 {Mark::kSquare, "square", 1, true, true},
                                 {Mark::kDiamond, "diamond", 0.5, true, false},
                                 {Mark::kTriangle, "triangle", 0.5, true, false}}) {
    SCOPED_TRACE(shape.name);
    const auto picture = drawn(60, 60, [&](Canvas& canvas) {
      canvas.mark(shape.mark, {30, 30}, 40, kRed);
    });
    EXPECT_EQ(picture(30, 30), shape.middle ? kRed : kPaper);
    EXPECT_EQ(picture(11, 11), shape.corner ? kRed : kPaper);
    const Extent extent = drawn_extent(picture);
    const bool ring = shape.mark == Mark::kRing;  // its line lies across the border
    EXPECT_NEAR(extent.width(), ring ? 50 : 40, 2);
    EXPECT_NEAR(extent.height(), ring ? 50 : 40, 2);
    EXPECT_NEAR((extent.left + extent.right + 1) / 2.0, 30, 1);
    // A ring's line is a quarter of its size wide, so it covers as much as its disc.
    EXPECT_NEAR(extent.pixels / 1600.0, shape.share, ring ? 0.1 : 0.05);
  }
}

Image<Rgb> checkered() {
  Image<Rgb> picture(6, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      picture(x, y) = (x + y) % 2 == 0 ? kRed : kBlue;
    }
  }
  return picture;
}

TEST(Canvas, EnlargedPicturesHaveHardPixelBorders) {
  const Image<Rgb> pixels = checkered();
  const auto picture = drawn(40, 30, [&](Canvas& canvas) {
    canvas.picture(pixels.view(), {5, 3, 30, 20});
  });
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      ASSERT_EQ(picture(5 + x, 3 + y), pixels(x / 5, y / 5)) << x << ", " << y;
    }
  }
  EXPECT_EQ(drawn_extent(picture).pixels, 30 * 20);
}

TEST(Canvas, ReducedPicturesAreAveraged) {
  Image<Rgb> stripes(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      stripes(x, y) = x % 2 == 0 ? Rgb{0, 0, 0} : Rgb{255, 255, 255};
    }
  }
  const auto picture = drawn(16, 16, [&](Canvas& canvas) {
    canvas.picture(stripes.view(), {0, 0, 16, 16});
  });
  for (int x = 2; x < 14; ++x) {
    EXPECT_NEAR(picture(x, 8).g, 128, 30) << x;
  }
}

TEST(Canvas, AFrameEndsWithItsDrawing) {
  const auto picture = drawn(60, 40, [](Canvas& canvas) {
    canvas.inside_frame({10, 10, 20, 20}, 2, 2, [&] {
      canvas.fill({-0.5, -0.5, 1, 1}, kRed);  // pixel (0, 0)
      canvas.fill({0.5, 0.5, 9, 9}, kBlue);   // pixel (1, 1) and what is beyond the frame
    });
    canvas.fill({50, 5, 4, 4}, kRed);  // in points again, and not clipped
  });
  EXPECT_EQ(picture(10, 10), kRed);
  EXPECT_EQ(picture(19, 19), kRed);
  EXPECT_EQ(picture(20, 20), kBlue);
  EXPECT_EQ(picture(29, 29), kBlue);
  EXPECT_EQ(picture(25, 15), kPaper);
  EXPECT_EQ(extent_of(picture, kBlue).pixels, 100);
  EXPECT_EQ(extent_of(picture, kRed).pixels, 100 + 16);
  EXPECT_EQ(picture(50, 5), kRed);
}

TEST(CanvasText, IsAlignedAtItsPoint) {
  for (const auto& [align, shift] :
       {std::pair{Align::kLeft, 0.0}, {Align::kCentre, 0.5}, {Align::kRight, 1.0}}) {
    TextStyle style{.size = 20};
    style.align = align;
    double width = 0;
    const auto picture = drawn(300, 40, [&](Canvas& canvas) {
      width = canvas.text_width("HHHHH", style);
      canvas.text({150, 30}, "HHHHH", style);
    });
    const Extent ink = drawn_extent(picture);
    EXPECT_NEAR(ink.left, 150 - shift * width, 3) << shift;
    EXPECT_NEAR(ink.right, 150 + (1 - shift) * width, 3) << shift;
    EXPECT_NEAR(ink.bottom, 29, 1) << "capitals stand on the base line";
  }
}

TEST(CanvasText, GrowsWithItsSizeWeightAndLength) {
  drawn(10, 10, [](Canvas& canvas) {
    const double width = canvas.text_width("frame", {.size = 10});
    EXPECT_NEAR(canvas.text_width("frame", {.size = 20}), 2 * width, 0.02 * width);
    EXPECT_NEAR(canvas.text_width("frameframe", {.size = 10}), 2 * width, 0.02 * width);
    EXPECT_GT(canvas.text_width("frame", {.size = 10, .weight = Weight::kSemibold}), width);
    EXPECT_EQ(canvas.text_width("", {.size = 10}), 0);
  });
}

TEST(CanvasText, HasTheColourItWasGiven) {
  const auto picture = drawn(60, 60, [](Canvas& canvas) {
    canvas.text({5, 50}, "I", {.size = 60, .colour = kRed, .weight = Weight::kSemibold});
  });
  EXPECT_GT(extent_of(picture, kRed).pixels, 60);
}

struct Wrapping {
  const char* text;
  double width_of_n;  // the room: so many letters n, of which the words are made
  std::vector<std::string> lines;
};

TEST(CanvasText, WrapsAtTheLastWordThatFits) {
  drawn(10, 10, [](Canvas& canvas) {
    const TextStyle style{.size = 10};
    const double n = canvas.text_width("n", style);
    const double space = canvas.text_width("n n", style) - 2 * n;
    for (const Wrapping& wrapping : {Wrapping{"nn nn nn", 6, {"nn nn nn"}},
                                     {"nn nn nn", 4, {"nn nn", "nn"}},
                                     {"nn nn nn", 3, {"nn", "nn", "nn"}},
                                     {"nnnnnnnn nn", 4, {"nnnnnnnn", "nn"}},
                                     {"nn nnnnnnnn nn", 4, {"nn", "nnnnnnnn", "nn"}},
                                     {"n", 0, {"n"}},
                                     {"", 4, {}}}) {
      const double width = wrapping.width_of_n * n + 2 * space + 0.01;
      EXPECT_EQ(canvas.wrap(wrapping.text, width, style), wrapping.lines)
          << wrapping.text << " in " << wrapping.width_of_n;
    }
  });
}

}  // namespace
}  // namespace thermedge::figures
