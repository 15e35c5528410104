// Which track each edgel belongs to: labels along edges, new tracks, tracks that are one.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "tracker_state.hpp"

namespace thermedge {
namespace {

constexpr std::int32_t kBroken = -50;  // frames that a corner counts for

}  // namespace

using detail::dot;

// Corners, and where the chain turns sharply without one: at the places where a corner is seen in
// some frames only, pieces must end all the same.
void Tracker::Impl::find_breaks(const Edge& edge) {
  const Edgels& edgels = edges->edgels;
  const auto count = static_cast<std::size_t>(edge.edgels.count);
  const auto arm = static_cast<std::size_t>(tuning.turn_arm_px);
  breaks.assign(edges->corners_of(edge).begin(), edges->corners_of(edge).end());
  turns.assign(count, -1);
  for (std::size_t i = arm; i + arm < count; ++i) {
    const std::size_t at = edge.edgels.first + i;
    const float ax = edgels.x[at] - edgels.x[at - arm];
    const float ay = edgels.y[at] - edgels.y[at - arm];
    const float bx = edgels.x[at + arm] - edgels.x[at];
    const float by = edgels.y[at + arm] - edgels.y[at];
    turns[i] = -dot(ax, ay, bx, by) / std::sqrt(dot(ax, ay, ax, ay) * dot(bx, by, bx, by));
  }
  const auto least = static_cast<float>(-tuning.turn_cosine);
  for (std::size_t i = arm; i + arm < count; ++i) {
    const auto first = turns.begin() + static_cast<std::ptrdiff_t>(i - arm);
    if (turns[i] > least && std::max_element(first, first + 2 * arm + 1) ==
                                turns.begin() + static_cast<std::ptrdiff_t>(i)) {
      breaks.push_back(static_cast<std::uint32_t>(i));
    }
  }
  std::sort(breaks.begin(), breaks.end());
}

void Tracker::Impl::mark_breaks(const Edge& edge) {
  constexpr std::int64_t kReach = 2;  // a corner's place is known to so many points
  find_breaks(edge);
  const auto count = static_cast<std::int64_t>(edge.edgels.count);
  is_break.assign(edge.edgels.count, 0);
  for (const std::uint32_t corner : breaks) {
    const std::int64_t first = std::max<std::int64_t>(corner - kReach, 0);
    const std::int64_t end = std::min<std::int64_t>(corner + kReach, count);
    for (std::int64_t i = first; i < end; ++i) {
      is_break[static_cast<std::size_t>(i)] = 1;
    }
  }
}

// Runs that are too short take the label of the longer run beside them.
void Tracker::Impl::smooth_runs(std::span<std::int32_t> of_edge) const {
  const auto end_of_run = [&](std::size_t i) {
    std::size_t end = i + 1;
    while (end < of_edge.size() && of_edge[end] == of_edge[i]) {
      ++end;
    }
    return end;
  };
  const auto shortest = static_cast<std::size_t>(tuning.shortest_run_px);
  std::size_t before = 0;  // length of the run before
  for (std::size_t i = 0; i < of_edge.size();) {
    const std::size_t end = end_of_run(i);
    const std::size_t length = end - i;
    if (length < shortest && length < of_edge.size()) {
      const std::size_t after = end < of_edge.size() ? end_of_run(end) - end : 0;
      const std::int32_t label = before >= after ? of_edge[i - 1] : of_edge[end];
      std::fill(of_edge.begin() + static_cast<std::ptrdiff_t>(i),
                of_edge.begin() + static_cast<std::ptrdiff_t>(end), label);
      before += length;
    } else {
      before = length;
    }
    i = end;
  }
}

std::int32_t Tracker::Impl::new_track() {
  Track track;
  track.born_ns = now_ns;
  track.born_index = updates;
  tracks.push_back(track);
  return static_cast<std::int32_t>(tracks.size()) - 1;
}

// Each unlabelled piece between breaks that is long enough becomes a track.
void Tracker::Impl::give_birth(std::span<std::int32_t> of_edge) {
  const auto is_cut = [&](std::size_t i) {
    return std::binary_search(breaks.begin(), breaks.end(), static_cast<std::uint32_t>(i));
  };
  const auto least = static_cast<std::size_t>(std::ceil(options.shortest_px));
  for (std::size_t i = 0; i < of_edge.size();) {
    if (of_edge[i] >= 0) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (end < of_edge.size() && of_edge[end] < 0 && !is_cut(end)) {
      ++end;
    }
    if (end - i >= least) {
      std::fill(of_edge.begin() + static_cast<std::ptrdiff_t>(i),
                of_edge.begin() + static_cast<std::ptrdiff_t>(end), new_track());
    }
    i = end;
  }
}

// Remembers for how long a track has gone on from an older one without a break. A corner that
// flickers is one.
void Tracker::Impl::note_neighbours(std::span<const std::int32_t> of_edge) {
  for (std::size_t i = 0; i + 1 < of_edge.size(); ++i) {
    const std::int32_t a = of_edge[i];
    const std::int32_t b = of_edge[i + 1];
    if (a == b || a < 0 || b < 0) {
      continue;
    }
    const bool a_is_older =
        std::pair(track_of(a).born_index, a) < std::pair(track_of(b).born_index, b);
    Track& younger = track_of(a_is_older ? b : a);
    const std::int32_t older = a_is_older ? a : b;
    if (younger.neighbour != older) {
      younger.neighbour = older;
      younger.neighbour_frames = 0;
    }
    younger.neighbour_frames = is_break[i] == 0 ? younger.neighbour_frames + 1 : kBroken;
  }
}

void Tracker::Impl::label_edge(const Edge& edge) {
  const std::span of_edge(labels.data() + edge.edgels.first, edge.edgels.count);
  mark_breaks(edge);
  chain_labels.choose(std::span(votes).subspan(edge.edgels.first, edge.edgels.count), is_break,
                      {tuning.change_cost, tuning.change_cost_at_break, tuning.unvoted_cost},
                      of_edge);
  smooth_runs(of_edge);
  give_birth(of_edge);
  note_neighbours(of_edge);
}

void Tracker::Impl::label_edges() {
  for (const Edge& edge : edges->kept_edges()) {
    label_edge(edge);
  }
}

// The older identity goes on.
void Tracker::Impl::merge_tracks() {
  bool any = false;
  for (Track& track : tracks) {
    if (track.neighbour_frames >= tuning.merge_frames && track_of(track.neighbour).id >= 0) {
      track.merged_into = track.neighbour;
      track.neighbour_frames = 0;
      any = true;
    }
  }
  if (!any) {
    return;
  }
  // Chains of merges end at their oldest track, as each goes to an older one.
  const auto target = [&](std::int32_t index) {
    while (track_of(index).merged_into >= 0) {
      index = track_of(index).merged_into;
    }
    return index;
  };
  for (std::int32_t& label : labels) {
    label = label >= 0 ? target(label) : label;
  }
  for (Sample& sample : samples) {
    sample.track = target(sample.track);
  }
}

}  // namespace thermedge
