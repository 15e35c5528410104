#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "results/csv_text.hpp"
#include "results/digits.hpp"
#include "thermedge/io/edges_file.hpp"

namespace thermedge::io {
namespace {

constexpr std::string_view kHeader =
    "frame,stamp_ns,edge,status,score,contrast_counts,point,x_px,y_px,normal_x,normal_y,"
    "strength_counts_per_px,position_sigma_px,is_corner\n";

void append_edge(CsvText& csv, const std::string& frame, const EdgeSet& set, const Edge& edge) {
  const Edgels& e = set.edgels;
  const bool is_measured = std::isfinite(edge.contrast_counts);  // an edge map has no frame
  const auto corners = set.corners_of(edge);
  const auto measured = [&](double value) { return is_measured ? value : NAN; };
  for (std::uint32_t i = 0; i < edge.edgels.count; ++i) {
    const std::uint32_t at = edge.edgels.first + i;
    const bool is_corner = std::find(corners.begin(), corners.end(), i) != corners.end();
    csv << std::string_view(frame) << std::int64_t{edge.index} << status_name(edge.status)
        << to_significant(edge.score, kScoreDigits)
        << to_significant(edge.contrast_counts, kContrastDigits) << std::int64_t{i}
        << to_decimals(e.x[at], kPositionDecimals) << to_decimals(e.y[at], kPositionDecimals)
        << to_decimals(measured(e.nx[at]), kNormalDecimals)
        << to_decimals(measured(e.ny[at]), kNormalDecimals)
        << to_significant(measured(e.magnitude_counts[at]), kStrengthDigits)
        << to_significant(measured(e.position_sigma_px[at]), kPositionSigmaDigits)
        << std::int64_t{is_corner ? 1 : 0};
    csv.end_row();
  }
}

}  // namespace

std::string_view edges_csv_header() { return kHeader; }

std::string edges_to_csv_rows(const Detection& detection, const EdgesFileOptions& options) {
  const EdgeSet& set = detection.edges;
  const std::string frame = frame_cells(detection);
  CsvText csv;
  const std::size_t count = options.dropped_edges ? set.edges.size() : set.kept;
  for (std::size_t i = 0; i < count; ++i) {
    append_edge(csv, frame, set, set.edges[i]);
  }
  return csv.text();
}

}  // namespace thermedge::io
