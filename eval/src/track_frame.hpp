// Tracks and truth of one frame, place by place.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "measured_curve.hpp"
#include "track_index.hpp"

namespace thermedge::eval {

inline constexpr std::int32_t kNoTrack = -1;

// Curves of one frame with what is needed to find places on them. The curves must outlive it.
class PlacedCurves {
 public:
  PlacedCurves(const std::vector<Curve>& curves, double reach_px);

  [[nodiscard]] const std::vector<MeasuredCurve>& measured() const { return measured_; }
  // Calls visit for the nearest place on each curve that passes within reach of `point` in
  // directions that agree.
  using PartPlace = NearestOnCurves::PartPlace;
  [[nodiscard]] std::vector<PartPlace> near(Point point, Point direction,
                                            double least_cosine) const;
  [[nodiscard]] double arc_px(const PartPlace& place) const {
    return measured_[place.curve].arc_px(place.part, place.share);
  }

 private:
  NearestOnCurves grid_;
  std::vector<MeasuredCurve> measured_;
};

// The nearest of places as PlacedCurves::near gives them for which `wanted` holds; ties: the first.
template <class F>
[[nodiscard]] const NearestOnCurves::PartPlace* nearest_of(
    const std::vector<NearestOnCurves::PartPlace>& places, F&& wanted) {
  const NearestOnCurves::PartPlace* best = nullptr;
  for (const NearestOnCurves::PartPlace& place : places) {
    if (wanted(place) && (best == nullptr || place.place.distance_px < best->place.distance_px)) {
      best = &place;
    }
  }
  return best;
}

// Samples that lie close to each other, in the order of `truth`.
struct SamplePair {
  std::int32_t truth = 0, found = 0;
  float similarity = 0;  // 1 - distance / reach
  float along_px = 0;    // how far apart along the true edge
};

// The samples of one frame, 1 px apart.
struct FrameSamples {
  std::vector<std::int32_t> true_visits;  // of the true samples that count
  std::vector<std::int32_t> tracks;       // of the found samples with an identity, without those
                                          // that are at true edges that don't count alone
  std::vector<SamplePair> pairs;
};

// What one frame says. Lengths in samples.
struct FrameFigures {
  std::map<std::int32_t, std::int64_t> true_px;                          // by visit
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> labels;  // found true length by
                                                                         // visit and track, or
                                                                         // kNoTrack
  std::map<std::int32_t, std::int64_t> track_px;                         // by track
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> places;  // by track and true edge
                                                                         // within reach
  FrameSamples samples;
};

[[nodiscard]] FrameFigures compare_frame(std::size_t index, const FramePair& frame,
                                         const TrackIndex& tracks, const TracksOptions& options);

// The curves of tracked edges, without their identities.
[[nodiscard]] std::vector<Curve> curves_of(const TrackedFrame& frame);

[[nodiscard]] double least_cosine(const TracksOptions& options);

}  // namespace thermedge::eval
