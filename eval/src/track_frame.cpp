#include "track_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace thermedge::eval {
namespace {

constexpr double kAlongPx = 1;  // farthest that paired samples are apart along the true edge

using Sample = MeasuredCurve::Sample;

// The track of each point of an edge.
std::vector<std::int32_t> labels_of(const TrackedCurve& edge, const TrackIndex& tracks) {
  std::vector<std::int32_t> labels(edge.curve.points.size(), kNoTrack);
  for (const TrackRun& run : edge.tracks) {
    std::fill(labels.begin() + static_cast<std::ptrdiff_t>(run.from),
              labels.begin() + static_cast<std::ptrdiff_t>(run.to), tracks.track(run.id));
  }
  return labels;
}

class Comparison {
 public:
  Comparison(std::size_t index, const FramePair& frame, const TrackIndex& tracks,
             const TracksOptions& options)
      : index_(index),
        tracks_(tracks),
        options_(options),
        least_cosine_(least_cosine(options)),
        found_curves_(curves_of(*frame.found)),
        true_curves_(frame.truth->edges.curves),
        found_(found_curves_, options.reach_px),
        truth_(true_curves_, options.reach_px) {
    for (const TrackedCurve& edge : frame.found->edges) {
      labels_.push_back(labels_of(edge, tracks));
    }
  }

  FrameFigures run() {
    for (std::size_t curve = 0; curve < true_curves_.size(); ++curve) {
      look_at_true(curve);
    }
    for (std::size_t curve = 0; curve < found_curves_.size(); ++curve) {
      for (const Sample& sample : found_.measured()[curve].samples()) {
        look_at_found(curve, sample);
      }
    }
    auto& pairs = figures_.samples.pairs;
    std::sort(pairs.begin(), pairs.end(), [](const SamplePair& a, const SamplePair& b) {
      return std::pair(a.truth, a.found) < std::pair(b.truth, b.found);
    });
    return std::move(figures_);
  }

 private:
  // What was found at the samples of a true curve.
  void look_at_true(std::size_t curve) {
    first_sample_.push_back(static_cast<std::int32_t>(figures_.samples.true_visits.size()));
    true_samples_.push_back(truth_.measured()[curve].samples());
    if (!tracks_.counts(index_, curve)) {
      return;
    }
    const std::int32_t visit = tracks_.visit(index_, curve);
    for (const Sample& sample : true_samples_.back()) {
      figures_.samples.true_visits.push_back(visit);
      ++figures_.true_px[visit];
      const Point direction = truth_.measured()[curve].direction(sample.arc_px);
      const auto near = found_.near(sample.place, direction, least_cosine_);
      if (const auto* place = nearest_of(near, [](const auto&) { return true; })) {
        ++figures_.labels[{visit, label_at(*place)}];
      }
    }
  }

  [[nodiscard]] std::int32_t label_at(const NearestOnCurves::PartPlace& place) const {
    const auto& labels = labels_[place.curve];
    return labels[(place.part + (place.share > 0.5 ? 1 : 0)) % labels.size()];
  }

  // Which true edges a found sample with an identity is at.
  void look_at_found(std::size_t curve, const Sample& sample) {
    const std::int32_t track = labels_[curve][sample.point];
    if (track == kNoTrack) {
      return;
    }
    ++figures_.track_px[track];
    const Point direction = found_.measured()[curve].direction(sample.arc_px);
    const auto near = truth_.near(sample.place, direction, least_cosine_);
    std::set<std::int32_t> edges;
    bool counts = near.empty();
    for (const auto& place : near) {
      counts = counts || tracks_.counts(index_, place.curve);
      edges.insert(
          tracks_.visits()[static_cast<std::size_t>(tracks_.visit(index_, place.curve))].edge);
    }
    for (const std::int32_t edge : edges) {
      ++figures_.places[{track, edge}];
    }
    if (counts) {
      figures_.samples.tracks.push_back(track);
      for (const auto& place : near) {
        if (tracks_.counts(index_, place.curve)) {
          pair_with(place);
        }
      }
    }
  }

  // The last found sample with the true samples around a place.
  void pair_with(const NearestOnCurves::PartPlace& place) {
    const MeasuredCurve& measured = truth_.measured()[place.curve];
    const double arc = truth_.arc_px(place);
    const auto& samples = true_samples_[place.curve];
    const double similarity = 1 - place.place.distance_px / options_.reach_px;
    if (similarity <= 0) {
      return;
    }
    const auto count = static_cast<std::int64_t>(samples.size());
    const double step = measured.length_px() / static_cast<double>(count);
    const auto middle = static_cast<std::int64_t>(step > 0 ? std::floor(arc / step) : 0);
    for (std::int64_t i = std::max(middle - 2, std::int64_t{0});
         i <= std::min(middle + 2, count - 1); ++i) {
      const double along = std::abs(samples[static_cast<std::size_t>(i)].arc_px - arc);
      if (along <= kAlongPx) {
        figures_.samples.pairs.push_back(
            {first_sample_[place.curve] + static_cast<std::int32_t>(i),
             static_cast<std::int32_t>(figures_.samples.tracks.size()) - 1,
             static_cast<float>(similarity), static_cast<float>(along)});
      }
    }
  }

  std::size_t index_;
  const TrackIndex& tracks_;
  const TracksOptions& options_;
  double least_cosine_;
  std::vector<Curve> found_curves_;
  const std::vector<Curve>& true_curves_;
  PlacedCurves found_, truth_;
  std::vector<std::vector<std::int32_t>> labels_;  // of each found curve
  std::vector<std::vector<Sample>> true_samples_;  // of each true curve
  std::vector<std::int32_t> first_sample_;         // of each true curve, among those that count
  FrameFigures figures_;
};

}  // namespace

PlacedCurves::PlacedCurves(const std::vector<Curve>& curves, double reach_px)
    : grid_(curves, reach_px), measured_(curves.begin(), curves.end()) {}

std::vector<NearestOnCurves::PartPlace> PlacedCurves::near(Point point, Point direction,
                                                           double least_cosine) const {
  std::map<std::size_t, PartPlace> best;  // by curve
  grid_.visit_near(point, [&](const PartPlace& place) {
    if (!directions_agree(measured_[place.curve].part_direction(place.part), direction,
                          least_cosine)) {
      return;
    }
    const auto [entry, is_new] = best.try_emplace(place.curve, place);
    const PartPlace& known = entry->second;
    if (!is_new && std::pair(place.place.distance_px, place.part) <
                       std::pair(known.place.distance_px, known.part)) {
      entry->second = place;
    }
  });
  std::vector<PartPlace> places;
  places.reserve(best.size());
  for (const auto& [curve, place] : best) {
    places.push_back(place);
  }
  return places;
}

std::vector<Curve> curves_of(const TrackedFrame& frame) {
  std::vector<Curve> curves;
  curves.reserve(frame.edges.size());
  for (const TrackedCurve& edge : frame.edges) {
    curves.push_back(edge.curve);
  }
  return curves;
}

double least_cosine(const TracksOptions& options) {
  return options.most_angle_deg < 90 ? std::cos(options.most_angle_deg * std::numbers::pi / 180)
                                     : 0;
}

FrameFigures compare_frame(std::size_t index, const FramePair& frame, const TrackIndex& tracks,
                           const TracksOptions& options) {
  return Comparison(index, frame, tracks, options).run();
}

}  // namespace thermedge::eval
