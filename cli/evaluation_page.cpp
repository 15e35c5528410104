#include "evaluation_page.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "page.hpp"

namespace thermedge::cli {
namespace {

std::string frames_text(std::size_t frames) {
  return fmt::format("{} frame{}", frames, frames == 1 ? "" : "s");
}

std::string threshold_text(double threshold) { return fmt::format("at {:.4g} of 255", threshold); }

void add_scores(const eval::Evaluation& evaluation, const eval::EvaluationOptions& options,
                Page& page) {
  const eval::Scores& scores = evaluation.scores;
  page.heading(fmt::format("Edge pixels, matched one to one within {} of the diagonal",
                           options.count.max_distance));
  page.row("F", number(scores.f, 4),
           evaluation.swept() ? threshold_text(scores.threshold) + ", the best for all frames (ODS)"
                              : threshold_text(scores.threshold));
  page.row("precision", number(scores.precision, 4), "share of what was found that is true");
  page.row("recall", number(scores.recall, 4), "share of what is true that was found");
  if (evaluation.swept()) {
    page.row("OIS", number(scores.ois, 4), "F, each frame at its own best threshold");
    page.row("AP", number(scores.ap, 4), "area under precision over recall");
  }
  page.row("figure of merit", number(evaluation.merit.mean, 4),
           "Pratt's: 1 is exact; counts distances as well");
  if (evaluation.merit.best != evaluation.merit.mean) {
    page.row("", number(evaluation.merit.best, 4), "against the annotator that agrees best");
  }
}

void add_structure(const eval::StructureSummary& structure, int short_px, Page& page) {
  page.heading("Structure");
  page.row("edge pixels", number(structure.edge_pixels, 0), "per frame");
  page.row("fragments", number(structure.fragments_per_1000_px, 2), "per 1000 edge pixels");
  page.row("spurs", number(structure.spurs_per_1000_px, 2),
           fmt::format("per 1000 edge pixels: stubs under {} px", short_px));
  page.row("contour length", number(structure.median_contour_px, 1), "px, median");
  page.row("", number(structure.weighted_median_contour_px, 0),
           "px; half of the edge pixels lie in longer ones");
  page.row("short fragments", fmt::format("{:.1f} %", 100 * structure.short_fragments),
           fmt::format("have under {} px; they hold {:.1f} % of the edge pixels", short_px,
                       100 * structure.short_fragments_px));
  std::string lengths;
  for (std::size_t i = 0; i < structure.contour_lengths.size(); ++i) {
    lengths += fmt::format("{}{}+: {}", i == 0 ? "" : "  ", 1U << i, structure.contour_lengths[i]);
  }
  constexpr std::size_t kWidest = 97;
  const std::size_t cut = lengths.size() > kWidest ? lengths.rfind("  ", kWidest) : lengths.size();
  page.line("  contours by length in px");
  page.line("  " + lengths.substr(0, cut));
  if (cut < lengths.size()) {
    page.line(lengths.substr(cut));
  }
}

void add_table(const eval::ContrastRecall& recall, std::string_view unit, Page& page) {
  const double whole =
      std::max_element(recall.true_px.begin(), recall.true_px.end()) != recall.true_px.end()
          ? *std::max_element(recall.true_px.begin(), recall.true_px.end())
          : 0;
  if (whole <= 0) {
    return;
  }
  page.heading(fmt::format("Recall by contrast in {}", unit));
  page.line(fmt::format("  {:>12} {:>12} {:>8}", "contrast", "true px", "recall"));
  for (std::size_t i = 0; i < recall.limits.size(); ++i) {
    if (recall.true_px[i] > 0) {
      const std::string range =
          i + 1 < recall.limits.size()
              ? fmt::format("{:g} - {:g}", recall.limits[i], recall.limits[i + 1])
              : fmt::format("{:g} up", recall.limits[i]);
      page.line(fmt::format("  {:>12} {:>12.0f} {:>8.4f}", range, recall.true_px[i],
                            recall.found_px[i] / recall.true_px[i]));
    }
  }
}

void add_curves(const eval::CurveFigures& curves, Page& page) {
  page.heading("Position along the normal of the true edge");
  page.row("points", fmt::format("{}", curves.localisation.points), "beside a true edge");
  page.row("RMS", number(curves.localisation.rms_px(), 4), "px");
  page.row("mean", number(curves.localisation.mean_px(), 4),
           "px, positive: right of the true edge's walking direction");
  if (curves.repeatability.found_px > 0) {
    page.heading("From each frame to the next");
    page.row("repeatability", number(curves.repeatability.share(), 4),
             "of the true edges that were found are found again, by length");
  }
  add_table(curves.by_counts, "counts", page);
  add_table(curves.by_sigma, "units of the noise", page);
}

}  // namespace

std::string evaluation_page(const eval::Evaluation& evaluation,
                            const eval::EvaluationOptions& options) {
  Page page;
  page.line(fmt::format("{}, {}", frames_text(evaluation.frames),
                        evaluation.swept()  ? fmt::format("strength maps at {} thresholds",
                                                          evaluation.thresholds.size())
                        : evaluation.binary ? "binary maps"
                                            : "strength maps at one threshold"));
  add_scores(evaluation, options, page);
  add_structure(evaluation.structure, options.short_px, page);
  if (evaluation.curves) {
    add_curves(*evaluation.curves, page);
  }
  return page.take();
}

std::string evaluation_page(const eval::TruthlessEvaluation& evaluation,
                            const eval::EvaluationOptions& options, bool empty) {
  Page page;
  page.line(fmt::format("{}, without truth, {}", frames_text(evaluation.frames),
                        threshold_text(evaluation.threshold)));
  page.heading(empty ? "False alarms in empty scenes" : "What was found");
  page.row("edges", number(evaluation.edges.mean, 2),
           fmt::format("per frame, at most {}", evaluation.edges.most));
  page.row("edge pixels", number(evaluation.edge_pixels.mean, 1),
           fmt::format("per frame, at most {}", evaluation.edge_pixels.most));
  if (empty) {
    return page.take();
  }
  if (evaluation.pairs > 0) {
    page.heading("From each frame to the next");
    page.row("repeatability", number(evaluation.repeatability.share(), 4),
             fmt::format("of the points within {} px of a point, shifted by up to {} px",
                         options.repeat_reach_px, options.most_shift_px));
  }
  add_structure(evaluation.structure, options.short_px, page);
  return page.take();
}

}  // namespace thermedge::cli
