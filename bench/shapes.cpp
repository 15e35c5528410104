#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "portable.hpp"

namespace thermedge::bench {
namespace {

using eval::Point;
using sim::sin_cos;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kRoundCorners = 120;  // of round shapes: within 0.03 px of the circle at 85 px

// `local` turned by `angle` and moved to `centre`.
Point place(Point local, double angle, Point centre) {
  const auto [sine, cosine] = sin_cos(angle);
  return {centre.x + cosine * local.x - sine * local.y,
          centre.y + sine * local.x + cosine * local.y};
}

std::vector<Point> ellipse(double size, double angle, Point centre, Draws& draws) {
  const double other = size * draws.uniform(0.35, 1);
  std::vector<Point> corners;
  for (int i = 0; i < kRoundCorners; ++i) {
    const auto [sine, cosine] = sin_cos(kTurn * i / kRoundCorners);
    corners.push_back(place({size * cosine, other * sine}, angle, centre));
  }
  return corners;
}

std::vector<Point> convex(double size, Point centre, Draws& draws) {
  std::vector<double> angles(static_cast<std::size_t>(draws.integer(3, 6)));
  std::generate(angles.begin(), angles.end(), [&] { return draws.uniform(0, kTurn); });
  std::sort(angles.begin(), angles.end());
  std::vector<Point> corners;
  corners.reserve(angles.size());
  for (const double angle : angles) {
    corners.push_back(place({size, 0}, angle, centre));
  }
  return corners;
}

std::vector<Point> box(double size, double angle, Point centre, Draws& draws) {
  const double other = size * draws.uniform(0.2, 1);
  const double turn = draws.coin() ? angle : 0;  // half of them stand upright
  std::vector<Point> corners;
  for (const Point corner : {Point{-size, -other}, {size, -other}, {size, other}, {-size, other}}) {
    corners.push_back(place(corner, turn, centre));
  }
  return corners;
}

// A circle whose radius varies smoothly.
std::vector<Point> blob(double size, Point centre, Draws& draws) {
  constexpr int kWaves = 4;
  std::vector<std::pair<double, double>> waves;  // height, phase
  for (int k = 0; k < kWaves; ++k) {
    const double height = draws.normal(0.35 / (k + 2));
    waves.emplace_back(height, draws.uniform(0, kTurn));
  }
  std::vector<Point> corners;
  for (int i = 0; i < kRoundCorners; ++i) {
    const double angle = kTurn * i / kRoundCorners;
    double radius = 1;
    for (int k = 0; k < kWaves; ++k) {
      const auto [height, phase] = waves[static_cast<std::size_t>(k)];
      radius += height * sin_cos((k + 2) * angle + phase).cos;
    }
    corners.push_back(place({size * std::max(0.25, radius), 0}, angle, centre));
  }
  return corners;
}

// A parabola's arc of constant thickness.
std::vector<Point> strip(double size, double angle, Point centre, Draws& draws) {
  constexpr int kSteps = 30;
  const double bend = draws.normal(0.5);
  const double half_px = draws.uniform(3, 8);
  std::vector<Point> corners, back;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const Point middle{3 * size * t, 3 * size * bend * t * t};
    const double slope = 2 * bend * t;
    const double along = std::sqrt(1 + slope * slope);
    const Point across{-slope / along * half_px, half_px / along};
    corners.push_back(place({middle.x + across.x, middle.y + across.y}, angle, centre));
    back.push_back(place({middle.x - across.x, middle.y - across.y}, angle, centre));
  }
  corners.insert(corners.end(), back.rbegin(), back.rend());
  return corners;
}

}  // namespace

Polygon::Polygon(std::vector<Point> corners)
    : corners_(std::move(corners)), low_(corners_.front()), high_(corners_.front()) {
  for (const Point corner : corners_) {
    low_ = {std::min(low_.x, corner.x), std::min(low_.y, corner.y)};
    high_ = {std::max(high_.x, corner.x), std::max(high_.y, corner.y)};
  }
}

void Polygon::crossings(double y, std::vector<double>& x) const {
  x.clear();
  if (y < low_.y || y > high_.y) {
    return;
  }
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point from = corners_[i];
    const Point to = corners_[(i + 1) % corners_.size()];
    if ((from.y <= y) != (to.y <= y)) {
      x.push_back(from.x + (y - from.y) * (to.x - from.x) / (to.y - from.y));
    }
  }
  std::sort(x.begin(), x.end());
}

bool Polygon::contains(Point point) const {
  if (point.x < low_.x || point.x > high_.x || point.y < low_.y || point.y > high_.y) {
    return false;
  }
  bool inside = false;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point from = corners_[i];
    const Point to = corners_[(i + 1) % corners_.size()];
    if ((from.y <= point.y) != (to.y <= point.y) &&
        point.x >= from.x + (point.y - from.y) * (to.x - from.x) / (to.y - from.y)) {
      inside = !inside;
    }
  }
  return inside;
}

Polygon random_shape(int width, int height, Draws& draws) {
  const Point centre{draws.uniform(0, width), draws.uniform(0, height)};
  const double share = draws.uniform(0, 1);
  const double size = 15 + 70 * share * share;
  const double angle = draws.uniform(0, kTurn);
  switch (draws.integer(0, 4)) {
    case 0:
      return Polygon(ellipse(size, angle, centre, draws));
    case 1:
      return Polygon(convex(size, centre, draws));
    case 2:
      return Polygon(box(size, angle, centre, draws));
    case 3:
      return Polygon(blob(size, centre, draws));
    default:
      return Polygon(strip(size, angle, centre, draws));
  }
}

Polygon random_small_shape(int width, int height, Draws& draws) {
  const Point centre{draws.uniform(0.05, 0.95) * width, draws.uniform(0.05, 0.95) * height};
  const double size = draws.uniform(8, 17);
  const double angle = draws.uniform(0, kTurn);
  return Polygon(draws.coin() ? ellipse(size, angle, centre, draws)
                              : box(size, angle, centre, draws));
}

Polygon random_wall(int width, int height, Draws& draws) {
  constexpr double kOutside = 50;
  const bool upright = draws.coin();
  const double extent = upright ? width : height;
  const double from = draws.uniform(0.1, 0.9) * extent;
  const double to = from + draws.uniform(0.1, 0.9) * extent;
  const double low = -kOutside;
  const double high = (upright ? height : width) + kOutside;
  if (upright) {
    return Polygon({{from, low}, {to, low}, {to, high}, {from, high}});
  }
  return Polygon({{low, from}, {high, from}, {high, to}, {low, to}});
}

}  // namespace thermedge::bench
