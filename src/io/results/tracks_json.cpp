#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "results/digits.hpp"
#include "results/edges_json.hpp"
#include "thermedge/io/tracks_file.hpp"

namespace thermedge::io {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(std::int64_t track) { return track >= 0 ? Json(track) : Json(nullptr); }

Json to_json(const FrameEvents& events) {
  Json names = Json::array();
  for (const auto& event : kFrameEvents) {
    if (events.has(event.value)) {
      names.push_back(event.name);
    }
  }
  return names;
}

Json to_json(const Motion& motion) {
  constexpr int kElementDigits = 9;
  constexpr int kMeasuredDigits = 4;
  Json homography = Json::array();
  for (const double element : motion.homography) {
    homography.push_back(to_significant(element, kElementDigits));
  }
  return {{"homography", std::move(homography)},
          {"offset_counts", to_significant(motion.offset_counts, kMeasuredDigits)},
          {"inliers", to_significant(motion.inliers, kMeasuredDigits)},
          {"sigma_px", to_significant(motion.sigma_px, kMeasuredDigits)}};
}

Json ended(const Tracks& tracks) {
  Json list = Json::array();
  for (const EndedTrack& end : tracks.ended) {
    list.push_back({end.track, track_end_name(end.why)});
  }
  return list;
}

Json merged(const Tracks& tracks) {
  Json list = Json::array();
  for (const EndedTrack& end : tracks.ended) {
    if (end.why == TrackEnd::kMerged) {
      list.push_back({end.track, end.merged_into});
    }
  }
  return list;
}

// What is known of an edge over time.
void add_tracks(const Tracks& tracks, const Edge& edge, const TrackedEdge& tracked, Json& json) {
  json["track"] = or_null(tracked.track);
  json["age"] = tracked.track >= 0 ? Json(tracked.age) : Json(nullptr);
  Json runs = Json::array();
  for (std::uint32_t i = tracked.runs.first; i < tracked.runs.first + tracked.runs.count; ++i) {
    const TrackRun& run = tracks.runs[i];
    const std::uint32_t from = run.edgels.first - edge.edgels.first;
    runs.push_back({from, from + run.edgels.count, run.track});
  }
  json["tracks"] = std::move(runs);
  Json smooth = Json::array();
  for (std::uint32_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
    smooth.push_back({to_decimals(tracks.smooth_x[i], kPositionDecimals),
                      to_decimals(tracks.smooth_y[i], kPositionDecimals)});
  }
  json["smooth"] = std::move(smooth);
}

}  // namespace

std::string_view track_end_name(TrackEnd why) {
  switch (why) {
    case TrackEnd::kLost:
      return "lost";
    case TrackEnd::kLeft:
      return "left";
    case TrackEnd::kMerged:
      return "merged";
  }
  return "";
}

std::string tracks_to_json(const TrackedFrame& frame, const std::string& source,
                           const EdgesFileOptions& options) {
  Json document = frame_json(frame.detection, source, options);
  Json& edges = document["edges"];
  for (std::size_t i = 0; i < edges.size(); ++i) {
    add_tracks(frame.tracks, frame.detection.edges.edges[i], frame.tracks.edges[i], edges[i]);
  }
  constexpr int kSecondsDigits = 6;
  document["valid"] = frame.events.valid;
  document["events"] = to_json(frame.events);
  document["since_shutter_s"] =
      frame.events.since_shutter_s
          ? Json(to_significant(*frame.events.since_shutter_s, kSecondsDigits))
          : Json(nullptr);
  document["motion"] = frame.motion.found ? to_json(frame.motion) : Json(nullptr);
  document["born"] = frame.tracks.born;
  document["ended"] = ended(frame.tracks);
  document["merged"] = merged(frame.tracks);
  return json_line(document);
}

}  // namespace thermedge::io
