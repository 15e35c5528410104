#include <algorithm>
#include <map>

#include "measured_curve.hpp"
#include "thermedge/eval/tracks.hpp"

namespace thermedge::eval {
namespace {

constexpr std::size_t kAged = 5;  // frames

struct Life {
  std::size_t first = 0, last = 0;
};
using Lives = std::map<std::int64_t, Life>;

// The id of each point, -1: none.
std::vector<std::int64_t> ids_of(const TrackedCurve& edge) {
  std::vector<std::int64_t> ids(edge.curve.points.size(), -1);
  for (const TrackRun& run : edge.tracks) {
    std::fill(ids.begin() + static_cast<std::ptrdiff_t>(run.from),
              ids.begin() + static_cast<std::ptrdiff_t>(run.to), run.id);
  }
  return ids;
}

void add_edge(const TrackedCurve& edge, std::size_t frame, Lives& lives, TracksSummary& summary) {
  const auto ids = ids_of(edge);
  for (const TrackRun& run : edge.tracks) {
    lives.try_emplace(run.id, Life{frame, frame}).first->second.last = frame;
  }
  for (const auto& sample : MeasuredCurve(edge.curve).samples()) {
    const std::int64_t id = ids[sample.point];
    ++summary.found_px;
    if (id >= 0) {
      ++summary.labelled_px;
      summary.aged_px += frame - lives.at(id).first >= kAged ? 1 : 0;
    }
  }
}

double median_life(const Lives& lives) {
  std::vector<std::size_t> frames;
  frames.reserve(lives.size());
  for (const auto& [id, life] : lives) {
    frames.push_back(life.last - life.first + 1);
  }
  if (frames.empty()) {
    return 0;
  }
  const auto middle = frames.begin() + static_cast<std::ptrdiff_t>((frames.size() - 1) / 2);
  std::nth_element(frames.begin(), middle, frames.end());
  return static_cast<double>(*middle);
}

}  // namespace

TracksSummary summarise_tracks(const std::vector<TrackedFrame>& frames) {
  TracksSummary summary;
  Lives lives;
  std::map<std::string, std::size_t> events;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const std::string& event : frames[i].events) {
      ++events[event];
    }
    if (!frames[i].valid) {
      ++summary.invalid_frames;
      continue;
    }
    for (const TrackedCurve& edge : frames[i].edges) {
      add_edge(edge, i, lives, summary);
    }
  }
  summary.frames = frames.size();
  summary.ids = lives.size();
  summary.median_life_frames = median_life(lives);
  summary.events.assign(events.begin(), events.end());
  return summary;
}

}  // namespace thermedge::eval
