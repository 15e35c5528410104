#include "event_figures.hpp"

#include <algorithm>
#include <set>
#include <string_view>

namespace thermedge::eval {
namespace {

// What the simulator tells of, in the order of the names.
constexpr std::array<std::string_view, 5> kKinds = {"dropped", "frozen", "near_frozen",
                                                    "offset_jump", "pattern_changed"};

// First and last frame.
struct Episode {
  int first = 0, last = 0;
};

std::vector<Episode> episodes(std::span<const FramePair> frames, std::string_view kind,
                              const auto& events_of) {
  std::vector<Episode> result;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    const std::vector<std::string>& events = events_of(frames[static_cast<std::size_t>(i)]);
    if (std::find(events.begin(), events.end(), kind) == events.end()) {
      continue;
    }
    if (!result.empty() && result.back().last == i - 1) {
      result.back().last = i;
    } else {
      result.push_back({i, i});
    }
  }
  return result;
}

const std::vector<std::string>& found_events(const FramePair& frame) { return frame.found->events; }
const std::vector<std::string>& true_events(const FramePair& frame) { return frame.truth->events; }

EventFigures figures_of(std::span<const FramePair> frames, std::string_view kind, int slack) {
  const auto found = episodes(frames, kind, found_events);
  const auto truth = episodes(frames, kind, true_events);
  const auto begins_with = [&](const Episode& wanted) {
    return std::any_of(found.begin(), found.end(), [&](const Episode& one) {
      return std::abs(one.first - wanted.first) <= slack;
    });
  };
  const auto is_true = [&](const Episode& one) {
    return std::any_of(truth.begin(), truth.end(), [&](const Episode& wanted) {
      return one.first <= wanted.last + slack && one.last >= wanted.first - slack;
    });
  };
  EventFigures figures;
  figures.kind = kind;
  figures.truth = truth.size();
  figures.truth_found =
      static_cast<std::size_t>(std::count_if(truth.begin(), truth.end(), begins_with));
  figures.found = found.size();
  figures.found_true = static_cast<std::size_t>(std::count_if(found.begin(), found.end(), is_true));
  return figures;
}

}  // namespace

void measure_events(std::span<const FramePair> frames, int slack, TracksEvaluation& evaluation) {
  for (const std::string_view kind : kKinds) {
    EventFigures figures = figures_of(frames, kind, kind == "near_frozen" ? slack + 1 : slack);
    if (figures.truth + figures.found > 0) {
      evaluation.events.push_back(std::move(figures));
    }
  }
  std::set<std::string> others;
  for (const FramePair& frame : frames) {
    for (const std::string& event : frame.found->events) {
      if (std::find(kKinds.begin(), kKinds.end(), event) == kKinds.end()) {
        others.insert(event);
      }
    }
  }
  evaluation.other_events.assign(others.begin(), others.end());
}

}  // namespace thermedge::eval
