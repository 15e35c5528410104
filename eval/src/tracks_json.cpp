#include <algorithm>
#include <cmath>

#include "curves_json.hpp"
#include "thermedge/eval/tracks.hpp"

namespace thermedge::eval {
namespace {

constexpr std::size_t kMostEvents = 100;  // of one frame

tl::unexpected<Error> wrong(const std::string& name, const std::string& what) {
  return failure(ErrorCode::kBadData, name + ": " + what);
}

// The value of a key, null where it is absent.
const Json& at(const Json& object, const char* key) {
  static const Json null;
  const auto entry = object.find(key);
  return entry == object.end() ? null : *entry;
}

bool take_whole(const Json& value, std::int64_t& field) {
  if (!value.is_number_integer() ||
      (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t{1} << 62)) {
    return false;
  }
  field = value.get<std::int64_t>();
  return field >= 0;
}

Status take_frame(const Json& document, const std::string& name, std::int64_t& frame) {
  if (!document.is_object()) {
    return wrong(name, "should be a JSON object with frame and edges");
  }
  if (!take_whole(at(document, "frame"), frame)) {
    return wrong(name, "frame should be a whole number from 0 up");
  }
  return {};
}

Status take_events(const Json& document, const std::string& name,
                   std::vector<std::string>& events) {
  const Json& list = at(document, "events");
  if (list.is_null()) {
    return {};
  }
  const bool names =
      list.is_array() && list.size() <= kMostEvents &&
      std::all_of(list.begin(), list.end(), [](const Json& event) { return event.is_string(); });
  if (!names) {
    return wrong(name, "events should be a list of up to 100 names");
  }
  for (const Json& event : list) {
    events.push_back(event.get<std::string>());
  }
  return {};
}

// [from, to, id]
bool take_run(const Json& json, std::size_t points, std::vector<TrackRun>& runs) {
  std::int64_t from = 0;
  std::int64_t to = 0;
  TrackRun run;
  if (!json.is_array() || json.size() != 3 || !take_whole(json[0], from) ||
      !take_whole(json[1], to) || !take_whole(json[2], run.id)) {
    return false;
  }
  run.from = static_cast<std::size_t>(from);
  run.to = static_cast<std::size_t>(to);
  const bool fits =
      run.from < run.to && run.to <= points && (runs.empty() || runs.back().to <= run.from);
  runs.push_back(run);
  return fits;
}

// `tracks`, or else `track` for the whole edge.
Status take_tracks(const Json& json, const std::string& name, TrackedCurve& edge) {
  const std::size_t points = edge.curve.points.size();
  const Json& runs = at(json, "tracks");
  if (!runs.is_null()) {
    const bool good = runs.is_array() && runs.size() <= points &&
                      std::all_of(runs.begin(), runs.end(), [&](const Json& run) {
                        return take_run(run, points, edge.tracks);
                      });
    return good ? Status{}
                : wrong(name,
                        "tracks should be a list of [from, to, id], rising and apart, with "
                        "to at most the number of points (" +
                            std::to_string(points) + ")");
  }
  const Json& track = at(json, "track");
  TrackRun whole{0, points, 0};
  if (track.is_null()) {
    return {};
  }
  if (!take_whole(track, whole.id)) {
    return wrong(name, "track should be a whole number from 0 up, or null");
  }
  if (points > 0) {
    edge.tracks.push_back(whole);
  }
  return {};
}

Status take_smooth(const Json& json, const std::string& name, TrackedCurve& edge) {
  const Json& smooth = at(json, "smooth");
  if (smooth.is_null() || (smooth.is_array() && smooth.empty())) {
    return {};
  }
  const auto take = [&](const Json& place) {
    Point point;
    const bool good = place.is_null() || take_point(place, point);
    edge.smooth.push_back(place.is_null() ? std::nullopt : std::optional(point));
    return good;
  };
  if (!smooth.is_array() || smooth.size() != edge.curve.points.size() ||
      !std::all_of(smooth.begin(), smooth.end(), take)) {
    return wrong(name, "smooth should be a list with [x, y] in px, or null, for each of the " +
                           std::to_string(edge.curve.points.size()) + " points");
  }
  return {};
}

Result<TrackedCurve> parse_edge(const Json& json, const std::string& name) {
  return parse_curve(json, name).and_then([&](Curve curve) -> Result<TrackedCurve> {
    TrackedCurve edge;
    edge.curve = std::move(curve);
    Status status = take_tracks(json, name, edge);
    if (status) {
      status = take_smooth(json, name, edge);
    }
    return status ? Result<TrackedCurve>(std::move(edge)) : tl::unexpected(status.error());
  });
}

Status take_settings(const Json& document, const std::string& name, TrackedFrame& frame) {
  if (const Json& stamp = at(document, "stamp_ns"); !stamp.is_null()) {
    std::int64_t stamp_ns = 0;
    if (!take_whole(stamp, stamp_ns)) {
      return wrong(name, "stamp_ns should be a whole number from 0 up, or null");
    }
    frame.stamp_ns = stamp_ns;
  }
  if (const Json& valid = at(document, "valid"); !valid.is_null()) {
    if (!valid.is_boolean()) {
      return wrong(name, "valid should be true or false");
    }
    frame.valid = valid.get<bool>();
  }
  if (const Json& sigma = at(document, "sigma_counts"); !sigma.is_null()) {
    frame.sigma_counts = sigma.is_number() ? sigma.get<double>() : -1;
    if (!std::isfinite(frame.sigma_counts) || frame.sigma_counts < 0) {
      return wrong(name, "sigma_counts should be a number from 0 up, or null");
    }
  }
  return take_events(document, name, frame.events);
}

bool take_numbers(const Json& object, std::initializer_list<std::pair<const char*, double*>> keys) {
  return object.is_object() && std::all_of(keys.begin(), keys.end(), [&](const auto& key) {
           const Json& value = at(object, key.first);
           *key.second = value.is_number() ? value.get<double>() : 0;
           return value.is_number() && std::isfinite(*key.second);
         });
}

Status take_camera(const Json& document, const std::string& name, TrackTruth& frame) {
  const Json& pose = at(document, "pose");
  const Json& lens = at(document, "intrinsics");
  if (pose.is_null() || lens.is_null()) {
    return {};
  }
  CameraView& camera = frame.camera.emplace();
  if (!take_numbers(lens, {{"fx_px", &camera.fx_px},
                           {"fy_px", &camera.fy_px},
                           {"cx_px", &camera.cx_px},
                           {"cy_px", &camera.cy_px},
                           {"k1", &camera.k1},
                           {"k2", &camera.k2}}) ||
      camera.fx_px <= 0 || camera.fy_px <= 0) {
    return wrong(name, "intrinsics should hold fx_px, fy_px, cx_px, cy_px, k1 and k2");
  }
  const Json& turn = pose.is_object() ? at(pose, "orientation_xyzw") : pose;
  double square = 0;
  for (std::size_t i = 0; turn.is_array() && turn.size() == 4 && i < 4; ++i) {
    camera.orientation_xyzw[i] = turn[i].is_number() ? turn[i].get<double>() : 2;
    square += camera.orientation_xyzw[i] * camera.orientation_xyzw[i];
  }
  if (!(std::abs(square - 1) < 1e-3)) {
    return wrong(name, "pose should hold orientation_xyzw, a quaternion of length 1");
  }
  return {};
}

Status take_truth(const Json& document, const std::string& name, TrackTruth& frame) {
  if (!take_whole(at(document, "stamp_ns"), frame.stamp_ns)) {
    return wrong(name, "stamp_ns should be a whole number from 0 up");
  }
  for (const char* key : {"shutter", "freeze"}) {
    const Json& state = at(document, key);
    const Json& frozen = state.is_object() ? at(state, "frozen") : state;
    if (!frozen.is_null() && !frozen.is_boolean()) {
      return wrong(name, std::string(key) + " should be null or hold frozen, true or false");
    }
    frame.frozen = frame.frozen || (frozen.is_boolean() && frozen.get<bool>());
  }
  return take_events(document, name, frame.events).and_then([&] {
    return take_camera(document, name, frame);
  });
}

}  // namespace

Result<TrackedFrame> parse_tracked_frame(std::string_view json, const std::string& name) {
  const Json document = Json::parse(json, nullptr, false);
  TrackedFrame frame;
  Status status = take_frame(document, name, frame.frame);
  if (status) {
    status = take_settings(document, name, frame);
  }
  if (!status) {
    return tl::unexpected(status.error());
  }
  const Json& edges = at(document, "edges");
  if (!edges.is_array() && !(edges.is_null() && !frame.valid)) {
    return wrong(name, "edges should be a list");
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    auto edge = parse_edge(edges[i], name + ": edge " + std::to_string(i));
    if (!edge) {
      return tl::unexpected(std::move(edge.error()));
    }
    frame.edges.push_back(std::move(*edge));
  }
  return frame;
}

Result<TrackTruth> parse_track_truth(std::string_view json, const std::string& name) {
  const Json document = Json::parse(json, nullptr, false);
  TrackTruth frame;
  Status status = take_frame(document, name, frame.frame);
  if (status) {
    status = take_truth(document, name, frame);
  }
  if (!status) {
    return tl::unexpected(status.error());
  }
  return parse_curves(document, name).and_then([&](CurveFrame edges) -> Result<TrackTruth> {
    const bool named = std::all_of(edges.curves.begin(), edges.curves.end(),
                                   [](const Curve& curve) { return curve.id >= 0; });
    if (!named) {
      return wrong(name, "each edge should have an id: the same for one edge over the sequence");
    }
    frame.edges = std::move(edges);
    return std::move(frame);
  });
}

}  // namespace thermedge::eval
