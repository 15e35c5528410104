// Files of found and true edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "thermedge/eval/counts.hpp"
#include "thermedge/eval/curves.hpp"
#include "thermedge/limits.hpp"

namespace thermedge::eval {

// Edges that a detector found in a frame: a map, and curves where the file has them.
struct Prediction {
  Image<std::uint8_t> map;  // strength, 0: none; curves: 255
  std::optional<CurveFrame> curves;
};

// True edges of a frame: maps, and curves where the file has them.
struct TrueEdges {
  TruthMaps maps;
  std::optional<CurveFrame> curves;
};

// Text of many lines, of which each holds one JSON object. Empty lines are passed over.
class JsonLines {
 public:
  [[nodiscard]] static Result<JsonLines> read(const std::string& path, const Limits& limits);
  [[nodiscard]] std::size_t size() const { return lines_.size(); }
  [[nodiscard]] std::string_view text(std::size_t index) const {
    return std::string_view(text_).substr(lines_[index].begin, lines_[index].length);
  }
  // File and line, for messages.
  [[nodiscard]] std::string label(std::size_t index) const;
  // Errors name file and line.
  [[nodiscard]] Result<CurveFrame> frame(std::size_t index) const;

 private:
  struct Line {
    std::size_t number, begin, length;
  };
  std::string path_;
  std::string text_;
  std::vector<Line> lines_;
};

// Results of a detector: a directory of 8-bit PNG (binary maps, or strength with 255 for the best)
// or of JSON as `detect --write json` gives it, or one such file, or JSON lines (.jsonl), one frame
// a line. Const functions are thread-safe.
class PredictionSet {
 public:
  // Errors: nothing there, or PNG and JSON side by side.
  [[nodiscard]] static Result<PredictionSet> open(const std::string& path,
                                                  const Limits& limits = {});
  // Base names in natural order (2 before 10); of JSON lines "0", "1" ...
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] bool has_curves() const { return curves_; }
  [[nodiscard]] Result<Prediction> read(std::size_t index) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::string> paths_;  // of each name; empty where lines_ holds them
  std::optional<JsonLines> lines_;
  bool curves_ = false;
  Limits limits_;
};

// Truth for frames by base name. In a directory: NAME.npz ('maps' of (n, h, w), each an
// annotator's, and 'all' with edges that precision accepts besides), NAME.mat (groundTruth of BSDS,
// or plain arrays), NAME.png, NAME_*.png, NAME/*.png (edges: what is not 0, where there
// is one other value; else what is above 127), NAME.json or NAME.jsonl
// (curves), looked for in this order; or one file. One file of JSON lines (.jsonl; in a directory:
// the only one there) holds the frames in the order of the results. Const functions are
// thread-safe.
class GroundTruthSet {
 public:
  struct Options {
    // Curves of less contrast are accepted by precision, but not asked for by recall. Unknown
    // contrasts are asked for.
    double least_contrast_counts = 0;
    Limits limits;
  };
  [[nodiscard]] static Result<GroundTruthSet> open(const std::string& path, const Options& options);

  // An error where JSON lines hold another number of frames.
  [[nodiscard]] Status check_frames(std::size_t count) const;
  // Truth of the frame with this base name, which is the `index`th of the results.
  [[nodiscard]] Result<TrueEdges> read(const std::string& name, std::size_t index) const;

 private:
  [[nodiscard]] Result<TrueEdges> from_curves(Result<CurveFrame> curves) const;
  [[nodiscard]] Result<TrueEdges> read_file(const std::string& path) const;

  std::string path_;
  bool directory_ = false;
  std::optional<JsonLines> lines_;
  Options options_;
};

// The single formats. Errors name the file and what is wrong.
[[nodiscard]] Result<TruthMaps> read_npz_truth(const std::string& path, const Limits& limits = {});
[[nodiscard]] Result<TruthMaps> read_mat_truth(const std::string& path, const Limits& limits = {});
// 8-bit grey as it is.
[[nodiscard]] Result<Image<std::uint8_t>> read_edge_map(const std::string& path,
                                                        const Limits& limits = {});

}  // namespace thermedge::eval
