#include "thermedge/io/edges_file.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "thermedge/io/overlay.hpp"

namespace thermedge::io {
namespace {

// A closed triangle and a line that touches it; the line is beyond the budget.
Detection two_edges() {
  Detection detection;
  detection.width = 20;
  detection.height = 10;
  detection.sigma_counts = 5.8;
  EdgeSet& set = detection.edges;
  set.edgels.resize(5);
  set.edgels.x = {1, 8, 4, 10, 12.3456F};
  set.edgels.y = {1, 1, 6, 5, 5};
  set.corners = {0, 1, 2, 0, 1};
  set.connections = {1, 0};
  set.edges.resize(2);
  set.edges[0].closed = true;
  set.edges[0].kept = true;
  set.edges[0].score = 1e-7;
  set.edges[0].z = std::numeric_limits<double>::quiet_NaN();
  set.edges[0].contrast_counts = 12.3456;
  set.edges[0].contrast_sigmas = 2.5;
  set.edges[0].edgels = {0, 3};
  set.edges[0].corners = {0, 3};
  set.edges[0].connections = {0, 1};
  set.edges[1].index = set.edges[1].rank = 1;
  set.edges[1].edgels = {3, 2};
  set.edges[1].corners = {3, 2};
  set.edges[1].connections = {1, 1};
  set.junctions = {{{8, 1}}};
  set.kept = 1;
  return detection;
}

TEST(EdgesJson, HoldsTheKeptEdges) {
  const auto json = nlohmann::json::parse(edges_to_json(two_edges(), "a.png"));
  EXPECT_EQ(json["source"], "a.png");
  EXPECT_EQ(json["sigma_counts"], 5.8);
  ASSERT_EQ(json["edges"].size(), 1U);
  const auto& edge = json["edges"][0];
  EXPECT_EQ(edge["points"], nlohmann::json::parse("[[1,1],[8,1],[4,6]]"));
  EXPECT_EQ(edge["corners"], nlohmann::json::parse("[0,1,2]"));
  EXPECT_EQ(edge["connected"], nlohmann::json::parse("[1]"));
  EXPECT_EQ(edge["score"], 1e-7);
  EXPECT_TRUE(edge["z"].is_null());
  EXPECT_EQ(edge["contrast_counts"], 12.346);
  EXPECT_EQ(edge["contrast_sigmas"], 2.5);
  EXPECT_TRUE(edge["closed"]);
  EXPECT_EQ(json["junctions"], nlohmann::json::parse("[[8,1]]"));
  EXPECT_EQ(json["stats"]["edges_found"], 2);
}

TEST(EdgesJson, RoundsPointsToAThousandth) {
  Detection detection = two_edges();
  detection.edges.kept = 2;
  const auto json = nlohmann::json::parse(edges_to_json(detection, ""));
  EXPECT_EQ(json["edges"][1]["points"][1][0], 12.346);
}

TEST(EdgesJson, SaysWhatWasMeasuredAndChosen) {
  Detection detection = two_edges();
  detection.corrections.noise = {5.5, 1.25, 0.75};
  const auto of_canny = nlohmann::json::parse(edges_to_json(detection, ""));
  EXPECT_EQ(of_canny["stats"]["measured"]["pixel_sigma_counts"], 5.5);
  EXPECT_EQ(of_canny["stats"]["measured"]["column_sigma_counts"], 1.25);
  EXPECT_FALSE(of_canny["stats"]["measured"].contains("unit_counts"));
  NoiseModel& noise = detection.corrections.noise_model;
  noise.level_counts = 6.25;
  noise.spectrum[8 * 2 + 3] = 0.5F;
  Image<float> nodes(2, 2);
  fill_pixels(nodes.view(), 1.5F);
  nodes(1, 0) = 0.75F;
  noise.map.set_nodes(nodes, 40, 20);
  detection.unit_counts = 45.2;
  detection.kernel_px = {1.2, 2.5};
  const auto json = nlohmann::json::parse(edges_to_json(detection, ""));
  EXPECT_EQ(json["stats"]["measured"]["unit_counts"], 45.2);
  EXPECT_EQ(json["stats"]["measured"]["level_counts"], 6.25);
  EXPECT_EQ(json["stats"]["measured"]["level_range"], nlohmann::json({0.75, 1.5}));
  EXPECT_EQ(json["stats"]["measured"]["spectrum"][2][3], 0.5);
  EXPECT_EQ(json["stats"]["measured"]["kernel_px"], nlohmann::json({1.2, 2.5}));
}

TEST(EdgesJson, CountsTheDroppedEdgesByTheReason) {
  Detection detection = two_edges();
  for (const EdgeStatus status :
       {EdgeStatus::kWeak, EdgeStatus::kInsignificant, EdgeStatus::kInsignificant,
        EdgeStatus::kLowContrast, EdgeStatus::kLowContrast, EdgeStatus::kLowContrast,
        EdgeStatus::kBeyondBudget}) {
    detection.edges.edges.emplace_back().status = status;
  }
  const auto json = nlohmann::json::parse(edges_to_json(detection, ""));
  EXPECT_EQ(json["stats"]["edges_dropped"],
            nlohmann::json(
                {{"weak", 1}, {"insignificant", 2}, {"low_contrast", 3}, {"beyond_budget", 1}}));
}

TEST(EdgesJson, SaysWhatAlgorithm1ClippedWherePresetPaperRan) {
  Detection detection = two_edges();
  EXPECT_FALSE(
      nlohmann::json::parse(edges_to_json(detection, ""))["stats"].contains("clipped_low_share"));
  detection.preset = Preset::kPaper;
  detection.clipped = {0.125, 0.25};
  const auto json = nlohmann::json::parse(edges_to_json(detection, ""));
  EXPECT_EQ(json["stats"]["clipped_low_share"], 0.125);
  EXPECT_EQ(json["stats"]["clipped_high_share"], 0.25);
}

TEST(EdgesJson, IsOneLineWhateverTheName) {
  const std::string text = edges_to_json(two_edges(), "a.png");
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  EXPECT_TRUE(nlohmann::json::accept(text));
}

TEST(EdgesSvg, TitlesSayHowSureAndHowStrongWhereThatIsKnown) {
  Detection detection = two_edges();
  detection.edges.edges[0].log10_nfa = -7.128;
  EXPECT_NE(
      edges_to_svg(detection, "")
          .find(" px, log10 of false alarms -7.13, contrast 12.35 counts = 2.5 sigma</title>"),
      std::string::npos);
  Edge& edge = detection.edges.edges[0];
  edge.log10_nfa = -std::numeric_limits<double>::infinity();
  edge.contrast_sigmas = std::numeric_limits<double>::infinity();
  EXPECT_NE(edges_to_svg(detection, "").find(" px, contrast 12.35 counts</title>"),
            std::string::npos);
}

TEST(EdgesSvg, DrawsClosedPathsAndEscapesNames) {
  const std::string svg = edges_to_svg(two_edges(), "a<b>&c");
  EXPECT_NE(svg.find("d=\"M1 1L8 1L4 6Z\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("a&lt;b&gt;&amp;c"), std::string::npos);
  EXPECT_EQ(svg.find("edge1"), std::string::npos);
}

TEST(Overlay, DrawsKeptEdgesByRankAndOthersMutedAtTwiceTheSize) {
  Image<Rgb> overlay;
  draw_overlay(two_edges(), {}, overlay);
  ASSERT_EQ(overlay.width(), 40);
  ASSERT_EQ(overlay.height(), 20);
  EXPECT_EQ(overlay(9, 3), rank_colour(0));         // on the side from (1, 1) to (8, 1)
  EXPECT_EQ(overlay(23, 11), (Rgb{70, 120, 150}));  // the line beyond the budget is muted
}

TEST(Overlay, ViewSpreadsTheRangeAndDoesNotBlowUpNoise) {
  Image<std::uint16_t> counts(100, 1);
  Image<std::uint8_t> view(100, 1);
  for (int x = 0; x < 100; ++x) {
    counts(x, 0) = static_cast<std::uint16_t>(3000 + 10 * x);
  }
  draw_view(counts, view);
  EXPECT_EQ(view(0, 0), 0);
  EXPECT_GE(view(99, 0), 253);
  for (int x = 0; x < 100; ++x) {
    counts(x, 0) = static_cast<std::uint16_t>(3000 + x % 2);
  }
  draw_view(counts, view);
  EXPECT_LE(std::abs(view(1, 0) - view(0, 0)), 16);
}

}  // namespace
}  // namespace thermedge::io
