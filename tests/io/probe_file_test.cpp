// The report as JSON and the suggestions as TOML.
#include "thermedge/io/probe_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/recordings.hpp"
#include "thermedge/io/config.hpp"

namespace thermedge::io {
namespace {

using Json = nlohmann::json;

constexpr double kDigits = 1e-5;  // numbers have six

RecordingReport report_of(const std::string& scene) {
  RecordingProbe recording;
  for (const Image<std::uint16_t>& frame : test::scene_frames(scene)) {
    EXPECT_TRUE(recording.add(frame));
  }
  return recording.report();
}

TEST(ProbeFile, JsonHasWhatIsPromised) {
  const auto report = report_of("sim:desk?frames=3&width=96&height=72");
  const Json json = Json::parse(probe_to_json(report, {"a", "b"}));
  EXPECT_EQ(json["inputs"], Json({"a", "b"}));
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["width"], 96);
  EXPECT_NEAR(json["noise"]["sigma_counts"], report.sigma_counts,
              kDigits * std::abs(report.sigma_counts));
  EXPECT_NEAR(json["noise"]["sigma_degc"], 0.01 * report.sigma_counts,
              kDigits * std::abs(0.01 * report.sigma_counts));
  EXPECT_NEAR(json["range"]["mean_degc"], 0.01 * report.range_counts,
              kDigits * std::abs(0.01 * report.range_counts));
  EXPECT_NEAR(json["noise"]["pixel_sigma_counts"], report.pixel_sigma_counts,
              kDigits * std::abs(report.pixel_sigma_counts));
  EXPECT_EQ(json["noise"]["kind"], "white");
  ASSERT_EQ(json["noise"]["spectrum"].size(), 8U);
  EXPECT_NEAR(json["noise"]["spectrum"][2][3], report.spectrum[8 * 2 + 3],
              kDigits * std::abs(report.spectrum[8 * 2 + 3]));
  EXPECT_TRUE(json["noise"]["fixed_pattern_share"].is_null());
  EXPECT_EQ(json["series"]["median_counts"].size(), 3U);
  EXPECT_EQ(json["column_profile_counts"].size(), 96U);
  EXPECT_EQ(json["row_profile_counts"].size(), 72U);
  EXPECT_EQ(json["noise_map"]["sigma_counts"].size(),
            json["noise_map"]["columns"].get<std::size_t>() *
                json["noise_map"]["rows"].get<std::size_t>());
  EXPECT_EQ(json["histogram"]["edges_counts"].size(), json["histogram"]["pixels"].size() + 1);
  for (const auto& entry : json["clipping"]) {
    EXPECT_EQ(entry["clipped_share"] == 0, report.clipped_share(entry["gain"]) < 5e-7);
  }
}

TEST(ProbeFile, JsonOfNoFramesIsValid) {
  EXPECT_TRUE(Json::accept(probe_to_json(RecordingProbe().report(), {"\xff"})));
}

// Every suggestion that there can be is taken by the detector and does what it says.
RecordingReport report_with_every_suggestion() {
  RecordingReport report;
  report.frames = 100;
  report.width = 160;
  report.height = 120;
  report.container_bits = 16;
  report.sigma_counts = report.pixel_sigma_counts = 9.64;
  report.frame_sigma_counts = 8;
  report.passing_bad_pixels = 30;
  report.row_sigma_counts = 2.1;
  report.clipping = {{0.5, 0.6}, {0.2, 0.3}, {0.1, 0.021}, {0.05, 0.001}, {0.02, 0}};
  report.preset = Preset::kPaper;
  report.suggested = suggest_options(report, report.preset);
  return report;
}

TEST(ProbeFile, SuggestionsAreTakenByTheDetector) {
  const auto report = report_with_every_suggestion();
  ASSERT_EQ(report.suggested.size(), 5U);
  // Of the presets, `paper` has none of the suggested values already.
  const DetectorOptions before = DetectorOptions(Preset::kPaper);
  DetectorOptions options = before;
  const Status status =
      parse_config(suggested_toml(report), "probe.toml", PresetChoice::kFree, options);
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(options.paper()->grey_scale.gain, 0.05);
  EXPECT_EQ(options.denoise.sigma_counts, 9.6);
  EXPECT_EQ(options.bad_pixels.threshold_sigmas, 12);
  EXPECT_EQ(options.paper()->contours.min_component_px, 21);
  EXPECT_TRUE(options.stripes.remove);
  EXPECT_NE(before.paper()->grey_scale.gain, 0.05);
  EXPECT_NE(before.denoise.sigma_counts, 9.6);
  EXPECT_NE(before.bad_pixels.threshold_sigmas, 12);
  EXPECT_NE(before.paper()->contours.min_component_px, 21);
  EXPECT_FALSE(before.stripes.remove);
  EXPECT_TRUE(options.check());
  DetectorOptions set = before;
  for (const SuggestedOption& option : report.suggested) {
    EXPECT_TRUE(apply_setting(option.name + "=" + option.value, set)) << option.name;
  }
  EXPECT_EQ(dump_config(set), dump_config(options));
}

// The noise model of these presets has a map.
TEST(ProbeFile, RobustAndFastAreToldNoSigma) {
  const auto report = report_with_every_suggestion();
  for (const Preset preset : {Preset::kRobust, Preset::kFast}) {
    for (const SuggestedOption& option : suggest_options(report, preset)) {
      EXPECT_NE(option.name, "denoise.sigma_counts");
    }
  }
}

TEST(ProbeFile, WithoutSuggestionsTheTomlIsStillRead) {
  RecordingReport report = report_with_every_suggestion();
  report.suggested.clear();
  report.preset = Preset::kRobust;
  DetectorOptions options;
  ASSERT_TRUE(parse_config(suggested_toml(report), "probe.toml", PresetChoice::kFree, options));
  EXPECT_EQ(dump_config(options), dump_config(DetectorOptions{}));
}

struct GainCase {
  std::string name;
  double sigma;
  std::vector<GainClipping> clipping;
  std::string gain;  // empty: none suggested
};

class SuggestedGain : public testing::TestWithParam<GainCase> {};

TEST_P(SuggestedGain, IsTheFinestThatClipsLittle) {
  RecordingReport report;
  report.width = 640;
  report.height = 512;
  report.container_bits = 16;
  report.sigma_counts = report.pixel_sigma_counts = GetParam().sigma;
  report.frame_sigma_counts = GetParam().sigma;
  report.clipping = GetParam().clipping;
  const auto options = suggest_options(report, Preset::kPaper);
  EXPECT_EQ(options.empty() ? "" : options[0].value, GetParam().gain);
}

TEST(SuggestedOptions, TuningSaysHowMuchMayBeClipped) {
  RecordingReport report;
  report.container_bits = 16;
  report.sigma_counts = report.pixel_sigma_counts = report.frame_sigma_counts = 5;
  report.width = 640;
  report.height = 512;
  report.clipping = {{1, 0.4}, {0.5, 0.16}, {0.2, 0.01}, {0.1, 0}};
  const auto options = suggest_options(report, Preset::kPaper, {.most_clipped_share = 0.005});
  ASSERT_FALSE(options.empty());
  EXPECT_EQ(options[0].value, "0.1");
}

INSTANTIATE_TEST_SUITE_P(
    All, SuggestedGain,
    testing::Values(
        GainCase{"default_suits", 5, {{1, 0.1}, {0.5, 0.01}, {0.2, 0}}, ""},
        GainCase{"wide_range", 5, {{1, 0.4}, {0.5, 0.16}, {0.2, 0.01}, {0.1, 0}}, "0.2"},
        GainCase{"too_wide_for_any", 5, {{1, 0.9}, {0.5, 0.9}, {0.2, 0.9}}, ""},
        GainCase{"quiet_camera", 0.5, {{10, 0}, {5, 0}, {2, 0}, {1, 0}, {0.5, 0}}, "5"},
        GainCase{"quiet_but_wide", 0.5, {{10, 0.9}, {5, 0.5}, {2, 0.1}, {1, 0}, {0.5, 0}}, "1"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace thermedge::io
