#include "curves_json.hpp"

#include <algorithm>
#include <cmath>

#include "curve_parts.hpp"
#include "thermedge/limits.hpp"

namespace thermedge::eval {
namespace {

constexpr double kFarthestPx = 1e5;  // a coordinate beyond this is no place in a frame

tl::unexpected<Error> wrong(const std::string& name, const std::string& what) {
  return failure(ErrorCode::kBadData, name + ": " + what);
}

// An absent or null value leaves `field` as it is.
bool take_number(const Json& object, const char* key, double& field) {
  const auto entry = object.find(key);
  if (entry == object.end() || entry->is_null()) {
    return true;
  }
  field = entry->is_number() ? entry->get<double>() : 0;
  return entry->is_number() && std::isfinite(field) && field >= 0;
}

bool take_side(const Json& object, const char* key, int& field) {
  const auto entry = object.find(key);
  if (entry == object.end() || !entry->is_number_integer()) {
    return false;
  }
  const auto value = entry->get<std::int64_t>();
  field = static_cast<int>(value);
  return value >= 1 && value <= Limits{}.max_side_px;
}

bool take_points(const Json& edge, std::vector<Point>& points) {
  const auto entry = edge.find("points");
  if (entry == edge.end() || !entry->is_array()) {
    return false;
  }
  points.resize(entry->size());
  return std::equal(entry->begin(), entry->end(), points.begin(),
                    [](const Json& from, Point& to) { return take_point(from, to); });
}

double length_px(const CurveFrame& frame) {
  double sum = 0;
  for (const Curve& curve : frame.curves) {
    sum += length_px(curve);
  }
  return sum;
}

}  // namespace

bool take_point(const Json& json, Point& point) {
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number()) {
    return false;
  }
  point = {json[0].get<double>(), json[1].get<double>()};
  return std::abs(point.x) <= kFarthestPx && std::abs(point.y) <= kFarthestPx;
}

Result<Curve> parse_curve(const Json& edge, const std::string& name) {
  Curve curve;
  if (!edge.is_object() || !take_points(edge, curve.points)) {
    return wrong(name, "points should be a list of [x, y] in px");
  }
  if (!take_number(edge, "contrast_counts", curve.contrast_counts)) {
    return wrong(name, "contrast_counts should be a number from 0 up, or null");
  }
  if (const auto closed = edge.find("closed"); closed != edge.end() && !closed->is_null()) {
    if (!closed->is_boolean()) {
      return wrong(name, "closed should be true or false");
    }
    curve.closed = closed->get<bool>();
  }
  if (const auto id = edge.find("id"); id != edge.end() && !id->is_null()) {
    if (!id->is_number_integer() || id->get<std::int64_t>() < 0) {
      return wrong(name, "id should be a whole number from 0 up, or null");
    }
    curve.id = id->get<std::int64_t>();
  }
  return curve;
}

Result<CurveFrame> parse_curves(const Json& document, const std::string& name) {
  if (!document.is_object()) {
    return wrong(name, "should be a JSON object with width, height and edges");
  }
  CurveFrame frame;
  if (!take_side(document, "width", frame.width) || !take_side(document, "height", frame.height)) {
    return wrong(name, "width and height should be whole numbers of px, 1 to " +
                           std::to_string(Limits{}.max_side_px));
  }
  if (!take_number(document, "sigma_counts", frame.sigma_counts)) {
    return wrong(name, "sigma_counts should be a number from 0 up, or null");
  }
  const auto edges = document.find("edges");
  if (edges == document.end() || !edges->is_array()) {
    return wrong(name, "edges should be a list");
  }
  for (std::size_t i = 0; i < edges->size(); ++i) {
    auto curve = parse_curve((*edges)[i], name + ": edge " + std::to_string(i));
    if (!curve) {
      return tl::unexpected(std::move(curve.error()));
    }
    frame.curves.push_back(std::move(*curve));
  }
  // No frame holds more, and the time to judge it grows with the length.
  const double most_px = 4.0 * frame.width * frame.height;
  if (const double total = length_px(frame); total > most_px) {
    return wrong(name, "edges of " + std::to_string(std::llround(total)) +
                           " px in all are more than a frame of " + std::to_string(frame.width) +
                           "x" + std::to_string(frame.height) + " pixels holds");
  }
  return frame;
}

Result<CurveFrame> parse_curves(std::string_view json, const std::string& name) {
  return parse_curves(Json::parse(json, nullptr, false), name);
}

}  // namespace thermedge::eval
