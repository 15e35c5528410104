// Identities, HOTA, motion and events on sequences whose figures are known.
#include <gtest/gtest.h>

#include <cmath>

#include "support/runners.hpp"
#include "thermedge/eval/tracks.hpp"

namespace thermedge::eval {
namespace {

constexpr int kFrames = 40;
constexpr std::int64_t kStepNs = 12'500'000;
constexpr std::size_t kPoints = 101;  // of a line: 100 px

Curve line(Point from, Point to, std::int64_t id = -1, double contrast_counts = 100) {
  Curve curve;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double t = static_cast<double>(i) / (kPoints - 1);
    curve.points.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
  }
  curve.id = id;
  curve.contrast_counts = contrast_counts;
  return curve;
}

Curve level(double y, std::int64_t id = -1, double contrast_counts = 100) {
  return line({20, y}, {120, y}, id, contrast_counts);
}

TrackedCurve tracked(Curve curve, std::vector<TrackRun> runs) {
  return {std::move(curve), std::move(runs), {}};
}
TrackedCurve tracked(Curve curve, std::int64_t id) {
  return tracked(std::move(curve), {{0, kPoints, id}});
}

// Frames of tracks and their truth.
struct Sequence {
  std::vector<TrackedFrame> found;
  std::vector<TrackTruth> truth;

  explicit Sequence(int frames = kFrames) {
    for (int i = 0; i < frames; ++i) {
      TrackedFrame& one = found.emplace_back();
      one.frame = i;
      TrackTruth& other = truth.emplace_back();
      other.frame = i;
      other.stamp_ns = i * kStepNs;
      other.edges.width = 160;
      other.edges.height = 120;
    }
  }
  // Each frame i gets the curves of `make(i)`.
  void add_truth(const auto& make) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      truth[i].edges.curves.push_back(make(static_cast<int>(i)));
    }
  }
  void add_found(const auto& make) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      found[i].edges.push_back(make(static_cast<int>(i)));
    }
  }
  [[nodiscard]] Result<TracksEvaluation> try_judge(const TracksOptions& options = {}) const {
    return evaluate_tracks(found, "tracks", truth, "truth", options, *make_runner(1));
  }
  [[nodiscard]] TracksEvaluation judged(const TracksOptions& options = {}) const {
    auto evaluation = try_judge(options);
    EXPECT_TRUE(evaluation) << evaluation.error().message;
    return evaluation ? *evaluation : TracksEvaluation{};
  }
};

// Two true edges of 100 px at y = 30 and 60 in each frame.
Sequence two_edges() {
  Sequence sequence;
  sequence.add_truth([](int) { return level(30, 0); });
  sequence.add_truth([](int) { return level(60, 1); });
  return sequence;
}

// Both found where they are, under ids that the frame decides.
Sequence labelled(const auto& first, const auto& second) {
  Sequence sequence = two_edges();
  sequence.add_found([&](int i) { return tracked(level(30), first(i)); });
  sequence.add_found([&](int i) { return tracked(level(60), second(i)); });
  return sequence;
}

constexpr auto always(std::int64_t id) {
  return [id](int) { return id; };
}
constexpr auto half_way(std::int64_t before, std::int64_t after) {
  return [before, after](int i) { return i < kFrames / 2 ? before : after; };
}

void expect_identities(const Sequence& sequence, double kept, double purity, double ids_per_edge) {
  const IdentityFigures figures = sequence.judged().identities;
  EXPECT_NEAR(figures.kept(), kept, 1e-12);
  EXPECT_NEAR(figures.purity(), purity, 1e-12);
  EXPECT_NEAR(figures.harmonic_mean(), 2 * kept * purity / (kept + purity), 1e-12);
  EXPECT_NEAR(figures.ids_per_edge(), ids_per_edge, 1e-12);
}

void expect_hota(const Sequence& sequence, double det_a, double ass_a) {
  const HotaFigures figures = sequence.judged().hota;
  ASSERT_EQ(figures.by_alpha.size(), 19U);
  for (const Hota& hota : {figures.at_reach, figures.mean, figures.by_alpha.back()}) {
    EXPECT_NEAR(hota.det_a, det_a, 1e-12);
    EXPECT_NEAR(hota.ass_a, ass_a, 1e-12);
    EXPECT_NEAR(hota.hota, std::sqrt(det_a * ass_a), 1e-12);
    EXPECT_NEAR(hota.loc_a, 1, 1e-12);
  }
}

TEST(Tracks, ThatAreTheTruthHaveAllOfEverything) {
  const Sequence sequence = labelled(always(7), always(900000000000));
  expect_identities(sequence, 1, 1, 1);
  expect_hota(sequence, 1, 1);
  const TracksEvaluation evaluation = sequence.judged();
  EXPECT_EQ(evaluation.frames, static_cast<std::size_t>(kFrames));
  EXPECT_EQ(evaluation.identities.true_px, 200.0 * kFrames);
  EXPECT_EQ(evaluation.identities.found_px, 200.0 * kFrames);
  EXPECT_EQ(evaluation.identities.edges, 2U);
  EXPECT_EQ(evaluation.identities.ids, 2U);
  EXPECT_EQ(evaluation.identities.false_px, 0);
  EXPECT_EQ(evaluation.repeatability.share(), 1);
  EXPECT_TRUE(evaluation.events.empty());
}

TEST(Tracks, OneIdentityForEverythingIsKeptButNotPure) {
  const Sequence sequence = labelled(always(5), always(5));
  expect_identities(sequence, 1, 0.5, 1);
  expect_hota(sequence, 1, 0.5);
}

TEST(Tracks, IdentitiesThatSwapHalfWayAreNeitherKeptNorPure) {
  const Sequence sequence = labelled(half_way(1, 2), half_way(2, 1));
  expect_identities(sequence, 0.5, 0.5, 2);
  expect_hota(sequence, 1, 1.0 / 3);
}

TEST(Tracks, AnIdentityThatIsReplacedIsPureButNotKept) {
  const Sequence in_time = labelled(half_way(1, 2), half_way(3, 4));
  expect_identities(in_time, 0.5, 1, 2);
  expect_hota(in_time, 1, 0.5);
  // The same along the edge: points 0..49 and 50..100 meet in the middle of a part.
  Sequence along = two_edges();
  along.add_found([](int) { return tracked(level(30), {{0, 50, 1}, {50, kPoints, 2}}); });
  along.add_found([](int) { return tracked(level(60), {{0, 50, 3}, {50, kPoints, 4}}); });
  const IdentityFigures figures = along.judged().identities;
  EXPECT_NEAR(figures.kept(), 0.5, 0.01);
  EXPECT_EQ(figures.purity(), 1);
  EXPECT_EQ(figures.ids_per_edge(), 2);
}

TEST(Tracks, MergedIdentities) {
  // The second edge takes the identity of the first: of 2n px, 3n/2 are kept; of the first
  // identity's 3n/2 px, n are at its main edge, and all n/2 of the second's.
  expect_identities(labelled(always(1), half_way(2, 1)), 0.75, 0.75, 1.5);
}

TEST(Tracks, ShortIdentitiesCountLittle) {
  const auto flicker = [](int i) { return i == 10 ? std::int64_t{2} : std::int64_t{1}; };
  const IdentityFigures figures = labelled(flicker, always(3)).judged().identities;
  EXPECT_EQ(figures.ids_per_edge(), 1);  // 1 of 40 frames is less than 5 %
  EXPECT_EQ(figures.all_edge_ids, 3U);
  EXPECT_NEAR(figures.kept(), 79.0 / 80, 1e-12);
}

TEST(Tracks, WhatHasNoIdentityIsFoundButNotKept) {
  Sequence sequence = two_edges();
  sequence.add_found([](int) { return tracked(level(30), 1); });
  sequence.add_found([](int) { return tracked(level(60), std::vector<TrackRun>{}); });
  const IdentityFigures figures = sequence.judged().identities;
  EXPECT_EQ(figures.found_px, figures.true_px);
  EXPECT_EQ(figures.labelled_px, figures.true_px / 2);
  EXPECT_EQ(figures.kept(), 0.5);
  EXPECT_EQ(figures.purity(), 1);
  EXPECT_EQ(figures.ids_per_edge(), 1);
  expect_hota(sequence, 0.5, 1);
}

TEST(Tracks, FalseEdgesAreToldApart) {
  Sequence sequence = labelled(always(1), always(2));
  sequence.add_found([](int) { return tracked(level(90), 3); });
  const IdentityFigures figures = sequence.judged().identities;
  EXPECT_EQ(figures.false_px, 100.0 * kFrames);
  EXPECT_EQ(figures.purity(), 1);
  EXPECT_EQ(figures.ids, 2U);
  expect_hota(sequence, 2.0 / 3, 1);
  // An identity that is now at an edge, now nowhere, is not pure.
  expect_identities(
      [] {
        Sequence strays = two_edges();
        strays.add_found([](int i) { return tracked(level(i < 30 ? 30 : 90), 1); });
        return strays;
      }(),
      1, 0.75, 1);
}

TEST(Tracks, EdgesThatCrossAreNotTheEdge) {
  Sequence sequence = two_edges();
  sequence.add_found([](int) { return tracked(level(30), 1); });
  sequence.add_found([](int) { return tracked(line({70, 15}, {70, 115}), 2); });
  const IdentityFigures figures = sequence.judged().identities;
  EXPECT_EQ(figures.found_px, figures.true_px / 2);
  EXPECT_EQ(figures.kept(), 1);
  TracksOptions any;
  any.most_angle_deg = 90;
  EXPECT_GT(sequence.judged(any).identities.found_px, figures.found_px);
}

TEST(Tracks, PlacesOutOfReachAreNotTheEdge) {
  for (const double away : {1.9, 2.1}) {
    Sequence sequence = two_edges();
    sequence.add_found([&](int) { return tracked(level(30 + away), 1); });
    sequence.add_found([](int) { return tracked(level(60), 2); });
    const TracksEvaluation evaluation = sequence.judged();
    EXPECT_EQ(evaluation.identities.found_px / evaluation.identities.true_px, away < 2 ? 1 : 0.5);
    EXPECT_NEAR(evaluation.hota.at_reach.det_a, away < 2 ? 1 : 1.0 / 3, 1e-12);
    // Of the distances up to 1.9 px in steps of 0.1 only the largest holds this edge.
    EXPECT_NEAR(evaluation.hota.by_alpha.front().det_a, away < 2 ? 1 : 1.0 / 3, 1e-12);
    EXPECT_NEAR(evaluation.hota.by_alpha[1].det_a, 1.0 / 3, 1e-12);
  }
}

// Weak edges and such as show for a moment may be found but need not be.
TEST(Tracks, EdgesThatDoNotCount) {
  Sequence sequence = labelled(always(1), always(2));
  const double kept_hota = sequence.judged().hota.at_reach.hota;
  sequence.add_truth([](int) { return level(80, 2, 39); });
  sequence.add_truth([](int) { return level(90, 3, 41); });
  sequence.add_found([](int) { return tracked(level(80), 3); });
  sequence.add_found([](int) { return tracked(level(90), 4); });
  for (std::size_t i = 25; i < sequence.truth.size(); ++i) {
    sequence.truth[i].edges.curves.pop_back();
    sequence.found[i].edges.pop_back();
  }
  const TracksEvaluation evaluation = sequence.judged();
  EXPECT_EQ(evaluation.identities.true_px, 200.0 * kFrames);
  EXPECT_EQ(evaluation.identities.ids, 2U);
  EXPECT_EQ(evaluation.identities.false_px, 0);
  EXPECT_EQ(evaluation.hota.at_reach.hota, kept_hota);
  TracksOptions options;
  options.least_frames = 25;
  EXPECT_EQ(sequence.judged(options).identities.true_px, 200.0 * kFrames + 2500);
  options.least_contrast_counts = 39;
  EXPECT_EQ(sequence.judged(options).identities.true_px, 300.0 * kFrames + 2500);
  options.sigma_counts = 20.4;  // 2 sigma: 40.8
  EXPECT_EQ(sequence.judged(options).identities.true_px, 200.0 * kFrames + 2500);
  // The tracks' own noise is taken where none is given.
  options.sigma_counts = 0;
  for (TrackedFrame& frame : sequence.found) {
    frame.sigma_counts = 60;
  }
  const auto none = sequence.try_judge(options);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no edge of at least 120 counts"), std::string::npos);
}

TEST(Tracks, AnEdgeThatWasAwayForLongIsAnother) {
  constexpr int kLong = 400;
  Sequence sequence(kLong);
  sequence.add_truth([](int) { return level(30, 0); });
  sequence.add_truth([](int) { return level(60, 1); });
  sequence.add_found([](int) { return tracked(level(30), 1); });
  sequence.add_found([](int i) { return tracked(level(60), i < 200 ? 2 : 3); });
  for (std::size_t i = 150; i < 250; ++i) {
    sequence.truth[i].edges.curves.pop_back();
    sequence.found[i].edges.pop_back();
  }
  EXPECT_EQ(sequence.judged().identities.kept(), 1);
  EXPECT_EQ(sequence.judged().identities.edges, 3U);
  TracksOptions options;
  options.absence_s = 2;
  EXPECT_NEAR(sequence.judged(options).identities.kept(), 550.0 / 700, 1e-12);
  options.absence_s = 0;
  EXPECT_NEAR(sequence.judged(options).identities.kept(), 550.0 / 700, 1e-12);
  // In frozen frames it was there all the time.
  for (std::size_t i = 150; i < 250; ++i) {
    sequence.truth[i].edges.curves.push_back(level(60, 1));
    sequence.truth[i].frozen = true;
  }
  const TracksEvaluation frozen = sequence.judged();
  EXPECT_EQ(frozen.frozen_frames, 100U);
  EXPECT_EQ(frozen.identities.edges, 2U);
  EXPECT_NEAR(frozen.identities.kept(), 450.0 / 600, 1e-12);
}

TEST(Tracks, InvalidFramesCountForNothing) {
  Sequence sequence = labelled(always(1), always(2));
  for (std::size_t i = 20; i < 25; ++i) {
    sequence.found[i].valid = false;
    sequence.found[i].edges = {tracked(level(10), 9)};
  }
  expect_identities(sequence, 1, 1, 1);
  expect_hota(sequence, 1, 1);
  EXPECT_EQ(sequence.judged().invalid_frames, 5U);
  EXPECT_EQ(sequence.judged().identities.false_px, 0);
}

TEST(Gaps, TellWhetherIdentitiesComeBack) {
  const auto with_gap = [](std::int64_t after) {
    Sequence sequence = labelled(half_way(1, after), always(2));
    for (std::size_t i = 15; i < 20; ++i) {
      sequence.truth[i].frozen = true;
    }
    return sequence.judged().gaps;
  };
  EXPECT_EQ(with_gap(1).gaps, 1U);
  EXPECT_EQ(with_gap(1).share(), 1);
  EXPECT_EQ(with_gap(3).share(), 0.5);
  EXPECT_EQ(with_gap(3).found_px, 5 * 200);
  // The first two frames after it are left to settle.
  for (const std::size_t late : {1U, 2U}) {
    Sequence sequence = labelled(always(1), always(2));
    for (std::size_t i = 15; i < 20; ++i) {
      sequence.found[i].valid = false;
    }
    sequence.found[20 + late].edges[0].tracks[0].id = 9;
    EXPECT_EQ(sequence.judged().gaps.share(), late == 1 ? 1 : 0.9);
  }
  EXPECT_EQ(labelled(always(1), always(2)).judged().gaps.gaps, 0U);
}

TEST(TracksSummary, CountsLengthsAndLives) {
  Sequence sequence;
  sequence.add_found([](int i) { return tracked(level(30), i < 30 ? 1 : 2); });
  sequence.add_found([](int) { return tracked(level(60), {{0, 50, 3}}); });
  sequence.found[7].valid = false;
  sequence.found[7].events = {"frozen"};
  sequence.found[8].events = {"frozen", "clipped"};
  const TracksSummary summary = summarise_tracks(sequence.found);
  EXPECT_EQ(summary.frames, 40U);
  EXPECT_EQ(summary.invalid_frames, 1U);
  EXPECT_EQ(summary.found_px, 39 * 200);
  EXPECT_EQ(summary.labelled_px, 39 * 150);
  // Of the first edge all but the first 5 frames of each identity, of the half one likewise.
  EXPECT_EQ(summary.aged_px, (24 + 5) * 100 + 34 * 50);
  EXPECT_EQ(summary.ids, 3U);
  EXPECT_EQ(summary.median_life_frames, 30);
  ASSERT_EQ(summary.events.size(), 2U);
  EXPECT_EQ(summary.events[1].first, "frozen");
  EXPECT_EQ(summary.events[1].second, 2U);
  EXPECT_EQ(summarise_tracks(std::vector<TrackedFrame>{}).ids, 0U);
}

// Wiggles of the found edge are no length, and cost nothing.
TEST(Tracks, NoiseOfPositionsCostsNoDetections) {
  Sequence sequence = two_edges();
  for (const double y : {30.0, 60.0}) {
    sequence.add_found([&](int i) {
      Curve curve = level(y);
      for (std::size_t k = 0; k < kPoints; ++k) {
        curve.points[k].y += (k + static_cast<std::size_t>(i)) % 2 == 0 ? 0.3 : -0.3;
      }
      return tracked(curve, static_cast<std::int64_t>(y));
    });
  }
  const TracksEvaluation evaluation = sequence.judged();
  EXPECT_GT(evaluation.hota.at_reach.det_a, 0.985);
  EXPECT_EQ(evaluation.identities.kept(), 1);
}

// Both ends of a closed edge meet.
TEST(Tracks, ClosedEdges) {
  const auto circle = [](double radius_px) {
    Curve curve;
    curve.closed = true;
    curve.id = 4;
    for (int i = 0; i < 300; ++i) {
      const double angle = (i + 11) * 2 * 3.14159265358979323846 / 300;
      curve.points.push_back({80 + radius_px * std::cos(angle), 60 + radius_px * std::sin(angle)});
    }
    return curve;
  };
  Sequence sequence;
  sequence.add_truth([&](int) { return circle(30); });
  sequence.add_found([&](int i) {
    Curve found = circle(30.2);
    std::rotate(found.points.begin(), found.points.begin() + i * 5, found.points.end());
    return TrackedCurve{found, {{0, 300, 1}}, {}};
  });
  const TracksEvaluation evaluation = sequence.judged();
  EXPECT_EQ(evaluation.identities.kept(), 1);
  EXPECT_EQ(evaluation.identities.purity(), 1);
  EXPECT_GT(evaluation.hota.at_reach.det_a, 0.98);
  EXPECT_GT(evaluation.repeatability.points, 7000);
  EXPECT_EQ(evaluation.repeatability.share(), 1);
}

// The found edge jumps by `jump_px` from frame to frame, the true one moves by `speed_px`.
double repeated_share(double jump_px, double speed_px, const TracksOptions& options = {}) {
  Sequence sequence;
  const auto y = [&](int i) { return 20 + speed_px * i; };
  sequence.add_truth([&](int i) { return level(y(i), 0); });
  sequence.add_found([&](int i) { return tracked(level(y(i) + (i % 2 == 0 ? jump_px : 0)), 1); });
  return sequence.judged(options).repeatability.share();
}

TEST(TrackRepeatability, IsMeasuredOnTheMovingEdge) {
  EXPECT_EQ(repeated_share(0.9, 0), 1);
  EXPECT_EQ(repeated_share(1.1, 0), 0);
  EXPECT_EQ(repeated_share(0.9, 2), 1);
  EXPECT_EQ(repeated_share(-1.1, 2), 0);
  TracksOptions wide;
  wide.repeat_reach_px = 1.2;
  EXPECT_EQ(repeated_share(1.1, 2, wide), 1);
}

// A camera that turns by 20 px a frame.
TEST(TrackRepeatability, FollowsTheTurnOfTheCamera) {
  for (const bool with_camera : {true, false}) {
    Sequence sequence(6);
    constexpr double kFocalPx = 200;
    const auto column = [](int i) { return 80 + kFocalPx * std::tan(0.35 - 0.1 * i); };
    sequence.add_truth([&](int i) { return line({column(i), 10}, {column(i), 110}, 0); });
    sequence.add_found([&](int i) { return tracked(line({column(i), 10}, {column(i), 110}), 1); });
    for (std::size_t i = 0; with_camera && i < sequence.truth.size(); ++i) {
      const double half = 0.05 * static_cast<double>(i);
      sequence.truth[i].camera =
          CameraView{{0, std::sin(half), 0, std::cos(half)}, kFocalPx, kFocalPx, 80, 60, 0, 0};
    }
    TracksOptions options;
    options.least_frames = 5;
    const Repeatability figures = sequence.judged(options).repeatability;
    EXPECT_EQ(figures.points > 400, with_camera);
    if (with_camera) {
      EXPECT_EQ(figures.share(), 1);
    }
  }
}

TEST(Smooth, RmsAndLagAreMeasuredAcrossTheEdge) {
  for (const double speed_px : {0.8, -0.8}) {
    Sequence sequence;
    const auto y = [&](int i) { return 60 + speed_px * i; };
    sequence.add_truth([&](int i) { return level(y(i), 0); });
    sequence.add_found([&](int i) {
      const double noise = i % 2 == 0 ? 0.4 : -0.4;
      TrackedCurve edge = tracked(level(y(i) + noise), 1);
      for (const Point point : edge.curve.points) {
        edge.smooth.emplace_back(Point{point.x, y(i) + noise / 4 - 0.05 * speed_px});
      }
      edge.smooth[3] = std::nullopt;
      return edge;
    });
    const SmoothFigures smooth = sequence.judged().smooth;
    EXPECT_NEAR(static_cast<double>(smooth.points), 100.0 * kFrames, 3 * kFrames);
    EXPECT_NEAR(smooth.measured_rms_px, 0.4, 1e-9);
    EXPECT_NEAR(smooth.smooth_rms_px, std::hypot(0.1, 0.04), 1e-9);
    // From +0.4 to -0.4 and back.
    EXPECT_NEAR(smooth.measured_jitter_px, 0.8 / std::sqrt(2), 1e-9);
    EXPECT_NEAR(smooth.smooth_jitter_px, 0.2 / std::sqrt(2), 1e-9);
    EXPECT_GT(smooth.repeated_points, 3500);
    EXPECT_GT(smooth.moving_points, 3000);
    EXPECT_NEAR(smooth.smooth_lag_px, 0.04, 0.005);  // the noise of one frame may stay
    EXPECT_NEAR(smooth.measured_lag_px, 0, 0.02);
  }
}

TEST(Smooth, NoLagIsToldWithoutAConstantSpeed) {
  Sequence sequence;
  const auto y = [](int i) { return 30 + 3 * std::sin(i * 0.7); };
  sequence.add_truth([&](int i) { return level(y(i), 0); });
  sequence.add_found([&](int i) {
    TrackedCurve edge = tracked(level(y(i)), 1);
    edge.smooth.assign(edge.curve.points.begin(), edge.curve.points.end());
    return edge;
  });
  const SmoothFigures smooth = sequence.judged().smooth;
  EXPECT_GT(smooth.points, 0);
  EXPECT_LT(static_cast<double>(smooth.moving_points), 0.2 * static_cast<double>(smooth.points));
}

TEST(Events, AreMatchedByTheirBeginnings) {
  Sequence sequence = labelled(always(1), always(2));
  const auto put = [](auto& frames, const char* kind, std::initializer_list<std::size_t> where) {
    for (const std::size_t i : where) {
      frames[i].events.emplace_back(kind);
    }
  };
  put(sequence.truth, "frozen", {5, 6, 7, 8, 20, 21, 22});
  put(sequence.found, "frozen", {6, 7, 8, 9, 35});  // one late by one, one missed, one false
  put(sequence.truth, "near_frozen", {10, 11, 12});
  put(sequence.found, "near_frozen", {12});
  put(sequence.truth, "offset_jump", {15});
  put(sequence.found, "offset_jump", {17});
  put(sequence.found, "settling", {17, 18});
  const TracksEvaluation evaluation = sequence.judged();
  ASSERT_EQ(evaluation.events.size(), 3U);
  const EventFigures& frozen = evaluation.events[0];
  EXPECT_EQ(frozen.kind, "frozen");
  EXPECT_EQ(frozen.truth, 2U);
  EXPECT_EQ(frozen.truth_found, 1U);
  EXPECT_EQ(frozen.found, 2U);
  EXPECT_EQ(frozen.found_true, 1U);
  EXPECT_EQ(evaluation.events[1].kind, "near_frozen");
  EXPECT_EQ(evaluation.events[1].truth_found, 1U);
  EXPECT_EQ(evaluation.events[2].kind, "offset_jump");
  EXPECT_EQ(evaluation.events[2].truth_found, 0U);
  EXPECT_EQ(evaluation.events[2].found_true, 0U);
  EXPECT_EQ(evaluation.other_events, std::vector<std::string>{"settling"});
}

TEST(FramePairs, AreFormedByStampsThenNumbersThenOrder) {
  Sequence sequence = labelled(half_way(1, 2), always(3));
  // Frames 0 to 19 are missing in the tracks.
  sequence.found.erase(sequence.found.begin(), sequence.found.begin() + 20);
  TracksOptions options;
  options.least_frames = 10;
  EXPECT_EQ(sequence.judged(options).identities.kept(), 1);
  // Stamps that are all the same tell nothing.
  for (TrackedFrame& frame : sequence.found) {
    frame.stamp_ns = 0;
  }
  EXPECT_EQ(sequence.judged(options).identities.kept(), 1);
  // Numbers that are not the truth's: stamps decide.
  for (std::size_t i = 0; i < 20; ++i) {
    sequence.found[i].frame = static_cast<std::int64_t>(i);
    sequence.found[i].stamp_ns = static_cast<std::int64_t>(i + 20) * kStepNs;
    sequence.truth[i].edges.curves.clear();
  }
  EXPECT_EQ(sequence.judged(options).identities.kept(), 1);
  sequence.found[3].stamp_ns = 1;
  sequence.found[4].frame = 77;
  const auto none = sequence.try_judge(options);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("tracks: neither stamp_ns nor frame of its 20 frames"),
            std::string::npos);
  sequence.truth.erase(sequence.truth.begin(), sequence.truth.begin() + 20);
  EXPECT_EQ(sequence.judged(options).identities.kept(), 1);
}

TEST(Tracks, HaveTheSameFiguresForEveryRunner) {
  const Sequence sequence = labelled(half_way(1, 2), half_way(2, 1));
  const std::string one = evaluation_to_json(sequence.judged(), "a", "b");
  test::ShuffledRunner shuffled(3);
  const auto other =
      evaluate_tracks(sequence.found, "tracks", sequence.truth, "truth", {}, shuffled);
  ASSERT_TRUE(other);
  EXPECT_EQ(evaluation_to_json(*other, "a", "b"), one);
}

TEST(Tracks, OptionsOutOfRangeAreErrors) {
  const Sequence sequence = labelled(always(1), always(2));
  const auto expect = [&](const char* part, const auto& change) {
    TracksOptions options;
    change(options);
    const auto result = sequence.try_judge(options);
    ASSERT_FALSE(result) << part;
    EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
  };
  expect("reach_px", [](TracksOptions& o) { o.reach_px = 0; });
  expect("reach_px", [](TracksOptions& o) { o.repeat_reach_px = std::nan(""); });
  expect("most_angle_deg", [](TracksOptions& o) { o.most_angle_deg = 91; });
  expect("sigma_counts", [](TracksOptions& o) { o.sigma_counts = -1; });
  expect("least_frames", [](TracksOptions& o) { o.least_frames = 0; });
  expect("absence_s", [](TracksOptions& o) { o.absence_s = -1; });
}

}  // namespace
}  // namespace thermedge::eval
