// A detection as text: JSON, CSV and SVG. docs/output.md describes them for whoever reads them.
#pragma once

#include <string>
#include <string_view>

#include "thermedge/detector.hpp"

namespace thermedge::io {

// Raised by changes after which a reader of the JSON has to change, too; new fields are none.
inline constexpr int kFormatVersion = 1;

// What a file has of each point besides its position, and of which edges.
struct EdgesFileOptions {
  bool normals = true;           // unit normals, towards the warmer side
  bool strengths = false;        // gradient across the edge, counts a px
  bool position_sigmas = false;  // standard deviation of the position along the normal, px
  bool dropped_edges = false;    // edges that were not kept, too, with the reason
};

// "kept", "weak", "insignificant", "low_contrast" or "beyond_budget".
[[nodiscard]] std::string_view status_name(EdgeStatus status);

// The kept edges of a frame as one line of JSON, as docs/schema/frame.schema.json says. Frame
// number and time stamp are Detection::index and stamp_ns. Points are sub-pixel [x, y], pixel
// centres at integers, rounded to 1/1000 px; other numbers to 3 to 5 digits. Values that were not
// measured (contrast without a frame) or are infinite (z and NFA without noise) are null.
[[nodiscard]] std::string edges_to_json(const Detection& detection, const std::string& source,
                                        const EdgesFileOptions& options = {});

// The header of a CSV file, and the kept edges of a frame as its rows, one for each edgel, with all
// columns whatever the options say of points. What was not measured is empty. Lines end in "\n".
[[nodiscard]] std::string_view edges_csv_header();
[[nodiscard]] std::string edges_to_csv_rows(const Detection& detection,
                                            const EdgesFileOptions& options = {});

// The kept edges as vectors in pixel coordinates, one path per edge with its index, rank and score;
// junctions as circles, corners as squares. What of `source` cannot stand in XML (bytes that are
// not UTF-8, control characters) becomes question marks.
[[nodiscard]] std::string edges_to_svg(const Detection& detection, const std::string& source);

}  // namespace thermedge::io
