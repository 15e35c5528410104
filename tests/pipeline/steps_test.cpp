// The small steps between the stages, pixel by pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "pipeline.hpp"
#include "support/drawing.hpp"
#include "support/images.hpp"
#include "support/strided_image.hpp"

namespace thermedge::detail {
namespace {

using test::random_map;
using test::same_pixels;
using test::StridedImage;

TEST(MaskInvalid, TakesOffWhatLiesWithinThreePixelsOfAnInvalidOne) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {4, 3}, {33, 21}}) {
    for (const double density : {0.0, 0.03, 0.6, 1.0}) {
      StridedImage<std::uint8_t> edges(width, height);
      copy_pixels(random_map(width, height, 0.7, 121).view(), edges.view());
      const auto bad = random_map(width, height, density, 122);
      StridedImage<std::uint8_t> valid(width, height, 0);
      Image<std::uint8_t> expected(width, height);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          valid.view()(x, y) = bad(x, y) != 0 ? 0 : 9;
          bool near_bad = false;
          for (int v = 0; v < height; ++v) {
            for (int u = 0; u < width; ++u) {
              near_bad =
                  near_bad || (bad(u, v) != 0 && std::abs(u - x) <= 3 && std::abs(v - y) <= 3);
            }
          }
          expected(x, y) = near_bad ? 0 : edges.view()(x, y);
        }
      }
      Image<std::uint8_t> clear;
      Image<std::uint8_t> masked;
      keep_clear_of_invalid(valid.view(), clear);
      const auto result = mask_invalid(edges.view(), clear, masked);
      EXPECT_TRUE(same_pixels<std::uint8_t>(result, expected)) << width << "x" << height;
      EXPECT_TRUE(edges.intact());
    }
  }
}

TEST(MaskInvalid, WithoutAMaskIsTheMapItself) {
  const auto edges = random_map(5, 4, 0.5, 123);
  Image<std::uint8_t> masked;
  EXPECT_EQ(mask_invalid(edges.view(), {}, masked).data(), edges.view().data());
  EXPECT_TRUE(masked.empty());
}

// Three edges of four points in a frame whose first five columns are no measurement.
TEST(MarkCutEnds, NotesTheEndsOfOpenEdgesNearInvalidPixels) {
  EdgeSet edges;
  edges.edgels.resize(12);
  edges.edges.resize(3);
  for (std::uint32_t i = 0; i < 12; ++i) {
    edges.edges[i / 4].edgels = {i / 4 * 4, 4};
    edges.edgels.x[i] = (i / 4 == 0 ? 9.4F : 9.5F) + static_cast<float>(i % 4);
    edges.edgels.y[i] = static_cast<float>(i / 4);
  }
  edges.edges[2].closed = true;
  edges.edgels.x[8] = 5;
  std::swap(edges.edgels.x[4], edges.edgels.x[7]);
  edges.edgels.x[7] = 6;
  Image<std::uint8_t> valid(30, 12);
  fill_pixels(valid.view(), std::uint8_t{1});
  mark_cut_ends({}, edges);
  mark_cut_ends(valid, edges);
  EXPECT_FALSE(edges.edges[0].begins_at_invalid);
  fill_pixels(valid.view().crop(0, 0, 5, 12), std::uint8_t{0});
  mark_cut_ends(valid, edges);
  EXPECT_TRUE(edges.edges[0].begins_at_invalid) << "column 9 is 5 px from column 4";
  EXPECT_FALSE(edges.edges[0].ends_at_invalid);
  EXPECT_FALSE(edges.edges[1].begins_at_invalid);
  EXPECT_TRUE(edges.edges[1].ends_at_invalid);
  EXPECT_FALSE(edges.edges[2].begins_at_invalid || edges.edges[2].ends_at_invalid) << "closed";
}

TEST(RoundToLevels, RoundsHalvesUpAndClamps) {
  const float values[] = {-1e30F, -0.6F,   0,      0.49F,  0.5F, 0.999F,
                          127.5F, 254.49F, 254.5F, 255.9F, 256,  1e30F};
  const int expected[] = {0, 0, 0, 0, 1, 1, 128, 254, 255, 255, 255, 255};
  Image<std::uint8_t> levels;
  round_to_levels({values, 4, 3}, levels);
  ASSERT_EQ(levels.size(), 12U);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(levels(i % 4, i / 4), expected[i]) << values[i];
  }
}

TEST(Binarize, IsWhiteWhereTheMapIsNotZero) {
  StridedImage<std::uint8_t> map(16, 16);
  for (int i = 0; i < 256; ++i) {
    map.view()(i % 16, i / 16) = static_cast<std::uint8_t>(i);
  }
  Image<std::uint8_t> binary;
  binarize(map.view(), binary);
  for (int i = 0; i < 256; ++i) {
    EXPECT_EQ(binary(i % 16, i / 16), i == 0 ? 0 : 255);
  }
}

TEST(ForgetContrast, LeavesTheRestOfAnEdge) {
  EdgeSet set;
  set.edges.resize(2);
  set.edges[1].score = 3;
  set.edges[1].es = 4;
  set.edges[1].z = set.edges[1].contrast_counts = 5;
  forget_contrast(set);
  for (const Edge& edge : set.edges) {
    EXPECT_TRUE(std::isnan(edge.contrast_counts) && std::isnan(edge.z) &&
                std::isnan(edge.log10_nfa));
  }
  EXPECT_EQ(set.edges[1].score, 3);
  EXPECT_EQ(set.edges[1].es, 4);
}

// A float frame of degrees, 64 counts each.
TEST(FrameUnits, AreThoseOfWhatWasMeasuredInCountsOnly) {
  Detection found;
  found.corrections.counts_per_unit = 64;
  found.corrections.noise = {6.4, 3.2, 1.6};
  found.corrections.stripes.columns = {64, -32};
  found.corrections.stripes.rows = {128};
  found.sigma_counts = 6.4;
  found.threshold_low = 2;
  found.edges.edgels.resize(1);
  found.edges.edgels.x[0] = 7;
  found.edges.edgels.magnitude_counts[0] = 640;
  found.edges.edges.resize(1);
  found.edges.edges[0].contrast_counts = -96;
  found.edges.edges[0].z = 5;
  convert_to_frame_units(found);
  EXPECT_EQ(found.corrections.noise.sigma_counts, 0.1);
  EXPECT_EQ(found.corrections.noise.column_sigma_counts, 0.05);
  EXPECT_EQ(found.corrections.noise.row_sigma_counts, 0.025);
  EXPECT_EQ(found.corrections.stripes.columns, (std::vector<float>{1, -0.5F}));
  EXPECT_EQ(found.corrections.stripes.rows, (std::vector<float>{2}));
  EXPECT_EQ(found.sigma_counts, 0.1);
  EXPECT_EQ(found.edges.edgels.magnitude_counts[0], 10);
  EXPECT_EQ(found.edges.edges[0].contrast_counts, -1.5);
  // Not in counts.
  EXPECT_EQ(found.threshold_low, 2);
  EXPECT_EQ(found.edges.edgels.x[0], 7);
  EXPECT_EQ(found.edges.edges[0].z, 5);
}

}  // namespace
}  // namespace thermedge::detail
