#include "thermedge/eval/evaluate.hpp"

#include "frames.hpp"

namespace thermedge::eval {
namespace {

const std::vector<double>& count_limits() {
  static const std::vector<double> limits{0, 5, 10, 20, 40, 80, 160, 320};
  return limits;
}
const std::vector<double>& sigma_limits() {
  static const std::vector<double> limits{0, 1, 2, 3, 4, 6, 8, 12, 20};
  return limits;
}

struct FrameFigures {
  std::vector<MatchCounts> counts;
  PrattFom merit;
  MapStructure structure;
  std::optional<CurveFigures> curves;
  std::vector<EdgeShare> edges;  // of the truth, with curves
};

void compare_curves(const CurveFrame& found, const CurveFrame& truth,
                    const EvaluationOptions& options, FrameFigures& frame) {
  const double reach_px = match_radius_px(options.count, truth.width, truth.height);
  frame.edges = found_by_id(found, truth, reach_px);
  CurveFigures& figures = frame.curves.emplace(CurveFigures{localise(found, truth, reach_px),
                                                            ContrastRecall(count_limits()),
                                                            ContrastRecall(sigma_limits()),
                                                            {}});
  figures.by_counts.add(found, truth, reach_px, 1);
  const double sigma = options.sigma_counts > 0 ? options.sigma_counts : found.sigma_counts;
  if (sigma > 0) {
    figures.by_sigma.add(found, truth, reach_px, sigma);
  }
}

void judge_at(double threshold, const Prediction& found, const TrueEdges& truth,
              const EvaluationOptions& options, FrameFigures& figures) {
  Image<std::uint8_t> map;
  found_at(found.map.view(), threshold, truth.maps.annotators, map);
  figures.merit = pratt_merit(map.view(), truth.maps.annotators);
  figures.structure = measure_structure(map.view(), options.short_px);
  if (found.curves && truth.curves) {
    compare_curves(*found.curves, *truth.curves, options, figures);
  }
}

// Messages of a comparison name the frame; those of reading name the file already.
Error with_name(const std::string& name, Error error) {
  error.message = name + ": " + error.message;
  return error;
}

void add_up(std::vector<FrameFigures> frames, const EvaluationOptions& options,
            Evaluation& evaluation) {
  std::vector<MapStructure> structures;
  for (FrameFigures& frame : frames) {
    evaluation.merit.mean += frame.merit.mean;
    evaluation.merit.best += frame.merit.best;
    structures.push_back(std::move(frame.structure));
    if (!frame.curves) {
      continue;
    }
    if (!evaluation.curves) {
      evaluation.curves = std::move(frame.curves);
    } else {
      evaluation.curves->localisation += frame.curves->localisation;
      evaluation.curves->by_counts += frame.curves->by_counts;
      evaluation.curves->by_sigma += frame.curves->by_sigma;
    }
  }
  for (std::size_t i = 1; evaluation.curves && i < frames.size(); ++i) {
    evaluation.curves->repeatability += repeatability_by_id(frames[i - 1].edges, frames[i].edges);
  }
  evaluation.merit.mean /= static_cast<double>(frames.size());
  evaluation.merit.best /= static_cast<double>(frames.size());
  evaluation.structure = summarise_structure(structures, options.short_px);
}

class Judge {
 public:
  Judge(const PredictionSet& found, const GroundTruthSet& truth, const EvaluationOptions& options,
        ParallelRunner& runner)
      : found_(found), truth_(truth), options_(options), runner_(runner) {}

  Result<Evaluation> run() {
    Thresholds thresholds = choose_thresholds(found_, options_);
    Evaluation evaluation;
    evaluation.binary = thresholds.binary;
    evaluation.thresholds = std::move(thresholds.values);

    // With a single threshold there is nothing to choose, so one reading of the files will do.
    const auto only = static_cast<double>(evaluation.thresholds.front());
    auto results =
        for_each([&](const Prediction& found, const TrueEdges& truth, FrameFigures& figures) {
          return count_matches(found.map.view(), truth.maps, evaluation.thresholds, options_.count)
              .map([&](std::vector<MatchCounts> counts) {
                figures.counts = std::move(counts);
                if (!evaluation.swept()) {
                  judge_at(only, found, truth, options_, figures);
                }
              });
        });
    std::vector<FrameFigures> frames = take_good(std::move(results), evaluation.errors);
    if (frames.empty()) {
      return tl::unexpected(evaluation.errors.front());
    }
    evaluation.frames = frames.size();
    evaluation.scores = score(counts_of(frames), evaluation.thresholds);
    if (evaluation.swept()) {
      frames = judge_swept(evaluation.scores.threshold);
    }
    add_up(std::move(frames), options_, evaluation);
    return evaluation;
  }

 private:
  template <class F>
  std::vector<Result<FrameFigures>> for_each(F&& compare) {
    return for_each_frame<FrameFigures>(
        found_, runner_, options_.progress, found_.names().size(),
        [&](std::size_t i) -> Result<FrameFigures> {
          const std::string& name = found_.names()[i];
          const auto found = found_.read(i);
          if (!found) {
            return tl::unexpected(found.error());
          }
          const auto truth = truth_.read(name, i);
          if (!truth) {
            return tl::unexpected(truth.error());
          }
          FrameFigures figures;
          if (const Status status = compare(*found, *truth, figures); !status) {
            return tl::unexpected(with_name(name, status.error()));
          }
          return figures;
        });
  }

  static std::vector<std::vector<MatchCounts>> counts_of(std::vector<FrameFigures>& frames) {
    std::vector<std::vector<MatchCounts>> counts;
    counts.reserve(frames.size());
    for (FrameFigures& frame : frames) {
      counts.push_back(std::move(frame.counts));
    }
    return counts;
  }

  // Frames that failed the sweep fail here again, and their errors are known.
  std::vector<FrameFigures> judge_swept(double threshold) {
    auto results =
        for_each([&](const Prediction& found, const TrueEdges& truth, FrameFigures& figures) {
          // Maps of another size than their truth have no figures.
          return count_matches(found.map.view(), truth.maps, {}, options_.count).map([&](auto&&) {
            judge_at(threshold, found, truth, options_, figures);
          });
        });
    std::vector<Error> known;
    return take_good(std::move(results), known);
  }

  const PredictionSet& found_;
  const GroundTruthSet& truth_;
  const EvaluationOptions& options_;
  ParallelRunner& runner_;
};

}  // namespace

Result<Evaluation> evaluate(const PredictionSet& found, const GroundTruthSet& truth,
                            const EvaluationOptions& options, ParallelRunner& runner) {
  if (Status status = check(options); !status) {
    return tl::unexpected(status.error());
  }
  if (Status status = truth.check_frames(found.names().size()); !status) {
    return tl::unexpected(status.error());
  }
  return io::catch_bad_alloc("evaluation",
                             [&] { return Judge(found, truth, options, runner).run(); });
}

}  // namespace thermedge::eval
