// How sure edges are, on steps, slopes, ramps and noise whose truth is known.
#include "thermedge/stages/significance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "support/edge_sets.hpp"
#include "support/images.hpp"
#include "thermedge/stages/scoring.hpp"

namespace thermedge {
namespace {

using test::noise_image;

constexpr int kWidth = 240;
constexpr int kHeight = 200;
constexpr double kSigma = 8;

using Points = std::vector<std::pair<float, float>>;

Points along_column(int x, int y_begin, int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(static_cast<float>(x), static_cast<float>(y_begin + i));
  }
  return points;
}

Points along_row(int x_begin, int y, int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(static_cast<float>(x_begin + i), static_cast<float>(y));
  }
  return points;
}

// clean(x, y) and white noise of `sigma`.
template <class F>
Image<std::uint16_t> frame_of(double sigma, F&& clean, unsigned seed = 3) {
  const auto noise = noise_image<double>(kWidth, kHeight, 8000, 1, seed);
  Image<std::uint16_t> frame(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(
          std::lround(8000 + sigma * (noise(x, y) - 8000) + clean(x, y)));
    }
  }
  return frame;
}

// What the oriented filter leaves behind: edges along columns whose warmer side lies at larger x,
// no sure edge anywhere.
struct Pixels {
  Pixels(int width, int height)
      : response(width, height),
        suppressed(width, height),
        direction(width, height),
        edges(width, height) {
    fill_pixels(response.view(), 1.0F);
    fill_pixels(suppressed.view(), 0.2F);
    fill_pixels(direction.view(), 18);
    fill_pixels(edges.view(), std::uint8_t{0});
  }
  [[nodiscard]] OrientedFilterResult result() const {
    return {response, direction, suppressed, edges, {}};
  }
  Image<float> response, suppressed;
  Image<std::int32_t> direction;
  Image<std::uint8_t> edges;
};

NoiseModel noise_of(double level) {
  NoiseModel noise;
  noise.level_counts = level;
  return noise;
}

// The score of an edge whose mean suppressed response is this one.
void set_response(Edge& edge, double response) {
  edge.score = std::log(response) +
               ScoringTuning().length_weight * std::log(static_cast<double>(edge.edgels.count));
}

class Judged {
 public:
  explicit Judged(ImageView<const std::uint16_t> frame) : frame_(frame), pixels_(kWidth, kHeight) {}

  void add(const Points& points, double response = 0.19, bool closed = false) {
    Edge& edge = test::add_edge(set_, points);
    set_response(edge, response);
    edge.closed = closed;
  }
  const std::vector<Edge>& run(const NoiseModel& noise, ImageView<const std::uint8_t> valid = {},
                               const SignificanceTuning& tuning = {}) {
    SignificanceTest(tuning).run(frame_, noise, valid, pixels_.result(), set_, *make_runner(1));
    return set_.edges;
  }
  [[nodiscard]] Pixels& pixels() { return pixels_; }
  [[nodiscard]] const EdgeSet& set() const { return set_; }

 private:
  ImageView<const std::uint16_t> frame_;
  Pixels pixels_;
  EdgeSet set_;
};

Edge judged(ImageView<const std::uint16_t> frame, const Points& points, const NoiseModel& noise) {
  Judged one(frame);
  one.add(points);
  return one.run(noise).front();
}

double step_at(int x, int at, double counts) { return x < at ? 0 : x == at ? counts / 2 : counts; }

// Of the same step, measured where the noise is as strong as its level, and where it is twice that.
TEST(Significance, ContrastInSigmasIsThatOverTheNoiseOfThePlace) {
  const auto frame = frame_of(kSigma, [](int x, int) { return step_at(x, 120, 40); });
  NoiseModel noise = noise_of(kSigma);
  Image<float> nodes(2, 2);
  nodes(0, 0) = nodes(1, 0) = 1;
  nodes(0, 1) = nodes(1, 1) = 2;
  noise.map.set_nodes(nodes, kWidth, kHeight);
  const Edge above = judged(frame, along_column(120, 0, 4), noise);
  const Edge below = judged(frame, along_column(120, kHeight - 4, 4), noise);
  EXPECT_NEAR(above.contrast_sigmas, above.contrast_counts / kSigma, 1e-9);
  EXPECT_NEAR(below.contrast_sigmas, below.contrast_counts / (2 * kSigma), 1e-9);
  // Whatever its length: that is what z is for.
  const Edge longer = judged(frame, along_column(120, 40, 120), noise_of(kSigma));
  EXPECT_NEAR(longer.contrast_sigmas, 5, 0.5);
  EXPECT_GT(longer.z, 20);
  EXPECT_TRUE(std::isinf(judged(frame, along_column(120, 40, 60), NoiseModel{}).contrast_sigmas));
}

// The contrast is known, and so is its spread: .4375 of white noise's variance for each edgel, and
// a part of the slope's that is small where none is found.
TEST(Significance, OfAClearStepIsItsContrastOverTheNoise) {
  const auto frame = frame_of(kSigma, [](int x, int) { return step_at(x, 120, 40); });
  for (const int count : {30, 60, 120}) {
    const Edge edge = judged(frame, along_column(120, 40, count), noise_of(kSigma));
    EXPECT_NEAR(edge.contrast_counts, 40, 4 * kSigma * std::sqrt(0.4375 / count));
    const double z = 40 / kSigma * std::sqrt(count / 0.9375);
    EXPECT_GT(edge.z, 0.75 * z);
    EXPECT_LT(edge.z, 1.6 * z);
    EXPECT_LT(edge.log10_nfa, -30);
  }
}

TEST(Significance, PointsNormalsToTheWarmerSide) {
  for (const double height : {40.0, -40.0}) {
    const auto frame = frame_of(kSigma, [&](int x, int) { return step_at(x, 120, height); });
    Judged one(frame);
    one.add(along_column(120, 40, 60));
    EXPECT_GT(one.run(noise_of(kSigma)).front().contrast_counts, 0);
    for (std::size_t i = 0; i < 60; ++i) {
      EXPECT_EQ(one.set().edgels.nx[i], height > 0 ? 1.0F : -1.0F);
    }
  }
}

// An edge between a thing and surroundings that are colder here and warmer there.
TEST(Significance, FollowsTheFilterWhereTheWarmerSideChanges) {
  const auto frame =
      frame_of(0, [](int x, int y) { return y < 70 ? step_at(x, 120, 40) : -step_at(x, 120, 40); });
  Judged one(frame);
  one.add(along_column(120, 40, 60));
  fill_pixels(one.pixels().direction.view().crop(0, 70, kWidth, kHeight - 70), 6);
  EXPECT_NEAR(one.run(noise_of(kSigma)).front().contrast_counts, 40, 2);
  EXPECT_EQ(one.set().edgels.nx[5], 1.0F);
  EXPECT_EQ(one.set().edgels.nx[55], -1.0F);
}

TEST(Significance, ASlopeIsNoEdge) {
  for (const double slope : {2.0, 10.0, -10.0}) {
    const auto frame = frame_of(kSigma, [=](int x, int) { return slope * (x - 120); });
    const Edge edge = judged(frame, along_column(120, 40, 100), noise_of(kSigma));
    EXPECT_NEAR(edge.contrast_counts, std::abs(slope) * 6.2, 4);
    EXPECT_LT(edge.z, 3) << "contrast of " << std::abs(slope) * 6 / kSigma * 10 / 0.7 << " sigma";
    EXPECT_GT(edge.log10_nfa, -1);
  }
}

TEST(Significance, TuningSaysHowFarOutContrastIsTaken) {
  const auto slope = frame_of(0, [](int x, int) { return 4 * (x - 120); });
  for (const auto& [nearest, farthest, span] : {std::tuple{2.5, 3.5, 6}, {2.5, 4.5, 7}}) {
    Judged one(slope);
    one.add(along_column(120, 40, 70));
    SignificanceTuning tuning;
    tuning.contrast = {.nearest_px = nearest, .farthest_px = farthest};
    // With what might be blur.
    EXPECT_NEAR(one.run(noise_of(5), {}, tuning).front().contrast_counts, 1.06 * 4 * span, 1e-9);
  }
}

// 3 counts per px on the warm side, none on the other: a knee. From 1.5 to 4.5 px its contrast is 9
// counts, all of it made by the ramp, of which three quarters may be taken off.
TEST(Significance, ARampOnOneSideExplainsAtMostItsShare) {
  const double most = SideSlopeTuning{}.most_of_ramp;
  const auto knee = frame_of(0, [](int x, int) { return 3.0 * std::max(x - 120, 0); });
  Judged by_default(knee);
  by_default.add(along_column(120, 40, 100));
  const Edge edge = by_default.run(noise_of(1)).front();
  EXPECT_NEAR(edge.contrast_counts, 1.06 * 9, 1e-9);  // with what might be blur
  SignificanceTuning none;
  none.slopes.most_of_ramp = 0;
  Judged unexplained(knee);
  unexplained.add(along_column(120, 40, 100));
  const double z = unexplained.run(noise_of(1), {}, none).front().z;
  // The noise of the slope counts in full where a slope is found: by root 2/3.
  EXPECT_NEAR(edge.z / z, (1 - most) * std::sqrt(2.0 / 3), 1e-9);
}

TEST(Significance, ARampOnEitherSideIsTheSame) {
  const auto warm = frame_of(0, [](int x, int) { return 3.0 * std::max(x - 120, 0); });
  const auto cold = frame_of(0, [](int x, int) { return 3.0 * std::min(x - 120, 0); });
  const Edge a = judged(warm, along_column(120, 40, 100), noise_of(1));
  const Edge b = judged(cold, along_column(120, 40, 100), noise_of(1));
  EXPECT_NEAR(a.z, b.z, 1e-6 * a.z);
  EXPECT_GT(a.z, 0);
}

// Offsets of columns, half as strong as the noise: they look like edges along columns.
TEST(Significance, IsLessAlongWhatNoiseGoesOnAlong) {
  const auto offsets = noise_image<double>(kWidth, 1, 0, kSigma / 2, 5);
  const auto clean = [](int x, int y) { return x > 120 && y > 100 ? 40 : 0; };
  const auto white = frame_of(kSigma, clean);
  const auto striped = frame_of(kSigma, [&](int x, int y) { return clean(x, y) + offsets(x, 0); });
  const auto z = [&](ImageView<const std::uint16_t> frame, const Points& points) {
    Judged one(frame);
    one.add(points);
    if (points[0].first != points[1].first) {
      fill_pixels(one.pixels().direction.view(), 0);  // along rows, warmer at larger y
    }
    // Nothing is measured near the edges themselves.
    for (int i = 0; i < 100; ++i) {
      if (120 + i < kWidth) {
        one.pixels().edges(120 + i, 100) = 255;
        one.pixels().suppressed(120 + i, 100) = 5;
      }
      if (100 + i < kHeight) {
        one.pixels().edges(120, 100 + i) = 255;
        one.pixels().suppressed(120, 100 + i) = 5;
      }
    }
    return one.run(noise_of(kSigma)).front().z;
  };
  const Points column = along_column(120, 110, 64);
  const Points row = along_row(130, 100, 64);
  EXPECT_LT(z(striped, column), 0.7 * z(white, column));
  EXPECT_NEAR(z(striped, row) / z(white, row), 1, 0.2);
}

// Columns of nodes on both sides of the middle, so that the level changes between them.
NoiseModel half_of_twice(double level) {
  NoiseModel noise = noise_of(level);
  Image<float> nodes(24, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 24; ++x) {
      nodes(x, y) = x < 12 ? 1.0F : 2.0F;
    }
  }
  noise.map.set_nodes(nodes, kWidth, kHeight);
  return noise;
}

TEST(Significance, IsHalvedWhereTheNoiseIsTwiceAsStrong) {
  const auto frame = frame_of(0, [](int x, int) { return x % 60 < 30 ? 0 : 40; });
  // Without noise in the frame the spread is the least that is believed, on both sides.
  Judged both(frame);
  both.add(along_column(30, 60, 60));
  both.add(along_column(210, 60, 60));
  const auto& edges = both.run(half_of_twice(kSigma));
  EXPECT_NEAR(edges[0].contrast_counts, edges[1].contrast_counts, 1e-9);
  EXPECT_NEAR(edges[1].z, edges[0].z / 2, 1e-3 * edges[0].z);
  EXPECT_LT(edges[0].log10_nfa, edges[1].log10_nfa);
}

TEST(Significance, OfNoiseItselfIsThatOfANormalVariable) {
  const auto frame = frame_of(
      kSigma, [](int, int) { return 0; }, 9);
  Judged many(frame);
  for (int x = 20; x < kWidth - 20; x += 4) {
    for (int y = 20; y + 20 < kHeight - 20; y += 20) {
      many.add(along_column(x, y, 20));
    }
  }
  double squares = 0;
  const auto& edges = many.run(noise_of(kSigma));
  for (const Edge& edge : edges) {
    EXPECT_GT(edge.log10_nfa, -1);
    squares += edge.z * edge.z;
  }
  const double spread = std::sqrt(squares / static_cast<double>(edges.size()));
  EXPECT_GT(spread, 0.6) << "slopes take off some of it";
  EXPECT_LT(spread, 1.2);
}

// By as much contrast for each edgel.
TEST(Significance, LongerEdgesAreLessLikelyFalse) {
  const auto frame = frame_of(0, [](int x, int) { return step_at(x, 120, 4); });
  double before = std::numeric_limits<double>::infinity();
  for (const int count : {20, 40, 80, 120}) {
    const Edge edge = judged(frame, along_column(120, 30, count), noise_of(kSigma));
    EXPECT_LT(edge.log10_nfa, before) << count;
    before = edge.log10_nfa;
  }
}

// The numbers of one edge, by the formula: NFA = n p (1 + x + x^2 / 2), p = e^-x.
double expected_log10_nfa(const Edge& edge, double response) {
  const NoiseEdgeTuning own;
  const double candidates = kWidth * kHeight / own.px_per_candidate;
  const double climb = (edge.z - own.climb * std::sqrt(edge.edgels.count)) / own.deviation;
  const double tail = 0.5 * std::erfc(climb / std::numbers::sqrt2);
  double x = -std::log(tail);
  if (climb >= own.least_climb) {
    x += (edge.edgels.count - own.shortest) / own.mean_length;
    x += std::max(std::log(response) - own.log_response, 0.0) / (2 * own.log_response_excess);
  }
  return std::log10(candidates * std::exp(-x) * (1 + x + x * x / 2));
}

TEST(Significance, IsTheNumberOfSuchEdgesOfNoise) {
  const auto frame = frame_of(kSigma, [](int x, int) { return step_at(x, 120, 8); });
  for (const int count : {10, 20, 40}) {
    for (const double response : {0.1, 0.25, 0.4}) {
      Judged one(frame);
      one.add(along_column(120, 40, count), response);
      const Edge edge = one.run(noise_of(kSigma)).front();
      const double climb = (edge.z - 0.55 * std::sqrt(count)) / 0.8;
      ASSERT_GT(climb, 0) << "counts as no edge of noise";
      ASSERT_LT(climb, 8) << "the tail below has a number";
      EXPECT_NEAR(edge.log10_nfa, expected_log10_nfa(edge, response), 2e-3) << count;
    }
  }
}

// Less contrast than noise of its length has: length and response say nothing then.
TEST(Significance, LengthProvesNothingBelowTheNoise) {
  const auto frame = frame_of(0, [](int x, int) { return x < 120 ? 0 : 1; });
  Judged two(frame);
  two.add(along_column(119, 40, 100), 0.19);
  two.add(along_column(119, 40, 100), 5);
  const auto& edges = two.run(noise_of(kSigma));
  ASSERT_GT(edges[0].z, 0);
  ASSERT_LT((edges[0].z - 0.55 * std::sqrt(100)) / 0.8, -1);
  EXPECT_EQ(edges[0].log10_nfa, edges[1].log10_nfa);
  EXPECT_GT(edges[0].log10_nfa, -0.5);
}

TEST(Significance, ManyWeakCandidatesMakeAnEdgeLessSure) {
  const auto frame = frame_of(kSigma, [](int x, int) { return step_at(x, 120, 12); });
  const auto log10_nfa = [&](int weak) {
    Judged some(frame);
    some.add(along_column(120, 40, 20));
    for (int i = 0; i < weak; ++i) {
      // Noise far off, with hardly any contrast.
      some.add(along_column(20 + 2 * (i % 40), 20 + 12 * (i / 40), 10));
    }
    return some.run(noise_of(kSigma)).front().log10_nfa;
  };
  EXPECT_GT(log10_nfa(100), log10_nfa(0) + 1);
  EXPECT_GT(log10_nfa(400), log10_nfa(100) + 0.3);
}

TEST(Significance, WithoutNoiseEveryContrastIsCertain) {
  const auto frame = frame_of(0, [](int x, int) { return step_at(x, 120, 10); });
  Judged two(frame);
  two.add(along_column(120, 40, 60));
  two.add(along_column(60, 40, 60));
  const auto& edges = two.run(noise_of(0));
  EXPECT_EQ(edges[0].z, std::numeric_limits<double>::infinity());
  EXPECT_EQ(edges[0].log10_nfa, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(edges[1].contrast_counts, 0);
  EXPECT_EQ(edges[1].z, 0);
  EXPECT_TRUE(std::isfinite(edges[1].log10_nfa));
}

// A third of the frame is ten times as loud, which the map does not say.
TEST(Significance, LeavesInvalidAreasOutOfTheSpread) {
  const auto step = [](int x, int) { return step_at(x, 180, 20); };
  auto frame = frame_of(kSigma, step);
  const double quiet = judged(frame, along_column(180, 60, 60), noise_of(kSigma)).z;
  const auto loud = frame_of(10 * kSigma, step, 21);
  copy_pixels(loud.view().crop(0, 0, 100, kHeight), frame.view().crop(0, 0, 100, kHeight));
  Image<std::uint8_t> valid(kWidth, kHeight);
  fill_pixels(valid.view(), std::uint8_t{1});
  fill_pixels(valid.view().crop(0, 0, 116, kHeight), std::uint8_t{0});
  Judged masked(frame);
  masked.add(along_column(180, 60, 60));
  EXPECT_NEAR(masked.run(noise_of(kSigma), valid).front().z / quiet, 1, 0.3);
  EXPECT_LT(judged(frame, along_column(180, 60, 60), noise_of(kSigma)).z, 0.5 * quiet);
}

TEST(Significance, LeavesSureEdgesOutOfTheSpread) {
  // Steps of 200 counts every 40 px would be the noise otherwise.
  const auto frame = frame_of(kSigma, [](int x, int) { return x % 40 < 20 ? 0 : 200; });
  const auto z = [&](bool sure) {
    Judged one(frame);
    one.add(along_column(120, 60, 60));
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; x += 20) {
        one.pixels().edges(x, y) = 255;
        one.pixels().suppressed(x, y) = sure ? 5.0F : 0.2F;
      }
    }
    return one.run(noise_of(kSigma)).front().z;
  };
  EXPECT_GT(z(true), 2 * z(false));
}

TEST(Significance, AFrameFullOfStrongEdgesTellsItsNoiseByTheWeakest) {
  // Bands of 40 counts every 12 px are in all places but at the left, where the bands are 4 counts.
  const auto frame = frame_of(kSigma, [](int x, int) {
    return x / 6 % 2 == 0 ? 0 : x < 80 ? 4 : 40;
  });
  const auto z = [&](double least_measured) {
    Judged one(frame);
    one.add(along_column(120, 60, 60));
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; x += 6) {
        one.pixels().edges(x, y) = 255;
        one.pixels().suppressed(x, y) = x < 80 ? 1.0F : 3.0F;
      }
    }
    SignificanceTuning tuning;
    tuning.spread.least_measured = least_measured;
    return one.run(noise_of(kSigma), {}, tuning).front().z;
  };
  // A third is free of the strong ones; of two thirds, the bands are the noise.
  EXPECT_GT(z(0.25), 2 * z(0.9));
}

TEST(Significance, BesideTheBorderTheSlopeOfTheInnerSideCounts) {
  // A slope of 16 counts per px has a contrast of some 64 counts, 8 sigma, 3 px from the border.
  const auto frame = frame_of(kSigma, [](int x, int) { return 16 * x; });
  EXPECT_LT(judged(frame, along_column(3, 60, 80), noise_of(kSigma)).z, 4);
  EXPECT_LT(judged(frame, along_column(kWidth - 4, 60, 80), noise_of(kSigma)).z, 4);
  const auto step = frame_of(kSigma, [](int x, int) { return step_at(x, 4, 12); });
  EXPECT_GT(judged(step, along_column(4, 60, 80), noise_of(kSigma)).z, 8);
}

TEST(Significance, TheEdgeThatAnEndMeetsDoesNotCount) {
  // An edge of nothing runs for 60 px from 4 px beyond a step of 400 counts.
  const auto frame = frame_of(kSigma, [](int x, int y) { return x < 60 && y < 100 ? 400 : 0; });
  const auto z = [&](double trim) {
    Judged one(frame);
    one.add(along_row(56, 100, 64));
    SignificanceTuning tuning;
    tuning.contrast_trim = trim;
    return one.run(noise_of(kSigma), {}, tuning).front().z;
  };
  EXPECT_LT(z(0.1), 0.5 * z(0));
}

TEST(Significance, BesideAJumpOfTheLevelTheHigherOneCounts) {
  const auto frame = frame_of(kSigma, [](int x, int) { return step_at(x, 120, 16); });
  Image<float> nodes(10, 2);
  const auto z = [&](float right) {
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 10; ++x) {
        nodes(x, y) = x < 6 ? 1 : right;
      }
    }
    NoiseModel noise = noise_of(kSigma);
    noise.map.set_nodes(nodes, kWidth, kHeight);
    return judged(frame, along_column(120, 60, 60), noise).z;
  };
  EXPECT_NEAR(z(1.2F) / z(1.0001F), 1, 0.1);
  EXPECT_LT(z(4), 0.8 * z(1.0001F));
}

TEST(Significance, ARingMustStandOutFartherThanALine) {
  const auto frame = frame_of(
      kSigma, [](int x, int y) { return std::hypot(x - 120, y - 100) < 2.5 ? 3 * kSigma : 0; });
  Points ring;
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6;
    ring.emplace_back(static_cast<float>(120 + 2 * std::cos(angle)),
                      static_cast<float>(100 + 2 * std::sin(angle)));
  }
  const auto log10_nfa = [&](bool closed, double climb) {
    Judged one(frame);
    one.add(ring, 0.19, closed);
    for (std::size_t i = 0; i < ring.size(); ++i) {  // the middle is warmer
      const auto [x, y] = ring[i];
      one.pixels().direction(static_cast<int>(x), static_cast<int>(y)) =
          (static_cast<int>(i) * 2 + 6) % kEdgeDirections;
    }
    SignificanceTuning tuning;
    tuning.noise_edges.ring_climb = climb;
    return one.run(noise_of(kSigma), {}, tuning).front().log10_nfa;
  };
  const double usual = SignificanceTuning().noise_edges.ring_climb;
  EXPECT_GT(log10_nfa(true, usual), log10_nfa(true, 0) + 2);
  EXPECT_EQ(log10_nfa(false, usual), log10_nfa(false, 0));
}

TEST(Significance, SurvivesDegenerateEdges) {
  const auto noise = noise_image<std::uint16_t>(kWidth, kHeight, 8000, 8, 1);
  Judged odd(noise);
  for (const Points& points : {Points{{5, 5}}, Points{{5, 5}, {6, 5}}, Points{{0, 0}, {0, 1}},
                               Points{{239, 199}, {238, 199}, {237, 199}}}) {
    odd.add(points);
  }
  for (const Edge& edge : odd.run(noise_of(kSigma))) {
    EXPECT_TRUE(std::isfinite(edge.z));
    EXPECT_FALSE(std::isnan(edge.log10_nfa));
  }
  Judged none(noise);
  EXPECT_TRUE(none.run(noise_of(kSigma)).empty());
}

}  // namespace
}  // namespace thermedge
