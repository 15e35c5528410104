#include <charconv>
#include <string>

#include "thermedge/io/edges_file.hpp"
#include "thermedge/io/overlay.hpp"

namespace thermedge::io {
namespace {

// Builds SVG text; numbers do not depend on the locale.
class SvgText {
 public:
  SvgText& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  SvgText& operator<<(double value) {
    char digits[32];
    text_.append(std::begin(digits),
                 std::to_chars(std::begin(digits), std::end(digits), value).ptr);
    return *this;
  }
  SvgText& operator<<(Rgb colour) {
    return *this << "rgb(" << colour.r << "," << colour.g << "," << colour.b << ")";
  }
  SvgText& escaped(std::string_view text) {
    for (const char c : text) {
      switch (c) {
        case '&':
          text_ += "&amp;";
          break;
        case '<':
          text_ += "&lt;";
          break;
        case '>':
          text_ += "&gt;";
          break;
        default:
          text_ += c;
      }
    }
    return *this;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void append_edge(SvgText& svg, const EdgeSet& set, const Edge& edge, Rgb colour) {
  const Edgels& e = set.edgels;
  svg << "<path id=\"edge" << edge.index << "\" stroke=\"" << colour << "\" d=\"";
  for (std::uint32_t i = 0; i < edge.edgels.count; ++i) {
    const std::uint32_t at = edge.edgels.first + i;
    svg << (i == 0 ? "M" : "L") << e.x[at] << " " << e.y[at];
  }
  svg << (edge.closed ? "Z" : "") << "\"><title>edge " << edge.index << ", rank " << edge.rank
      << ", score " << edge.score << ", " << edge.length_px << " px</title></path>\n";
  for (const std::uint32_t corner : set.corners_of(edge)) {
    const std::uint32_t at = edge.edgels.first + corner;
    svg << "<rect x=\"" << e.x[at] - 0.5 << "\" y=\"" << e.y[at] - 0.5
        << "\" width=\"1\" height=\"1\" stroke=\"white\"/>\n";
  }
}

}  // namespace

std::string edges_to_svg(const Detection& detection, const std::string& source) {
  const EdgeSet& set = detection.edges;
  SvgText svg;
  // Pixel centres lie at integers, so the frame begins half a pixel before 0.
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-0.5 -0.5 " << detection.width << " "
      << detection.height << "\" width=\"" << 2 * detection.width << "\" height=\""
      << 2 * detection.height << "\">\n<title>";
  svg.escaped(source) << ", preset ";
  svg.escaped(preset_name(detection.preset))
      << "</title>\n<rect x=\"-0.5\" y=\"-0.5\" width=\"100%\" "
         "height=\"100%\" fill=\"#181818\"/>\n"
      << "<g fill=\"none\" stroke-width=\"0.6\">\n";
  const double last = set.kept > 1 ? static_cast<double>(set.kept - 1) : 1.0;
  for (std::size_t i = set.kept; i-- > 0;) {
    append_edge(svg, set, set.edges[i], rank_colour(static_cast<double>(i) / last));
  }
  for (const Junction& junction : set.junctions) {
    svg << "<circle cx=\"" << junction.at.x << "\" cy=\"" << junction.at.y
        << "\" r=\"1.5\" stroke=\"#5adcff\"/>\n";
  }
  svg << "</g>\n</svg>\n";
  return svg.take();
}

}  // namespace thermedge::io
