#include "thermedge/eval/evaluate.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>

#include "io/guard.hpp"

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

Status check(const EvaluationOptions& options) {
  const auto range = [](const char* name, const char* values) -> Status {
    return failure(ErrorCode::kInvalidArgument, std::string(name) + " should be " + values);
  };
  if (!(options.count.max_distance >= 0 && options.count.max_distance <= 0.1)) {
    return range("max_distance", "0 to 0.1 of the diagonal");
  }
  if (options.thresholds < 1 || options.thresholds > 254) {
    return range("thresholds", "1 to 254");
  }
  if (options.at < 0 || options.at > 255) {
    return range("at", "1 to 255, or 0 for a sweep");
  }
  if (options.short_px < 1 || options.short_px > 10000) {
    return range("short_px", "1 to 10000");
  }
  if (!(options.sigma_counts >= 0 && options.sigma_counts <= 65535)) {
    return range("sigma_counts", "0 to 65535");
  }
  if (!(options.repeat_reach_px > 0 && options.repeat_reach_px <= 100)) {
    return range("repeat_reach_px", "above 0, up to 100");
  }
  if (options.most_shift_px < 0 || options.most_shift_px > 64) {
    return range("most_shift_px", "0 to 64");
  }
  return {};
}

// The values that occur in the first few maps: whether they are binary.
std::bitset<256> values_of(const FoundSet& found) {
  constexpr std::size_t kLookedAt = 5;
  std::bitset<256> values;
  for (std::size_t i = 0; i < std::min(found.names().size(), kLookedAt); ++i) {
    const auto edges = found.read(i);
    for (int y = 0; edges && y < edges->map.height(); ++y) {
      const std::uint8_t* row = edges->map.row(y);
      std::for_each(row, row + edges->map.width(), [&](std::uint8_t value) { values.set(value); });
    }
  }
  return values;
}

int highest(const std::bitset<256>& values) {
  int value = 255;
  while (value > 1 && !values[static_cast<std::size_t>(value)]) {
    --value;
  }
  return value;
}

struct Thresholds {
  bool binary = false;
  std::vector<int> values;
};

Thresholds choose_thresholds(const FoundSet& found, const EvaluationOptions& options) {
  const auto values = values_of(found);
  Thresholds thresholds;
  thresholds.binary = values.count() <= 2;
  thresholds.values = options.at > 0      ? std::vector<int>{options.at}
                      : thresholds.binary ? std::vector<int>{highest(values)}
                                          : spread_thresholds(options.thresholds);
  return thresholds;
}

// Runs `work(i)`, which gives a Result, for each frame. A frame that fails leaves its error in
// place of its result.
template <class T, class F>
std::vector<Result<T>> for_each_frame(const FoundSet& found, Runner& runner, std::size_t count,
                                      F&& work) {
  std::vector<Result<T>> results(count);
  runner.run(static_cast<int>(count), [&](int task) {
    const auto i = static_cast<std::size_t>(task);
    results[i] = io::without_throwing(found.names()[i], [&] { return work(i); });
  });
  return results;
}

template <class T>
std::vector<T> take_good(std::vector<Result<T>> results, std::vector<Error>& errors) {
  std::vector<T> good;
  for (Result<T>& result : results) {
    if (result) {
      good.push_back(std::move(*result));
    } else {
      errors.push_back(std::move(result.error()));
    }
  }
  return good;
}

struct FrameFigures {
  std::vector<MatchCounts> counts;
  Merit merit;
  MapStructure structure;
  std::optional<CurveFigures> curves;
};

CurveFigures compare_curves(const CurveFrame& found, const CurveFrame& truth,
                            const EvaluationOptions& options) {
  const double reach_px = options.count.max_distance * std::hypot(truth.width, truth.height);
  CurveFigures figures{localise(found, truth, reach_px), ContrastRecall(count_limits()),
                       ContrastRecall(sigma_limits())};
  figures.by_counts.add(found, truth, reach_px, 1);
  const double sigma = options.sigma_counts > 0 ? options.sigma_counts : found.sigma_counts;
  if (sigma > 0) {
    figures.by_sigma.add(found, truth, reach_px, sigma);
  }
  return figures;
}

void judge_at(double threshold, const FoundEdges& found, const TrueEdges& truth,
              const EvaluationOptions& options, FrameFigures& figures) {
  Image<std::uint8_t> map;
  thin_at(found.map.view(), threshold, map);
  figures.merit = pratt_merit(map.view(), truth.maps.annotators);
  figures.structure = measure_structure(map.view(), options.short_px);
  if (found.curves && truth.curves) {
    figures.curves = compare_curves(*found.curves, *truth.curves, options);
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
  evaluation.merit.mean /= static_cast<double>(frames.size());
  evaluation.merit.best /= static_cast<double>(frames.size());
  evaluation.structure = summarise_structure(structures, options.short_px);
}

class Judge {
 public:
  Judge(const FoundSet& found, const TruthSet& truth, const EvaluationOptions& options,
        Runner& runner)
      : found_(found), truth_(truth), options_(options), runner_(runner) {}

  Result<Evaluation> run() {
    Thresholds thresholds = choose_thresholds(found_, options_);
    Evaluation evaluation;
    evaluation.binary = thresholds.binary;
    evaluation.thresholds = std::move(thresholds.values);

    // With a single threshold there is nothing to choose, so one reading of the files will do.
    const auto only = static_cast<double>(evaluation.thresholds.front());
    auto results =
        for_each([&](const FoundEdges& found, const TrueEdges& truth, FrameFigures& figures) {
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
        found_, runner_, found_.names().size(), [&](std::size_t i) -> Result<FrameFigures> {
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
    for (FrameFigures& frame : frames) {
      counts.push_back(std::move(frame.counts));
    }
    return counts;
  }

  // Frames that failed the sweep fail here again, and their errors are known.
  std::vector<FrameFigures> judge_swept(double threshold) {
    auto results =
        for_each([&](const FoundEdges& found, const TrueEdges& truth, FrameFigures& figures) {
          // Maps of another size than their truth have no figures.
          return count_matches(found.map.view(), truth.maps, {}, options_.count).map([&](auto&&) {
            judge_at(threshold, found, truth, options_, figures);
          });
        });
    std::vector<Error> known;
    return take_good(std::move(results), known);
  }

  const FoundSet& found_;
  const TruthSet& truth_;
  const EvaluationOptions& options_;
  Runner& runner_;
};

struct LoneFrame {
  std::size_t edges = 0;
  MapStructure structure;
};

LoneFrame look_at(const FoundEdges& found, int threshold, const EvaluationOptions& options) {
  LoneFrame frame;
  Image<std::uint8_t> map;
  thin_at(found.map.view(), threshold, map);
  frame.structure = measure_structure(map.view(), options.short_px);
  frame.edges = found.curves ? found.curves->curves.size() : frame.structure.fragments_px.size();
  return frame;
}

CurveFrame as_curves(FoundEdges found, int threshold) {
  if (found.curves) {
    return std::move(*found.curves);
  }
  Image<std::uint8_t> map;
  thin_at(found.map.view(), threshold, map);
  return pixels_as_curves(map.view());
}

PerFrame per_frame(const std::vector<std::size_t>& values) {
  PerFrame figures;
  for (const std::size_t value : values) {
    figures.mean += static_cast<double>(value);
    figures.most = std::max(figures.most, value);
  }
  figures.mean /= static_cast<double>(values.size());
  return figures;
}

// Reads the frames again, two at a time, so that long sequences need not fit into memory. Frames
// that can't be read are no part of a pair.
void repeat(const FoundSet& found, const EvaluationOptions& options, Runner& runner,
            LoneEvaluation& evaluation) {
  auto pairs = for_each_frame<std::optional<Repeatability>>(
      found, runner, found.names().size() - 1,
      [&](std::size_t i) -> Result<std::optional<Repeatability>> {
        auto first = found.read(i);
        auto second = found.read(i + 1);
        if (!first || !second || !same_size(first->map.view(), second->map.view())) {
          return std::nullopt;
        }
        return best_shift(as_curves(std::move(*first), evaluation.threshold),
                          as_curves(std::move(*second), evaluation.threshold),
                          options.most_shift_px, options.repeat_reach_px)
            .repeatability;
      });
  for (const auto& pair : take_good(std::move(pairs), evaluation.errors)) {
    if (pair) {
      ++evaluation.pairs;
      evaluation.repeatability.points += pair->points;
      evaluation.repeatability.repeated += pair->repeated;
    }
  }
}

}  // namespace

Result<Evaluation> evaluate(const FoundSet& found, const TruthSet& truth,
                            const EvaluationOptions& options, Runner& runner) {
  if (Status status = check(options); !status) {
    return tl::unexpected(status.error());
  }
  if (Status status = truth.check_frames(found.names().size()); !status) {
    return tl::unexpected(status.error());
  }
  return io::without_throwing("evaluation",
                              [&] { return Judge(found, truth, options, runner).run(); });
}

Result<LoneEvaluation> evaluate_alone(const FoundSet& found, const EvaluationOptions& options,
                                      Runner& runner) {
  if (Status status = check(options); !status) {
    return tl::unexpected(status.error());
  }
  return io::without_throwing("evaluation", [&]() -> Result<LoneEvaluation> {
    LoneEvaluation evaluation;
    // Without truth there is no best threshold; every pixel of a strength map counts.
    const Thresholds thresholds = choose_thresholds(found, options);
    evaluation.threshold = thresholds.values.size() > 1 ? 1 : thresholds.values.front();
    std::vector<LoneFrame> frames = take_good(
        for_each_frame<LoneFrame>(found, runner, found.names().size(),
                                  [&](std::size_t i) -> Result<LoneFrame> {
                                    return found.read(i).map([&](const FoundEdges& edges) {
                                      return look_at(edges, evaluation.threshold, options);
                                    });
                                  }),
        evaluation.errors);
    if (frames.empty()) {
      return tl::unexpected(evaluation.errors.front());
    }
    evaluation.frames = frames.size();
    std::vector<std::size_t> edges;
    std::vector<std::size_t> pixels;
    std::vector<MapStructure> structures;
    for (LoneFrame& frame : frames) {
      edges.push_back(frame.edges);
      pixels.push_back(frame.structure.edge_pixels);
      structures.push_back(std::move(frame.structure));
    }
    evaluation.edges = per_frame(edges);
    evaluation.edge_pixels = per_frame(pixels);
    evaluation.structure = summarise_structure(structures, options.short_px);
    repeat(found, options, runner, evaluation);
    return evaluation;
  });
}

}  // namespace thermedge::eval
