#include <cmath>
#include <nlohmann/json.hpp>

#include "thermedge/eval/tracks.hpp"

namespace thermedge::eval {
namespace {

using Ordered = nlohmann::ordered_json;

constexpr int kFormatVersion = 1;

Ordered number(double value) {
  constexpr double kDigits = 1e9;
  return std::isfinite(value) ? Ordered(std::round(value * kDigits) / kDigits) : Ordered(nullptr);
}

Ordered share(std::size_t part, std::size_t whole) {
  return number(static_cast<double>(part) / static_cast<double>(whole));
}

Ordered to_json(const IdentityFigures& figures) {
  return {{"true_px", number(figures.true_px)},
          {"found", number(figures.found_px / figures.true_px)},
          {"labelled", number(figures.labelled_px / figures.found_px)},
          {"kept", number(figures.kept())},
          {"purity", number(figures.purity())},
          {"harmonic_mean", number(figures.harmonic_mean())},
          {"edges", figures.edges},
          {"ids", figures.ids},
          {"ids_per_edge", number(figures.ids_per_edge())},
          {"all_ids_per_edge", share(figures.all_edge_ids, figures.edges)},
          {"false_px", number(figures.false_px)}};
}

Ordered to_json(const Hota& hota) {
  return {{"hota", number(hota.hota)},     {"det_a", number(hota.det_a)},
          {"det_re", number(hota.det_re)}, {"det_pr", number(hota.det_pr)},
          {"ass_a", number(hota.ass_a)},   {"ass_re", number(hota.ass_re)},
          {"ass_pr", number(hota.ass_pr)}, {"loc_a", number(hota.loc_a)}};
}

Ordered to_json(const HotaFigures& figures) {
  Ordered by_alpha = Ordered::array();
  for (const Hota& hota : figures.by_alpha) {
    by_alpha.push_back(to_json(hota));
  }
  return {{"at_reach", to_json(figures.at_reach)},
          {"mean", to_json(figures.mean)},
          {"by_alpha", std::move(by_alpha)}};
}

Ordered to_json(const SmoothFigures& figures) {
  return {{"points", figures.points},
          {"measured_rms_px", number(figures.measured_rms_px)},
          {"smooth_rms_px", number(figures.smooth_rms_px)},
          {"ratio", number(figures.smooth_rms_px / figures.measured_rms_px)},
          {"measured_jitter_px", number(figures.measured_jitter_px)},
          {"smooth_jitter_px", number(figures.smooth_jitter_px)},
          {"jitter_ratio", number(figures.smooth_jitter_px / figures.measured_jitter_px)},
          {"moving_points", figures.moving_points},
          {"measured_lag_px", number(figures.measured_lag_px)},
          {"smooth_lag_px", number(figures.smooth_lag_px)}};
}

Ordered to_json(const std::vector<EventFigures>& events) {
  Ordered list = Ordered::array();
  for (const EventFigures& event : events) {
    list.push_back({{"kind", event.kind},
                    {"truth", event.truth},
                    {"found", event.found},
                    {"precision", share(event.found_true, event.found)},
                    {"recall", share(event.truth_found, event.truth)}});
  }
  return list;
}

std::string line(const Ordered& document) {
  return document.dump(-1, ' ', false, Ordered::error_handler_t::replace) + "\n";
}

}  // namespace

std::string evaluation_to_json(const TracksEvaluation& evaluation, const std::string& found,
                               const std::string& truth) {
  const Ordered document = {{"format_version", kFormatVersion},
                            {"found", found},
                            {"truth", truth},
                            {"frames", evaluation.frames},
                            {"invalid_frames", evaluation.invalid_frames},
                            {"frozen_frames", evaluation.frozen_frames},
                            {"identities", to_json(evaluation.identities)},
                            {"after_gaps",
                             {{"gaps", evaluation.gaps.gaps},
                              {"found_px", number(evaluation.gaps.found_px)},
                              {"share", number(evaluation.gaps.share())}}},
                            {"hota", to_json(evaluation.hota)},
                            {"repeatability",
                             {{"points", evaluation.repeatability.points},
                              {"share", number(evaluation.repeatability.share())}}},
                            {"smooth", to_json(evaluation.smooth)},
                            {"events", to_json(evaluation.events)},
                            {"other_events", evaluation.other_events}};
  return line(document);
}

std::string summary_to_json(const TracksSummary& summary, const std::string& found) {
  Ordered events = Ordered::object();
  for (const auto& [kind, frames] : summary.events) {
    events[kind] = frames;
  }
  return line({{"format_version", kFormatVersion},
               {"found", found},
               {"frames", summary.frames},
               {"invalid_frames", summary.invalid_frames},
               {"found_px", number(summary.found_px)},
               {"labelled", number(summary.labelled_px / summary.found_px)},
               {"aged", number(summary.aged_px / summary.found_px)},
               {"ids", summary.ids},
               {"median_life_frames", number(summary.median_life_frames)},
               {"events", std::move(events)}});
}

}  // namespace thermedge::eval
