// Contours and corners against the public code that the paper used: exactly, missing and extra.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "support/drawing.hpp"
#include "support/images.hpp"
#include "support/oracle.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/corners_paper.hpp"

namespace thermedge::test {
namespace {

ContourSet trace(const OracleMap& map) {
  ContourOptions options;
  options.min_component_px = 0;
  options.closed_gap_px = 5.66;  // as the public code has it
  options.gap_px = map.gap_px;
  ContourSet contours;
  EXPECT_TRUE(ContourTracer(options).run(map.edges, contours));
  return contours;
}

CornerSet find_corners(const ContourSet& contours, bool end_points) {
  PaperCornerOptions options;
  options.end_points = end_points;
  CornerSet corners;
  EXPECT_TRUE(PaperCornerFinder(options).run(contours, corners));
  return corners;
}

void expect_same_contours(const OracleMap& map) {
  const ContourSet contours = trace(map);
  ASSERT_EQ(contours.items.size(), map.curves.size());
  for (std::size_t i = 0; i < map.curves.size(); ++i) {
    SCOPED_TRACE("curve " + std::to_string(i));
    EXPECT_EQ(contours.items[i].closed, map.curves[i].closed);
    EXPECT_EQ(pixels_of(contours, i), map.curves[i].pixels);
  }
}

// Curves whose corners, ends apart, are not those of the oracle.
std::size_t count_wrong_curves(const OracleMap& map) {
  const CornerSet corners = find_corners(trace(map), false);
  EXPECT_EQ(corners.ranges.size(), map.curves.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < map.curves.size(); ++i) {
    const auto indices = slice(corners.indices, corners.ranges[i]);
    wrong += !std::equal(indices.begin(), indices.end(), map.curves[i].corners.begin(),
                         map.curves[i].corners.end());
  }
  return wrong;
}

// All corners of the frame with the ends, in one order.
std::vector<Pixel> sorted(std::vector<Pixel> pixels) {
  std::sort(pixels.begin(), pixels.end(),
            [](Pixel a, Pixel b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); });
  return pixels;
}

std::vector<Pixel> all_corners(const OracleMap& map) {
  const ContourSet contours = trace(map);
  const CornerSet corners = find_corners(contours, true);
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    for (const std::uint32_t index : slice(corners.indices, corners.ranges[i])) {
      pixels.push_back(contours.pixels(contours.items[i])[index]);
    }
  }
  return sorted(pixels);
}

std::filesystem::path drawn_directory() {
  return std::filesystem::path(THERMEDGE_TEST_DATA) / "oracle";
}
std::filesystem::path photograph_directory() { return shared_directory() / "oracle"; }

TEST(Oracle, DrawnShapesAreAllThere) {
  EXPECT_EQ(oracle_files(drawn_directory(), true).size(), 15U);
}

TEST(Oracle, ContoursOfDrawnShapes) {
  for (const auto& file : oracle_files(drawn_directory(), true)) {
    SCOPED_TRACE(file.filename().string());
    expect_same_contours(read_oracle(file));
  }
}

TEST(Oracle, CornersOfDrawnShapes) {
  for (const auto& file : oracle_files(drawn_directory(), true)) {
    SCOPED_TRACE(file.filename().string());
    const OracleMap map = read_oracle(file);
    EXPECT_EQ(count_wrong_curves(map), 0U);
    EXPECT_EQ(all_corners(map), sorted(map.corners));
  }
}

TEST(Oracle, ContoursOfPhotographs) {
  THERMEDGE_NEEDS_SHARED("oracle");
  const auto files = oracle_files(photograph_directory(), false);
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    expect_same_contours(read_oracle(file));
  }
}

// A curvature of 0 or 0.01, or one angle, can hang on the last bit of a library function.
TEST(Oracle, CornersOfPhotographs) {
  THERMEDGE_NEEDS_SHARED("oracle");
  std::size_t curves = 0;
  std::size_t wrong_curves = 0;
  std::size_t corners = 0;
  std::size_t wrong_corners = 0;
  for (const auto& file : oracle_files(photograph_directory(), false)) {
    const OracleMap map = read_oracle(file);
    curves += map.curves.size();
    wrong_curves += count_wrong_curves(map);
    const auto found = all_corners(map);
    const auto wanted = sorted(map.corners);
    std::vector<Pixel> missing_or_extra;
    std::set_symmetric_difference(found.begin(), found.end(), wanted.begin(), wanted.end(),
                                  std::back_inserter(missing_or_extra), [](Pixel a, Pixel b) {
                                    return std::tie(a.y, a.x) < std::tie(b.y, b.x);
                                  });
    corners += wanted.size();
    wrong_corners += missing_or_extra.size();
  }
  RecordProperty("curves", static_cast<int>(curves));
  RecordProperty("wrong_curves", static_cast<int>(wrong_curves));
  EXPECT_GT(curves, 700U);
  EXPECT_LE(static_cast<double>(wrong_curves), 0.005 * static_cast<double>(curves));
  EXPECT_LE(static_cast<double>(wrong_corners), 0.005 * static_cast<double>(corners));
}

}  // namespace
}  // namespace thermedge::test
