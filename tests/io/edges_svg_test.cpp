// Drawings of edges as SVG.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/edge_sets.hpp"
#include "thermedge/io/edges_file.hpp"

namespace thermedge::io {
namespace {

Detection detection_of(int width, int height) {
  Detection detection;
  detection.width = width;
  detection.height = height;
  return detection;
}

// Parts of the text in the order given.
testing::AssertionResult holds_in_order(const std::string& text,
                                        const std::vector<std::string>& parts) {
  std::size_t at = 0;
  for (const std::string& part : parts) {
    at = text.find(part, at);
    if (at == std::string::npos) {
      return testing::AssertionFailure() << "'" << part << "' is missing in\n" << text;
    }
    at += part.size();
  }
  return testing::AssertionSuccess();
}

TEST(EdgesSvg, DrawsTheWorstFirstWithCornersAndJunctions) {
  Detection detection = detection_of(40, 30);
  test::add_edge(detection.edges, {{1.5F, 2}, {3, 2.25F}}).corners = {0, 2};
  test::add_edge(detection.edges, {{5, 6}, {5, 9}, {8, 9}}, true);
  test::add_edge(detection.edges, {{20, 20}, {30, 20}}, false, false);
  detection.edges.corners = {0, 1};
  detection.edges.junctions = {{{7, 8}}};
  const std::string svg = edges_to_svg(detection, "x.png");
  EXPECT_TRUE(holds_in_order(
      svg, {"<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-0.5 -0.5 40 30\"",
            "width=\"80\" height=\"60\"", "<title>x.png, preset robust</title>",
            "<path id=\"edge1\" stroke=\"rgb(177,42,144)\"", "d=\"M5 6L5 9L8 9Z\"",
            "<title>edge 1, rank 1", "<path id=\"edge0\" stroke=\"rgb(240,249,33)\"",
            "d=\"M1.5 2L3 2.25\"", "<rect x=\"1\" y=\"1.5\" width=\"1\" height=\"1\"",
            "<rect x=\"2.5\" y=\"1.75\"", "<circle cx=\"7\" cy=\"8\"", "</g>\n</svg>\n"}));
  EXPECT_EQ(svg.find("M20"), std::string::npos);
}

// File names may be any bytes, text in XML may not: nlohmann's strict writer tells UTF-8 from what
// is none.
TEST(EdgesSvg, IsUtf8WithoutControlCharactersWhateverTheName) {
  const auto title_of = [](const std::string& name) {
    const std::string svg = edges_to_svg(detection_of(1, 1), name);
    EXPECT_NO_THROW((void)nlohmann::json(svg).dump()) << testing::PrintToString(name);
    EXPECT_TRUE(std::none_of(svg.begin(), svg.end(), [](char c) {
      return c >= 0 && c < ' ' && c != '\n' && c != '\t' && c != '\r';
    }));
    const std::size_t begin = svg.find("<title>") + 7;
    return svg.substr(begin, svg.find(", preset") - begin);
  };
  for (const std::string name :
       {"T\u00fcr", "\u07ff\u0800\ud7ff\ue000", "\U0001f525\U0010ffff", "a\tb"}) {
    EXPECT_EQ(title_of(name), name);
  }
  EXPECT_EQ(title_of("T\xfcr"), "T?r");
  EXPECT_EQ(title_of("\x1b[31m\x01"), "?[31m?");
  EXPECT_EQ(title_of("\xc3"), "?");
  EXPECT_EQ(title_of("\xef\xbf\xbd\xef\xbf\xbe\xef\xbf\xbf"), "\ufffd??????");
  EXPECT_EQ(title_of("\xe2\x82<"), "??&lt;");
  EXPECT_EQ(title_of("\xc1\xbf \xe0\x9f\xbf \xf0\x8f\xbf\xbf"), "?? ??? ????");  // too long
  EXPECT_EQ(title_of("\xed\xa0\x80 \xf4\x90\x80\x80"), "??? ????");  // surrogate, too large
  for (int first = 1; first < 256; ++first) {
    for (const char* rest : {"", "a", "\x80", "\xbf\xbf", "\x80\x80\x80", "\xff"}) {
      (void)title_of(static_cast<char>(first) + std::string(rest));
    }
  }
}

}  // namespace
}  // namespace thermedge::io
