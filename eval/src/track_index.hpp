// Identities and true edges of a sequence, numbered from 0, and which of them count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "thermedge/eval/tracks.hpp"

namespace thermedge::eval {

// A frame of the tracks and its truth.
struct FramePair {
  const TrackedFrame* found = nullptr;
  const TrackTruth* truth = nullptr;

  // Whether its edges say anything.
  [[nodiscard]] bool counts() const { return found->valid && !truth->frozen; }
};

// By stamps, else by numbers, else by order; see evaluate_tracks.
[[nodiscard]] Result<std::vector<FramePair>> pair_frames(const std::vector<TrackedFrame>& found,
                                                         const std::string& name,
                                                         const std::vector<TrackTruth>& truth,
                                                         const std::string& truth_name);

// A true edge from where it comes into view until it is gone for longer than absence_s.
struct Visit {
  std::int32_t edge = 0;   // number of the true edge
  int frames = 0;          // in which it shows
  double length_px = 0;    // summed over the frames
  double contrast_px = 0;  // contrast times length, likewise
  bool counts = false;
};

class TrackIndex {
 public:
  TrackIndex(const std::vector<FramePair>& frames, const TracksOptions& options);

  [[nodiscard]] const std::vector<Visit>& visits() const { return visits_; }
  // The visit that the `curve`th true curve of a frame belongs to; frames that don't count have
  // none.
  [[nodiscard]] std::int32_t visit(std::size_t frame, std::size_t curve) const {
    return visits_of_[frame][curve];
  }
  [[nodiscard]] bool counts(std::size_t frame, std::size_t curve) const {
    return visits_[static_cast<std::size_t>(visit(frame, curve))].counts;
  }
  [[nodiscard]] std::int32_t track(std::int64_t id) const { return tracks_.at(id); }
  [[nodiscard]] std::size_t tracks() const { return tracks_.size(); }
  // Weaker true edges don't count.
  [[nodiscard]] double least_contrast_counts() const { return least_contrast_counts_; }

 private:
  struct Seen {
    std::int32_t edge = 0, visit = -1;
    std::int64_t last_stamp_ns = 0;
    std::size_t last_frame = 0;  // that counts
  };
  void add_tracks(const TrackedFrame& frame);
  void add_edges(std::size_t index, const FramePair& frame, double absence_s);
  [[nodiscard]] Seen& see(const Curve& curve, std::int64_t stamp_ns, double absence_s);

  std::vector<Visit> visits_;
  std::vector<std::vector<std::int32_t>> visits_of_;
  std::map<std::int64_t, std::int32_t> tracks_;
  std::map<std::int64_t, Seen> seen_;  // true edges by their ids
  double least_contrast_counts_ = 0;
};

}  // namespace thermedge::eval
