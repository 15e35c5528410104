#include "thermedge/eval/tracks.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "curve_parts.hpp"
#include "event_figures.hpp"
#include "hota.hpp"
#include "identities.hpp"
#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/eval/files.hpp"
#include "track_motion.hpp"

namespace thermedge::eval {
namespace {

tl::unexpected<Error> wrong(const std::string& what) {
  return failure(ErrorCode::kInvalidArgument, what);
}

Status check(const TracksOptions& options) {
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  if (!within(options.reach_px, 0.1, 20) || !within(options.repeat_reach_px, 0.1, 20)) {
    return wrong("reach_px and repeat_reach_px should be from 0.1 to 20");
  }
  if (!within(options.most_angle_deg, 1, 90)) {
    return wrong("most_angle_deg should be from 1 to 90");
  }
  if (!within(options.least_contrast_counts, 0, 65535) || !within(options.sigma_counts, 0, 65535)) {
    return wrong("least_contrast_counts and sigma_counts should be from 0 to 65535");
  }
  if (options.least_frames < 1 || options.least_frames > 1000000) {
    return wrong("least_frames should be from 1 to 1000000");
  }
  if (!within(options.absence_s, 0, 1e6) || !within(options.event_slack, 0, 100)) {
    return wrong("absence_s should be from 0 to 1e6, event_slack from 0 to 100");
  }
  return {};
}

// The time to judge a frame grows with its length.
Status check_length(const FramePair& frame, const std::string& name) {
  double total_px = 0;
  for (const TrackedCurve& edge : frame.found->edges) {
    total_px += length_px(edge.curve);
  }
  const CurveFrame& truth = frame.truth->edges;
  if (total_px <= 4.0 * truth.width * truth.height) {
    return {};
  }
  return failure(ErrorCode::kBadData, name + ": frame " + std::to_string(frame.found->frame) +
                                          ": edges of " + std::to_string(std::llround(total_px)) +
                                          " px in all are more than a frame of " +
                                          std::to_string(truth.width) + "x" +
                                          std::to_string(truth.height) + " pixels holds");
}

class Judge {
 public:
  Judge(std::vector<FramePair> frames, const TracksOptions& options, ParallelRunner& runner)
      : frames_(std::move(frames)), options_(options), runner_(runner), index_(frames_, options) {}

  [[nodiscard]] bool has_edges() const {
    return std::any_of(index_.visits().begin(), index_.visits().end(),
                       [](const Visit& visit) { return visit.counts; });
  }
  [[nodiscard]] double least_contrast_counts() const { return index_.least_contrast_counts(); }

  TracksEvaluation run() {
    std::vector<FrameFigures> figures(frames_.size());
    std::vector<MotionFigures> motions(frames_.size());
    std::mutex mutex;
    std::size_t done = 0;
    runner_.run(static_cast<int>(frames_.size()), [&](int task) {
      const auto i = static_cast<std::size_t>(task);
      if (frames_[i].counts()) {
        figures[i] = compare_frame(i, frames_[i], index_, options_);
        motions[i] = compare_neighbours(frames_, i, index_, options_);
      }
      if (options_.progress) {
        const std::lock_guard lock(mutex);
        options_.progress(++done, frames_.size());
      }
    });
    TracksEvaluation evaluation;
    count_frames(evaluation);
    evaluation.identities = measure_identities(figures, index_);
    evaluation.gaps = measure_gaps(figures, frames_that_count());
    evaluation.hota = measure_hota(samples_of(figures), runner_);
    MotionFigures motion;
    for (const MotionFigures& one : motions) {
      motion += one;
    }
    evaluation.repeatability = motion.repeatability;
    evaluation.smooth = motion.smooth();
    measure_events(frames_, options_.event_slack, evaluation);
    return evaluation;
  }

 private:
  void count_frames(TracksEvaluation& evaluation) const {
    evaluation.frames = frames_.size();
    for (const FramePair& frame : frames_) {
      evaluation.invalid_frames += frame.found->valid ? 0 : 1;
      evaluation.frozen_frames += frame.truth->frozen ? 1 : 0;
    }
  }

  [[nodiscard]] std::vector<bool> frames_that_count() const {
    std::vector<bool> counts(frames_.size());
    std::transform(frames_.begin(), frames_.end(), counts.begin(),
                   [](const FramePair& frame) { return frame.counts(); });
    return counts;
  }

  static std::vector<const FrameSamples*> samples_of(const std::vector<FrameFigures>& figures) {
    std::vector<const FrameSamples*> samples;
    samples.reserve(figures.size());
    for (const FrameFigures& frame : figures) {
      samples.push_back(&frame.samples);
    }
    return samples;
  }

  std::vector<FramePair> frames_;
  const TracksOptions& options_;
  ParallelRunner& runner_;
  TrackIndex index_;
};

// Each line of a file.
template <class Frame>
Result<std::vector<Frame>> read_frames(const std::string& path,
                                       Result<Frame> (*parse)(std::string_view,
                                                              const std::string&)) {
  return JsonLines::read(path, {}).and_then(
      [&](const JsonLines& lines) -> Result<std::vector<Frame>> {
        std::vector<Frame> frames;
        frames.reserve(lines.size());
        for (std::size_t i = 0; i < lines.size(); ++i) {
          auto frame = parse(lines.text(i), lines.label(i));
          if (!frame) {
            return tl::unexpected(std::move(frame.error()));
          }
          frames.push_back(std::move(*frame));
        }
        return frames;
      });
}

Result<TracksEvaluation> judge(std::vector<FramePair> frames, const std::string& name,
                               const std::string& truth_name, const TracksOptions& options,
                               ParallelRunner& runner) {
  for (const FramePair& frame : frames) {
    if (Status status = check_length(frame, name); !status) {
      return tl::unexpected(status.error());
    }
  }
  Judge of_frames(std::move(frames), options, runner);
  if (!of_frames.has_edges()) {
    return failure(ErrorCode::kBadData,
                   truth_name + ": no edge of at least " +
                       std::to_string(std::llround(of_frames.least_contrast_counts())) +
                       " counts shows in " + std::to_string(options.least_frames) +
                       " frames or more, or too few frames are valid");
  }
  return of_frames.run();
}

}  // namespace

Result<TracksEvaluation> evaluate_tracks(const std::vector<TrackedFrame>& found,
                                         const std::string& name,
                                         const std::vector<TrackTruth>& truth,
                                         const std::string& truth_name,
                                         const TracksOptions& options, ParallelRunner& runner) {
  return io::catch_bad_alloc("evaluation of tracks", [&] {
    return check(options)
        .and_then([&] { return pair_frames(found, name, truth, truth_name); })
        .and_then([&](std::vector<FramePair> frames) {
          return judge(std::move(frames), name, truth_name, options, runner);
        });
  });
}

Result<TracksEvaluation> evaluate_tracks(const std::string& found_path,
                                         const std::string& truth_path,
                                         const TracksOptions& options, ParallelRunner& runner) {
  const auto found = read_frames<TrackedFrame>(found_path, parse_tracked_frame);
  if (!found) {
    return tl::unexpected(found.error());
  }
  const auto truth = read_frames<TrackTruth>(truth_path, parse_track_truth);
  if (!truth) {
    return tl::unexpected(truth.error());
  }
  return evaluate_tracks(*found, found_path, *truth, truth_path, options, runner);
}

Result<TracksSummary> summarise_tracks(const std::string& path) {
  return io::catch_bad_alloc(path, [&] {
    return read_frames<TrackedFrame>(path, parse_tracked_frame)
        .map([](const std::vector<TrackedFrame>& frames) { return summarise_tracks(frames); });
  });
}

}  // namespace thermedge::eval
