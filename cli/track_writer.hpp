// Writes tracked edges as the user asked for it.
#pragma once

#include <string>
#include <vector>

#include "common.hpp"
#include "line_file.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/io/tracks_file.hpp"

namespace thermedge::cli {

// Serves `track`:
//   no -o             a line per frame on standard output, for people
//   -o -              a line of JSON per frame on standard output
//   -o x.jsonl|.csv   a line of JSON per frame, or a row per edgel
//   -o DIR --write json,csv,overlay,distance   DIR/tracks.jsonl, DIR/tracks.csv,
//                                              DIR/overlay/<stem>.png, DIR/distance/<stem>.png
// What belongs to a frame has left the program when write() returns.
class TrackWriter {
 public:
  // Fails (a usage error) where `output` and `kinds` do not go together, or where an output is an
  // input or the folder of one.
  [[nodiscard]] static Result<TrackWriter> create(const std::string& output,
                                                  const std::string& kinds, bool quiet,
                                                  const InputFiles& inputs);
  [[nodiscard]] bool draws_overlays() const;
  // Where results are, for people.
  [[nodiscard]] std::string place() const;

  // `counts`: what an overlay lies on; empty: black.
  [[nodiscard]] Status write(const TrackedFrame& frame, ImageView<const std::uint16_t> counts,
                             const std::string& source, const std::string& stem);

 private:
  TrackWriter(OutputKind kind, std::string output, std::vector<std::string> kinds, bool quiet,
              const InputFiles& inputs);
  [[nodiscard]] Status write_kind(const std::string& kind, const TrackedFrame& frame,
                                  ImageView<const std::uint16_t> counts, const std::string& source);

  OutputKind kind_;
  std::string output_;
  std::vector<std::string> kinds_;
  bool quiet_;
  OutputDirectory directory_;
  LineFile json_, csv_;
  bool csv_begun_ = false;
  Image<io::Rgb> colour_;
  Image<std::uint16_t> grey16_;
  DistanceTransform distance_transform_;
  DistanceField distance_;
};

}  // namespace thermedge::cli
