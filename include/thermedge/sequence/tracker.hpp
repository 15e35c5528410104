// The same physical edge under the same identity for as long as it is seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "thermedge/detection.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/sequence/motion.hpp"

namespace thermedge {

struct TrackerOptions {
  double shortest_px = 8;  // shorter pieces get no identity
  // A piece gets its identity when it was found in so many of the last four frames; one that is
  // more certain than this z at once.
  int confirm_hits = 3;
  double confirm_z = 20;
  // How long the identity of what is not found any more is kept, seconds: of a new edge, and of one
  // that had been followed for longer than the second time.
  double coast_s = 0.15;
  double coast_long_s = 1;
  double rate_hz = 80;  // frames a second, where their stamps do not tell

  // Fails with one line that names the option: out of its range.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<TrackerOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("shortest_px", o.shortest_px, Bounds{2, 1000}, "shorter pieces of edges get no identity, px");
  v("confirm_hits", o.confirm_hits, Bounds{1, 4},
    "number of the last four frames that a piece is found in before it gets its identity");
  v("confirm_z", o.confirm_z, Bounds{0, 1e9}, "edges with a larger z get their identities at once");
  v("coast_s", o.coast_s, Bounds{0, 1000}, "how long an edge that is not found is followed, s");
  v("coast_long_s", o.coast_long_s, Bounds{0, 1000},
    "the same for an edge that was followed for longer than this, s");
  v("rate_hz", o.rate_hz, Bounds{0.1, 100000}, "frames a second where stamps do not tell");
}

// Measured on simulated scenes (docs/sequences.md) unless a line says otherwise.
struct TrackerTuning {
  double least_gate_px = 1.5;  // an edgel is looked for within 3 standard deviations, along the
  double most_gate_px = 4;     // normal of its prediction, but within these bounds
  double least_normal_cosine = 0.8;      // of the angle between the two normals: 37 degrees
  double most_contrast_ratio = 2.5;      // between the two gradients, either way
  double motion_noise_px = 0.05;         // by which predictions are less certain with each frame
  double least_position_sigma_px = 0.1;  // of an edgel: what its own figure does not know
  double least_gain = 0.3;               // of the filter along the normal
  // Costs of the labels along a chain, in units of a sure vote: to change the label, at a break
  // (corner) and elsewhere; and of a label that no vote speaks for, per edgel.
  double change_cost = 6;
  double change_cost_at_break = 1;
  double unvoted_cost = 0.1;
  // A chain breaks at its corners, and where its directions over arms of this length enclose more
  // than an angle with this cosine.
  int turn_arm_px = 6;
  double turn_cosine = 0.8;
  int shortest_run_px = 5;  // shorter runs take their neighbour's label
  int shift_samples = 20;   // a track's own shift is measured from so many samples on
  double shift_gain = 0.5;  // of a measured shift, for the next prediction
  int merge_frames = 5;     // one smooth chain under two identities for so long is one edge
};

// Why an identity ended.
enum class TrackEnd : std::uint8_t { kLost, kLeft, kMerged };

// A run of edgels of one identity: [first, first + count) in EdgeSet::edgels.
struct TrackRun {
  Range edgels;
  std::int64_t track = -1;
};

struct TrackedEdge {
  std::int64_t track = -1;  // the identity with most length on it; -1: none yet
  std::int64_t age = 0;     // frames since that identity was first seen; 0 in its first frame
  Range runs;               // in Tracks::runs
};

struct EndedTrack {
  std::int64_t track = -1;
  TrackEnd why = TrackEnd::kLost;
  std::int64_t merged_into = -1;  // the identity that goes on, where it was merged
};

// What is known about the edges of one frame over time. The arrays over edgels have the length of
// EdgeSet::edgels of the frame's Detection.
struct Tracks {
  std::vector<std::int64_t> track;  // identity of each edgel; -1: none
  std::vector<std::int32_t> last;   // the same place in the last frame's edgels; -1: not found
  std::vector<float> smooth_x, smooth_y;  // position filtered over time along the normal, px
  std::vector<TrackedEdge> edges;         // of each kept edge
  std::vector<TrackRun> runs;             // edge by edge
  std::vector<std::int64_t> born;         // identities given for the first time
  std::vector<EndedTrack> ended;

  void clear();
};

// Follows edges over frames. Identity lives on edgels: an edge that the detector cuts or joins with
// another keeps the identities of its parts. Each track is a set of samples, one an edgel, that are
// moved by the picture's motion and the track's own; edgels and samples vote for each other where
// they are nearest and look alike, and along each edge the labels are chosen that cost least
// (Viterbi). Identities are never reused. Nothing is random, one thread, the same result
// everywhere. One object per thread.
class Tracker {
 public:
  [[nodiscard]] static Result<Tracker> create(const TrackerOptions& options = {},
                                              const TrackerTuning& tuning = {});
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;
  ~Tracker();

  // The kept edges of the next frame. `motion`: since the frame of the last call. Time is that of
  // Detection::stamp_ns; where stamps are missing or do not rise, that of TrackerOptions::rate_hz.
  // A frame of another size ends all tracks.
  void update(const Detection& detection, const Motion& motion, Tracks& tracks);

  // A frame that tells nothing of the scene: nothing ages, and its time does not count.
  void pass_over(std::optional<std::int64_t> stamp_ns, Tracks& tracks);
  // Ends all tracks; identities go on counting. Adds to what `tracks` says of the frame.
  void restart(Tracks& tracks);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  explicit Tracker(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
