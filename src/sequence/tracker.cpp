#include "thermedge/sequence/tracker.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "thermedge/memory.hpp"
#include "tracker_state.hpp"
#include "try.hpp"

namespace thermedge {
namespace {

constexpr double kSecond = 1e9;  // ns

}  // namespace

using detail::dot;

Status TrackerOptions::check() const { return check_ranges(*this, "tracker."); }

void Tracks::clear() {
  track.clear();
  last.clear();
  smooth_x.clear();
  smooth_y.clear();
  edges.clear();
  runs.clear();
  born.clear();
  ended.clear();
}

Result<Tracker> Tracker::create(const TrackerOptions& options, const TrackerTuning& tuning) {
  THERMEDGE_TRY(options.check());
  return Tracker(std::make_unique<Impl>(options, tuning));
}

Tracker::Tracker(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;
Tracker::~Tracker() = default;

std::size_t Tracker::memory_bytes() const {
  const Impl& self = *impl_;
  return detail::memory_of(self.tracks, self.samples, self.next_samples, self.edgel_field,
                           self.sample_field, self.votes, self.voter, self.last_edgel, self.labels,
                           self.is_break, self.breaks, self.turns, self.chain_labels, self.sums,
                           self.own_shifts, self.is_certain, self.place);
}

void Tracker::restart(Tracks& tracks) { impl_->end_all(tracks); }

void Tracker::pass_over(std::optional<std::int64_t> stamp_ns, Tracks& tracks) {
  tracks.clear();
  impl_->last_stamp_ns = stamp_ns;
}

void Tracker::update(const Detection& detection, const Motion& motion, Tracks& tracks) {
  Impl& self = *impl_;
  self.start_frame(detection, tracks);
  self.predict(motion);
  self.find_own_shifts();
  self.move_tracks();
  self.vote();
  self.label_edges();
  self.merge_tracks();
  self.take_samples();
  self.keep_coasting();
  self.confirm_and_end(tracks);
  self.fill(tracks);
}

void Tracker::Impl::start_frame(const Detection& detection, Tracks& out) {
  out.clear();
  if (detection.width != width || detection.height != height) {
    end_all(out);
    width = detection.width;
    height = detection.height;
  }
  // Stamps that stand still or go back tell no time.
  const std::int64_t step =
      detection.stamp_ns && last_stamp_ns ? *detection.stamp_ns - *last_stamp_ns : 0;
  frame_ns = step > 0 ? step : static_cast<std::int64_t>(kSecond / options.rate_hz);
  last_stamp_ns = detection.stamp_ns;
  now_ns += frame_ns;
  ++updates;
  edges = &detection.edges;
  const Edgels& edgels = edges->edgels;
  edgel_field.start(width, height);
  for (const Edge& edge : edges->kept_edges()) {
    for (std::uint32_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
      edgel_field.paint(static_cast<std::int32_t>(i), edgels.x[i], edgels.y[i], edgels.nx[i],
                        edgels.ny[i]);
    }
  }
  votes.assign(edgels.size(), {});
  voter.assign(edgels.size(), -1);
  last_edgel.assign(edgels.size(), -1);
  labels.assign(edgels.size(), -1);
}

// Edgels with a label become the samples of their tracks.
void Tracker::Impl::take_samples() {
  const Edgels& edgels = edges->edgels;
  next_samples.clear();
  for (Track& track : tracks) {
    track.edgels = 0;
  }
  for (const Edge& edge : edges->kept_edges()) {
    for (std::uint32_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
      if (labels[i] < 0) {
        continue;
      }
      ++track_of(labels[i]).edgels;
      const auto edgel = static_cast<std::int32_t>(i);
      const float sigma = position_sigma(edgel);
      Sample sample{edgels.x[i],  edgels.y[i],   edgels.nx[i],
                    edgels.ny[i], sigma * sigma, edgels.magnitude_counts[i],
                    labels[i],    edgel,         now_ns};
      if (voter[i] >= 0 && samples[static_cast<std::size_t>(voter[i])].track == labels[i]) {
        const Sample& predicted = samples[static_cast<std::size_t>(voter[i])];
        last_edgel[i] = predicted.edgel;
        const float gain = std::max(predicted.variance / (predicted.variance + sigma * sigma),
                                    static_cast<float>(tuning.least_gain));
        const float back =
            (1 - gain) * dot(predicted.x - sample.x, predicted.y - sample.y, sample.nx, sample.ny);
        sample.x += back * sample.nx;
        sample.y += back * sample.ny;
        sample.variance = gain * sigma * sigma;
        constexpr float kNewGradient = 0.2F;
        sample.gradient =
            predicted.gradient + kNewGradient * (sample.gradient - predicted.gradient);
      }
      next_samples.push_back(sample);
    }
  }
}

std::int64_t Tracker::Impl::coast_ns(const Track& track) const {
  const bool is_old =
      track.id >= 0 && static_cast<double>(now_ns - track.born_ns) > options.coast_long_s * kSecond;
  const auto time =
      static_cast<std::int64_t>(kSecond * (is_old ? options.coast_long_s : options.coast_s));
  return std::max(time, 2 * frame_ns);
}

// Samples that were not found go on for a while, where no labelled edgel has taken their place.
void Tracker::Impl::keep_coasting() {
  constexpr float kCoveredPx = 2;
  for (Sample sample : samples) {
    const std::int32_t edgel = find_edgel(sample, std::max(gate_of(sample), kCoveredPx));
    if (edgel >= 0 && labels[static_cast<std::size_t>(edgel)] >= 0) {
      continue;
    }
    if (now_ns - sample.seen_ns <= coast_ns(track_of(sample.track))) {
      sample.edgel = -1;
      next_samples.push_back(sample);
    }
  }
  samples.swap(next_samples);
  for (Track& track : tracks) {
    track.samples = 0;
  }
  for (const Sample& sample : samples) {
    ++track_of(sample.track).samples;
  }
}

// Gives identities, and takes tracks without samples from the list.
void Tracker::Impl::confirm_and_end(Tracks& out) {
  constexpr std::uint32_t kLastFour = 0b1111;
  for (Track& track : tracks) {
    track.recent_hits = (track.recent_hits << 1U | (track.edgels > 0 ? 1U : 0U)) & kLastFour;
  }
  is_certain.assign(tracks.size(), 0);
  for (const Edge& edge : edges->kept_edges()) {
    if (edge.z > options.confirm_z) {
      for (std::uint32_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
        if (labels[i] >= 0) {
          is_certain[static_cast<std::size_t>(labels[i])] = 1;
        }
      }
    }
  }
  place.assign(tracks.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    Track& track = tracks[i];
    const int hits = std::popcount(track.recent_hits);
    if (track.id < 0 && track.edgels > 0 && (hits >= options.confirm_hits || is_certain[i] != 0)) {
      track.id = next_id++;
      out.born.push_back(track.id);
    }
    if (track.samples == 0) {
      if (track.id >= 0) {
        const std::int32_t into = track.merged_into;
        out.ended.push_back({track.id,
                             into >= 0    ? TrackEnd::kMerged
                             : track.left ? TrackEnd::kLeft
                                          : TrackEnd::kLost,
                             into >= 0 ? tracks[static_cast<std::size_t>(into)].id : -1});
      }
      continue;
    }
    place[i] = static_cast<std::int32_t>(kept++);
  }
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (place[i] >= 0) {
      Track moved = tracks[i];
      moved.neighbour =
          moved.neighbour >= 0 ? place[static_cast<std::size_t>(moved.neighbour)] : -1;
      tracks[static_cast<std::size_t>(place[i])] = moved;
    }
  }
  tracks.resize(kept);
  for (Sample& sample : samples) {
    sample.track = place[static_cast<std::size_t>(sample.track)];
  }
  for (std::int32_t& label : labels) {
    label = label >= 0 ? place[static_cast<std::size_t>(label)] : -1;
  }
}

void Tracker::Impl::fill(Tracks& out) const {
  const Edgels& edgels = edges->edgels;
  out.track.assign(edgels.size(), -1);
  out.last.assign(last_edgel.begin(), last_edgel.end());
  out.smooth_x = edgels.x;
  out.smooth_y = edgels.y;
  for (const Sample& sample : samples) {
    if (sample.edgel >= 0) {
      out.smooth_x[static_cast<std::size_t>(sample.edgel)] = sample.x;
      out.smooth_y[static_cast<std::size_t>(sample.edgel)] = sample.y;
    }
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    out.track[i] = labels[i] >= 0 ? tracks[static_cast<std::size_t>(labels[i])].id : -1;
  }
  for (const Edge& edge : edges->kept_edges()) {
    TrackedEdge tracked;
    tracked.runs.first = static_cast<std::uint32_t>(out.runs.size());
    std::uint32_t longest = 0;
    const std::uint32_t end = edge.edgels.first + edge.edgels.count;
    for (std::uint32_t i = edge.edgels.first; i < end;) {
      std::uint32_t to = i + 1;
      while (to < end && out.track[to] == out.track[i]) {
        ++to;
      }
      if (out.track[i] >= 0) {
        out.runs.push_back({{i, to - i}, out.track[i]});
        if (to - i > longest) {
          longest = to - i;
          tracked.track = out.track[i];
          tracked.age = updates - tracks[static_cast<std::size_t>(labels[i])].born_index;
        }
      }
      i = to;
    }
    tracked.runs.count = static_cast<std::uint32_t>(out.runs.size()) - tracked.runs.first;
    out.edges.push_back(tracked);
  }
}

void Tracker::Impl::end_all(Tracks& out) {
  for (const Track& track : tracks) {
    if (track.id >= 0) {
      out.ended.push_back({track.id, TrackEnd::kLost, -1});
    }
  }
  tracks.clear();
  samples.clear();
}

}  // namespace thermedge
