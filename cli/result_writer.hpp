// Writes what was detected, as the user asked for it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common.hpp"
#include "line_file.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::cli {

// What the command line says of results.
struct ResultRequest {
  std::string output;                 // -o
  std::string kinds;                  // --write
  std::optional<std::string> points;  // --points
  bool all_edges = false;             // --all-edges
  bool quiet = false;
};

// Serves `detect` and `trace`:
//   no -o             a line per frame on standard output, for people
//   -o -              a line of JSON per frame on standard output
//   -o x.jsonl|.csv   a line of JSON per frame, or a row per edgel, of all frames
//   -o x.png|.json|.svg   mask, edges or vectors of the one frame
//   -o DIR --write mask,strength,labels,json,csv,svg,overlay,distance   DIR/mask/<stem>.png ...
// What belongs to a frame has left the program when write() returns.
class ResultWriter {
 public:
  // Fails (a usage error) where the parts of `request` do not go together, or where an output is an
  // input or the folder of one.
  [[nodiscard]] static Result<ResultWriter> create(const ResultRequest& request,
                                                   const InputFiles& inputs);
  [[nodiscard]] Room room() const { return mode_ == Mode::kOneFile ? Room::kOne : Room::kMany; }
  // Whether the frames follow each other in one file, so that none may be missing.
  [[nodiscard]] bool is_stream() const { return mode_ == Mode::kStream; }
  // Where results are, for people: "out/mask, out/json".
  [[nodiscard]] std::string place() const;

  // Whether overlays show dropped edges and why they were dropped.
  void explain_overlays(bool explain) { explain_ = explain; }

  // `counts`: what an overlay lies on; empty where there is no frame.
  [[nodiscard]] Status write(const Detection& detection, ImageView<const std::uint16_t> counts,
                             const std::string& source, const std::string& stem);

 private:
  enum class Mode { kSilent, kSummary, kJsonLines, kStream, kOneFile, kDirectory };
  ResultWriter(Mode mode, std::string output, std::vector<std::string> kinds,
               const InputFiles& inputs);
  [[nodiscard]] static Result<ResultWriter> create_in(const OutputTarget& target,
                                                      const ResultRequest& request,
                                                      std::vector<std::string> kinds,
                                                      const InputFiles& inputs);
  [[nodiscard]] Status write_to_stream(const Detection& detection, const std::string& source);
  [[nodiscard]] Status write_kind(const std::string& kind, const std::string& path,
                                  const Detection& detection, ImageView<const std::uint16_t> counts,
                                  const std::string& source);

  Mode mode_;
  std::string output_;
  std::vector<std::string> kinds_;
  bool explain_ = false;
  io::EdgesFileOptions edges_;
  OutputDirectory directory_;
  LineFile stream_;
  bool stream_begun_ = false;
  Image<std::uint8_t> grey8_;
  Image<std::uint16_t> grey16_;
  Image<io::Rgb> colour_;
  DistanceTransform distance_transform_;
  DistanceField distance_;
};

}  // namespace thermedge::cli
