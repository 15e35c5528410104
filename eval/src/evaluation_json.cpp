#include <cmath>
#include <nlohmann/json.hpp>

#include "thermedge/eval/evaluate.hpp"

namespace thermedge::eval {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormatVersion = 1;

Json number(double value) {
  constexpr double kDigits = 1e6;  // after the point: 1 in a million of a share, or of a px
  return std::isfinite(value) ? Json(std::round(value * kDigits) / kDigits) : Json(nullptr);
}

Json to_json(const StructureSummary& structure) {
  return {{"edge_pixels", number(structure.edge_pixels)},
          {"fragments_per_1000_px", number(structure.fragments_per_1000_px)},
          {"spurs_per_1000_px", number(structure.spurs_per_1000_px)},
          {"median_contour_px", number(structure.median_contour_px)},
          {"weighted_median_contour_px", number(structure.weighted_median_contour_px)},
          {"short_fragments", number(structure.short_fragments)},
          {"short_fragments_px", number(structure.short_fragments_px)},
          {"contours_by_powers_of_two_px", structure.contour_lengths}};
}

Json to_json(const ContrastRecall& recall) {
  Json bins = Json::array();
  for (std::size_t i = 0; i < recall.limits.size(); ++i) {
    bins.push_back({{"from", recall.limits[i]},
                    {"to", i + 1 < recall.limits.size() ? Json(recall.limits[i + 1]) : Json()},
                    {"true_px", number(recall.true_px[i])},
                    {"recall", number(recall.found_px[i] / recall.true_px[i])}});
  }
  return bins;
}

Json to_json(const CurveFigures& curves) {
  return {{"points", curves.localisation.points},
          {"rms_px", number(curves.localisation.rms_px())},
          {"mean_px", number(curves.localisation.mean_px())},
          {"repeatability", number(curves.repeatability.share())},
          {"recall_by_contrast_counts", to_json(curves.by_counts)},
          {"recall_by_contrast_sigma", to_json(curves.by_sigma)}};
}

Json to_json(const PerFrame& figures) {
  return {{"mean", number(figures.mean)}, {"most", figures.most}};
}

Json messages(const std::vector<Error>& errors) {
  Json list = Json::array();
  for (const Error& error : errors) {
    list.push_back(error.message);
  }
  return list;
}

std::string line(const Json& document) {
  return document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string evaluation_to_json(const Evaluation& evaluation, const std::string& found,
                               const std::string& truth) {
  const bool swept = evaluation.swept();
  const Scores& scores = evaluation.scores;
  return line({{"format_version", kFormatVersion},
               {"found", found},
               {"truth", truth},
               {"frames", evaluation.frames},
               {"binary", evaluation.binary},
               {"thresholds", evaluation.thresholds.size()},
               {"threshold", number(scores.threshold)},
               {"f", number(scores.f)},
               {"precision", number(scores.precision)},
               {"recall", number(scores.recall)},
               {"ois", swept ? number(scores.ois) : Json()},
               {"ap", swept ? number(scores.ap) : Json()},
               {"merit", number(evaluation.merit.mean)},
               {"merit_best", number(evaluation.merit.best)},
               {"structure", to_json(evaluation.structure)},
               {"curves", evaluation.curves ? to_json(*evaluation.curves) : Json()},
               {"left_out", messages(evaluation.errors)}});
}

std::string evaluation_to_json(const TruthlessEvaluation& evaluation, const std::string& found) {
  const bool repeated = evaluation.repeatability.points > 0;
  return line({{"format_version", kFormatVersion},
               {"found", found},
               {"frames", evaluation.frames},
               {"threshold", evaluation.threshold},
               {"edges_per_frame", to_json(evaluation.edges)},
               {"edge_pixels_per_frame", to_json(evaluation.edge_pixels)},
               {"structure", to_json(evaluation.structure)},
               {"pairs", evaluation.pairs},
               {"repeatability", repeated ? number(evaluation.repeatability.share()) : Json()},
               {"left_out", messages(evaluation.errors)}});
}

}  // namespace thermedge::eval
