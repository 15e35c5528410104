#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "results/csv_text.hpp"
#include "results/digits.hpp"
#include "thermedge/io/tracks_file.hpp"

namespace thermedge::io {
namespace {

constexpr std::string_view kHeader =
    "frame,stamp_ns,track,edge,point,x_px,y_px,smooth_x_px,smooth_y_px,normal_x,normal_y,"
    "strength_counts_per_px,position_sigma_px\n";

}  // namespace

std::string_view tracks_csv_header() { return kHeader; }

std::string tracks_to_csv_rows(const TrackedFrame& frame) {
  const Detection& detection = frame.detection;
  const Edgels& e = detection.edges.edgels;
  const std::string of_frame = frame_cells(detection);
  CsvText csv;
  for (const TrackRun& run : frame.tracks.runs) {
    for (std::uint32_t i = 0; i < run.edgels.count; ++i) {
      const std::size_t at = run.edgels.first + i;
      const Edge& edge = detection.edges.edges[static_cast<std::size_t>(e.edge[at])];
      csv << std::string_view(of_frame) << run.track << std::int64_t{edge.index}
          << static_cast<std::int64_t>(at - edge.edgels.first)
          << to_decimals(e.x[at], kPositionDecimals) << to_decimals(e.y[at], kPositionDecimals)
          << to_decimals(frame.tracks.smooth_x[at], kPositionDecimals)
          << to_decimals(frame.tracks.smooth_y[at], kPositionDecimals)
          << to_decimals(e.nx[at], kNormalDecimals) << to_decimals(e.ny[at], kNormalDecimals)
          << to_significant(e.magnitude_counts[at], kStrengthDigits)
          << to_significant(e.position_sigma_px[at], kPositionSigmaDigits);
      csv.end_row();
    }
  }
  return csv.text();
}

}  // namespace thermedge::io
