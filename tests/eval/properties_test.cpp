// What must hold for any set of maps: runners, perfect and useless results, thresholds.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/edge_maps.hpp"
#include "support/files.hpp"
#include "support/images.hpp"
#include "support/runners.hpp"
#include "thermedge/eval/evaluate.hpp"
#include "thermedge/eval/thinning.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::eval {
namespace {

class EvaluationProperty : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"found", "truth"}) {
      std::filesystem::create_directories(directory_ / name);
    }
    for (unsigned i = 0; i < 7; ++i) {
      const std::string name = "/f" + std::to_string(i) + ".png";
      const auto map = test::random_edge_map(80, 60, 8, 1 + static_cast<int>(i % 2), i);
      write("found" + name, map.view());
      write("truth" + name, test::annotated(map.view(), 1, 0, i).view());
    }
  }

  void write(const std::string& name, ImageView<const std::uint8_t> map) {
    const Status status = io::write_picture(directory_ / name, map);
    ASSERT_TRUE(status) << status.error().message;
  }
  PredictionSet found(const std::string& name = "found") const {
    return *PredictionSet::open(directory_ / name);
  }
  GroundTruthSet truth() const { return *GroundTruthSet::open(directory_ / "truth", {}); }

  test::TemporaryDirectory directory_;
};

TEST_F(EvaluationProperty, IsTheSameForEveryRunner) {
  std::string with_truth;
  std::string alone;
  for (const auto& runner : test::all_runners()) {
    const auto result = evaluate(found(), truth(), {}, *runner);
    ASSERT_TRUE(result) << result.error().message;
    const std::string json = evaluation_to_json(*result, "a", "b");
    with_truth = with_truth.empty() ? json : with_truth;
    EXPECT_EQ(json, with_truth);

    const auto lone = evaluate_without_truth(found(), {}, *runner);
    ASSERT_TRUE(lone) << lone.error().message;
    const std::string lone_json = evaluation_to_json(*lone, "a");
    alone = alone.empty() ? lone_json : alone;
    EXPECT_EQ(lone_json, alone);
  }
}

TEST_F(EvaluationProperty, TruthItselfIsPerfect) {
  for (unsigned i = 0; i < 7; ++i) {
    // Thin, so that thinning takes nothing away.
    auto map = test::annotated(test::random_edge_map(80, 60, 8, 1, i).view(), 0, 0, i);
    thin(map);
    for (int y = 0; y < map.height(); ++y) {
      std::transform(map.row(y), map.row(y) + map.width(), map.row(y),
                     [](std::uint8_t v) { return static_cast<std::uint8_t>(v != 0 ? 255 : 0); });
    }
    write("truth/f" + std::to_string(i) + ".png", map.view());
  }
  const auto runner = make_runner(1);
  const auto result = evaluate(found("truth"), truth(), {}, *runner);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_TRUE(result->binary);
  EXPECT_EQ(result->scores.f, 1);
  EXPECT_EQ(result->merit.mean, 1);
}

TEST_F(EvaluationProperty, TellsItsProgress) {
  for (const auto& runner : test::all_runners()) {
    std::vector<std::size_t> done;
    EvaluationOptions options;
    options.progress = [&](std::size_t frames, std::size_t all) {
      EXPECT_EQ(all, 7U);
      done.push_back(frames);
    };
    ASSERT_TRUE(evaluate(found(), truth(), options, *runner));
    EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7, 1, 2, 3, 4, 5, 6, 7}));
  }
}

// More pixels never lower the recall of nested maps, and one-to-one pairs never exceed either side.
TEST_F(EvaluationProperty, CountsAreConsistent) {
  const std::vector<int> thresholds = spread_thresholds(40);
  for (unsigned i = 0; i < 7; ++i) {
    const auto map = test::random_edge_map(80, 60, 8, 2, i);
    TruthMaps maps;
    maps.annotators.push_back(test::annotated(map.view(), 1, 1, i));
    for (const bool thin : {true, false}) {
      const auto counts = count_matches(map.view(), maps, thresholds, {0.02, thin});
      ASSERT_TRUE(counts);
      for (std::size_t t = 0; t < thresholds.size(); ++t) {
        const MatchCounts& c = (*counts)[t];
        EXPECT_EQ(c.truth_matched, c.found_matched);
        EXPECT_LE(c.truth_matched, std::min(c.truth, c.found));
        if (!thin && t > 0) {
          EXPECT_LE(c.found, (*counts)[t - 1].found);
          EXPECT_LE(c.truth_matched, (*counts)[t - 1].truth_matched);
        }
      }
      // Thresholds don't influence each other.
      const auto single =
          count_matches(map.view(), maps, std::vector<int>{thresholds[20]}, {0.02, thin});
      EXPECT_EQ((*single)[0].found, (*counts)[20].found);
      EXPECT_EQ((*single)[0].truth_matched, (*counts)[20].truth_matched);
    }
  }
}

TEST_F(EvaluationProperty, FramesThatFailAreLeftOutAndNamed) {
  test::write_text(directory_ / "found/f2.png", "rubbish");
  const auto other = test::random_edge_map(40, 60, 8, 1, 3);
  write("truth/f4.png", other.view());
  std::filesystem::remove(directory_ / "truth/f6.png");
  const auto runner = make_runner(2);
  const auto result = evaluate(found(), truth(), {}, *runner);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->frames, 4U);
  ASSERT_EQ(result->errors.size(), 3U);
  EXPECT_NE(result->errors[0].message.find("found/f2.png"), std::string::npos);
  EXPECT_EQ(result->errors[1].message, "f4: 80x60 pixels, but its truth has 40x60");
  EXPECT_NE(result->errors[2].message.find("truth/f6: no truth there"), std::string::npos);

  // The others are judged as if those had never been there.
  for (const char* name : {"found/f2.png", "found/f4.png", "found/f6.png"}) {
    std::filesystem::remove(directory_ / name);
  }
  const auto without = evaluate(found(), truth(), {}, *runner);
  ASSERT_TRUE(without);
  EXPECT_EQ(without->scores.f, result->scores.f);
  EXPECT_EQ(without->merit.mean, result->merit.mean);
  EXPECT_EQ(without->structure.fragments_per_1000_px, result->structure.fragments_per_1000_px);
}

TEST_F(EvaluationProperty, OptionsOutOfRangeAreNamed) {
  const auto runner = make_runner(1);
  const auto message = [&](auto&& change) {
    EvaluationOptions options;
    change(options);
    const auto result = evaluate(found(), truth(), options, *runner);
    EXPECT_FALSE(evaluate_without_truth(found(), options, *runner));
    return result ? std::string() : result.error().message;
  };
  EXPECT_EQ(message([](auto& o) { o.count.max_distance = 0.2; }),
            "max_distance should be 0 to 0.1 of the diagonal");
  EXPECT_EQ(message([](auto& o) { o.count.max_distance = std::nan(""); }),
            "max_distance should be 0 to 0.1 of the diagonal");
  EXPECT_EQ(message([](auto& o) { o.thresholds = 0; }), "thresholds should be 1 to 254");
  EXPECT_EQ(message([](auto& o) { o.at = 256; }), "at should be 1 to 255, or 0 for a sweep");
  EXPECT_EQ(message([](auto& o) { o.short_px = 0; }), "short_px should be 1 to 10000");
  EXPECT_EQ(message([](auto& o) { o.sigma_counts = -1; }), "sigma_counts should be 0 to 65535");
  EXPECT_EQ(message([](auto& o) { o.repeat_reach_px = 0; }),
            "repeat_reach_px should be above 0, up to 100");
  EXPECT_EQ(message([](auto& o) { o.most_shift_px = 65; }), "most_shift_px should be 0 to 64");
}

}  // namespace
}  // namespace thermedge::eval
