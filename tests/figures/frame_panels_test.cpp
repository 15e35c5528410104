// Pictures of the stages: every pixel and every line in the colour that its legend says.
#include "frame_panels.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "raster.hpp"
#include "support/drawing.hpp"
#include "support/edge_sets.hpp"
#include "support/images.hpp"

namespace thermedge::figures {
namespace {

constexpr int kWidth = 24;
constexpr int kHeight = 18;
constexpr int kZoom = 8;  // points a pixel

// `draw` over the whole of a picture of 24 x 18 pixels.
Image<Rgb> enlarged(const Draw& draw) {
  return drawn(kWidth * kZoom, kHeight * kZoom, [&](Canvas& canvas) {
    draw(canvas, {0, 0, kWidth * kZoom, kHeight * kZoom});
  });
}

// Lines and marks in the coordinates of the frame, on white.
Image<Rgb> on_frame(const std::function<void(Canvas&)>& draw) {
  return enlarged([&](Canvas& canvas, const Box& box) {
    canvas.inside_frame(box, kWidth, kHeight, [&] { draw(canvas); });
  });
}

Rgb middle_of(const Image<Rgb>& picture, int x, int y) {
  return picture(x * kZoom + kZoom / 2, y * kZoom + kZoom / 2);
}

Rgb grey(int level) {
  const auto value = static_cast<std::uint8_t>(level);
  return {value, value, value};
}

Image<std::uint16_t> ramp() {
  Image<std::uint16_t> counts(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      counts(x, y) = static_cast<std::uint16_t>(3000 + 20 * x);
    }
  }
  return counts;
}

TEST(FramePanels, FramesRunFromBlackToWhite) {
  Image<std::uint16_t> counts = ramp();
  counts(12, 9) = 65535;  // one hot pixel does not darken all others
  const auto picture = enlarged(frame_picture(counts));
  EXPECT_EQ(middle_of(picture, 0, 5), grey(0));
  EXPECT_EQ(middle_of(picture, kWidth - 1, 5), grey(255));
  EXPECT_EQ(middle_of(picture, 12, 9), grey(255));
  for (int x = 1; x < kWidth; ++x) {
    EXPECT_GT(middle_of(picture, x, 3).g, middle_of(picture, x - 1, 3).g) << x;
  }
}

TEST(FramePanels, DimmedFramesLeaveRoomForBrightLines) {
  const Image<std::uint16_t> counts = ramp();
  const auto full = enlarged(frame_picture(counts));
  const auto dimmed = enlarged(dimmed_frame(counts));
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_NEAR(middle_of(dimmed, x, 4).g, middle_of(full, x, 4).g * 130 / 255.0, 1) << x;
  }
}

TEST(FramePanels, LevelsAreShownAsTheyAre) {
  const auto levels = test::noise_image<std::uint8_t>(kWidth, kHeight, 120, 60, 3);
  const auto picture = enlarged(levels_picture(levels));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(middle_of(picture, x, y), grey(levels(x, y))) << x << ", " << y;
    }
  }
}

TEST(FramePanels, NeighbouringContoursHaveTheirOwnColours) {
  ContourSet set;
  for (int i = 0; i < 8; ++i) {
    test::add_contour(set, test::straight({2, 2 * i + 1}, {20, 2 * i + 1}));
  }
  const auto picture = on_frame([&](Canvas& canvas) { draw_contours(canvas, set); });
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(middle_of(picture, 10, 2 * i + 1), category_colour(static_cast<std::size_t>(i)));
    EXPECT_EQ(middle_of(picture, 10, 2 * i), kPaper) << "between them";
  }
  EXPECT_NE(category_colour(0), category_colour(1));
  EXPECT_EQ(category_colour(0), category_colour(7));
  const auto plain = on_frame([&](Canvas& canvas) { draw_contours(canvas, set, kSoftInk); });
  EXPECT_EQ(drawn_extent(plain).pixels, drawn_extent(picture).pixels);
  EXPECT_EQ(middle_of(plain, 10, 5), kSoftInk);
}

TEST(FramePanels, ClosedContoursAreClosed) {
  for (const bool closed : {false, true}) {
    ContourSet set;
    test::add_contour(set, test::polyline({{4, 4}, {14, 4}, {14, 12}, {4, 12}}), closed);
    const auto picture = on_frame([&](Canvas& canvas) { draw_contours(canvas, set, kInk); });
    EXPECT_EQ(middle_of(picture, 4, 8), closed ? kInk : kPaper);
    EXPECT_EQ(middle_of(picture, 14, 8), kInk);
    EXPECT_EQ(middle_of(picture, 9, 8), kPaper) << "lines are not filled";
  }
}

TEST(FramePanels, TheBestEdgeLiesOnTop) {
  EdgeSet set;
  test::add_edge(set, {{2, 8}, {20, 8}});
  test::add_edge(set, {{10, 2}, {10, 16}});
  const auto picture = on_frame([&](Canvas& canvas) {
    draw_edges(canvas, set, set.edges, [](const Edge& edge) {
      return edge.rank == 0 ? Rgb{255, 0, 0} : Rgb{0, 0, 255};
    });
  });
  EXPECT_EQ(middle_of(picture, 10, 8), (Rgb{255, 0, 0})) << "where they cross";
  EXPECT_EQ(middle_of(picture, 10, 13), (Rgb{0, 0, 255}));
  EXPECT_EQ(middle_of(picture, 16, 8), (Rgb{255, 0, 0}));
}

// A line a pixel wide covers the pixels in whose middle it runs, and halves of two elsewhere.
TEST(FramePanels, EdgesKeepTheirPartsOfAPixel) {
  for (const float y : {6.0F, 6.25F, 6.5F}) {
    EdgeSet set;
    test::add_edge(set, {{2, y}, {20, y}});
    const auto picture = on_frame([&](Canvas& canvas) {
      draw_edges(canvas, set, set.edges, [](const Edge&) { return kInk; });
    });
    const Extent extent = extent_of(picture, kInk);
    EXPECT_EQ(extent.top, static_cast<int>(y * kZoom));
    EXPECT_EQ(extent.height(), kZoom);
  }
}

TEST(FramePanels, CornersAreMarkedOnTheirEdgelsOnly) {
  EdgeSet set;
  test::add_edge(set, {{2, 2}, {6, 2}, {10, 2}});
  Edge& bent = test::add_edge(set, {{4, 10}, {12, 10}, {20, 14}});
  set.corners = {1, 2};
  bent.corners = {0, 2};
  const auto picture = on_frame([&](Canvas& canvas) { draw_corners(canvas, set, {250, 200, 0}); });
  const Extent corners = extent_of(picture, {250, 200, 0});
  EXPECT_EQ(corners.pixels, 2 * 9 * kZoom * kZoom) << "two squares of three pixels";
  EXPECT_EQ(middle_of(picture, 12, 10), (Rgb{250, 200, 0}));
  EXPECT_EQ(middle_of(picture, 20, 14), (Rgb{250, 200, 0}));
  EXPECT_EQ(middle_of(picture, 4, 10), kPaper);
  EXPECT_EQ(middle_of(picture, 6, 2), kPaper);
}

TEST(FramePanels, LinksAreMarkedInTheMiddleByTheirType) {
  const LinkType types[] = {LinkType::kEndToEnd, LinkType::kEndToMiddle, LinkType::kLoop};
  std::vector<Link> links;
  for (int i = 0; i < 3; ++i) {
    links.push_back({types[i], 0, 0, {3 + 8 * i, 6}, {5 + 8 * i, 10}});
  }
  const auto picture = on_frame([&](Canvas& canvas) { draw_links(canvas, links); });
  ASSERT_EQ(link_marks().size(), 3U);
  std::set<std::string> labels;
  for (int i = 0; i < 3; ++i) {
    const LegendEntry& entry = link_marks()[static_cast<std::size_t>(i)];
    EXPECT_EQ(middle_of(picture, 4 + 8 * i, 8), entry.colour) << entry.label;
    labels.insert(entry.label);
  }
  EXPECT_EQ(labels, (std::set<std::string>{"end to end", "end to middle", "loop"}));
}

}  // namespace
}  // namespace thermedge::figures
