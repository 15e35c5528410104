// What each stage of preset robust makes of two simulated frames, as hashes: the first stage that
// differs is the one that changed. A test that fails prints the new table.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "support/hash.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

using test::Hash;

using StageHashes = std::vector<std::pair<std::string, std::uint64_t>>;

constexpr double kRelative = 1e-6;  // steps of what is rounded
constexpr double kPixel = 1e-3;

std::uint64_t noise_hash(const Detection& found) {
  return Hash()
      .add_rounded(found.corrections.noise.sigma_counts, kRelative)
      .add_rounded(found.corrections.noise.column_sigma_counts, kRelative)
      .add_rounded(found.corrections.noise.row_sigma_counts, kRelative)
      .add_rounded(found.sigma_counts, kRelative)
      .add_rounded(found.corrections.noise_model.level_counts, kRelative)
      .add_rounded(found.unit_counts, kRelative)
      .value();
}

std::uint64_t bad_pixels_hash(const Detection& found) {
  Hash hash;
  for (const BadPixel& pixel : found.corrections.bad_pixels) {
    hash.add(pixel.x).add(pixel.y);
  }
  return hash.value();
}

std::uint64_t stripes_hash(const Detection& found) {
  Hash hash;
  for (const auto* offsets :
       {&found.corrections.stripes.columns, &found.corrections.stripes.rows}) {
    hash.add(offsets->size());
    for (const float offset : *offsets) {
      hash.add_rounded(static_cast<double>(offset), 1e-4);
    }
  }
  return hash.value();
}

void add_contours(const ContourSet& set, Hash& hash) {
  hash.add(set.items.size()).add(set.junctions.size());
  for (const Contour& contour : set.items) {
    hash.add(contour.closed).add(contour.points.count);
    for (const Pixel pixel : set.pixels(contour)) {
      hash.add(pixel);
    }
  }
  for (const Junction& junction : set.junctions) {
    hash.add(junction.at);
  }
}

std::uint64_t contours_hash(const Intermediates& steps) {
  Hash hash;
  add_contours(steps.contours, hash);
  return hash.value();
}

std::uint64_t linked_hash(const Intermediates& steps) {
  Hash hash;
  add_contours(steps.linked.contours, hash);
  for (const Link& link : steps.linked.links) {
    hash.add(static_cast<int>(link.type)).add(link.a).add(link.b).add(link.from).add(link.to);
  }
  return hash.value();
}

std::uint64_t corners_hash(const Detection& found) {
  Hash hash;
  for (const Edge& edge : found.edges.edges) {
    hash.add(edge.corners.count);
    for (const std::uint32_t corner : found.edges.corners_of(edge)) {
      hash.add(corner);
    }
  }
  return hash.value();
}

std::uint64_t scores_hash(const Detection& found) {
  Hash hash;
  for (const Edge& edge : found.edges.edges) {
    hash.add(edge.edgels.count).add(edge.closed);
    hash.add_rounded(edge.score, kRelative).add_rounded(edge.length_px, kRelative);
    for (const std::int32_t other : found.edges.connections_of(edge)) {
      hash.add(other);
    }
  }
  return hash.value();
}

std::uint64_t significance_hash(const Detection& found) {
  Hash hash;
  for (const Edge& edge : found.edges.edges) {
    hash.add_rounded(edge.contrast_counts, kRelative);
    hash.add_rounded(edge.z, kRelative).add_rounded(edge.log10_nfa, kRelative);
  }
  return hash.value();
}

std::uint64_t positions_hash(const Detection& found) {
  const Edgels& edgels = found.edges.edgels;
  Hash hash;
  for (std::size_t i = 0; i < edgels.size(); ++i) {
    for (const auto* values : {&edgels.x, &edgels.y, &edgels.nx, &edgels.ny,
                               &edgels.magnitude_counts, &edgels.position_sigma_px}) {
      hash.add_rounded(static_cast<double>((*values)[i]), kPixel);
    }
  }
  return hash.value();
}

std::uint64_t selection_hash(const Detection& found) {
  Hash hash;
  hash.add(found.edges.kept);
  for (const Edge& edge : found.edges.edges) {
    hash.add(static_cast<int>(edge.status)).add(edge.kept).add(edge.rank);
  }
  for (const Junction& junction : found.edges.junctions) {
    hash.add(junction.at);
  }
  return hash.value();
}

StageHashes hashes_of(ImageView<const std::uint16_t> counts, const Detection& found,
                      const Intermediates& steps) {
  return {{"frame", Hash().add_pixels(counts).value()},
          {"noise", noise_hash(found)},
          {"bad pixels", bad_pixels_hash(found)},
          {"stripes", stripes_hash(found)},
          {"corrected", Hash().add_pixels(steps.corrected.view()).value()},
          {"levels", Hash().add_pixels(steps.levels.view()).value()},
          {"denoised", Hash().add_pixels(steps.denoised.view()).value()},
          {"edge pixels", Hash().add_pixels(steps.edge_map.view()).value()},
          {"contours", contours_hash(steps)},
          {"linked", linked_hash(steps)},
          {"corners", corners_hash(found)},
          {"scores", scores_hash(found)},
          {"significance", significance_hash(found)},
          {"positions", positions_hash(found)},
          {"selection", selection_hash(found)}};
}

std::string table(const StageHashes& hashes) {
  std::string text;
  for (const auto& [stage, hash] : hashes) {
    char digits[24];
    std::snprintf(digits, sizeof digits, "0x%016llX", static_cast<unsigned long long>(hash));
    text += "{\"" + stage + "\", " + digits + "},\n";
  }
  return text;
}

void expect_hashes(const std::string& spec, const StageHashes& wanted) {
  const auto scene = sim::parse_scene(spec);
  ASSERT_TRUE(scene);
  const auto frame = sim::render(*scene, 0);
  ASSERT_TRUE(frame);
  auto detector = Detector::create(DetectorOptions(Preset::kRobust));
  ASSERT_TRUE(detector);
  Detection found;
  Intermediates steps;
  ASSERT_TRUE(detector->detect(frame->counts, found, {&steps, {}}));
  // Each stage has something to do.
  EXPECT_FALSE(found.corrections.bad_pixels.empty());
  EXPECT_FALSE(found.corrections.stripes.columns.empty());
  EXPECT_FALSE(steps.linked.links.empty());
  EXPECT_GT(found.edges.kept, 5U);
  EXPECT_LT(found.edges.kept, found.edges.edges.size());
  EXPECT_EQ(table(hashes_of(frame->counts, found, steps)), table(wanted));
}

TEST(GoldenStages, OfRobustInLittleNoise) {
  expect_hashes("sim:corridor?sigma=8&column_sigma=6&row_sigma=3&bad_pixels=20",
                {{"frame", 0x097D3CB601F24096},
                 {"noise", 0xA9775CC9614F2693},
                 {"bad pixels", 0x9B5DF59D2CE9529D},
                 {"stripes", 0xA34DF5CC97420469},
                 {"corrected", 0x3466E019913AF4BE},
                 {"levels", 0xE815BA5793A82FD9},
                 {"denoised", 0x6CFE09576B8667A9},
                 {"edge pixels", 0x992A886A39B62364},
                 {"contours", 0xC52F0169CEEFEB71},
                 {"linked", 0xE30B9886B6723516},
                 {"corners", 0xD788C75948A90CE7},
                 {"scores", 0xFD71DEB660DA7933},
                 {"significance", 0x029E2182EDD394CC},
                 {"positions", 0x23831A517D926EDB},
                 {"selection", 0xB29A3114F5466D22}});
}

TEST(GoldenStages, OfRobustInStrongNoise) {
  expect_hashes("sim:desk?sigma=60&column_sigma=30&bad_pixels=20",
                {{"frame", 0x2A43AE39268BB285},
                 {"noise", 0xDD4A6DEF7903F239},
                 {"bad pixels", 0x9B5DF59D2CE9529D},
                 {"stripes", 0x9D4065D4441131E6},
                 {"corrected", 0x9874609204C7CFA3},
                 {"levels", 0x3BB435AA73833696},
                 {"denoised", 0x6FED01B3F83AC466},
                 {"edge pixels", 0xFD5EEA742145A03B},
                 {"contours", 0xDDF4467CB17BB0FA},
                 {"linked", 0x7FB1BD3FCDFB6212},
                 {"corners", 0xE92B3C3CC77F95B2},
                 {"scores", 0xE574F5425353432D},
                 {"significance", 0x629F9B416EB5AF56},
                 {"positions", 0xBC46CE2851B44E84},
                 {"selection", 0x9DCEFB96422B0778}});
}

}  // namespace
}  // namespace thermedge
