// Edges with identities over a sequence, against the truth of a simulated one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "thermedge/eval/curves.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"

namespace thermedge::eval {

// The points [from, to) of an edge carry the identity `id`. Points in no run carry none.
struct TrackRun {
  std::size_t from = 0, to = 0;
  std::int64_t id = 0;
};

struct TrackedCurve {
  Curve curve;
  std::vector<TrackRun> tracks;              // rising, none overlaps another
  std::vector<std::optional<Point>> smooth;  // of each point, px; empty: of none
};

// One frame of a tracker's output.
struct TrackedFrame {
  std::int64_t frame = 0;                // its number
  std::optional<std::int64_t> stamp_ns;  // nothing where it is not known
  bool valid = true;                     // false: no measurement; its edges count for nothing
  double sigma_counts = std::numeric_limits<double>::quiet_NaN();  // noise; NaN: not known
  std::vector<std::string> events;
  std::vector<TrackedCurve> edges;
};

// Camera of a true frame: where it looks, and how its lens maps rays to pixels.
struct CameraView {
  std::array<double, 4> orientation_xyzw{0, 0, 0, 1};  // turns camera axes into those of the world
  double fx_px = 1, fy_px = 1, cx_px = 0, cy_px = 0;
  double k1 = 0, k2 = 0;  // Brown's radial distortion
};

// One frame of the simulator's truth. Edges are those of the frame's own time.
struct TrackTruth {
  std::int64_t frame = 0;
  std::int64_t stamp_ns = 0;
  bool frozen = false;  // the picture is that of an earlier frame: edges count for nothing
  std::vector<std::string> events;
  std::optional<CameraView> camera;
  CurveFrame edges;
};

// A frame from one JSON object, as `thermedge track` and `thermedge simulate` write it
// (docs/evaluation.md and docs/scenes.md); keys that are not named above are passed over. `name` is
// for messages. Errors name the key. Thread-safe.
[[nodiscard]] Result<TrackedFrame> parse_tracked_frame(std::string_view json,
                                                       const std::string& name);
[[nodiscard]] Result<TrackTruth> parse_track_truth(std::string_view json, const std::string& name);

struct TracksOptions {
  double reach_px = 2;                // of a found place from a true edge, 0.1..20
  double most_angle_deg = 45;         // between their directions, 1..90 (90: any)
  double least_contrast_counts = 40;  // true edges of less count for nothing; at least 2 sigma, too
  double sigma_counts = 0;            // noise; 0: as the tracks say, if they do
  int least_frames = 30;  // true edges that show in fewer frames count for nothing, 1..1e6
  double absence_s = 1;   // a true edge that was out of view for longer is another one; 0: never
  double repeat_reach_px = 1;  // of places that are found again in the next frame, 0.1..20
  int event_slack = 1;         // frames between a true event and the one found, 0..100; of
                               // near_frozen one more
  std::function<void(std::size_t, std::size_t)> progress;  // frames done, of all; may be empty
};

// Which true edge carries which identity. Lengths are in px, summed over frames.
struct IdentityFigures {
  double true_px = 0;            // of the true edges
  double found_px = 0;           // of it, within reach of a found edge
  double labelled_px = 0;        // of that, the nearest found place has an identity
  double main_px = 0;            // of that, it is the identity that holds most of the true edge
  std::size_t edges = 0;         // true edges of which something was found with an identity
  std::size_t edge_ids = 0;      // identities on each true edge, largest first, that hold 95 % of
                                 // what is labelled there; summed over the true edges
  std::size_t all_edge_ids = 0;  // the same with all identities, however short
  std::size_t ids = 0;           // identities whose main true edge counts
  double id_px = 0;              // found length of these
  double pure_px = 0;            // of it, within reach of the identity's main true edge
  double false_px = 0;           // found length of identities that are never at a true edge

  [[nodiscard]] double kept() const { return main_px / found_px; }  // NaN: nothing was found
  [[nodiscard]] double purity() const { return pure_px / id_px; }
  [[nodiscard]] double harmonic_mean() const;
  [[nodiscard]] double ids_per_edge() const;
};

// Identities after frames that are no measurement (invalid or frozen). Lengths are of true edges,
// in the third to seventh frame after such a gap, summed over gaps and edges that had an identity
// before it.
struct GapFigures {
  std::size_t gaps = 0;
  double found_px = 0;
  double same_px = 0;  // the identity that held most of the edge in the five frames before the gap

  [[nodiscard]] double share() const { return same_px / found_px; }  // NaN without a gap
};

// HOTA (Luiten et al. 2020) with the samples of curves, 1 px apart, as detections.
struct Hota {
  double hota = 0;
  double det_a = 0, det_re = 0, det_pr = 0;
  double ass_a = 0, ass_re = 0, ass_pr = 0;
  double loc_a = 0;  // NaN where nothing is matched
};
struct HotaFigures {
  Hota at_reach;               // pairs up to reach_px apart
  Hota mean;                   // over the 19 similarities 0.05, 0.10 ... 0.95; a pair d px apart
                               // has the similarity 1 - d / reach_px
  std::vector<Hota> by_alpha;  // at each of these
};

// Positions across the true edge, of points that have a smoothed position as well.
struct SmoothFigures {
  std::int64_t points = 0;
  double measured_rms_px = 0;  // NaN without points
  double smooth_rms_px = 0;
  // From frame to frame: the difference of the two distances from the moved true edge, over the
  // root of 2. What is off in the same way in both frames is not in it. NaN without such points.
  std::int64_t repeated_points = 0;
  double measured_jitter_px = 0;
  double smooth_jitter_px = 0;
  std::int64_t moving_points = 0;  // of true edges that move at constant speed
  double measured_lag_px = 0;      // behind the true edge, along its motion; NaN without points
  double smooth_lag_px = 0;
};

// Events of one kind. An event is a run of neighbouring frames that name the kind.
struct EventFigures {
  std::string kind;
  std::size_t truth = 0;
  std::size_t truth_found = 0;  // one that was found begins within the slack of its beginning
  std::size_t found = 0;
  std::size_t found_true = 0;  // that a true one overlaps, within the slack
};

struct TracksEvaluation {
  std::size_t frames = 0;
  std::size_t invalid_frames = 0;  // by the tracks
  std::size_t frozen_frames = 0;   // by the truth
  IdentityFigures identities;
  GapFigures gaps;
  HotaFigures hota;
  Repeatability repeatability;  // of samples that are found again in the next frame, moved with
                                // their true edge
  SmoothFigures smooth;
  std::vector<EventFigures> events;  // kinds that the simulator has, in the order of their names
  std::vector<std::string> other_events;  // kinds found that it hasn't; they are not judged
};

// Tracks against truth; docs/evaluation.md tells what each figure is. The frames are tasks of
// `runner`; the figures are the same for every ParallelRunner. Frames are matched by their stamps,
// else by their numbers, else, where there are equally many, by their order.
// Errors: an option out of range; frames without truth; no true edge that counts. `name` and
// `truth_name` are for messages.
[[nodiscard]] Result<TracksEvaluation> evaluate_tracks(const std::vector<TrackedFrame>& found,
                                                       const std::string& name,
                                                       const std::vector<TrackTruth>& truth,
                                                       const std::string& truth_name,
                                                       const TracksOptions& options,
                                                       ParallelRunner& runner);

// The same for two files of JSON lines. Errors name file and line.
[[nodiscard]] Result<TracksEvaluation> evaluate_tracks(const std::string& found_path,
                                                       const std::string& truth_path,
                                                       const TracksOptions& options,
                                                       ParallelRunner& runner);

// What tracks say without truth. Lengths are in px, of found edges in valid frames.
struct TracksSummary {
  std::size_t frames = 0;
  std::size_t invalid_frames = 0;
  double found_px = 0;
  double labelled_px = 0;  // of it, with an identity
  double aged_px = 0;      // of that, of identities that were seen 5 frames before or earlier
  std::size_t ids = 0;
  double median_life_frames = 0;  // from the first to the last frame of an identity
  std::vector<std::pair<std::string, std::size_t>> events;  // frames that name each kind
};
[[nodiscard]] TracksSummary summarise_tracks(const std::vector<TrackedFrame>& frames);
// The same for a file of JSON lines. Errors name file and line.
[[nodiscard]] Result<TracksSummary> summarise_tracks(const std::string& path);

// Everything as one JSON object on one line, rounded to 9 digits. What there was nothing to measure
// on is null.
[[nodiscard]] std::string evaluation_to_json(const TracksEvaluation& evaluation,
                                             const std::string& found, const std::string& truth);
[[nodiscard]] std::string summary_to_json(const TracksSummary& summary, const std::string& found);

}  // namespace thermedge::eval
