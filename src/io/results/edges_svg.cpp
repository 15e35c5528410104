#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "results/digits.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/io/overlay.hpp"

namespace thermedge::io {
namespace {

// Length of the UTF-8 character that `text` begins with; 0 where there is none, or one that XML 1.0
// forbids (its production 2).
std::size_t character_length(std::string_view text) {
  constexpr unsigned kLeastOfLength[] = {0, 0, 0x80, 0x800, 0x10000};
  const auto byte_at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte_at(0);
  if (lead < 0x80) {
    return lead >= ' ' || lead == '\t' || lead == '\n' || lead == '\r' ? 1 : 0;
  }
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC0 || lead >= 0xF8 || text.size() < length) {
    return 0;
  }
  unsigned code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(i) & 0xC0U) != 0x80) {
      return 0;
    }
    code = code << 6 | (byte_at(i) & 0x3FU);
  }
  const bool allowed =
      code < 0xD800 || (code > 0xDFFF && code < 0xFFFE) || (code > 0xFFFF && code <= 0x10FFFF);
  return allowed && code >= kLeastOfLength[length] ? length : 0;
}

// Two digits after the point say all that is known of a contrast.
double shortened(double value) { return std::round(value * 100) / 100; }

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
  // What cannot stand in XML, as in file names that are not UTF-8, becomes question marks.
  SvgText& escaped(std::string_view text) {
    while (!text.empty()) {
      const std::size_t length = character_length(text);
      const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
      text.remove_prefix(character.size());
      switch (character[0]) {
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
          text_ += length > 0 ? character : "?";
      }
    }
    return *this;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

// How sure and how strong, where a frame tells. Without noise an edge is certain.
void append_evidence(SvgText& svg, const Edge& edge) {
  if (std::isfinite(edge.log10_nfa)) {
    svg << ", log10 of false alarms " << shortened(edge.log10_nfa);
  }
  if (std::isfinite(edge.contrast_counts)) {
    svg << ", contrast " << shortened(edge.contrast_counts) << " counts";
  }
  if (std::isfinite(edge.contrast_sigmas)) {
    svg << " = " << shortened(edge.contrast_sigmas) << " sigma";
  }
}

void append_edge(SvgText& svg, const EdgeSet& set, const Edge& edge, Rgb colour) {
  const Edgels& e = set.edgels;
  svg << "<path id=\"edge" << edge.index << "\" stroke=\"" << colour << "\" d=\"";
  for (std::uint32_t i = 0; i < edge.edgels.count; ++i) {
    const std::uint32_t at = edge.edgels.first + i;
    svg << (i == 0 ? "M" : "L") << to_decimals(e.x[at], kPositionDecimals) << " "
        << to_decimals(e.y[at], kPositionDecimals);
  }
  svg << (edge.closed ? "Z" : "") << "\"><title>edge " << edge.index << ", rank " << edge.rank
      << ", score " << to_significant(edge.score, kScoreDigits) << ", "
      << to_decimals(edge.length_px, 1) << " px";
  append_evidence(svg, edge);
  svg << "</title></path>\n";
  for (const std::uint32_t corner : set.corners_of(edge)) {
    const std::uint32_t at = edge.edgels.first + corner;
    svg << "<rect x=\"" << to_decimals(e.x[at] - 0.5, kPositionDecimals) << "\" y=\""
        << to_decimals(e.y[at] - 0.5, kPositionDecimals)
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
