// What holds for the whole detector on any frame.
#include "thermedge/detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "support/images.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

sim::TrueFrame small_desk(double sigma_counts) {
  sim::SceneOptions scene;
  scene.camera.width = 192;
  scene.camera.height = 144;
  scene.camera.sigma_counts = sigma_counts;
  auto frame = sim::render(scene, 0);
  EXPECT_TRUE(frame) << frame.error().message;
  return std::move(*frame);
}

Detector detector(const DetectorOptions& options) {
  auto made = Detector::create(options);
  EXPECT_TRUE(made);
  return std::move(*made);
}

// The whole result as text, without the times.
std::string fingerprint(const Detection& detection) {
  const std::string json = io::edges_to_json(detection, "");
  return json.substr(0, json.find("\"stats\""));
}

// For all thread counts and SIMD targets, on a frame with more than three kept edges.
void expect_the_same_everywhere(DetectorOptions options) {
  const auto frame = small_desk(20);
  std::string expected;
  test::for_each_simd_target([&](const std::string&) {
    for (const int threads : {1, 2, 5}) {
      options.threads = threads;
      Detector one = detector(options);
      const auto detection = one.detect(frame.counts);
      ASSERT_TRUE(detection);
      ASSERT_GT(detection->edges.kept, 3U);
      const std::string found = fingerprint(*detection);
      expected = expected.empty() ? found : expected;
      EXPECT_EQ(found, expected) << threads << " threads";
    }
  });
}

void expect_all_sizes_taken(const DetectorOptions& options, int smallest, int largest) {
  Detector one = detector(options);
  for (int height = smallest; height <= largest; height += 3) {
    for (int width = smallest; width <= largest; ++width) {
      const auto frame = test::noise_image<std::uint16_t>(width, height, 3000, 100, 5);
      const auto detection = one.detect(frame);
      ASSERT_TRUE(detection) << width << "x" << height << ": " << detection.error().message;
    }
  }
}

class EveryDenoiser : public testing::TestWithParam<DenoiseMethod> {};

TEST_P(EveryDenoiser, GivesTheSameEdgesForAllThreadCountsAndSimdTargets) {
  DetectorOptions options = DetectorOptions(Preset::kPaper);
  options.denoise.method = GetParam();
  options.paper()->contours.min_component_px = 10;
  expect_the_same_everywhere(options);
}

INSTANTIATE_TEST_SUITE_P(All, EveryDenoiser,
                         testing::Values(DenoiseMethod::kNone, DenoiseMethod::kGaussian,
                                         DenoiseMethod::kNlm, DenoiseMethod::kBm3d),
                         [](const auto& method) {
                           return std::string(
                               kDenoiseMethods[static_cast<std::size_t>(method.param)].name);
                         });

TEST(RobustDetector, GivesTheSameEdgesForAllThreadCountsAndSimdTargets) {
  expect_the_same_everywhere(DetectorOptions(Preset::kRobust));
  expect_the_same_everywhere(DetectorOptions(Preset::kFast));
}

// Offsets of columns and rows, dead pixels, and corners darker by `vignetting`.
void spoil(Image<std::uint16_t>& frame, double stripe_sigma, double vignetting,
           std::mt19937& random) {
  std::normal_distribution<double> normal(0, stripe_sigma);
  std::vector<double> columns(static_cast<std::size_t>(frame.width()));
  std::generate(columns.begin(), columns.end(), [&] { return normal(random); });
  for (int y = 0; y < frame.height(); ++y) {
    const double row = 0.75 * normal(random);
    for (int x = 0; x < frame.width(); ++x) {
      const double far = std::hypot(2.0 * x / frame.width() - 1, 2.0 * y / frame.height() - 1);
      const double shade = vignetting * far * far / 2;
      frame(x, y) = static_cast<std::uint16_t>(
          std::lround(frame(x, y) + row + columns[static_cast<std::size_t>(x)] - shade));
    }
  }
  frame(100, 50) = 0;
  frame(201, 151) = 16383;
}

// One false edge in ten frames is what max_false_alarms asks for.
class Presets : public testing::TestWithParam<Preset> {};

TEST_P(Presets, FindNothingInNoise) {
  std::mt19937 random(11);
  Detector one = detector(DetectorOptions(GetParam()));
  std::size_t found = 0;
  constexpr int kFrames = 90;
  for (int i = 0; i < kFrames; ++i) {
    const double sigma = std::pow(100, i / (kFrames - 1.0));  // 1 to 100 counts
    auto frame =
        test::noise_image<std::uint16_t>(382, 288, 8000, sigma, 40 + static_cast<unsigned>(i));
    if (i % 3 != 0) {
      spoil(frame, sigma / 3, i % 3 == 1 ? 0 : 5 * sigma, random);
    }
    found += one.detect(frame)->edges.kept;
  }
  EXPECT_LE(found, kFrames / 10U);
}

INSTANTIATE_TEST_SUITE_P(OfCountsInNoise, Presets, testing::Values(Preset::kRobust, Preset::kFast),
                         [](const auto& test) { return std::string(preset_name(test.param)); });

// The pixels of the kept edges.
std::set<std::pair<float, float>> kept_pixels(const EdgeSet& set) {
  std::set<std::pair<float, float>> pixels;
  for (const Edge& edge : set.kept_edges()) {
    for (std::uint32_t i = 0; i < edge.edgels.count; ++i) {
      const std::size_t at = edge.edgels.first + i;
      pixels.emplace(std::floor(set.edgels.x[at] + 0.5F), std::floor(set.edgels.y[at] + 0.5F));
    }
  }
  return pixels;
}

// Counts are whole numbers, also when stripes have been removed, so a gain changes the noise a
// little; an offset changes nothing.
TEST(RobustDetector, IsBlindToOffsetAndGainOfTheCounts) {
  const auto frame = small_desk(6);
  Detector one = detector(DetectorOptions(Preset::kRobust));
  const auto changed = [&](int gain, int offset) {
    Image<std::uint16_t> counts(frame.counts.width(), frame.counts.height());
    for (int y = 0; y < counts.height(); ++y) {
      for (int x = 0; x < counts.width(); ++x) {
        counts(x, y) = static_cast<std::uint16_t>(gain * frame.counts(x, y) + offset);
      }
    }
    return kept_pixels(one.detect(counts)->edges);
  };
  const auto first = changed(1, 0);
  const auto with_offset = changed(1, 1000);
  const auto with_gain = changed(4, 0);
  const auto common = [&](const std::set<std::pair<float, float>>& other) {
    return static_cast<double>(std::count_if(
        other.begin(), other.end(), [&](const auto& pixel) { return first.contains(pixel); }));
  };
  ASSERT_GT(first.size(), 500U);
  EXPECT_GE(common(with_offset), 0.99 * static_cast<double>(first.size()));
  EXPECT_GE(common(with_gain), 0.93 * static_cast<double>(first.size()));
}

TEST(RobustDetector, TakesEveryFrameFromEightPixelsUp) {
  expect_all_sizes_taken(DetectorOptions(Preset::kRobust), 8, 26);
}

TEST(RobustDetector, SaysWhyEdgesWereDropped) {
  const auto frame = small_desk(20);
  DetectorOptions options = DetectorOptions(Preset::kRobust);
  options.selection.keep_edges = 3;
  options.selection.min_score = 1.5;
  options.selection.max_false_alarms = 1e-6;
  Detector one = detector(options);
  const EdgeSet set = one.detect(frame.counts)->edges;
  ASSERT_EQ(set.kept, 3U);
  for (std::size_t i = 0; i < set.edges.size(); ++i) {
    const Edge& edge = set.edges[i];
    const bool weak = edge.score < 1.5;
    const bool insignificant = edge.log10_nfa > -6;
    EXPECT_EQ(edge.status, i < 3           ? EdgeStatus::kKept
                           : weak          ? EdgeStatus::kWeak
                           : insignificant ? EdgeStatus::kInsignificant
                                           : EdgeStatus::kBeyondBudget);
    EXPECT_EQ(edge.kept, i < 3);
  }
}

TEST(Detector, GivesTheSameForAFrameAgain) {
  const auto frame = small_desk(6);
  const auto other = test::noise_image<std::uint16_t>(192, 144, 3000, 50, 1);
  Detector one = detector({});
  const std::string first = fingerprint(*one.detect(frame.counts));
  ASSERT_TRUE(one.detect(other));
  EXPECT_EQ(fingerprint(*one.detect(frame.counts)), first);
}

// Both between 4096 and 8192 counts, where floats are equally fine.
TEST(Detector, IsBlindToAnOffsetOfTheCounts) {
  const auto frame = small_desk(6);
  Detector one = detector({});
  const auto with_offset = [&](int offset) {
    Image<std::uint16_t> counts(frame.counts.width(), frame.counts.height());
    for (int y = 0; y < counts.height(); ++y) {
      for (int x = 0; x < counts.width(); ++x) {
        counts(x, y) = static_cast<std::uint16_t>(frame.counts(x, y) + offset);
      }
    }
    return fingerprint(*one.detect(counts));
  };
  EXPECT_EQ(with_offset(4000), with_offset(2300));
}

TEST(Detector, KeepsBudgetsAndRanks) {
  const auto frame = small_desk(6);
  DetectorOptions options = DetectorOptions(Preset::kPaper);
  options.paper()->contours.min_component_px = 0;
  options.selection.keep_edges = 5;
  Detector one = detector(options);
  const auto detection = one.detect(frame.counts);
  ASSERT_TRUE(detection);
  const EdgeSet& set = detection->edges;
  ASSERT_GT(set.edges.size(), 5U);
  EXPECT_EQ(set.kept, 5U);
  for (std::size_t i = 0; i < set.edges.size(); ++i) {
    EXPECT_EQ(set.edges[i].rank, static_cast<int>(i));
    EXPECT_EQ(set.edges[i].kept, i < set.kept);
    if (i > 0) {
      EXPECT_LE(set.edges[i].score, set.edges[i - 1].score);
    }
  }
}

TEST(Detector, TakesEveryFrameFromOnePixelUp) {
  expect_all_sizes_taken(DetectorOptions(Preset::kPaper), 1, 20);
}

TEST(Detector, FindsNothingInAFlatFrame) {
  Image<std::uint16_t> flat(100, 80);
  for (const int level : {0, 3000, 65535}) {
    fill_pixels(flat.view(), static_cast<std::uint16_t>(level));
    Detector one = detector({});
    const auto detection = one.detect(flat);
    ASSERT_TRUE(detection);
    EXPECT_TRUE(detection->edges.edges.empty());
  }
}

// Without noise, slopes come as terraces one count high. Only the wall is an edge.
TEST(RobustDetector, FindsNoTerracesInARoundedSlope) {
  Image<std::uint16_t> slope(192, 144);
  for (int y = 0; y < slope.height(); ++y) {
    for (int x = 0; x < slope.width(); ++x) {
      const double wall = x > 170 ? 120 : 0;
      slope(x, y) = static_cast<std::uint16_t>(std::lround(3000 + 0.04 * x + 0.03 * y + wall));
    }
  }
  Detector one = detector(DetectorOptions(Preset::kRobust));
  EXPECT_EQ(one.detect(slope)->edges.kept, 1U);
}

TEST(Detector, TakesAViewIntoALargerBuffer) {
  const auto frame = small_desk(6);
  Image<std::uint16_t> buffer(300, 200);
  fill_pixels(buffer.view(), std::uint16_t{65535});
  const auto window = buffer.view().crop(17, 23, frame.counts.width(), frame.counts.height());
  copy_pixels(frame.counts.view(), window);
  Detector one = detector({});
  const std::string first = fingerprint(*one.detect(frame.counts));
  EXPECT_EQ(fingerprint(*one.detect(window)), first);
}

TEST(Detector, TraceOfItsOwnEdgeMapGivesItsEdges) {
  const auto frame = small_desk(6);
  Detector one = detector(DetectorOptions(Preset::kPaper));
  Detector other = detector(DetectorOptions(Preset::kPaper));
  Detection detected;
  Intermediates steps;
  ASSERT_TRUE(one.detect(frame.counts, detected, {&steps, {}}));
  const Detection traced = *other.trace(steps.edge_map);
  ASSERT_EQ(detected.edges.edges.size(), traced.edges.edges.size());
  EXPECT_EQ(detected.edges.edgels.x, traced.edges.edgels.x);
  EXPECT_EQ(detected.edges.edgels.y, traced.edges.edgels.y);
  EXPECT_EQ(detected.edges.corners, traced.edges.corners);
}

TEST(Detector, RefusesBadInputWithOneLine) {
  DetectorOptions options(Preset::kPaper);
  options.paper()->canny.low_over_high = std::numeric_limits<double>::quiet_NaN();
  const auto made = Detector::create(options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "canny.low_over_high = nan is out of range: 0 to 1");

  Detector one = detector({});
  const auto nothing = one.detect(ImageView<const std::uint16_t>());
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().message, "frame: it has no pixels");
}

TEST(Detector, TakesFramesOfEveryPixelType) {
  const auto frame = small_desk(20);
  Detector one = detector({});
  const Detection wanted = *one.detect(frame.counts);
  ASSERT_GT(wanted.edges.kept, 3U);
  Image<float> counts(frame.counts.width(), frame.counts.height());
  copy_pixels(frame.counts.view(), counts.view());
  EXPECT_EQ(fingerprint(*one.detect(counts)), fingerprint(wanted)) << "whole floats are counts";

  // In degC, with a range of a few degrees: the same edges, their contrast in degC.
  constexpr float kDegcPerCount = 0.01F;
  Image<float> degc(counts.width(), counts.height());
  for (int y = 0; y < degc.height(); ++y) {
    for (int x = 0; x < degc.width(); ++x) {
      degc(x, y) = kDegcPerCount * counts(x, y) - 40;
    }
  }
  const Detection found = *one.detect(degc);
  EXPECT_NEAR(found.sigma_counts, kDegcPerCount * wanted.sigma_counts,
              0.02 * kDegcPerCount * wanted.sigma_counts);
  EXPECT_NEAR(static_cast<double>(found.edges.kept), static_cast<double>(wanted.edges.kept), 2);
  EXPECT_NEAR(found.edges.edges[0].contrast_counts,
              kDegcPerCount * wanted.edges.edges[0].contrast_counts, 0.02);
}

// What is asked for in the unit of a float frame is what the result says in that unit.
TEST(Detector, TheSmallestContrastIsInTheUnitOfTheFrame) {
  const auto frame = small_desk(20);
  Image<float> degc(frame.counts.width(), frame.counts.height());
  for (int y = 0; y < degc.height(); ++y) {
    for (int x = 0; x < degc.width(); ++x) {
      degc(x, y) = 0.01F * static_cast<float>(frame.counts(x, y)) - 40;
    }
  }
  DetectorOptions options;
  const Detection all = *detector(options).detect(degc);
  const double least = all.kept_edges()[all.edges.kept / 2].contrast_counts;
  ASSERT_LT(least, 40) << "degrees";
  options.selection.min_contrast.value = least;
  const Detection strong = *detector(options).detect(degc);
  const auto expected =
      std::count_if(all.kept_edges().begin(), all.kept_edges().end(),
                    [&](const Edge& edge) { return edge.contrast_counts >= least; });
  EXPECT_NEAR(static_cast<double>(strong.edges.kept), static_cast<double>(expected), 1);
  EXPECT_LT(strong.edges.kept, all.edges.kept);
  for (const Edge& edge : strong.kept_edges()) {
    EXPECT_GE(edge.contrast_counts, 0.999999 * least);
  }
}

// A tenth of the frame is far colder than the rest, a fifth far hotter; 8-bit frames and preset
// robust know no Algorithm 1.
TEST(Detector, PresetPaperTellsWhatAlgorithm1Clips) {
  Image<std::uint16_t> frame(100, 50);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 100; ++x) {
      frame(x, y) = static_cast<std::uint16_t>(x < 10 ? 2000 : x < 80 ? 3000 + x % 3 : 4000);
    }
  }
  DetectorOptions options(Preset::kPaper);
  Detector paper = detector(options);
  const ClippedShares clipped = paper.detect(frame)->clipped;
  EXPECT_DOUBLE_EQ(clipped.low, 0.1);
  EXPECT_DOUBLE_EQ(clipped.high, 0.2);
  Image<std::uint8_t> valid(100, 50);
  fill_pixels(valid.view(), std::uint8_t{1});
  for (int y = 0; y < 50; ++y) {
    std::fill_n(valid.row(y) + 90, 10, std::uint8_t{0});
  }
  Frame masked(frame);
  masked.valid = valid;
  EXPECT_NEAR(paper.detect(masked)->clipped.high, 10.0 / 90, 1e-12);
  EXPECT_EQ(paper.detect(Frame(frame.view(), 8))->clipped.both(), 0);
  options.paper()->grey_scale.gain = 0.1;
  EXPECT_EQ(detector(options).detect(frame)->clipped.both(), 0);
  EXPECT_EQ(detector({}).detect(frame)->clipped.both(), 0);
}

TEST(Detector, InvalidPixelsMakeNoEdges) {
  const auto frame = small_desk(20);
  Image<float> holed(frame.counts.width(), frame.counts.height());
  copy_pixels(frame.counts.view(), holed.view());
  Image<std::uint8_t> valid(holed.width(), holed.height());
  fill_pixels(valid.view(), std::uint8_t{1});
  Image<std::uint16_t> masked = frame.counts.clone();
  for (int y = 40; y < 90; ++y) {
    for (int x = 60; x < 130; ++x) {
      holed(x, y) = std::numeric_limits<float>::quiet_NaN();
      valid(x, y) = 0;
      masked(x, y) = 65535;
    }
  }
  Frame with_mask(masked);
  with_mask.valid = valid.view();
  for (const Preset preset : {Preset::kRobust, Preset::kPaper}) {
    Detector one = detector(DetectorOptions(preset));
    const Detection by_nan = *one.detect(holed);
    const Detection by_mask = *one.detect(with_mask);
    ASSERT_GT(by_nan.edges.kept, 0U);
    EXPECT_EQ(fingerprint(by_nan), fingerprint(by_mask));
    for (const Edge& edge : by_nan.kept_edges()) {
      for (const auto [x, y] : by_nan.points(edge)) {
        EXPECT_FALSE(x > 60 && x < 129 && y > 40 && y < 89) << x << ", " << y;
      }
    }
  }
}

TEST(Detector, HandsOnWhatTheSourceKnows) {
  const auto counts = test::noise_image<std::uint16_t>(64, 48, 3000, 50, 1);
  Frame frame(counts);
  frame.stamp_ns = 123456789;
  frame.index = 42;
  frame.flags = kFrameAfterLoss;
  const Detection found = *detector({}).detect(frame);
  EXPECT_EQ(found.stamp_ns, 123456789);
  EXPECT_EQ(found.index, 42);
  EXPECT_EQ(found.flags, kFrameAfterLoss);
}

TEST(Detector, StopsBetweenStages) {
  const auto counts = test::noise_image<std::uint16_t>(64, 48, 3000, 50, 1);
  std::stop_source stop;
  Detector one = detector({});
  Detection found;
  ASSERT_TRUE(one.detect(counts, found, {nullptr, stop.get_token()}));
  stop.request_stop();
  const Status status = one.detect(counts, found, {nullptr, stop.get_token()});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(status.error().message, "detection was cancelled after correct");
}

TEST(Detector, RunsOnTheCallersRunnerAndOutlivesNoResult) {
  const auto frame = small_desk(20);
  const auto runner = make_runner(3);
  auto one = Detector::create({}, *runner);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->threads(), runner->threads());
  Detection found;
  ASSERT_TRUE(one->detect(frame.counts, found));
  one = Detector::create({});  // the first detector is gone, its result is not
  EXPECT_EQ(fingerprint(found), fingerprint(*one->detect(frame.counts)));
}

TEST(Detector, ReportsItsMemory) {
  for (const auto& preset : kPresets) {
    Detector one = detector(DetectorOptions(preset.value));
    const auto small = test::noise_image<std::uint16_t>(96, 72, 3000, 50, 1);
    const auto large = test::noise_image<std::uint16_t>(192, 144, 3000, 50, 1);
    ASSERT_TRUE(one.detect(small));
    const std::size_t of_small = one.memory_bytes();
    EXPECT_GT(of_small, 10 * small.size());  // at least some float pictures
    ASSERT_TRUE(one.detect(large));
    const std::size_t of_large = one.memory_bytes();
    EXPECT_GT(of_large, 2 * of_small);
    EXPECT_LT(of_large, 1200 * large.size());
    ASSERT_TRUE(one.detect(large));
    EXPECT_EQ(one.memory_bytes(), of_large);
  }
}

TEST(Detector, EachHasItsOwnInstructionSet) {
  const auto frame = small_desk(20);
  DetectorOptions options;
  options.simd = simd_targets().back();
  Detector slow = detector(options);
  const std::string found = fingerprint(*slow.detect(frame.counts));
  EXPECT_EQ(SimdScope::current().name(), simd_targets().front());
  EXPECT_EQ(fingerprint(*detector({}).detect(frame.counts)), found);
  options.simd = "magic";
  EXPECT_FALSE(Detector::create(options));
}

}  // namespace
}  // namespace thermedge
