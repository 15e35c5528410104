// Identities on drawn edges whose fate is known.
#include "thermedge/sequence/tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace thermedge {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 150;
constexpr std::int64_t kFrameNs = 12'500'000;

struct Chain {
  std::vector<Point> points;
  float side = 1;  // of the normals: 1 to the left of the walking direction
  std::vector<std::uint32_t> corners;
  double z = 50;
};

Chain line(Point from, Point to, float side = 1) {
  const float length = std::hypot(to.x - from.x, to.y - from.y);
  Chain chain;
  chain.side = side;
  const int count = static_cast<int>(length) + 1;
  for (int i = 0; i < count; ++i) {
    const float t = static_cast<float>(i) / length;
    chain.points.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
  }
  return chain;
}

Chain joined(Chain first, const Chain& second) {
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  return first;
}

Detection detection_of(const std::vector<Chain>& chains, std::int64_t frame) {
  Detection detection;
  detection.width = kWidth;
  detection.height = kHeight;
  detection.index = frame;
  detection.stamp_ns = frame * kFrameNs;
  EdgeSet& set = detection.edges;
  for (const Chain& chain : chains) {
    Edge edge;
    edge.index = static_cast<std::int32_t>(set.edges.size());
    edge.kept = true;
    edge.z = chain.z;
    const auto first = static_cast<std::uint32_t>(set.edgels.size());
    edge.edgels = {first, static_cast<std::uint32_t>(chain.points.size())};
    edge.corners = {static_cast<std::uint32_t>(set.corners.size()),
                    static_cast<std::uint32_t>(chain.corners.size())};
    set.corners.insert(set.corners.end(), chain.corners.begin(), chain.corners.end());
    set.edgels.resize(set.edgels.size() + chain.points.size());
    for (std::size_t i = 0; i < chain.points.size(); ++i) {
      const std::size_t at = first + i;
      const Point before = chain.points[i > 0 ? i - 1 : 0];
      const Point after = chain.points[std::min(i + 1, chain.points.size() - 1)];
      const float dx = after.x - before.x;
      const float dy = after.y - before.y;
      const float length = std::hypot(dx, dy);
      set.edgels.x[at] = chain.points[i].x;
      set.edgels.y[at] = chain.points[i].y;
      set.edgels.nx[at] = chain.side * dy / length;
      set.edgels.ny[at] = -chain.side * dx / length;
      set.edgels.magnitude_counts[at] = 20;
      set.edgels.position_sigma_px[at] = 0.2F;
      set.edgels.edge[at] = edge.index;
    }
    set.edges.push_back(edge);
  }
  set.kept = set.edges.size();
  return detection;
}

Motion shift(double x, double y) {
  Motion motion;
  motion.homography = {1, 0, x, 0, 1, y, 0, 0, 1};
  motion.found = true;
  return motion;
}

class TrackerTest : public testing::Test {
 protected:
  const Tracks& see(const std::vector<Chain>& chains, const Motion& motion = shift(0, 0)) {
    detection_ = detection_of(chains, frame_++);
    tracker_.update(detection_, motion, tracks_);
    EXPECT_EQ(tracks_.track.size(), detection_.edges.edgels.size());
    EXPECT_EQ(tracks_.edges.size(), chains.size());
    return tracks_;
  }
  // The identity of an edge's edgel, in walking order.
  [[nodiscard]] std::int64_t at(std::size_t edge, std::size_t edgel) const {
    return tracks_.track[detection_.edges.edges[edge].edgels.first + edgel];
  }

  Tracker tracker_ = *Tracker::create();
  Tracks tracks_;
  Detection detection_;
  std::int64_t frame_ = 0;
};

TEST_F(TrackerTest, AnEdgeKeepsItsIdentityWhileThePictureMoves) {
  const Motion motion = shift(3, -2);
  for (int i = 0; i < 20; ++i) {
    const auto x = static_cast<float>(20 + 3 * i);
    const auto y = static_cast<float>(100 - 2 * i);
    see({line({x, y}, {x + 60, y + 20})}, i == 0 ? Motion{} : motion);
    EXPECT_EQ(tracks_.edges[0].track, 0);
    EXPECT_EQ(tracks_.edges[0].age, i);
    EXPECT_EQ(tracks_.born.size(), i == 0 ? 1U : 0U);
    EXPECT_TRUE(tracks_.ended.empty());
  }
  EXPECT_EQ(tracks_.runs.size(), 1U);
  EXPECT_EQ(tracks_.runs[0].edgels.count, detection_.edges.edgels.size());
}

TEST_F(TrackerTest, AnEdgeThatMovesByItselfIsFollowed) {
  for (int i = 0; i < 25; ++i) {
    const auto x = static_cast<float>(30 + 2 * i);
    see({line({x, 20}, {x, 120})});
    EXPECT_EQ(tracks_.edges[0].track, 0) << i;
  }
}

TEST_F(TrackerTest, EdgelsKnowTheirPlaceInTheLastFrame) {
  const std::vector<Chain> chains = {line({20, 20}, {120, 20}), line({20, 60}, {120, 60})};
  see(chains);
  EXPECT_EQ(tracks_.last, std::vector<std::int32_t>(202, -1));
  see({chains[1], chains[0]});
  for (std::int32_t i = 0; i < 101; ++i) {
    EXPECT_EQ(tracks_.last[static_cast<std::size_t>(i)], 101 + i);
    EXPECT_EQ(tracks_.last[static_cast<std::size_t>(101 + i)], i);
  }
}

TEST_F(TrackerTest, AJoinedChainKeepsTheIdentitiesOfItsParts) {
  const Chain left = line({20, 50}, {80, 50});
  const Chain down = line({82, 52}, {82, 120});
  see({left, down});
  const std::int64_t first = tracks_.edges[0].track;
  const std::int64_t second = tracks_.edges[1].track;
  ASSERT_NE(first, second);
  see({joined(left, down)});
  ASSERT_EQ(tracks_.runs.size(), 2U);
  EXPECT_EQ(at(0, 10), first);
  EXPECT_EQ(at(0, 100), second);
  EXPECT_EQ(tracks_.edges[0].track, second) << "the longer part's";
  see({left, down});
  EXPECT_EQ(tracks_.edges[0].track, first);
  EXPECT_EQ(tracks_.edges[1].track, second);
}

TEST_F(TrackerTest, BothHalvesOfACutEdgeKeepItsIdentity) {
  see({line({20, 50}, {150, 50})});
  see({line({20, 50}, {80, 50}), line({90, 50}, {150, 50})});
  EXPECT_EQ(tracks_.edges[0].track, 0);
  EXPECT_EQ(tracks_.edges[1].track, 0);
  see({line({20, 50}, {150, 50})});
  EXPECT_EQ(tracks_.runs.size(), 1U);
  EXPECT_EQ(tracks_.edges[0].track, 0);
}

TEST_F(TrackerTest, ANewChainIsCutAtItsCorners) {
  Chain chain = joined(line({20, 50}, {80, 50}), line({81, 51}, {81, 120}));
  chain.corners = {60};
  see({chain});
  ASSERT_EQ(tracks_.runs.size(), 2U);
  EXPECT_NE(tracks_.runs[0].track, tracks_.runs[1].track);
  EXPECT_EQ(tracks_.runs[0].edgels.count, 60U);
}

TEST_F(TrackerTest, ANewChainIsCutWhereItTurnsSharplyWithoutACorner) {
  see({joined(line({20, 50}, {80, 50}), line({81, 51}, {81, 120}))});
  EXPECT_EQ(tracks_.runs.size(), 2U);
  std::vector<Point> round;
  for (int i = 0; i < 100; ++i) {
    const float angle = static_cast<float>(i) * 0.05F;
    round.push_back({100 + 20 * std::cos(angle), 75 + 20 * std::sin(angle)});
  }
  TrackerTest::tracker_ = *Tracker::create();
  Chain circle;
  circle.points = round;
  see({circle});
  EXPECT_EQ(tracks_.runs.size(), 1U) << "a circle has no corner";
}

TEST_F(TrackerTest, ParallelEdgesOfOppositeSignDoNotSwap) {
  for (int i = 0; i < 10; ++i) {
    const auto x = static_cast<float>(50 + i);
    see({line({x, 20}, {x, 120}, 1), line({x + 3, 20}, {x + 3, 120}, -1)},
        i == 0 ? Motion{} : shift(i % 2 == 0 ? 3 : -1, 0));  // wrong by two pixels, either way
    EXPECT_EQ(tracks_.edges[0].track, 0) << i;
    EXPECT_EQ(tracks_.edges[1].track, 1) << i;
  }
}

TEST_F(TrackerTest, DoubtfulEdgesGetTheirIdentityAfterThreeFrames) {
  Chain doubtful = line({20, 50}, {100, 50});
  doubtful.z = 7;
  see({doubtful});
  EXPECT_EQ(tracks_.edges[0].track, -1);
  EXPECT_TRUE(tracks_.runs.empty());
  see({});
  see({doubtful});
  EXPECT_EQ(tracks_.edges[0].track, -1);
  see({doubtful});
  EXPECT_EQ(tracks_.edges[0].track, 0);
  EXPECT_EQ(tracks_.born, std::vector<std::int64_t>{0});
  EXPECT_EQ(tracks_.edges[0].age, 3);
}

TEST_F(TrackerTest, AnEdgeComesBackUnderItsIdentityForAWhile) {
  const Chain chain = line({20, 50}, {100, 50});
  see({chain});
  for (int i = 0; i < 10; ++i) {
    see({}, shift(1, 0));
    EXPECT_TRUE(tracks_.ended.empty());
  }
  see({line({31, 50}, {111, 50})}, shift(1, 0));
  EXPECT_EQ(tracks_.edges[0].track, 0);
  EXPECT_TRUE(tracks_.born.empty());
}

TEST_F(TrackerTest, AnEdgeThatIsLostEndsAndItsIdentityIsNotUsedAgain) {
  const Chain chain = line({20, 50}, {100, 50});
  see({chain});
  std::vector<EndedTrack> ended;
  for (int i = 0; i < 14; ++i) {
    see({});
    ended.insert(ended.end(), tracks_.ended.begin(), tracks_.ended.end());
  }
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].track, 0);
  EXPECT_EQ(ended[0].why, TrackEnd::kLost);
  see({chain});
  EXPECT_EQ(tracks_.edges[0].track, 1);
}

TEST_F(TrackerTest, AnOldEdgeIsWaitedForLonger) {
  const Chain chain = line({20, 50}, {100, 50});
  for (int i = 0; i < 90; ++i) {
    see({chain});
  }
  for (int i = 0; i < 60; ++i) {
    see({});
  }
  see({chain});
  EXPECT_EQ(tracks_.edges[0].track, 0);
}

TEST_F(TrackerTest, AnEdgeThatLeavesThePictureEnds) {
  see({line({5, 20}, {5, 120})});
  see({}, shift(-8, 0));
  ASSERT_EQ(tracks_.ended.size(), 1U);
  EXPECT_EQ(tracks_.ended[0].why, TrackEnd::kLeft);
}

TEST_F(TrackerTest, OneSmoothChainUnderTwoIdentitiesBecomesTheOlderOne) {
  see({line({20, 50}, {80, 50})});
  see({line({20, 50}, {80, 50}), line({100, 50}, {170, 50})});
  ASSERT_EQ(tracks_.edges[1].track, 1);
  std::vector<EndedTrack> ended;
  for (int i = 0; i < 8; ++i) {
    see({line({20, 50}, {170, 50})});
    ended.insert(ended.end(), tracks_.ended.begin(), tracks_.ended.end());
  }
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].track, 1);
  EXPECT_EQ(ended[0].why, TrackEnd::kMerged);
  EXPECT_EQ(ended[0].merged_into, 0);
  ASSERT_EQ(tracks_.runs.size(), 1U);
  EXPECT_EQ(tracks_.runs[0].track, 0);
}

TEST_F(TrackerTest, AcrossACornerIdentitiesStayApart) {
  Chain chain = joined(line({20, 50}, {80, 50}), line({81, 51}, {81, 120}));
  chain.corners = {60};
  for (int i = 0; i < 20; ++i) {
    see({chain});
    chain.corners = i % 2 == 0 ? std::vector<std::uint32_t>{} : std::vector<std::uint32_t>{60};
    EXPECT_EQ(tracks_.runs.size(), 2U) << i;
  }
}

TEST_F(TrackerTest, SmoothedPositionsAreCalmerThanMeasuredOnesAndDoNotLag) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.2F);
  double measured = 0;
  double smoothed = 0;
  double lag = 0;
  int count = 0;
  for (int i = 0; i < 60; ++i) {
    const float x = 40 + 0.8F * static_cast<float>(i);
    Chain chain = line({x, 20}, {x, 120});
    std::vector<float> errors;
    for (Point& point : chain.points) {
      errors.push_back(noise(random));
      point.x += errors.back();
    }
    see({chain});  // the motion is the edge's own
    for (std::size_t k = 0; i >= 20 && k < chain.points.size(); ++k) {
      measured += std::pow(errors[k], 2);
      smoothed += std::pow(tracks_.smooth_x[k] - x, 2);
      lag += tracks_.smooth_x[k] - x;
      ++count;
    }
  }
  EXPECT_EQ(tracks_.edges[0].track, 0);
  EXPECT_LT(std::sqrt(smoothed / measured), 0.65);
  EXPECT_LT(std::abs(lag / count), 0.05);
}

TEST_F(TrackerTest, NothingAgesInFramesThatTellNothing) {
  const Chain chain = line({20, 50}, {100, 50});
  see({chain});
  see({chain});
  for (int i = 0; i < 80; ++i) {
    tracker_.pass_over(frame_++ * kFrameNs, tracks_);
    EXPECT_TRUE(tracks_.track.empty());
    EXPECT_TRUE(tracks_.ended.empty());
  }
  see({chain});
  EXPECT_EQ(tracks_.edges[0].track, 0);
  EXPECT_EQ(tracks_.edges[0].age, 2);
}

TEST_F(TrackerTest, AFrameOfAnotherSizeEndsAllTracks) {
  see({line({20, 50}, {100, 50}), line({20, 90}, {100, 90})});
  Detection other = detection_of({line({20, 50}, {100, 50})}, frame_++);
  other.width = kWidth + 10;
  tracker_.update(other, shift(0, 0), tracks_);
  EXPECT_EQ(tracks_.ended.size(), 2U);
  EXPECT_EQ(tracks_.edges[0].track, 2);
}

TEST_F(TrackerTest, EachFrameGoesOnFromItsStampNotFromTheNumberOfFrames) {
  // 0.15 s are two frames of a camera of 10 Hz.
  const Chain chain = line({20, 50}, {100, 50});
  const auto at_ms = [&](const std::vector<Chain>& chains, std::int64_t ms) {
    Detection detection = detection_of(chains, 0);
    detection.stamp_ns = ms * 1'000'000;
    tracker_.update(detection, shift(0, 0), tracks_);
  };
  at_ms({chain}, 0);
  for (const std::int64_t ms : {100, 200}) {
    at_ms({}, ms);
    EXPECT_TRUE(tracks_.ended.empty()) << ms;
  }
  at_ms({}, 300);
  EXPECT_EQ(tracks_.ended.size(), 1U);
}

TEST_F(TrackerTest, MemoryStaysFlat) {
  std::size_t memory = 0;
  for (int i = 0; i < 600; ++i) {
    const auto y = static_cast<float>(20 + i % 100);
    see({line({20, y}, {100, y}), line({120, y}, {180, y})}, shift(0, 40));  // always new edges
    if (i == 300) {
      memory = tracker_.memory_bytes();
    }
  }
  EXPECT_GT(memory, 0U);
  EXPECT_LE(tracker_.memory_bytes(), memory * 11 / 10);
}

TEST(TrackerOptions, OutOfRangeAreErrorsThatNameThem) {
  TrackerOptions options;
  options.coast_s = -1;
  const auto tracker = Tracker::create(options);
  ASSERT_FALSE(tracker);
  EXPECT_NE(tracker.error().message.find("tracker.coast_s"), std::string::npos);
}

}  // namespace
}  // namespace thermedge
