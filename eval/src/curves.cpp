#include "thermedge/eval/curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "curve_parts.hpp"

namespace thermedge::eval {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
struct Lengths {
  double true_px = 0;
  double found_px = 0;
};

// The length of a true curve, and of its part within reach of the found ones.
Lengths measure(const Curve& curve, const NearestOnCurves& found) {
  Lengths lengths;
  for_each_piece(curve, [&](Point middle, double length_px) {
    lengths.true_px += length_px;
    lengths.found_px += found.is_near(middle) ? length_px : 0;
  });
  return lengths;
}

bool mostly_found(const EdgeShare& edge) {
  return edge.found_px > 0 && edge.found_px >= edge.true_px / 2;
}

template <class F>
void for_each_point(const CurveFrame& frame, F&& visit) {
  for (const Curve& curve : frame.curves) {
    for (const Point point : curve.points) {
      visit(point);
    }
  }
}

bool inside(const CurveFrame& frame, Point point) {
  return point.x >= -0.5 && point.y >= -0.5 && point.x < frame.width - 0.5 &&
         point.y < frame.height - 0.5;
}

Repeatability count_repeated(const CurveFrame& from, const CurveFrame& to,
                             const NearestOnCurves& there,
                             const std::function<Point(Point)>& motion) {
  Repeatability result;
  for_each_point(from, [&](Point point) {
    const Point moved = motion(point);
    if (inside(to, moved)) {
      ++result.points;
      result.repeated += there.is_near(moved) ? 1 : 0;
    }
  });
  return result;
}

}  // namespace

void draw_curves(const CurveFrame& frame, double least_contrast_counts, Image<std::uint8_t>& map) {
  map.resize(frame.width, frame.height);
  fill_pixels(map.view(), std::uint8_t{0});
  const auto pixel_of = [](double position) { return std::floor(position + 0.5); };
  const auto paint = [&](Point point) {
    if (inside(frame, point)) {
      map(static_cast<int>(pixel_of(point.x)), static_cast<int>(pixel_of(point.y))) = 255;
    }
  };
  const auto touch = [&](Point a, Point b) {
    return std::abs(pixel_of(a.x) - pixel_of(b.x)) <= 1 &&
           std::abs(pixel_of(a.y) - pixel_of(b.y)) <= 1;
  };
  for (const Curve& curve : frame.curves) {
    if (curve.contrast_counts < least_contrast_counts) {
      continue;
    }
    std::for_each(curve.points.begin(), curve.points.end(), paint);
    for_each_part(curve, [&](Point from, Point to) {
      if (!touch(from, to)) {
        for_each_piece(from, to, [&](Point middle, double) { paint(middle); });
      }
    });
  }
}

double Localisation::mean_px() const {
  return points > 0 ? offset_sum_px / static_cast<double>(points) : kNan;
}

double Localisation::rms_px() const {
  return points > 0 ? std::sqrt(squared_sum_px2 / static_cast<double>(points)) : kNan;
}

Localisation& Localisation::operator+=(const Localisation& other) {
  points += other.points;
  offset_sum_px += other.offset_sum_px;
  squared_sum_px2 += other.squared_sum_px2;
  return *this;
}

Localisation localise(const CurveFrame& found, const CurveFrame& truth, double reach_px) {
  const NearestOnCurves there(truth.curves, reach_px);
  Localisation result;
  for_each_point(found, [&](Point point) {
    const auto place = there.nearest(point);
    if (place.distance_px <= reach_px && place.beside) {
      ++result.points;
      result.offset_sum_px += place.offset_px;
      result.squared_sum_px2 += place.offset_px * place.offset_px;
    }
  });
  return result;
}

ContrastRecall::ContrastRecall(std::vector<double> bin_limits)
    : limits(std::move(bin_limits)), true_px(limits.size(), 0), found_px(limits.size(), 0) {}

void ContrastRecall::add(const CurveFrame& found, const CurveFrame& truth, double reach_px,
                         double unit_counts) {
  const NearestOnCurves there(found.curves, reach_px);
  for (const Curve& curve : truth.curves) {
    const double contrast = curve.contrast_counts / unit_counts;
    const auto above = std::upper_bound(limits.begin(), limits.end(), contrast);
    if (std::isnan(contrast) || above == limits.begin()) {
      continue;
    }
    const auto bin = static_cast<std::size_t>(above - limits.begin() - 1);
    const Lengths lengths = measure(curve, there);
    true_px[bin] += lengths.true_px;
    found_px[bin] += lengths.found_px;
  }
}

ContrastRecall& ContrastRecall::operator+=(const ContrastRecall& other) {
  for (std::size_t i = 0; i < limits.size(); ++i) {
    true_px[i] += other.true_px[i];
    found_px[i] += other.found_px[i];
  }
  return *this;
}

double Repeatability::share() const {
  return points > 0 ? static_cast<double>(repeated) / static_cast<double>(points) : kNan;
}

Repeatability repeatability(const CurveFrame& from, const CurveFrame& to,
                            const std::function<Point(Point)>& motion, double reach_px) {
  return count_repeated(from, to, NearestOnCurves(to.curves, reach_px), motion);
}

ShiftedRepeatability best_shift(const CurveFrame& from, const CurveFrame& to, int most_px,
                                double reach_px) {
  std::vector<std::pair<int, int>> shifts;  // dy, dx
  for (int dy = -most_px; dy <= most_px; ++dy) {
    for (int dx = -most_px; dx <= most_px; ++dx) {
      shifts.emplace_back(dy, dx);
    }
  }
  std::stable_sort(shifts.begin(), shifts.end(), [](const auto& a, const auto& b) {
    return a.first * a.first + a.second * a.second < b.first * b.first + b.second * b.second;
  });
  const NearestOnCurves there(to.curves, reach_px);
  ShiftedRepeatability best;
  bool any = false;
  for (const auto& [dy, dx] : shifts) {
    const auto shifted = count_repeated(from, to, there, [x = dx, y = dy](Point point) {
      return Point{point.x + x, point.y + y};
    });
    if (!any || shifted.repeated > best.repeatability.repeated) {
      best = {dx, dy, shifted};
      any = true;
    }
  }
  return best;
}

std::vector<EdgeShare> found_by_id(const CurveFrame& found, const CurveFrame& truth,
                                   double reach_px) {
  const NearestOnCurves there(found.curves, reach_px);
  std::map<std::int64_t, EdgeShare> edges;
  for (const Curve& curve : truth.curves) {
    if (curve.id >= 0) {
      const Lengths lengths = measure(curve, there);
      EdgeShare& edge = edges[curve.id];
      edge.id = curve.id;
      edge.true_px += lengths.true_px;
      edge.found_px += lengths.found_px;
    }
  }
  std::vector<EdgeShare> shares;
  shares.reserve(edges.size());
  for (const auto& [id, edge] : edges) {
    shares.push_back(edge);
  }
  return shares;
}

double EdgeRepeatability::share() const { return found_px > 0 ? again_px / found_px : kNan; }

EdgeRepeatability& EdgeRepeatability::operator+=(const EdgeRepeatability& other) {
  found_px += other.found_px;
  again_px += other.again_px;
  return *this;
}

EdgeRepeatability repeatability_by_id(std::span<const EdgeShare> from,
                                      std::span<const EdgeShare> to) {
  EdgeRepeatability result;
  auto next = to.begin();
  for (const EdgeShare& edge : from) {
    next = std::find_if(next, to.end(), [&](const EdgeShare& e) { return e.id >= edge.id; });
    if (next != to.end() && next->id == edge.id && mostly_found(edge)) {
      result.found_px += edge.true_px;
      result.again_px += mostly_found(*next) ? edge.true_px : 0;
    }
  }
  return result;
}

CurveFrame pixels_as_curves(ImageView<const std::uint8_t> map) {
  CurveFrame frame;
  frame.width = map.width();
  frame.height = map.height();
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (map(x, y) != 0) {
        Curve curve;
        curve.points = {{static_cast<double>(x), static_cast<double>(y)}};
        frame.curves.push_back(std::move(curve));
      }
    }
  }
  return frame;
}

}  // namespace thermedge::eval
