#include "thermedge/io/config.hpp"

#include <gtest/gtest.h>

namespace thermedge::io {
namespace {

DetectorOptions unusual_options() {
  DetectorOptions options;
  options.threads = 3;
  options.nuc.bad_pixels = false;
  options.scale.gain = 1.0 / 3.0;
  options.denoise.method = DenoiseMethod::kNlm;
  options.denoise.bm3d.lambda = 3.1;
  options.contours.gap_px = 2;
  options.linking.gap_px = 0;
  options.selection.keep_edges = 0;
  return options;
}

TEST(Config, ReadsBackWhatItDumps) {
  const std::string text = dump_config(unusual_options());
  DetectorOptions options;
  const Status status = parse_config(text, "dump", options);
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(dump_config(options), text);
  EXPECT_EQ(options.scale.gain, 1.0 / 3.0);
  EXPECT_EQ(options.denoise.method, DenoiseMethod::kNlm);
  EXPECT_FALSE(options.nuc.bad_pixels);
}

TEST(Config, LeavesOptionsThatTheFileDoesNotName) {
  DetectorOptions options = unusual_options();
  ASSERT_TRUE(parse_config("[canny]\nlow_over_high = 0.5\n", "file", options));
  EXPECT_EQ(options.canny.low_over_high, 0.5);
  EXPECT_EQ(options.contours.gap_px, 2);
}

TEST(Config, TakesWholeNumbersForFractions) {
  DetectorOptions options;
  ASSERT_TRUE(parse_config("[linking]\ngap_px = 4\n", "file", options));
  EXPECT_EQ(options.linking.gap_px, 4.0);
}

struct BadConfig {
  std::string toml;
  std::string message;
};

class BadConfigs : public testing::TestWithParam<BadConfig> {};

TEST_P(BadConfigs, AreRefusedWithFileAndKeyAndChangeNothing) {
  DetectorOptions options = unusual_options();
  const std::string before = dump_config(options);
  const Status status = parse_config(GetParam().toml, "robot.toml", options);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, GetParam().message);
  EXPECT_EQ(dump_config(options), before);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadConfigs,
    testing::Values(
        BadConfig{"[canny]\nlow = 1\n", "robot.toml: line 2: unknown option canny.low"},
        BadConfig{"[cany]\n", "robot.toml: line 1: unknown option cany"},
        BadConfig{"[contours]\ngap_px = 1.5\n",
                  "robot.toml: line 2: contours.gap_px = 1.5 should be a whole number"},
        BadConfig{"[contours]\ngap_px = 99\n",
                  "robot.toml: contours.gap_px = 99 is out of range: 1 to 8"},
        BadConfig{"[paper_corners]\nend_points = 1\n",
                  "robot.toml: line 2: paper_corners.end_points = 1 should be true or false"},
        BadConfig{"[scale]\ngain = nan\n",
                  "robot.toml: scale.gain = nan is out of range: 1e-06 to 1000"},
        BadConfig{"[denoise]\nmethod = \"magic\"\n",
                  "robot.toml: line 2: denoise.method = 'magic' is none of none, gaussian, nlm, "
                  "bm3d"},
        BadConfig{"preset = \"magic\"\n",
                  "robot.toml: preset = 'magic' is none of robust, fast, paper"},
        BadConfig{"canny = 3\n", "robot.toml: line 1: canny should be a table of options"}));

TEST(Config, NamesTheLineOfWhatIsNotToml) {
  DetectorOptions options;
  const Status status = parse_config("[canny]\nlow_over_high = = 3\n", "robot.toml", options);
  ASSERT_FALSE(status);
  EXPECT_TRUE(status.error().message.starts_with("robot.toml: line 2: not TOML: "))
      << status.error().message;
}

TEST(Config, NamesAFileThatIsNotThere) {
  DetectorOptions options;
  const Status status = load_config("/nowhere/robot.toml", options);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "/nowhere/robot.toml: cannot be read as a configuration file");
}

TEST(Setting, SetsEachKindOfOption) {
  DetectorOptions options;
  EXPECT_TRUE(apply_setting("contours.gap_px=2", options));
  EXPECT_TRUE(apply_setting("linking.gap_px=0", options));
  EXPECT_TRUE(apply_setting("paper_corners.end_points=false", options));
  EXPECT_TRUE(apply_setting("denoise.method=gaussian", options));
  EXPECT_TRUE(apply_setting("denoise.bm3d.profile=fast", options));
  EXPECT_EQ(options.contours.gap_px, 2);
  EXPECT_EQ(options.linking.gap_px, 0.0);
  EXPECT_FALSE(options.paper_corners.end_points);
  EXPECT_EQ(options.denoise.method, DenoiseMethod::kGaussian);
  EXPECT_EQ(options.denoise.bm3d.profile, Bm3dProfile::kFast);
}

std::string setting_error(const std::string& setting) {
  DetectorOptions options;
  const Status status = apply_setting(setting, options);
  EXPECT_EQ(dump_config(options), dump_config(DetectorOptions{}));
  return status ? "" : status.error().message;
}

TEST(Setting, RefusesWhatIsNotAnOption) {
  EXPECT_EQ(setting_error("contours.gap_px"), "'contours.gap_px' should read stage.option=value");
  EXPECT_EQ(setting_error("magic=1"), "unknown option 'magic'; --dump-config lists all options");
  EXPECT_EQ(setting_error("link.gap_px=1"),
            "unknown option 'link.gap_px'; did you mean contours.gap_px, gap_closing.gap_px, "
            "linking.gap_px?");
  EXPECT_EQ(setting_error("contours.gap_px=two"), "contours.gap_px = two should be a whole number");
  EXPECT_EQ(setting_error("contours.gap_px=2x"), "contours.gap_px = 2x should be a whole number");
  EXPECT_EQ(setting_error("linking.gap_px=33"), "linking.gap_px = 33 is out of range: 0 to 32");
  EXPECT_EQ(setting_error("linking.gap_px=nan"), "linking.gap_px = nan is out of range: 0 to 32");
  EXPECT_EQ(setting_error("nuc.bad_pixels=yes"), "nuc.bad_pixels = yes should be true or false");
}

}  // namespace
}  // namespace thermedge::io
