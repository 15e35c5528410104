#include "track_index.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "curve_parts.hpp"

namespace thermedge::eval {
namespace {

using Key = std::function<std::optional<std::int64_t>(const TrackedFrame&)>;
using TrueKey = std::function<std::int64_t(const TrackTruth&)>;

// Nothing where a key is missing, comes twice, or has no truth.
std::optional<std::vector<FramePair>> pair_by(const std::vector<TrackedFrame>& found,
                                              const std::vector<TrackTruth>& truth, const Key& key,
                                              const TrueKey& true_key) {
  std::map<std::int64_t, const TrackTruth*> known;
  for (const TrackTruth& frame : truth) {
    known.emplace(true_key(frame), &frame);
  }
  std::vector<FramePair> pairs;
  for (const TrackedFrame& frame : found) {
    const auto wanted = key(frame);
    const auto entry = wanted ? known.find(*wanted) : known.end();
    if (entry == known.end()) {
      return std::nullopt;
    }
    pairs.push_back({&frame, entry->second});
    known.erase(entry);
  }
  return pairs;
}

double noise_of(const std::vector<FramePair>& frames, const TracksOptions& options) {
  if (options.sigma_counts > 0) {
    return options.sigma_counts;
  }
  double sum = 0;
  std::size_t known = 0;
  for (const FramePair& frame : frames) {
    if (!std::isnan(frame.found->sigma_counts)) {
      sum += frame.found->sigma_counts;
      ++known;
    }
  }
  return known > 0 ? sum / static_cast<double>(known) : 0;
}

}  // namespace

Result<std::vector<FramePair>> pair_frames(const std::vector<TrackedFrame>& found,
                                           const std::string& name,
                                           const std::vector<TrackTruth>& truth,
                                           const std::string& truth_name) {
  auto pairs = pair_by(
      found, truth, [](const TrackedFrame& frame) { return frame.stamp_ns; },
      [](const TrackTruth& frame) { return frame.stamp_ns; });
  if (!pairs) {
    pairs = pair_by(
        found, truth, [](const TrackedFrame& frame) { return std::optional(frame.frame); },
        [](const TrackTruth& frame) { return frame.frame; });
  }
  if (!pairs && found.size() == truth.size()) {
    pairs.emplace();
    for (std::size_t i = 0; i < found.size(); ++i) {
      pairs->push_back({&found[i], &truth[i]});
    }
  }
  if (!pairs) {
    return failure(ErrorCode::kBadData, name + ": neither stamp_ns nor frame of its " +
                                            std::to_string(found.size()) + " frames are all in " +
                                            truth_name + ", which has " +
                                            std::to_string(truth.size()) + " frames");
  }
  return std::move(*pairs);
}

TrackIndex::TrackIndex(const std::vector<FramePair>& frames, const TracksOptions& options)
    : visits_of_(frames.size()),
      least_contrast_counts_(
          std::max(options.least_contrast_counts, 2 * noise_of(frames, options))) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    add_edges(i, frames[i], options.absence_s);
    if (frames[i].counts()) {
      add_tracks(*frames[i].found);
    }
  }
  for (Visit& visit : visits_) {
    // Unknown contrasts count.
    const double contrast_counts = visit.contrast_px / visit.length_px;
    visit.counts =
        visit.frames >= options.least_frames && !(contrast_counts < least_contrast_counts_);
  }
}

void TrackIndex::add_tracks(const TrackedFrame& frame) {
  for (const TrackedCurve& edge : frame.edges) {
    for (const TrackRun& run : edge.tracks) {
      tracks_.emplace(run.id, static_cast<std::int32_t>(tracks_.size()));
    }
  }
}

// The edge of a true curve, in the visit of this moment. It may be seen in frames that don't count,
// too.
TrackIndex::Seen& TrackIndex::see(const Curve& curve, std::int64_t stamp_ns, double absence_s) {
  const auto [entry, is_new] = seen_.try_emplace(curve.id);
  Seen& seen = entry->second;
  seen.edge = is_new ? static_cast<std::int32_t>(seen_.size()) - 1 : seen.edge;
  const double away_s = static_cast<double>(stamp_ns - seen.last_stamp_ns) * 1e-9;
  if (is_new || (absence_s > 0 && away_s > absence_s)) {
    seen.visit = static_cast<std::int32_t>(visits_.size());
    visits_.push_back({.edge = seen.edge});
  }
  seen.last_stamp_ns = stamp_ns;
  return seen;
}

void TrackIndex::add_edges(std::size_t index, const FramePair& frame, double absence_s) {
  for (const Curve& curve : frame.truth->edges.curves) {
    Seen& seen = see(curve, frame.truth->stamp_ns, absence_s);
    visits_of_[index].push_back(seen.visit);
    Visit& visit = visits_[static_cast<std::size_t>(seen.visit)];
    if (frame.counts()) {
      visit.frames += visit.frames == 0 || seen.last_frame != index ? 1 : 0;
      seen.last_frame = index;
      const double length = length_px(curve);
      visit.length_px += length;
      visit.contrast_px += length * curve.contrast_counts;
    }
  }
}

}  // namespace thermedge::eval
