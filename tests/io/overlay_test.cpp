// Colours, grey views and overlays, pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "support/edge_sets.hpp"
#include "support/images.hpp"
#include "support/strided_image.hpp"
#include "thermedge/io/colour_map.hpp"
#include "thermedge/io/overlay.hpp"

namespace thermedge::io {
namespace {

using test::StridedImage;

double luminance(Rgb colour) { return 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b; }

TEST(Plasma, RisesEvenlyFromDarkBlueToYellow) {
  EXPECT_EQ(plasma(0), (Rgb{13, 8, 135}));
  EXPECT_EQ(plasma(1), (Rgb{240, 249, 33}));
  EXPECT_EQ(plasma(7.0 / 15), (Rgb{195, 61, 128}));
  EXPECT_EQ(plasma(0.5), (Rgb{203, 71, 121}));  // half way between two stops
  EXPECT_EQ(plasma(-0.1), plasma(0));
  EXPECT_EQ(plasma(1e300), plasma(1));
  for (int i = 0; i < 50; ++i) {
    EXPECT_GT(luminance(plasma((i + 1) / 50.0)), luminance(plasma(i / 50.0))) << i;
  }
  for (int i = 0; i < 1000; ++i) {
    const Rgb a = plasma(i / 1000.0);
    const Rgb b = plasma((i + 1) / 1000.0);
    EXPECT_LE(std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}), 1) << i;
  }
}

TEST(RankColour, GetsDarkerWithTheRankAndStaysVisible) {
  EXPECT_EQ(rank_colour(0), plasma(1));
  EXPECT_EQ(rank_colour(1), plasma(0.4));
  EXPECT_EQ(rank_colour(2), rank_colour(1));
  for (int i = 0; i < 20; ++i) {
    EXPECT_GT(luminance(rank_colour(i / 20.0)), luminance(rank_colour((i + 1) / 20.0))) << i;
  }
}

// The counts in order; those of rank floor(share (n - 1)) become black and white.
TEST(DrawView, SpreadsThePercentilesOfTheSortedCounts) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {7, 3}, {40, 31}}) {
    for (const double sigma : {0.0, 2.0, 6.0, 900.0, 40000.0}) {
      StridedImage<std::uint16_t> counts(width, height);
      copy_pixels(test::noise_image<std::uint16_t>(width, height, 30000, sigma, 111).view(),
                  counts.view());
      std::vector<int> sorted;
      for (int y = 0; y < height; ++y) {
        sorted.insert(sorted.end(), counts.view().row(y), counts.view().row(y) + width);
      }
      std::sort(sorted.begin(), sorted.end());
      const double last = static_cast<double>(sorted.size()) - 1;
      int black = sorted[static_cast<std::size_t>(0.005 * last)];
      int white = sorted[static_cast<std::size_t>(0.995 * last)];
      if (white - black < 16) {
        black -= (16 - (white - black)) / 2;
        white = black + 16;
      }
      StridedImage<std::uint8_t> view(width, height);
      draw_view(counts.view(), view.view());
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const double level = 255.0 * (counts.view()(x, y) - black) / (white - black);
          EXPECT_NEAR(view.view()(x, y), std::clamp(level, 0.0, 255.0), 0.5 + 1e-9);
        }
      }
      EXPECT_TRUE(view.intact());
    }
  }
}

TEST(DrawView, OfNoPixelsDrawsNone) {
  StridedImage<std::uint8_t> view(3, 0);
  draw_view({nullptr, 3, 0}, view.view());
  EXPECT_TRUE(view.intact());
}

Detection detection_of(int width, int height) {
  Detection detection;
  detection.width = width;
  detection.height = height;
  return detection;
}

// Where the overlay has this colour.
std::set<std::pair<int, int>> pixels_like(const Image<Rgb>& overlay, Rgb colour) {
  std::set<std::pair<int, int>> pixels;
  for (int y = 0; y < overlay.height(); ++y) {
    for (int x = 0; x < overlay.width(); ++x) {
      if (overlay(x, y) == colour) {
        pixels.emplace(x, y);
      }
    }
  }
  return pixels;
}

TEST(Overlay, ClosedEdgesAreDrawnBackToTheirBeginning) {
  for (const bool closed : {false, true}) {
    Detection detection = detection_of(10, 8);
    test::add_edge(detection.edges, {{1.25F, 1.25F}, {7.25F, 1.25F}, {7.25F, 5.25F}}, closed);
    Image<Rgb> overlay;
    draw_overlay(detection, {}, overlay);
    std::set<std::pair<int, int>> expected;
    for (int x = 3; x <= 15; ++x) {
      expected.emplace(x, 3);
    }
    for (int y = 3; y <= 11; ++y) {
      expected.emplace(15, y);
    }
    auto found = pixels_like(overlay, rank_colour(0));
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
    EXPECT_EQ(found.size() > expected.size(), closed);
    EXPECT_EQ(found.contains({9, 7}), closed);  // the middle of the third side
  }
}

TEST(Overlay, DroppedEdgesAreDrawnWhereTheyAreAskedForOnly) {
  Detection detection = detection_of(12, 12);
  test::add_edge(detection.edges, {{1, 5}, {9, 5}});
  test::add_edge(detection.edges, {{5, 1}, {5, 9}}, false, false).status =
      EdgeStatus::kInsignificant;
  test::add_edge(detection.edges, {{3, 7}, {3, 9}}, false, false).status = EdgeStatus::kWeak;
  Image<Rgb> kept;
  draw_overlay(detection, {}, kept);
  Image<Rgb> explained;
  draw_overlay(detection, {}, explained, OverlayContent::kExplained);
  EXPECT_EQ(kept(11, 5), kept(0, 0));
  EXPECT_EQ(kept(7, 17), kept(0, 0));
  EXPECT_EQ(explained(11, 5), status_colour(EdgeStatus::kInsignificant));
  EXPECT_EQ(explained(7, 17), status_colour(EdgeStatus::kWeak));
  EXPECT_EQ(explained(11, 11), status_colour(EdgeStatus::kKept));  // on top
}

TEST(Overlay, StatusesHaveColoursOfTheirOwn) {
  const std::array all = {EdgeStatus::kKept, EdgeStatus::kBeyondBudget, EdgeStatus::kWeak,
                          EdgeStatus::kInsignificant, EdgeStatus::kLowContrast};
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Rgb a = status_colour(all[i]);
      const Rgb b = status_colour(all[j]);
      EXPECT_GT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 100);
    }
  }
}

TEST(Overlay, TheBetterEdgeLiesOnTop) {
  Detection detection = detection_of(12, 12);
  test::add_edge(detection.edges, {{1, 5}, {9, 5}});
  test::add_edge(detection.edges, {{5, 1}, {5, 9}});
  Image<Rgb> overlay;
  draw_overlay(detection, {}, overlay);
  // Pixel (5, 5) is enlarged to (10..11, 10..11); its centre is rounded away from zero.
  EXPECT_EQ(overlay(11, 11), rank_colour(0));
  EXPECT_EQ(overlay(11, 15), rank_colour(1));
}

TEST(Overlay, CornersAreSquaresAndJunctionsRings) {
  Detection detection = detection_of(20, 20);
  test::add_edge(detection.edges, {{4.25F, 4.25F}, {8.25F, 4.25F}}).corners = {0, 1};
  detection.edges.corners = {1};
  detection.edges.junctions = {{{12, 12}}, {{0, 19}}};
  Image<Rgb> overlay;
  draw_overlay(detection, {}, overlay);
  std::set<std::pair<int, int>> square;
  std::set<std::pair<int, int>> rings;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (std::abs(x - 17) <= 1 && std::abs(y - 9) <= 1) {
        square.emplace(x, y);
      }
      for (const auto& [cx, cy] : {std::pair{25, 25}, {1, 39}}) {
        const double radius = std::hypot(x - cx, y - cy);
        if (radius > 2.6 && radius < 3.4) {
          rings.emplace(x, y);
        }
      }
    }
  }
  EXPECT_EQ(pixels_like(overlay, {255, 255, 255}), square);
  EXPECT_EQ(pixels_like(overlay, {90, 220, 255}), rings);
}

TEST(Overlay, EdgesOutsideTheFrameAreLeftOut) {
  Detection detection = detection_of(5, 5);
  test::add_edge(detection.edges, {{-30, -30}, {-30, 40}, {40, 40}}).corners = {0, 2};
  detection.edges.corners = {0, 2};
  detection.edges.junctions = {{{-9, 2}}};
  Image<Rgb> overlay;
  draw_overlay(detection, {}, overlay);
  EXPECT_EQ(pixels_like(overlay, overlay(0, 0)).size(), 100U);
}

TEST(Overlay, TheFrameIsDarkenedAndEachPixelIsASquareOfFour) {
  Image<std::uint16_t> counts(3, 2);
  for (int i = 0; i < 6; ++i) {
    counts(i % 3, i / 3) = static_cast<std::uint16_t>(1000 * i);
  }
  Image<std::uint8_t> view(3, 2);
  draw_view(counts, view);
  Image<Rgb> overlay;
  draw_overlay(detection_of(3, 2), counts, overlay);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 6; ++x) {
      const double grey = 20 + 180 * view(x / 2, y / 2) / 255.0;
      EXPECT_NEAR(overlay(x, y).r, grey, 0.5);
      EXPECT_EQ(overlay(x, y).r, overlay(x, y).g);
      EXPECT_EQ(overlay(x, y).r, overlay(x, y).b);
    }
  }
}

}  // namespace
}  // namespace thermedge::io
