#include "evaluate_tracks.hpp"

#include <fmt/core.h>

#include "page.hpp"

namespace thermedge::cli {
namespace {

std::string per_cent(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100 * share) : "-";
}

void add_identities(const eval::IdentityFigures& figures, Page& page) {
  page.row("found", number(figures.found_px / figures.true_px, 4), "of the true length");
  page.row("labelled", number(figures.labelled_px / figures.found_px, 4),
           "of the found true length has an identity");
  page.row("kept", number(figures.kept(), 4),
           "of the found true length has its true edge's main identity");
  page.row("purity", number(figures.purity(), 4),
           "of an identity's length is at its main true edge");
  page.row("harmonic mean", number(figures.harmonic_mean(), 4), "of these two");
  page.row("ids per true edge", number(figures.ids_per_edge(), 2),
           fmt::format("hold 95 % of what is labelled; {} true edges, {} identities", figures.edges,
                       figures.ids));
}

void add_gaps(const eval::GapFigures& gaps, Page& page) {
  if (gaps.found_px > 0) {
    page.row(
        "after gaps", number(gaps.share(), 4),
        fmt::format("of the true length has its identity from before; {} gap{} of frozen frames",
                    gaps.gaps, gaps.gaps == 1 ? "" : "s"));
  }
}

void add_hota(const eval::HotaFigures& figures, double reach_px, Page& page) {
  page.heading("Curve-HOTA, samples 1 px apart");
  page.line(fmt::format("  {:<20} {:>8} {:>8} {:>8} {:>8} {:>8}", "", "HOTA", "DetA", "AssA",
                        "AssRe", "AssPr"));
  const auto row = [&](const std::string& label, const eval::Hota& hota) {
    page.line(fmt::format("  {:<20} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f}", label, hota.hota,
                          hota.det_a, hota.ass_a, hota.ass_re, hota.ass_pr));
  };
  row(fmt::format("up to {:g} px", reach_px), figures.at_reach);
  row("mean of 19 distances", figures.mean);
}

void add_positions(const eval::TracksEvaluation& evaluation, double repeat_reach_px, Page& page) {
  page.heading("Positions across the true edge");
  page.row("repeatability", number(evaluation.repeatability.share(), 4),
           fmt::format("of the samples are found again in the next frame within {:g} px",
                       repeat_reach_px));
  const eval::SmoothFigures& smooth = evaluation.smooth;
  if (smooth.points == 0) {
    return;
  }
  page.row("measured", number(smooth.measured_rms_px, 4), "px RMS");
  page.row("smoothed", number(smooth.smooth_rms_px, 4),
           fmt::format("px RMS, {} of the measured",
                       number(smooth.smooth_rms_px / smooth.measured_rms_px, 3)));
  page.row("jitter", number(smooth.smooth_jitter_px, 4),
           fmt::format("px RMS from frame to frame, {} of the measured",
                       number(smooth.smooth_jitter_px / smooth.measured_jitter_px, 3)));
  page.row("lag", number(smooth.smooth_lag_px, 4),
           fmt::format("px at constant speed (measured {}), {} points",
                       number(smooth.measured_lag_px, 4), smooth.moving_points));
}

void add_events(const eval::TracksEvaluation& evaluation, int slack, Page& page) {
  if (evaluation.events.empty()) {
    return;
  }
  page.heading(fmt::format("Events, within {} frame{}", slack, slack == 1 ? "" : "s"));
  page.line(
      fmt::format("  {:<20} {:>8} {:>8} {:>10} {:>8}", "", "true", "found", "precision", "recall"));
  for (const eval::EventFigures& event : evaluation.events) {
    const auto share = [](std::size_t part, std::size_t whole) {
      return per_cent(static_cast<double>(part) / static_cast<double>(whole));
    };
    page.line(fmt::format("  {:<20} {:>8} {:>8} {:>10} {:>8}", event.kind, event.truth, event.found,
                          share(event.found_true, event.found),
                          share(event.truth_found, event.truth)));
  }
}

std::string page_of(const eval::TracksEvaluation& evaluation, const eval::TracksOptions& options) {
  Page page;
  page.line(fmt::format("{} frame{}, {} invalid, {} frozen in truth", evaluation.frames,
                        evaluation.frames == 1 ? "" : "s", evaluation.invalid_frames,
                        evaluation.frozen_frames));
  page.heading(fmt::format("Identities, within {:g} px and {:g} degrees", options.reach_px,
                           options.most_angle_deg));
  add_identities(evaluation.identities, page);
  add_gaps(evaluation.gaps, page);
  add_hota(evaluation.hota, options.reach_px, page);
  add_positions(evaluation, options.repeat_reach_px, page);
  add_events(evaluation, options.event_slack, page);
  return page.take();
}

std::string page_of(const eval::TracksSummary& summary) {
  Page page;
  page.line(fmt::format("{} frame{}, {} invalid, without truth", summary.frames,
                        summary.frames == 1 ? "" : "s", summary.invalid_frames));
  page.heading("Identities");
  page.row("labelled", number(summary.labelled_px / summary.found_px, 4),
           "of the length of the edges has an identity");
  page.row("aged", number(summary.aged_px / summary.found_px, 4),
           "has one that was seen 5 frames before or earlier");
  page.row("identities", fmt::format("{}", summary.ids),
           fmt::format("half of them last {:.0f} frames or less", summary.median_life_frames));
  if (!summary.events.empty()) {
    page.heading("Events, frames that name them");
    for (const auto& [kind, frames] : summary.events) {
      page.row(kind, fmt::format("{}", frames), "");
    }
  }
  return page.take();
}

}  // namespace

void TracksCommand::add_to(CLI::App& app) {
  CLI::Option* flag = app.add_flag("--tracks", on,
                                   "PRED are tracks of a sequence, GT, if any, is truth.jsonl of "
                                   "simulate: do edges keep their identities?");
  for (const char* other :
       {"--at", "--thresholds", "--no-thin", "--max-dist", "--shift", "--empty"}) {
    flag->excludes(app.get_option(other));
  }
  const auto add = [&](const char* name, auto& field, const char* meaning, auto low, auto high) {
    app.add_option(name, field, std::string("with --tracks: ") + meaning)
        ->check(CLI::Range(low, high))
        ->capture_default_str()
        ->needs(flag);
  };
  add("--reach", options.reach_px, "a place is at a true edge that is no farther, px", 0.1, 20.0);
  add("--angle", options.most_angle_deg, "and whose direction differs no more, degrees", 1.0, 90.0);
  add("--least-frames", options.least_frames, "true edges that show in fewer do not count", 1,
      1000000);
  add("--absence", options.absence_s,
      "a true edge that is out of view for longer is another one, s (0: never)", 0.0, 1e6);
}

Result<std::string> TracksCommand::run(const std::string& found, const std::string& truth,
                                       double least_contrast_counts, double sigma_counts,
                                       int threads, bool json, Console& report) const {
  if (truth.empty()) {
    return eval::summarise_tracks(found).map([&](const eval::TracksSummary& summary) {
      return json ? eval::summary_to_json(summary, found) : found + ": " + page_of(summary);
    });
  }
  eval::TracksOptions all = options;
  if (least_contrast_counts >= 0) {
    all.least_contrast_counts = least_contrast_counts;
  }
  all.sigma_counts = sigma_counts;
  all.progress = [&report](std::size_t done, std::size_t count) { report.progress(done, count); };
  return eval::evaluate_tracks(found, truth, all, *make_runner(threads))
      .map([&](const eval::TracksEvaluation& evaluation) {
        return json ? eval::evaluation_to_json(evaluation, found, truth)
                    : found + " against " + truth + ": " + page_of(evaluation, all);
      });
}

}  // namespace thermedge::cli
