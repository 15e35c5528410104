// Writes what was detected, as the user asked for it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::cli {

// Serves `detect` and `trace`:
//   no -o           a line per frame on standard output
//   -o -            a line of JSON per frame on standard output
//   -o x.png|.json|.svg   mask, edges or vectors of the one frame
//   -o DIR --write mask,strength,labels,json,svg,overlay,distance   DIR/mask/<stem>.png ...
class ResultWriter {
 public:
  // Fails (a usage error) where `output` and `kinds` do not go together, or where an output is an
  // input or the folder of one.
  [[nodiscard]] static Result<ResultWriter> create(const std::string& output,
                                                   const std::string& kinds,
                                                   const InputFiles& inputs);
  [[nodiscard]] Room room() const { return mode_ == Mode::kOneFile ? Room::kOne : Room::kMany; }

  // Whether overlays show dropped edges and why they were dropped.
  void explain_overlays(bool explain) { explain_ = explain; }

  // `counts`: what an overlay lies on; empty where there is no frame.
  [[nodiscard]] Status write(const Detection& detection, ImageView<const std::uint16_t> counts,
                             const std::string& source, const std::string& stem);

 private:
  enum class Mode { kSummary, kJsonLines, kOneFile, kDirectory };
  ResultWriter(Mode mode, std::string output, std::vector<std::string> kinds,
               const InputFiles& inputs);
  [[nodiscard]] Status write_kind(const std::string& kind, const std::string& path,
                                  const Detection& detection, ImageView<const std::uint16_t> counts,
                                  const std::string& source);

  Mode mode_;
  std::string output_;
  std::vector<std::string> kinds_;
  bool explain_ = false;
  OutputDirectory directory_;
  Image<std::uint8_t> grey8_;
  Image<std::uint16_t> grey16_;
  Image<io::Rgb> colour_;
  DistanceTransform distance_transform_;
  DistanceField distance_;
};

}  // namespace thermedge::cli
