#include <algorithm>

#include "frames.hpp"

namespace thermedge::eval {
namespace {

struct LoneFrame {
  std::size_t edges = 0;
  MapStructure structure;
};

LoneFrame look_at(const Prediction& found, int threshold, const EvaluationOptions& options) {
  LoneFrame frame;
  Image<std::uint8_t> map;
  thin_at(found.map.view(), threshold, map);
  frame.structure = measure_structure(map.view(), options.short_px);
  frame.edges = found.curves ? found.curves->curves.size() : frame.structure.fragments_px.size();
  return frame;
}

CurveFrame as_curves(Prediction found, int threshold) {
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
void repeat(const PredictionSet& found, const EvaluationOptions& options, ParallelRunner& runner,
            TruthlessEvaluation& evaluation) {
  auto pairs = for_each_frame<std::optional<Repeatability>>(
      found, runner, options.progress, found.names().size() - 1,
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

Result<TruthlessEvaluation> evaluate_without_truth(const PredictionSet& found,
                                                   const EvaluationOptions& options,
                                                   ParallelRunner& runner) {
  if (Status status = check(options); !status) {
    return tl::unexpected(status.error());
  }
  return io::catch_bad_alloc("evaluation", [&]() -> Result<TruthlessEvaluation> {
    TruthlessEvaluation evaluation;
    // Without truth there is no best threshold; every pixel of a strength map counts.
    const Thresholds thresholds = choose_thresholds(found, options);
    evaluation.threshold = thresholds.values.size() > 1 ? 1 : thresholds.values.front();
    std::vector<LoneFrame> frames = take_good(
        for_each_frame<LoneFrame>(found, runner, options.progress, found.names().size(),
                                  [&](std::size_t i) -> Result<LoneFrame> {
                                    return found.read(i).map([&](const Prediction& edges) {
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
