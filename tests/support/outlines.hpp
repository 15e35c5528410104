// Closed-form outlines and lines, and the pixels that they run through.
#pragma once

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "thermedge/geometry.hpp"

namespace thermedge::test {

struct Place {
  double x = 0;
  double y = 0;
};

inline double distance(Pixel a, Place b) { return std::hypot(a.x - b.x, a.y - b.y); }

inline Place ahead(Place from, double length, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {from.x + length * std::cos(angle), from.y + length * std::sin(angle)};
}

// A regular polygon with corners `radius` from its centre.
inline std::vector<Place> polygon_points(Place centre, double radius, int corners, double degrees) {
  std::vector<Place> points;
  for (int i = 0; i < corners; ++i) {
    points.push_back(ahead(centre, radius, degrees + 360.0 * i / corners));
  }
  return points;
}

inline std::vector<Place> ellipse_points(Place centre, double a, double b, double degrees) {
  std::vector<Place> points;
  for (int i = 0; i < 720; ++i) {
    const double t = i * std::numbers::pi / 360;
    points.push_back(ahead(ahead(centre, a * std::cos(t), degrees), b * std::sin(t), degrees + 90));
  }
  return points;
}

inline std::vector<Place> rounded_rectangle_points(Place centre, double half_width,
                                                   double half_height, double radius,
                                                   double degrees) {
  std::vector<Place> points;
  for (int i = 0; i < 360; ++i) {
    const int quarter = i / 90;
    const double x = (quarter == 0 || quarter == 3 ? 1 : -1) * (half_width - radius);
    const double y = (quarter < 2 ? 1 : -1) * (half_height - radius);
    const Place middle = ahead(ahead(centre, x, degrees), y, degrees + 90);
    points.push_back(ahead(middle, radius, degrees + i));
  }
  return points;
}

// A circle, of which a quarter is replaced by the two tangents at its ends.
inline std::vector<Place> tear_points(Place centre, double radius) {
  std::vector<Place> points{ahead(centre, radius * std::numbers::sqrt2, 45)};
  for (int i = 90; i <= 360; ++i) {
    points.push_back(ahead(centre, radius, i));
  }
  return points;
}

// Two arms, the second turned against the first.
inline std::vector<Place> bend_points(Place corner, double arm, double degrees, double turn) {
  return {ahead(corner, -arm, degrees), corner, ahead(corner, arm, degrees + turn)};
}

inline std::vector<Place> zigzag_points(Place from, double arm, int arms, double degrees,
                                        double turn) {
  std::vector<Place> points{from};
  for (int i = 0; i < arms; ++i) {
    points.push_back(ahead(points.back(), arm, degrees + (i % 2 == 0 ? 0 : turn)));
  }
  return points;
}

// The 8-connected pixels along straight lines from point to point, without steps around a corner.
inline std::vector<Pixel> line_pixels(const std::vector<Place>& points) {
  constexpr double kStepPx = 0.01;
  std::vector<Pixel> pixels;
  const auto add = [&](Pixel at) {
    if (!pixels.empty() && pixels.back() == at) {
      return;
    }
    if (pixels.size() >= 2) {
      const Pixel before = pixels[pixels.size() - 2];
      if (std::abs(before.x - at.x) <= 1 && std::abs(before.y - at.y) <= 1) {
        pixels.pop_back();
      }
    }
    pixels.push_back(at);
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Place a = points[i];
    const Place b = points[i + 1];
    const int steps = static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / kStepPx) + 1;
    for (int k = 0; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      add({static_cast<int>(std::lround(a.x + share * (b.x - a.x))),
           static_cast<int>(std::lround(a.y + share * (b.y - a.y)))});
    }
  }
  return pixels;
}

// The same, back to the first point.
inline std::vector<Pixel> outline_pixels(std::vector<Place> points) {
  points.push_back(points.front());
  auto pixels = line_pixels(points);
  while (pixels.size() > 1 && pixels.back() == pixels.front()) {
    pixels.pop_back();
  }
  return pixels;
}

}  // namespace thermedge::test
