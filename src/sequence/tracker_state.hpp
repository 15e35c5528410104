// The state of a tracker, shared by the files that its steps are in. Private.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "chain_labels.hpp"
#include "nearest_field.hpp"
#include "thermedge/sequence/tracker.hpp"

namespace thermedge {
namespace detail {

// A place on a track: where it was seen last, moved along since.
struct Sample {
  float x = 0, y = 0;        // px, filtered along the normal
  float nx = 0, ny = 0;      // unit normal, towards the warmer side
  float variance = 0;        // of the position along the normal, px^2
  float gradient = 0;        // counts per px
  std::int32_t track = -1;   // in Impl::tracks
  std::int32_t edgel = -1;   // in the last frame; -1: it was not found there
  std::int64_t seen_ns = 0;  // when it was found last
};

struct Track {
  std::int64_t id = -1;  // -1: not yet confirmed
  std::int64_t born_ns = 0;
  std::int64_t born_index = 0;     // number of updates before it
  std::uint32_t recent_hits = 0;   // bit 0: in this frame
  std::int32_t samples = 0;        // how many it has
  std::int32_t edgels = 0;         // in this frame
  float shift_x = 0, shift_y = 0;  // of its own, on top of the motion, px a frame
  bool left = false;               // its last samples left the picture
  std::int32_t neighbour = -1;     // older track that it goes on from without a break
  std::int32_t neighbour_frames = 0;
  std::int32_t merged_into = -1;
};

// Of the normal equations of a shift.
struct NormalSums {
  double xx = 0, xy = 0, yy = 0, x = 0, y = 0;
  int count = 0;
};

inline float dot(float ax, float ay, float bx, float by) { return ax * bx + ay * by; }

}  // namespace detail

struct Tracker::Impl {
  using Sample = detail::Sample;
  using Track = detail::Track;
  using NormalSums = detail::NormalSums;

  Impl(const TrackerOptions& chosen, const TrackerTuning& tuned) : options(chosen), tuning(tuned) {}

  void start_frame(const Detection& detection, Tracks& out);
  void predict(const Motion& motion);
  void move_tracks();
  void find_own_shifts();
  void vote();
  void label_edges();
  void label_edge(const Edge& edge);
  void find_breaks(const Edge& edge);
  void mark_breaks(const Edge& edge);
  void smooth_runs(std::span<std::int32_t> labels) const;
  void give_birth(std::span<std::int32_t> labels);
  std::int32_t new_track();
  void note_neighbours(std::span<const std::int32_t> labels);
  void merge_tracks();
  void take_samples();
  void keep_coasting();
  void confirm_and_end(Tracks& out);
  void fill(Tracks& out) const;
  void end_all(Tracks& out);

  [[nodiscard]] bool agree(const Sample& sample, std::int32_t edgel, float gate) const;
  [[nodiscard]] std::int32_t find_edgel(const Sample& sample, float gate) const;
  [[nodiscard]] std::int32_t find_sample(std::size_t edgel) const;
  [[nodiscard]] float gate_of(const Sample& sample) const;
  [[nodiscard]] float distance_along_normal(const Sample& sample, std::int32_t edgel) const;
  [[nodiscard]] float position_sigma(std::int32_t edgel) const;
  [[nodiscard]] bool is_inside(const Sample& sample) const;
  [[nodiscard]] std::int64_t coast_ns(const Track& track) const;
  Track& track_of(std::int32_t index) { return tracks[static_cast<std::size_t>(index)]; }

  TrackerOptions options;
  TrackerTuning tuning;
  std::vector<Track> tracks;
  std::vector<Sample> samples, next_samples;
  std::int64_t next_id = 0;
  std::int64_t updates = 0;
  std::int64_t now_ns = 0, frame_ns = 0;
  std::optional<std::int64_t> last_stamp_ns;
  int width = 0, height = 0;

  // Of the frame in work.
  const EdgeSet* edges = nullptr;
  detail::NearestField edgel_field, sample_field;
  std::vector<detail::LabelVote> votes;  // of each edgel
  std::vector<std::int32_t> voter;       // the sample that voted for it
  std::vector<std::int32_t> last_edgel;  // of that sample, in the last frame
  std::vector<std::int32_t> labels;      // track of each edgel
  std::vector<std::uint32_t> breaks;     // of the edge in work: ascending indices of its edgels
  std::vector<std::uint8_t> is_break;  // of each of its edgels: whether the label may change there
  std::vector<float> turns;            // of each of its edgels: less the cosine of the turn
  detail::ChainLabels chain_labels;
  std::vector<NormalSums> sums;                  // of each track
  std::vector<std::array<float, 2>> own_shifts;  // of each track, px
  std::vector<std::uint8_t> is_certain;          // of each track: whether its edge is
  std::vector<std::int32_t> place;               // of each track, in the list that stays
};

}  // namespace thermedge
