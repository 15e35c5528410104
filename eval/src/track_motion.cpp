#include "track_motion.hpp"

#include <algorithm>
#include <cmath>

#include "camera_view.hpp"

namespace thermedge::eval {
namespace {

// How far a true edge may be from where the camera's turn alone would have moved it: things that
// are near move more, and some move by themselves.
constexpr double kParallaxPx = 8;
constexpr double kBorderPx = 4;            // places nearer to the border need not be found again
constexpr int kPast = 3;                   // frames over which a constant speed is told
constexpr double kLeastSpeedPx = 0.5;      // a frame
constexpr double kSteadySpeedPx = 0.1;     // change of the speed from frame to frame
constexpr double kSteadySpeedShare = 0.1;  // or this share of it

// A place on a true edge and which way the edge goes there.
struct EdgePlace {
  Point place;
  Point along;

  // To the right of the walking direction.
  [[nodiscard]] double offset_px(Point point) const {
    return along.x * (point.y - place.y) - along.y * (point.x - place.x);
  }
  [[nodiscard]] Point beside(double offset_px) const {
    return {place.x - along.y * offset_px, place.y + along.x * offset_px};
  }
};

// True edges of one frame, for places of others.
class TrueScene {
 public:
  explicit TrueScene(const TrackTruth& truth, double reach_px)
      : truth_(truth), curves_(truth.edges.curves, reach_px) {}

  [[nodiscard]] const PlacedCurves& curves() const { return curves_; }
  [[nodiscard]] std::int64_t id(std::size_t curve) const { return truth_.edges.curves[curve].id; }

  // Where a place on edge `id` of another scene is in this one, as far as the edge tells: the
  // camera's turn takes the place over, and the nearest place on the edge is taken from there.
  // Nothing where that is at an end of what can be seen.
  [[nodiscard]] std::optional<EdgePlace> place_of(const EdgePlace& other, const TrueScene& scene,
                                                  std::int64_t id, double cosine) const {
    const std::optional<Point> moved =
        truth_.camera && scene.truth_.camera
            ? turned(other.place, *scene.truth_.camera, *truth_.camera)
            : std::optional(other.place);
    if (!moved) {
      return std::nullopt;
    }
    const auto near = curves_.near(*moved, other.along, cosine);
    const auto* best =
        nearest_of(near, [&](const auto& place) { return this->id(place.curve) == id; });
    if (best == nullptr || !best->place.beside) {
      return std::nullopt;
    }
    return EdgePlace{best->foot, direction_at(*best)};
  }

  [[nodiscard]] Point direction_at(const NearestOnCurves::PartPlace& place) const {
    return curves_.measured()[place.curve].part_direction(place.part);
  }

  [[nodiscard]] bool is_inside(Point point) const {
    return point.x >= kBorderPx && point.y >= kBorderPx &&
           point.x <= truth_.edges.width - 1 - kBorderPx &&
           point.y <= truth_.edges.height - 1 - kBorderPx;
  }

 private:
  const TrackTruth& truth_;
  PlacedCurves curves_;
};

// Edges through their smoothed positions.
std::vector<Curve> smooth_curves_of(const TrackedFrame& frame) {
  std::vector<Curve> curves;
  curves.reserve(frame.edges.size());
  for (const TrackedCurve& edge : frame.edges) {
    Curve& curve = curves.emplace_back();
    curve.closed = edge.curve.closed;
    for (const std::optional<Point>& point : edge.smooth) {
      if (point) {
        curve.points.push_back(*point);
      }
    }
  }
  return curves;
}

class Neighbours {
 public:
  Neighbours(std::span<const FramePair> frames, std::size_t index, const TrackIndex& tracks,
             const TracksOptions& options)
      : frame_(frames[index]),
        index_(index),
        tracks_(tracks),
        options_(options),
        cosine_(least_cosine(options)),
        found_curves_(curves_of(*frame_.found)),
        found_(found_curves_, options.reach_px),
        here_(*frame_.truth, std::max(kParallaxPx, options.reach_px)) {
    if (index + 1 < frames.size() && frames[index + 1].counts()) {
      next_curves_ = curves_of(*frames[index + 1].found);
      next_smooth_curves_ = smooth_curves_of(*frames[index + 1].found);
      next_found_.emplace(next_curves_, std::max(options.repeat_reach_px, options.reach_px));
      next_smooth_.emplace(next_smooth_curves_, options.reach_px);
      next_.emplace(*frames[index + 1].truth, kParallaxPx);
    }
    for (std::size_t back = 1; back <= kPast && back <= index && frames[index - back].counts();
         ++back) {
      past_.emplace_back(*frames[index - back].truth, kParallaxPx);
    }
  }

  MotionFigures run() {
    for (std::size_t i = 0; i < found_curves_.size(); ++i) {
      if (next_) {
        for (const auto& sample : found_.measured()[i].samples()) {
          look_ahead(sample.place, found_.measured()[i].direction(sample.arc_px));
        }
      }
      look_at_smooth(i);
    }
    return figures_;
  }

 private:
  struct OnEdge {
    EdgePlace place;
    std::int64_t id;
  };
  // The true edge that counts next to a found place.
  [[nodiscard]] std::optional<OnEdge> true_edge(Point point, Point direction) const {
    const auto near = here_.curves().near(point, direction, cosine_);
    const auto* place = nearest_of(
        near, [&](const auto& candidate) { return tracks_.counts(index_, candidate.curve); });
    if (place == nullptr || !place->place.beside || place->place.distance_px > options_.reach_px) {
      return std::nullopt;
    }
    return OnEdge{{place->foot, here_.direction_at(*place)}, here_.id(place->curve)};
  }

  void look_ahead(Point point, Point direction) {
    const auto edge = true_edge(point, direction);
    const auto there = edge ? next_->place_of(edge->place, here_, edge->id, cosine_) : std::nullopt;
    if (!there) {
      return;
    }
    const Point expected = there->beside(edge->place.offset_px(point));
    if (next_->is_inside(expected)) {
      ++figures_.repeatability.points;
      const auto near = next_found_->near(expected, there->along, cosine_);
      figures_.repeatability.repeated +=
          std::any_of(near.begin(), near.end(),
                      [&](const auto& place) {
                        return place.place.distance_px <= options_.repeat_reach_px;
                      })
              ? 1
              : 0;
    }
  }

  void look_at_smooth(std::size_t curve) {
    const TrackedCurve& edge = frame_.found->edges[curve];
    for (std::size_t i = 0; i < edge.smooth.size(); ++i) {
      if (!edge.smooth[i]) {
        continue;
      }
      const Point point = edge.curve.points[i];
      const auto& measured = found_.measured()[curve];
      const auto at = true_edge(
          point, measured.direction(measured.arc_px(std::min(i, edge.curve.points.size() - 1), 0)));
      if (at) {
        const double measured_px = at->place.offset_px(point);
        const double smooth_px = at->place.offset_px(*edge.smooth[i]);
        add_offsets(*at, measured_px, smooth_px);
        add_changes(*at, measured_px, smooth_px);
      }
    }
  }

  void add_offsets(const OnEdge& edge, double measured_px, double smooth_px) {
    ++figures_.points;
    figures_.measured_square_px2 += measured_px * measured_px;
    figures_.smooth_square_px2 += smooth_px * smooth_px;
    if (const auto speed = steady_speed_px(edge)) {
      const double sign = *speed > 0 ? 1 : -1;
      ++figures_.moving_points;
      figures_.measured_lag_px -= sign * measured_px;
      figures_.smooth_lag_px -= sign * smooth_px;
    }
  }

  // How the offsets are others in the next frame.
  void add_changes(const OnEdge& edge, double measured_px, double smooth_px) {
    const auto there = next_ ? next_->place_of(edge.place, here_, edge.id, cosine_) : std::nullopt;
    if (!there) {
      return;
    }
    const auto offset_in = [&](const PlacedCurves& curves, double expected_px) {
      const auto near = curves.near(there->beside(expected_px), there->along, cosine_);
      const auto* place = nearest_of(near, [](const auto& any) { return any.place.beside; });
      return place != nullptr ? std::optional(there->offset_px(place->foot)) : std::nullopt;
    };
    const auto measured = offset_in(*next_found_, measured_px);
    const auto smooth = offset_in(*next_smooth_, smooth_px);
    if (measured && smooth) {
      ++figures_.repeated_points;
      figures_.measured_change_px2 += (*measured - measured_px) * (*measured - measured_px);
      figures_.smooth_change_px2 += (*smooth - smooth_px) * (*smooth - smooth_px);
    }
  }

  // To the right of the edge's walking direction, px a frame, where it was the same over the last
  // frames.
  [[nodiscard]] std::optional<double> steady_speed_px(const OnEdge& edge) const {
    if (past_.size() < kPast) {
      return std::nullopt;
    }
    std::optional<double> speed;
    EdgePlace place = edge.place;
    const TrueScene* scene = &here_;
    for (const TrueScene& before : past_) {
      const auto there = before.place_of(place, *scene, edge.id, cosine_);
      if (!there) {
        return std::nullopt;
      }
      const double step = -place.offset_px(there->place);
      const double first = speed.value_or(step);
      if (std::abs(step - first) > std::max(kSteadySpeedPx, kSteadySpeedShare * std::abs(first))) {
        return std::nullopt;
      }
      speed = first;
      place = *there;
      scene = &before;
    }
    return std::abs(*speed) >= kLeastSpeedPx ? speed : std::nullopt;
  }

  FramePair frame_;
  std::size_t index_;
  const TrackIndex& tracks_;
  const TracksOptions& options_;
  double cosine_;
  std::vector<Curve> found_curves_, next_curves_, next_smooth_curves_;
  PlacedCurves found_;
  TrueScene here_;
  std::optional<PlacedCurves> next_found_, next_smooth_;
  std::optional<TrueScene> next_;
  std::vector<TrueScene> past_;  // the last frame first
  MotionFigures figures_;
};

}  // namespace

MotionFigures& MotionFigures::operator+=(const MotionFigures& other) {
  repeatability.points += other.repeatability.points;
  repeatability.repeated += other.repeatability.repeated;
  points += other.points;
  measured_square_px2 += other.measured_square_px2;
  smooth_square_px2 += other.smooth_square_px2;
  repeated_points += other.repeated_points;
  measured_change_px2 += other.measured_change_px2;
  smooth_change_px2 += other.smooth_change_px2;
  moving_points += other.moving_points;
  measured_lag_px += other.measured_lag_px;
  smooth_lag_px += other.smooth_lag_px;
  return *this;
}

SmoothFigures MotionFigures::smooth() const {
  const auto all = static_cast<double>(points);
  const auto moving = static_cast<double>(moving_points);
  const auto twice = 2 * static_cast<double>(repeated_points);
  return {points,
          std::sqrt(measured_square_px2 / all),
          std::sqrt(smooth_square_px2 / all),
          repeated_points,
          std::sqrt(measured_change_px2 / twice),
          std::sqrt(smooth_change_px2 / twice),
          moving_points,
          measured_lag_px / moving,
          smooth_lag_px / moving};
}

MotionFigures compare_neighbours(std::span<const FramePair> frames, std::size_t index,
                                 const TrackIndex& tracks, const TracksOptions& options) {
  return Neighbours(frames, index, tracks, options).run();
}

}  // namespace thermedge::eval
