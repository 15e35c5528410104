#include "thermedge/stages/gap_closing.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <tuple>

#include "pixel_window.hpp"

namespace thermedge {
namespace {

using detail::contour_of;
using detail::pixel_of;

constexpr std::int32_t kNone = -1;
constexpr double kNoWay = 1e9;

double bilinear(ImageView<const float> frame, double x, double y) {
  x = std::clamp(x, 0.0, static_cast<double>(frame.width() - 1));
  y = std::clamp(y, 0.0, static_cast<double>(frame.height() - 1));
  const int left = std::min(static_cast<int>(x), std::max(frame.width() - 2, 0));
  const int top = std::min(static_cast<int>(y), std::max(frame.height() - 2, 0));
  const int right = std::min(left + 1, frame.width() - 1);
  const int bottom = std::min(top + 1, frame.height() - 1);
  const double fx = x - left;
  const double fy = y - top;
  const double upper = frame(left, top) + fx * (frame(right, top) - frame(left, top));
  const double lower = frame(left, bottom) + fx * (frame(right, bottom) - frame(left, bottom));
  return upper + fy * (lower - upper);
}

// The right side of a point over its left one, seen in the direction (x, y).
double step_across(ImageView<const float> frame, double side_px, double at_x, double at_y, double x,
                   double y) {
  return bilinear(frame, at_x - side_px * y, at_y + side_px * x) -
         bilinear(frame, at_x + side_px * y, at_y - side_px * x);
}

}  // namespace

Status GapClosingOptions::check() const { return check_ranges(*this, "gap_closing."); }

Status GapCloser::run(const LinkedContours& curves, ImageView<const float> frame,
                      std::span<const std::uint8_t> eligible, LinkedContours& bridged,
                      ImageView<const std::uint8_t> valid) {
  bridged.clear();
  valid_ = valid;
  if (Status status = options_.check(); !status) {
    return status;
  }
  assert(eligible.size() == curves.contours.items.size());
  prepare(curves, frame, bridged);
  bridges_.clear();
  if (options_.gap_px > 0) {
    paint(curves, eligible);
    for (std::int32_t end = 0; end < chains_.ends(); ++end) {
      if (chains_.is_free(end) && eligible[contour_of(end)] != 0) {
        if (const auto bridge = find_bridge(curves.contours, end, frame)) {
          bridges_.push_back(*bridge);
        }
      }
    }
  }
  bridged.links.assign(curves.links.begin(), curves.links.end());
  bridged.contours.junctions.assign(curves.contours.junctions.begin(),
                                    curves.contours.junctions.end());
  join(curves.contours, bridged);
  return {};
}

void GapCloser::prepare(const LinkedContours& curves, ImageView<const float> frame,
                        LinkedContours& bridged) {
  const double gap_px = options_.gap_px;
  const auto reach = static_cast<std::int32_t>(gap_px);
  detail::list_offsets(
      reach,
      [=](Pixel offset) {
        return static_cast<double>(squared_distance(offset, {})) <= gap_px * gap_px;
      },
      window_);
  const std::size_t most_contours = curves.contours.items.capacity();
  chains_.reserve(most_contours);
  chains_.reset(curves.contours);
  bridges_.reserve(2 * most_contours);
  owner_.resize(frame.width(), frame.height());
  place_.resize(frame.width(), frame.height());
  offsets_.clear();
  std::transform(window_.begin(), window_.end(), std::back_inserter(offsets_), [&](Pixel step) {
    return Offset{step, step.y * owner_.stride() + step.x,
                  std::sqrt(static_cast<double>(squared_distance(step, {})))};
  });
  bridged.links.reserve(curves.links.capacity() + 2 * most_contours);
  bridged.contours.items.reserve(most_contours);
  bridged.contours.junctions.reserve(curves.contours.junctions.capacity() + 2 * most_contours);
  bridged.contours.points.reserve(curves.contours.points.capacity() +
                                  4 * most_contours * static_cast<std::size_t>(reach + 1));
}

void GapCloser::paint(const LinkedContours& curves, std::span<const std::uint8_t> eligible) {
  fill_pixels(owner_.view(), kNone);
  const auto paint_pixel = [&](Pixel pixel, std::size_t curve, std::size_t place) {
    owner_(pixel.x, pixel.y) = static_cast<std::int32_t>(curve);
    place_(pixel.x, pixel.y) = static_cast<std::int32_t>(place);
  };
  for (std::size_t i = 0; i < eligible.size(); ++i) {
    if (eligible[i] == 0) {
      continue;
    }
    const auto pixels = curves.contours.pixels(curves.contours.items[i]);
    paint_pixel(pixels.front(), i, 0);
    paint_pixel(pixels.back(), i, pixels.size() - 1);
  }
  // A pixel at which curves end belongs to one that goes on through it.
  for (std::size_t i = 0; i < eligible.size(); ++i) {
    if (eligible[i] == 0) {
      continue;
    }
    const auto pixels = curves.contours.pixels(curves.contours.items[i]);
    for (std::size_t place = 1; place + 1 < pixels.size(); ++place) {
      paint_pixel(pixels[place], i, place);
    }
  }
}

// Whether a pixel belongs to what an end is the end of.
bool GapCloser::is_own(std::int32_t end, Pixel at) const {
  return owner_(at.x, at.y) == static_cast<std::int32_t>(contour_of(end));
}

bool GapCloser::touches_another(std::int32_t end, Pixel at) const {
  for (int y = at.y - 1; y <= at.y + 1; ++y) {
    for (int x = at.x - 1; x <= at.x + 1; ++x) {
      if (owner_.view().contains(x, y) && owner_(x, y) != kNone && !is_own(end, {x, y})) {
        return true;
      }
    }
  }
  return false;
}

// Unit vector, or none.
GapCloser::Vector GapCloser::direction(Pixel from, Pixel to) {
  const double x = to.x - from.x;
  const double y = to.y - from.y;
  const double length = std::sqrt(x * x + y * y);
  return length > 0 ? Vector{x / length, y / length} : Vector{0, 0};
}

GapCloser::Tip GapCloser::tip_of(const ContourSet& contours, std::int32_t end,
                                 ImageView<const float> frame) const {
  const auto pixels = contours.pixels(contours.items[contour_of(end)]);
  const auto last = static_cast<int>(pixels.size()) - 1;
  const auto at = [&](int i) {
    return pixels[static_cast<std::size_t>(end % 2 == 0 ? i : last - i)];
  };
  const int back = std::min(tuning_.tip_pixels, last);
  Tip tip{at(0), direction(at(back), at(0)), 0};
  for (int i = 1; i <= back; ++i) {
    tip.contrast +=
        step_across(frame, tuning_.side_px, at(i).x, at(i).y, tip.ahead.x, tip.ahead.y) / back;
  }
  return tip;
}

// The curve straight ahead, or the border. Of targets that cost the same, the brighter one.
std::optional<GapCloser::Bridge> GapCloser::find_target(const Tip& tip, std::int32_t end,
                                                        double least_cosine,
                                                        ImageView<const float> frame) const {
  constexpr double kRounding = 1e-9;  // more than that of a cost or a cosine
  const std::int32_t own_place = place_(tip.at.x, tip.at.y);
  const std::int32_t* owner = &owner_(tip.at.x, tip.at.y);
  const auto reach = static_cast<std::int32_t>(options_.gap_px);
  const double turn_cost = tuning_.turn_cost;
  const double own_way = tuning_.own_gaps * options_.gap_px;
  const bool inside = tip.at.x >= reach && tip.at.y >= reach && tip.at.x < owner_.width() - reach &&
                      tip.at.y < owner_.height() - reach;
  Bridge best{kNoWay, end, {}, kNone, std::nullopt, std::abs(tip.contrast)};
  const auto is_better = [&](double cost, Pixel to) {
    const double rounding = kRounding * best.cost;
    return cost < best.cost - rounding ||
           (cost <= best.cost + rounding && frame(to.x, to.y) > frame(best.to.x, best.to.y));
  };
  for (const auto& [step, place, length] : offsets_) {
    if (length > best.cost * (1 + kRounding)) {
      break;  // no bridge costs less than its length
    }
    const Pixel to{tip.at.x + step.x, tip.at.y + step.y};
    if ((!inside && !owner_.view().contains(to.x, to.y)) || owner[place] == kNone) {
      continue;
    }
    const double ahead = step.x * tip.ahead.x + step.y * tip.ahead.y;
    const double unit = std::max(length, 1.0);
    if (ahead < (least_cosine - kRounding) * unit) {
      continue;  // before the division, as most are
    }
    const double cosine = ahead / unit;
    const bool own_tip = is_own(end, to) && std::abs(place_(to.x, to.y) - own_place) <= own_way;
    const double cost = length * (1 + turn_cost * (1 - cosine));
    if (cosine >= least_cosine && !own_tip && is_better(cost, to)) {
      best.cost = cost;
      best.to = to;
    }
  }
  if (const double length = distance_to_border(tip);
      length <= options_.gap_px && length < best.cost) {
    const auto place = [&](int from, double ahead, int size) {
      return std::clamp(from + static_cast<int>(std::lround(length * ahead)), 1, size - 2);
    };
    best.cost = length;
    best.to = {place(tip.at.x, tip.ahead.x, owner_.width()),
               place(tip.at.y, tip.ahead.y, owner_.height())};
  }
  return best.cost < kNoWay && best.to != tip.at ? std::optional(best) : std::nullopt;
}

// Straight ahead, to the last pixels that can be edges: one from the border.
double GapCloser::distance_to_border(const Tip& tip) const {
  const auto along = [](int room, double ahead) {
    return ahead > 0 ? std::max(room, 0) / ahead : kNoWay;
  };
  return std::min(
      {along(tip.at.x - 1, -tip.ahead.x), along(owner_.width() - 2 - tip.at.x, tip.ahead.x),
       along(tip.at.y - 1, -tip.ahead.y), along(owner_.height() - 2 - tip.at.y, tip.ahead.y)});
}

// Where the target is near a free end of its curve, that end is the target, and the two become one
// curve if their steps agree and either neither turns too far or both head for a corner.
void GapCloser::meet_end(const ContourSet& contours, ImageView<const float> frame, const Tip& tip,
                         double least_cosine, Bridge& bridge) const {
  const std::int32_t owner = owner_(bridge.to.x, bridge.to.y);
  if (owner == kNone) {
    return;
  }
  for (const std::int32_t other : {2 * owner, 2 * owner + 1}) {
    const Pixel at = pixel_of(contours, other);
    if (other == bridge.end || !chains_.is_free(other) ||
        squared_distance(at, bridge.to) > tuning_.tip_reach_px * tuning_.tip_reach_px) {
      continue;
    }
    bridge.to = at;
    const Vector way = direction(tip.at, at);
    const Tip met = tip_of(contours, other, frame);  // looks the other way
    if (tip.contrast * met.contrast > 0) {
      continue;
    }
    if (-(way.x * met.ahead.x + way.y * met.ahead.y) >= least_cosine) {
      bridge.partner = other;
    } else if (const auto corner = corner_of(tip, met);
               corner && step_goes_on(met, *corner, frame)) {
      bridge.partner = other;
      bridge.corner = corner;
    }
  }
}

// Where what two ends head for is the corner of an outline: ahead of both, no farther than a gap.
std::optional<Pixel> GapCloser::corner_of(const Tip& a, const Tip& b) const {
  const auto cross = [](const Vector& p, const Vector& q) { return p.x * q.y - p.y * q.x; };
  const double sine = cross(a.ahead, b.ahead);
  const Vector between{static_cast<double>(b.at.x - a.at.x), static_cast<double>(b.at.y - a.at.y)};
  const double from_a = cross(between, b.ahead) / sine;
  const double from_b = cross(between, a.ahead) / sine;
  const auto is_near = [&](double way) { return way >= 0 && way <= options_.gap_px; };
  if (std::abs(sine) < tuning_.least_corner_sine || !is_near(from_a) || !is_near(from_b)) {
    return std::nullopt;
  }
  const Pixel corner{a.at.x + static_cast<int>(std::lround(from_a * a.ahead.x)),
                     a.at.y + static_cast<int>(std::lround(from_a * a.ahead.y))};
  const bool inside = corner.x > 0 && corner.y > 0 && corner.x < owner_.width() - 1 &&
                      corner.y < owner_.height() - 1;
  return inside && corner != a.at && corner != b.at ? std::optional(corner) : std::nullopt;
}

// Whether one of the pixels around the way is no measurement.
bool GapCloser::leads_over_invalid(const Tip& tip, Pixel to) const {
  constexpr double kRounding = 1e-6;  // more than that of a place
  if (valid_.empty()) {
    return false;
  }
  const double length = std::sqrt(static_cast<double>(squared_distance(tip.at, to)));
  const Vector way = direction(tip.at, to);
  const auto first = [](double place) { return static_cast<int>(std::floor(place + kRounding)); };
  const auto last = [](double place) { return static_cast<int>(std::ceil(place - kRounding)); };
  const auto steps = static_cast<int>(length / tuning_.step_px);
  for (int i = 0; i <= steps; ++i) {
    const double along = i * tuning_.step_px;
    const double x = tip.at.x + along * way.x;
    const double y = tip.at.y + along * way.y;
    for (int v = first(y); v <= last(y); ++v) {
      for (int u = first(x); u <= last(x); ++u) {
        if (valid_(u, v) == 0) {
          return true;
        }
      }
    }
  }
  return false;
}

bool GapCloser::step_goes_on(const Tip& tip, Pixel to, ImageView<const float> frame) const {
  if (leads_over_invalid(tip, to)) {
    return false;
  }
  const double length = std::sqrt(static_cast<double>(squared_distance(tip.at, to)));
  if (length <= tuning_.unseen_px) {
    return true;
  }
  const Vector way = direction(tip.at, to);
  double step = 0;
  const int samples = std::max(static_cast<int>((length - 1) / tuning_.step_px), 1);
  for (int i = 1; i <= samples; ++i) {
    const double along = tuning_.step_px * i;
    step += step_across(frame, tuning_.side_px, tip.at.x + along * way.x, tip.at.y + along * way.y,
                        way.x, way.y);
  }
  const double same_side = tip.contrast < 0 ? -step : step;
  return same_side > 0 &&
         same_side >= options_.min_contrast_ratio * std::abs(tip.contrast) * samples;
}

std::optional<GapCloser::Bridge> GapCloser::find_bridge(const ContourSet& contours,
                                                        std::int32_t end,
                                                        ImageView<const float> frame) const {
  if (touches_another(end, pixel_of(contours, end))) {
    return std::nullopt;
  }
  const double least_cosine = std::cos(options_.max_turn_deg * std::numbers::pi / 180);
  const Tip tip = tip_of(contours, end, frame);
  auto bridge = find_target(tip, end, least_cosine, frame);
  if (bridge) {
    meet_end(contours, frame, tip, least_cosine, *bridge);
    if (!step_goes_on(tip, bridge->corner.value_or(bridge->to), frame)) {
      return std::nullopt;
    }
  }
  return bridge;
}

void GapCloser::join(const ContourSet& contours, LinkedContours& bridged) {
  std::sort(bridges_.begin(), bridges_.end(), [](const Bridge& a, const Bridge& b) {
    return std::tie(a.cost, b.contrast, a.end) < std::tie(b.cost, a.contrast, b.end);
  });
  for (const Bridge& bridge : bridges_) {
    if (!chains_.is_free(bridge.end)) {
      continue;
    }
    const auto self = static_cast<std::uint32_t>(contour_of(bridge.end));
    const Pixel from = pixel_of(contours, bridge.end);
    if (bridge.partner != kNone && chains_.is_free(bridge.partner)) {
      const bool loop = chains_.join(bridge.end, bridge.partner, bridge.corner);
      bridged.links.push_back(
          {loop ? LinkType::kLoop : LinkType::kEndToEnd, self, self, from, bridge.to});
      continue;
    }
    chains_.extend(bridge.end, bridge.to);
    const std::int32_t other = owner_(bridge.to.x, bridge.to.y);
    if (other != kNone) {
      bridged.links.push_back(
          {LinkType::kEndToMiddle, self, static_cast<std::uint32_t>(other), from, bridge.to});
      bridged.contours.junctions.push_back({bridge.to});
    }
  }
  chains_.assemble(contours, bridged.contours);
  for (Link& link : bridged.links) {
    link.a = static_cast<std::uint32_t>(chains_.chain_of(link.a));
    link.b = static_cast<std::uint32_t>(chains_.chain_of(link.b));
  }
}

}  // namespace thermedge
