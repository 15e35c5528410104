#include "thermedge/sim/truth_file.hpp"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace thermedge::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormatVersion = 1;

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

const char* name_of(EdgeKind kind) {
  return kind == EdgeKind::kOccluding ? "occluding"
         : kind == EdgeKind::kCrease  ? "crease"
                                      : "material";
}

Json to_json(const TrueEdge& edge) {
  Json points = Json::array();
  for (const Point p : edge.points) {
    points.push_back({rounded(p.x, 1e4), rounded(p.y, 1e4)});
  }
  return {{"id", edge.id},
          {"object", edge.object},
          {"kind", name_of(edge.kind)},
          {"contrast_counts", rounded(edge.contrast_counts, 1e3)},
          {"closed", edge.closed},
          {"points", std::move(points)}};
}

Json to_json(const std::optional<ShutterState>& shutter) {
  if (!shutter) {
    return nullptr;
  }
  return {{"frozen", shutter->frozen},
          {"shows_frame", shutter->shows_frame},
          {"jump_counts", rounded(shutter->jump_counts, 1e3)}};
}

const char* name_of(StreamEvent event) {
  switch (event) {
    case StreamEvent::kDropped:
      return "dropped";
    case StreamEvent::kFrozen:
      return "frozen";
    case StreamEvent::kNearFrozen:
      return "near_frozen";
    case StreamEvent::kOffsetJump:
      return "offset_jump";
    case StreamEvent::kPatternChanged:
      break;
  }
  return "pattern_changed";
}

Json to_json(const std::optional<FreezeState>& freeze) {
  if (!freeze) {
    return nullptr;
  }
  return {{"frozen", true},
          {"shows_frame", freeze->shows_frame},
          {"noise_counts", rounded(freeze->noise_counts, 1e3)}};
}

Json to_json(const std::vector<StreamEvent>& events) {
  Json list = Json::array();
  for (const StreamEvent event : events) {
    list.push_back(name_of(event));
  }
  return list;
}

Json to_json(const std::vector<MovedObject>& moved) {
  Json list = Json::array();
  for (const MovedObject& one : moved) {
    list.push_back({{"object", one.object}, {"by_m", {one.by_m.x, one.by_m.y, one.by_m.z}}});
  }
  return list;
}

// Locale-free, with a fixed number of digits after the point.
std::string fixed(double value, int digits) {
  char text[64];
  return {
      std::begin(text),
      std::to_chars(std::begin(text), std::end(text), value, std::chars_format::fixed, digits).ptr};
}

}  // namespace

std::string truth_line(const TrueFrame& frame) {
  const Vec3 at = frame.pose.position_m;
  const Intrinsics& i = frame.intrinsics;
  Json edges = Json::array();
  for (const TrueEdge& edge : frame.edges) {
    edges.push_back(to_json(edge));
  }
  const auto pose_value = [](double value) { return rounded(value, 1e9); };
  const auto& turn = frame.pose.orientation_xyzw;
  const Json line = {
      {"format_version", kFormatVersion},
      {"frame", frame.index},
      {"stamp_ns", frame.stamp_ns},
      {"width", i.width},
      {"height", i.height},
      {"pose",
       {{"position_m", {pose_value(at.x), pose_value(at.y), pose_value(at.z)}},
        {"orientation_xyzw",
         {pose_value(turn[0]), pose_value(turn[1]), pose_value(turn[2]), pose_value(turn[3])}}}},
      {"intrinsics",
       {{"fx_px", rounded(i.fx_px, 1e4)},
        {"fy_px", rounded(i.fy_px, 1e4)},
        {"cx_px", i.cx_px},
        {"cy_px", i.cy_px},
        {"k1", i.k1},
        {"k2", i.k2}}},
      {"shutter", to_json(frame.shutter)},
      {"freeze", to_json(frame.freeze)},
      {"offset_counts", rounded(frame.offset_counts, 1e3)},
      {"dropped_frames", frame.dropped_frames},
      {"events", to_json(frame.events)},
      {"moved", to_json(frame.moved)},
      {"edges", std::move(edges)}};
  return line.dump() + "\n";
}

std::string trajectory_line(const TrueFrame& frame) {
  std::string line = fixed(static_cast<double>(frame.stamp_ns) * 1e-9, 9);
  const Vec3 at = frame.pose.position_m;
  for (const double value : {at.x, at.y, at.z}) {
    line += " " + fixed(value, 9);
  }
  for (const double value : frame.pose.orientation_xyzw) {
    line += " " + fixed(value, 9);
  }
  return line + "\n";
}

}  // namespace thermedge::sim
