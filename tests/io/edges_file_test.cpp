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
  EXPECT_EQ(edge["contrast_counts"], 12.35);
  EXPECT_EQ(edge["contrast_sigmas"], 2.5);
  EXPECT_TRUE(edge["closed"]);
  EXPECT_EQ(json["junctions"], nlohmann::json::parse("[[8,1]]"));
  EXPECT_EQ(json["stats"]["edges_found"], 2);
}

// With what was measured at the points, each of another size.
Detection with_measures() {
  Detection detection = two_edges();
  Edgels& edgels = detection.edges.edgels;
  edgels.nx = {0.6F, -1, 0, 0.70710678F, -0.00001F};
  edgels.ny = {0.8F, 0, 1, -0.70710678F, 1};
  edgels.magnitude_counts = {1.23456F, 123.456F, 12345.6F, 0, 7};
  edgels.position_sigma_px = {0.0123456F, 0.123456F, 1.23456F, 0.5F, 0.25F};
  return detection;
}

nlohmann::json parsed(const Detection& detection, const EdgesFileOptions& options = {}) {
  return nlohmann::json::parse(edges_to_json(detection, "a.png", options));
}

TEST(EdgesJson, SaysWhichFrameItIsAndWhenItWasTaken) {
  Detection detection = two_edges();
  EXPECT_EQ(parsed(detection)["format_version"], kFormatVersion);
  EXPECT_EQ(parsed(detection)["frame"], 0);
  EXPECT_TRUE(parsed(detection)["stamp_ns"].is_null());
  detection.index = 41;
  detection.stamp_ns = 0;
  EXPECT_EQ(parsed(detection)["frame"], 41);
  EXPECT_EQ(parsed(detection)["stamp_ns"], 0) << "is a time as good as any";
  detection.stamp_ns = 1724423364092000001;
  EXPECT_EQ(parsed(detection)["stamp_ns"], 1724423364092000001);
}

TEST(EdgesJson, HasOfEachPointWhatIsAskedFor) {
  const Detection detection = with_measures();
  const auto usual = parsed(detection)["edges"][0];
  EXPECT_EQ(usual["normals"], nlohmann::json::parse("[[0.6,0.8],[-1.0,0.0],[0.0,1.0]]"));
  EXPECT_FALSE(usual.contains("strength_counts_per_px"));
  EXPECT_FALSE(usual.contains("position_sigma_px"));
  EdgesFileOptions options;
  options.normals = false;
  options.strengths = options.position_sigmas = true;
  const auto edge = parsed(detection, options)["edges"][0];
  EXPECT_FALSE(edge.contains("normals"));
  EXPECT_EQ(edge["strength_counts_per_px"], nlohmann::json({1.235, 123.5, 12350.0}));
  EXPECT_EQ(edge["position_sigma_px"], nlohmann::json({0.0123, 0.123, 1.23}));
  EXPECT_EQ(edge["points"], usual["points"]);
}

TEST(EdgesJson, MeasuresNothingAtThePointsOfAnEdgeMap) {
  Detection detection = with_measures();
  detection.edges.edges[0].contrast_counts = std::numeric_limits<double>::quiet_NaN();
  EdgesFileOptions options;
  options.strengths = options.position_sigmas = true;
  const auto edge = parsed(detection, options)["edges"][0];
  for (const char* key : {"normals", "strength_counts_per_px", "position_sigma_px"}) {
    EXPECT_TRUE(edge.contains(key) && edge[key].is_null()) << key;
  }
}

TEST(EdgesJson, NamesTheReasonOfEachDroppedEdge) {
  Detection detection = with_measures();
  detection.edges.edges[1].status = EdgeStatus::kLowContrast;
  detection.edges.edges.push_back(detection.edges.edges[1]);
  detection.edges.edges[2].status = EdgeStatus::kInsignificant;
  EXPECT_FALSE(parsed(detection).contains("dropped_edges"));
  EdgesFileOptions options;
  options.dropped_edges = true;
  const auto json = parsed(detection, options);
  EXPECT_EQ(json["edges"], parsed(detection)["edges"]);
  ASSERT_EQ(json["dropped_edges"].size(), 2U);
  EXPECT_EQ(json["dropped_edges"][0]["reason"], "low_contrast");
  EXPECT_EQ(json["dropped_edges"][1]["reason"], "insignificant");
  EXPECT_EQ(json["dropped_edges"][0]["points"], nlohmann::json::parse("[[10,5],[12.346,5]]"));
  EXPECT_EQ(json["dropped_edges"][0]["normals"][1], nlohmann::json({0.0, 1.0}));
}

TEST(EdgesJson, HasTheDigitsThatNumbersDeserve) {
  Detection detection = two_edges();
  Edge& edge = detection.edges.edges[0];
  edge.score = 2.866765877271155;
  edge.es = 0.00123456789;
  edge.z = -193.69612;
  edge.log10_nfa = -7127.4923;
  edge.length_px = 1534.42612;
  const std::string text = edges_to_json(detection, "");
  for (const char* part : {"\"score\":2.8668,", "\"es\":0.0012346,", "\"z\":-193.7,",
                           "\"log10_nfa\":-7127.0,", "\"length_px\":1534.4,"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
  }
}

TEST(EdgesCsv, HasARowForEachEdgelOfKeptEdges) {
  Detection detection = with_measures();
  detection.index = 7;
  const std::string header(edges_csv_header());
  EXPECT_EQ(header,
            "frame,stamp_ns,edge,status,score,contrast_counts,point,x_px,y_px,normal_x,normal_y,"
            "strength_counts_per_px,position_sigma_px,is_corner\n");
  EXPECT_EQ(edges_to_csv_rows(detection),
            "7,,0,kept,1e-07,12.35,0,1,1,0.6,0.8,1.235,0.0123,1\n"
            "7,,0,kept,1e-07,12.35,1,8,1,-1,0,123.5,0.123,1\n"
            "7,,0,kept,1e-07,12.35,2,4,6,0,1,12350,1.23,1\n");
  detection.stamp_ns = 12500000;
  detection.edges.edges[0].contrast_counts = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(edges_to_csv_rows(detection).substr(0, 42),
            "7,12500000,0,kept,1e-07,,0,1,1,,,,,1\n7,125");
}

TEST(EdgesCsv, NamesTheReasonOfDroppedEdges) {
  Detection detection = with_measures();
  detection.edges.edges[1].status = EdgeStatus::kBeyondBudget;
  EdgesFileOptions options;
  options.dropped_edges = true;
  const std::string rows = edges_to_csv_rows(detection, options);
  EXPECT_TRUE(rows.starts_with(edges_to_csv_rows(detection)));
  EXPECT_TRUE(
      rows.ends_with("0,,1,beyond_budget,0,0,0,10,5,0.7071,-0.7071,0,0.5,1\n"
                     "0,,1,beyond_budget,0,0,1,12.346,5,0,1,7,0.25,1\n"))
      << rows;
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

TEST(Overlay, DrawsKeptEdgesByRankAtTwiceTheSize) {
  Image<Rgb> overlay;
  draw_overlay(two_edges(), {}, overlay);
  ASSERT_EQ(overlay.width(), 40);
  ASSERT_EQ(overlay.height(), 20);
  EXPECT_EQ(overlay(9, 3), rank_colour(0));  // on the side from (1, 1) to (8, 1)
  EXPECT_EQ(overlay(23, 11), overlay(0, 0)) << "the line beyond the budget is not drawn";
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
