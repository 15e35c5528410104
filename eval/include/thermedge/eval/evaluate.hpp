// A detector's results over a set of frames, evaluated: one call for everything.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "thermedge/eval/curves.hpp"
#include "thermedge/eval/files.hpp"
#include "thermedge/eval/scores.hpp"
#include "thermedge/eval/structure.hpp"
#include "thermedge/parallel_runner.hpp"

namespace thermedge::eval {

// Told after each frame how many are done, of how many; one call at a time, from any thread. A
// sweep goes over the frames twice.
using Progress = std::function<void(std::size_t done, std::size_t all)>;

struct EvaluationOptions {
  CountOptions count;
  int thresholds = 99;  // of a sweep over strength maps, 1..254
  int at = 0;           // 1..255: evaluate at this threshold only; 0: sweep, but for binary maps
  int short_px = 10;    // fragments and spurs of fewer pixels are short, 1..10000
  double sigma_counts = 0;  // noise of the frames, for recall over contrast; 0: as the results say
  double repeat_reach_px = 1;  // how far from its place a point counts as found again, px, 0..100
  int most_shift_px = 4;       // whole-pixel shifts that are tried between two frames, 0..64
  Progress progress;           // may be empty
};

// Figures of results with curves against truth with curves.
struct CurveFigures {
  Localisation localisation;
  ContrastRecall by_counts;
  ContrastRecall by_sigma;  // contrast in units of the noise; no length where that is not known
  EdgeRepeatability repeatability;  // from each frame to the next one; nothing where edges lack ids
};

struct Evaluation {
  std::size_t frames = 0;
  bool binary = false;          // the maps hold two values at the most
  std::vector<int> thresholds;  // that were looked at; with a single one, OIS and AP say nothing
  Scores scores;
  PrattFom merit;              // at the threshold of the scores, mean over the frames
  StructureSummary structure;  // at the threshold of the scores
  std::optional<CurveFigures> curves;
  std::vector<Error> errors;  // of frames that were left out

  [[nodiscard]] bool swept() const { return thresholds.size() > 1; }
};

// Results against truth. The frames are tasks of `runner`; the figures are the same for every
// ParallelRunner. A frame that cannot be read or compared is left out and listed.
// Errors: no frame could be judged; another number of frames in the truth; an option out of range.
[[nodiscard]] Result<Evaluation> evaluate(const PredictionSet& found, const GroundTruthSet& truth,
                                          const EvaluationOptions& options, ParallelRunner& runner);

struct PerFrame {
  double mean = 0;
  std::size_t most = 0;
};

// Figures that need no truth.
struct TruthlessEvaluation {
  std::size_t frames = 0;
  int threshold = 0;     // of the maps
  PerFrame edges;        // curves, or fragments of maps; false alarms, where a scene is empty
  PerFrame edge_pixels;  // of thinned maps
  StructureSummary structure;
  // Each frame against the next one, in the order of the names, under the best whole-pixel shift;
  // frames of different size are no pair. Summed over pairs.
  std::size_t pairs = 0;
  Repeatability repeatability;
  std::vector<Error> errors;
};
[[nodiscard]] Result<TruthlessEvaluation> evaluate_without_truth(const PredictionSet& found,
                                                                 const EvaluationOptions& options,
                                                                 ParallelRunner& runner);

// Everything as one JSON object on one line, rounded to 9 digits. What there was nothing to measure
// on is null. `found`, `truth`: names of the inputs.
[[nodiscard]] std::string evaluation_to_json(const Evaluation& evaluation, const std::string& found,
                                             const std::string& truth);
[[nodiscard]] std::string evaluation_to_json(const TruthlessEvaluation& evaluation,
                                             const std::string& found);

}  // namespace thermedge::eval
