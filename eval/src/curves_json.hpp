// Curves from JSON that is parsed already.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "thermedge/eval/curves.hpp"

namespace thermedge::eval {

using Json = nlohmann::json;

// [x, y] in px; false where it is something else, or far from any frame.
[[nodiscard]] bool take_point(const Json& json, Point& point);

// One edge, and a whole frame, as parse_curves of curves.hpp describes them.
[[nodiscard]] Result<Curve> parse_curve(const Json& edge, const std::string& name);
[[nodiscard]] Result<CurveFrame> parse_curves(const Json& document, const std::string& name);

}  // namespace thermedge::eval
