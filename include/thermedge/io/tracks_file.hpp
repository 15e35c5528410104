// Tracked edges as text and as a picture. docs/sequences.md describes them for whoever reads them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "thermedge/image.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/sequence/sequence_detector.hpp"

namespace thermedge::io {

// "lost", "left" or "merged".
[[nodiscard]] std::string_view track_end_name(TrackEnd why);

// A frame as one line of JSON: what edges_to_json writes, and for each edge the identity and its
// age, the runs of its points with their identities and the smoothed positions; for the frame
// validity, events, motion, and identities that begin and end.
[[nodiscard]] std::string tracks_to_json(const TrackedFrame& frame, const std::string& source,
                                         const EdgesFileOptions& options = {});

// The header of a CSV file, and the edgels of a frame that have an identity as its rows. Lines end
// in "\n".
[[nodiscard]] std::string_view tracks_csv_header();
[[nodiscard]] std::string tracks_to_csv_rows(const TrackedFrame& frame);

// The colour of an identity: seven that people with any colour vision tell apart (Okabe and Ito
// 2008), one after the other.
[[nodiscard]] Rgb track_colour(std::int64_t track);

// The frame (`counts`; black, where it is empty) enlarged twice and darkened, with the kept edges
// in the colours of their identities, those without one in grey.
void draw_tracks(const TrackedFrame& frame, ImageView<const std::uint16_t> counts,
                 Image<Rgb>& overlay);

}  // namespace thermedge::io
