// The figures of an evaluator in Python and C++ that reproduces the published results of the
// Berkeley benchmark (gPb-ucm .7274, published .7263), on maps made here.
#include <gtest/gtest.h>

#include "support/edge_maps.hpp"
#include "support/files.hpp"
#include "thermedge/eval/evaluate.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::eval {
namespace {

constexpr int kFrames = 6;
constexpr int kAnnotators = 3;
constexpr double kMaxDistance = 0.02;

Image<std::uint8_t> found_map(int frame) {
  const int walks = frame == 4 ? 0 : 9 + frame;  // one frame is empty
  return test::random_edge_map(96 + 8 * frame, 72 - 4 * frame, walks, 1 + frame % 3,
                               100U + static_cast<unsigned>(frame));
}

Image<std::uint8_t> true_map(int frame, int annotator) {
  const auto seed = static_cast<unsigned>(frame);
  const auto base =
      test::random_edge_map(96 + 8 * frame, 72 - 4 * frame, 9 + frame, 1, 100U + seed);
  return test::annotated(base.view(), annotator - 1 + (frame == 2 ? 1 : 0), annotator % 2,
                         seed * 10 + static_cast<unsigned>(annotator));
}

using Counts = std::vector<MatchCounts>;

// At thresholds 1, 64, 128, 192: true pixels matched, true, found matched, found.
const std::vector<Counts>& thinned_each() {
  static const std::vector<Counts> counts{
      {{438, 440, 164, 189}, {433, 440, 160, 160}, {314, 440, 115, 115}, {155, 440, 55, 55}},
      {{283, 283, 115, 159}, {280, 283, 114, 119}, {201, 283, 81, 84}, {154, 283, 61, 62}},
      {{572, 587, 223, 243}, {557, 587, 215, 226}, {354, 587, 133, 136}, {141, 587, 53, 54}},
      {{637, 642, 240, 266}, {632, 642, 235, 235}, {419, 642, 158, 158}, {245, 642, 93, 93}},
      {{0, 462, 0, 0}, {0, 462, 0, 0}, {0, 462, 0, 0}, {0, 462, 0, 0}},
      {{730, 757, 283, 320}, {721, 757, 271, 280}, {552, 757, 205, 209}, {291, 757, 102, 103}}};
  return counts;
}

const std::vector<Counts>& nested() {
  static const std::vector<Counts> counts{
      {{438, 440, 158, 189}, {433, 440, 155, 160}, {314, 440, 113, 115}, {155, 440, 55, 55}},
      {{272, 283, 105, 149}, {268, 283, 103, 112}, {190, 283, 72, 80}, {153, 283, 58, 62}},
      {{545, 587, 216, 255}, {542, 587, 214, 242}, {356, 587, 137, 150}, {155, 587, 59, 65}},
      {{637, 642, 234, 266}, {632, 642, 231, 235}, {413, 642, 152, 156}, {239, 642, 89, 91}},
      {{0, 462, 0, 0}, {0, 462, 0, 0}, {0, 462, 0, 0}, {0, 462, 0, 0}},
      {{651, 757, 262, 327}, {646, 757, 260, 290}, {486, 757, 194, 213}, {274, 757, 109, 110}}};
  return counts;
}

TEST(GoldenEvaluation, CountsAreTheSame) {
  const std::vector<int> thresholds{1, 64, 128, 192};
  for (int frame = 0; frame < kFrames; ++frame) {
    TruthMaps truth;
    for (int annotator = 0; annotator < kAnnotators; ++annotator) {
      truth.annotators.push_back(true_map(frame, annotator));
    }
    const auto map = found_map(frame);
    for (const bool thin : {true, false}) {
      const auto counts = count_matches(map.view(), truth, thresholds, {kMaxDistance, thin});
      ASSERT_TRUE(counts) << counts.error().message;
      EXPECT_EQ(*counts, (thin ? thinned_each() : nested())[static_cast<std::size_t>(frame)])
          << "frame " << frame << (thin ? "" : ", nested");
    }
  }
}

struct Figures {
  bool thin;
  int at;
  double f, threshold, precision, recall, ois, ap, merit, merit_best;
  double edge_pixels, fragments, median, weighted_median, short_share, short_px, spurs;
};

constexpr Figures kFigures[] = {
    {true, 0, 0.9001634428382472, 59, 0.9749759384023099, 0.8360138757489751, 0.9005020768238193,
     0.8201293334199491, 0.7442747178164991, 0.7695230859141805, 173.16666666666666,
     139.5572666025024, 2, 14, 0.7655172413793103, 0.2502406159769009, 17.324350336862366},
    {false, 0, 0.859225075557931, 62, 0.9274116523400191, 0.8003784295175024, 0.8595928262898593,
     0.767266374466827, 0.7447520210439169, 0.7701708794636581, 171.66666666666666,
     140.7766990291262, 2, 15, 0.7655172413793103, 0.25145631067961166, 16.50485436893204},
    {true, 100, 0.8079949306196018, 100, 0.9842615012106537, 0.685272784610533, -1, -1,
     0.6833699660658459, 0.7040755295715715, 137.66666666666666, 151.3317191283293, 2, 15, 0.776,
     0.27239709443099275, 10.895883777239709},
};

TEST(GoldenEvaluation, FiguresAreTheSame) {
  const test::TemporaryDirectory directory;
  std::filesystem::create_directories(directory / "found");
  std::filesystem::create_directories(directory / "truth");
  const auto write = [&](const std::string& name, const Image<std::uint8_t>& map) {
    ASSERT_TRUE(io::write_picture(directory / name, ImageView<const std::uint8_t>(map.view())));
  };
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::string name = "f" + std::to_string(frame);
    write("found/" + name + ".png", found_map(frame));
    for (int annotator = 0; annotator < kAnnotators; ++annotator) {
      write("truth/" + name + "_" + std::to_string(annotator) + ".png", true_map(frame, annotator));
    }
  }
  const auto found = PredictionSet::open(directory / "found");
  const auto truth = GroundTruthSet::open(directory / "truth", {});
  ASSERT_TRUE(found && truth);
  for (const Figures& expected : kFigures) {
    EvaluationOptions options;
    options.count = {kMaxDistance, expected.thin};
    options.at = expected.at;
    const auto result = evaluate(*found, *truth, options, *make_runner(2));
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(result->errors.empty());
    EXPECT_EQ(result->frames, static_cast<std::size_t>(kFrames));
    const Scores& scores = result->scores;
    const StructureSummary& structure = result->structure;
    constexpr double kSame = 1e-6;
    EXPECT_NEAR(scores.f, expected.f, kSame);
    EXPECT_NEAR(scores.threshold, expected.threshold, kSame);
    EXPECT_NEAR(scores.precision, expected.precision, kSame);
    EXPECT_NEAR(scores.recall, expected.recall, kSame);
    if (expected.at == 0) {
      EXPECT_NEAR(scores.ois, expected.ois, kSame);
      EXPECT_NEAR(scores.ap, expected.ap, kSame);
    }
    EXPECT_NEAR(result->merit.mean, expected.merit, kSame);
    EXPECT_NEAR(result->merit.best, expected.merit_best, kSame);
    EXPECT_NEAR(structure.edge_pixels, expected.edge_pixels, kSame);
    EXPECT_NEAR(structure.fragments_per_1000_px, expected.fragments, kSame);
    EXPECT_NEAR(structure.median_contour_px, expected.median, kSame);
    EXPECT_NEAR(structure.weighted_median_contour_px, expected.weighted_median, kSame);
    EXPECT_NEAR(structure.short_fragments, expected.short_share, kSame);
    EXPECT_NEAR(structure.short_fragments_px, expected.short_px, kSame);
    EXPECT_NEAR(structure.spurs_per_1000_px, expected.spurs, kSame);
  }
}

}  // namespace
}  // namespace thermedge::eval
