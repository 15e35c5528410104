#include "thermedge/io/config.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace thermedge::io {
namespace {

DetectorOptions unusual_options() {
  DetectorOptions options(Preset::kPaper);
  options.threads = 3;
  options.bad_pixels.replace = false;
  options.paper()->grey_scale.gain = 1.0 / 3.0;
  options.denoise.method = DenoiseMethod::kNlm;
  options.denoise.nlm.patch_px = 5;
  options.paper()->contours.gap_px = 2;
  options.paper()->linking.gap_px = 0;
  options.selection.keep_edges = 0;
  return options;
}

TEST(Config, ReadsBackWhatItDumps) {
  const std::string text = dump_config(unusual_options());
  DetectorOptions options(Preset::kPaper);
  const Status status = parse_config(text, "dump", PresetChoice::kFree, options);
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(dump_config(options), text);
  EXPECT_EQ(options.paper()->grey_scale.gain, 1.0 / 3.0);
  EXPECT_EQ(options.denoise.method, DenoiseMethod::kNlm);
  EXPECT_FALSE(options.bad_pixels.replace);
}

TEST(Config, LeavesOptionsThatTheFileDoesNotName) {
  DetectorOptions options = unusual_options();
  ASSERT_TRUE(parse_config("[canny]\nlow_over_high = 0.5\n", "file", PresetChoice::kFree, options));
  EXPECT_EQ(options.paper()->canny.low_over_high, 0.5);
  EXPECT_EQ(options.paper()->contours.gap_px, 2);
}

TEST(Config, TakesWholeNumbersForFractions) {
  DetectorOptions options(Preset::kPaper);
  ASSERT_TRUE(parse_config("[linking]\ngap_px = 4\n", "file", PresetChoice::kFree, options));
  EXPECT_EQ(options.paper()->linking.gap_px, 4.0);
}

struct BadConfig {
  std::string toml;
  std::string message;
};

class BadConfigs : public testing::TestWithParam<BadConfig> {};

TEST_P(BadConfigs, AreRefusedWithFileAndKeyAndChangeNothing) {
  DetectorOptions options = unusual_options();
  const std::string before = dump_config(options);
  const Status status = parse_config(GetParam().toml, "robot.toml", PresetChoice::kFree, options);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, GetParam().message);
  EXPECT_EQ(dump_config(options), before);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadConfigs,
    testing::Values(
        BadConfig{"[canny]\nlow = 1\n",
                  "robot.toml: line 2: unknown option 'canny.low'; did you mean "
                  "canny.blur or canny.low_over_high?"},
        BadConfig{"[cany]\n", "robot.toml: line 1: unknown option 'cany'; did you mean canny?"},
        BadConfig{"[contours]\ngap_px = 1.5\n",
                  "robot.toml: line 2: contours.gap_px = 1.5 should be a whole number"},
        BadConfig{"[contours]\ngap_px = 99\n",
                  "robot.toml: contours.gap_px = 99 is out of range: 1 to 8"},
        BadConfig{"[corners]\nend_points = 1\n",
                  "robot.toml: line 2: corners.end_points = 1 should be true or false"},
        BadConfig{"[grey_scale]\ngain = nan\n",
                  "robot.toml: grey_scale.gain = nan is out of range: 1e-06 to 1000"},
        BadConfig{"[denoise]\nmethod = \"magic\"\n",
                  "robot.toml: line 2: denoise.method = 'magic' is none of none, gaussian, nlm, "
                  "bm3d"},
        BadConfig{"preset = \"magic\"\n",
                  "robot.toml: preset = 'magic' is none of robust, fast, paper"},
        BadConfig{"preset = 3\n",
                  "robot.toml: preset should be one of robust, fast, paper in quotes"},
        BadConfig{"canny = 3\n", "robot.toml: line 1: canny should be a table of options"}));

TEST(Config, NamesTheLineOfWhatIsNotToml) {
  DetectorOptions options(Preset::kPaper);
  const Status status =
      parse_config("[canny]\nlow_over_high = = 3\n", "robot.toml", PresetChoice::kFree, options);
  ASSERT_FALSE(status);
  EXPECT_TRUE(status.error().message.starts_with("robot.toml: line 2: not TOML: "))
      << status.error().message;
}

TEST(Config, NamesAFileThatIsNotThere) {
  DetectorOptions options(Preset::kPaper);
  const Status status = load_config("/nowhere/robot.toml", PresetChoice::kFree, options);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message,
            "/nowhere/robot.toml: no such file; should be a TOML file of options");
}

TEST(Setting, SetsEachKindOfOption) {
  DetectorOptions options(Preset::kPaper);
  EXPECT_TRUE(apply_setting("contours.gap_px=2", options));
  EXPECT_TRUE(apply_setting("linking.gap_px=0", options));
  EXPECT_TRUE(apply_setting("corners.end_points=false", options));
  EXPECT_TRUE(apply_setting("denoise.method=bm3d", options));
  EXPECT_TRUE(apply_setting("denoise.bm3d.profile=fast", options));
  EXPECT_EQ(options.paper()->contours.gap_px, 2);
  EXPECT_EQ(options.paper()->linking.gap_px, 0.0);
  EXPECT_FALSE(options.paper()->corners.end_points);
  EXPECT_EQ(options.denoise.method, DenoiseMethod::kBm3d);
  EXPECT_EQ(options.denoise.bm3d.profile, Bm3dProfile::kFast);
}

TEST(Setting, AContrastHasAUnit) {
  struct Case {
    std::string text;
    Quantity<ContrastUnit> read;
    std::string dumped;
  };
  for (const Case& given : {Case{"12", {12, ContrastUnit::kCounts}, "12"},
                            {"12counts", {12, ContrastUnit::kCounts}, "12"},
                            {"2.5 sigma", {2.5, ContrastUnit::kSigma}, "\"2.5sigma\""},
                            {"0.5degC", {0.5, ContrastUnit::kDegc}, "\"0.5degC\""},
                            {"0", {}, "0"}}) {
    DetectorOptions options;
    options.selection.degc_per_count = 0.01;
    ASSERT_TRUE(apply_setting("selection.min_contrast=" + given.text, options)) << given.text;
    EXPECT_EQ(options.selection.min_contrast, given.read) << given.text;
    const std::string dumped = dump_config(options);
    EXPECT_NE(dumped.find("\nmin_contrast = " + given.dumped + "  #"), std::string::npos) << dumped;
    DetectorOptions back;
    ASSERT_TRUE(parse_config(dumped, "dump", PresetChoice::kFree, back));
    EXPECT_EQ(back.selection.min_contrast, given.read) << given.text;
    EXPECT_EQ(dump_config(back), dumped);
    // In a file, as text or as a number.
    DetectorOptions from_file;
    const std::string in_quotes =
        "selection.degc_per_count = 1\nselection.min_contrast = \"" + given.text + "\"\n";
    ASSERT_TRUE(parse_config(in_quotes, "file", PresetChoice::kFree, from_file)) << given.text;
    EXPECT_EQ(from_file.selection.min_contrast, given.read) << given.text;
  }
}

TEST(Setting, RefusesAContrastThatIsNone) {
  for (const std::string text : {"", "sigma", "3 sigmas", "3sigma4", "3K", "three"}) {
    DetectorOptions options;
    const Status status = apply_setting("selection.min_contrast=" + text, options);
    ASSERT_FALSE(status) << text;
    EXPECT_EQ(status.error().message,
              "selection.min_contrast = '" + text +
                  "' should be a number of counts, or a number and one of the units counts, "
                  "sigma, degC");
    EXPECT_EQ(options.selection.min_contrast, Quantity<ContrastUnit>{});
  }
  DetectorOptions options;
  EXPECT_EQ(apply_setting("selection.min_contrast=-1sigma", options).error().message,
            "selection.min_contrast = -1 is out of range: 0 to 1e+09");
  EXPECT_EQ(
      parse_config("[selection]\nmin_contrast = true\n", "f.toml", PresetChoice::kFree, options)
          .error()
          .message,
      "f.toml: line 2: selection.min_contrast = 'true' should be a number of counts, or a "
      "number and one of the units counts, sigma, degC");
}

TEST(Options, OfContrastAreRefusedByPresetPaper) {
  DetectorOptions paper(Preset::kPaper);
  EXPECT_EQ(apply_setting("selection.min_contrast=3", paper).error().message,
            "unknown option 'selection.min_contrast': preset paper does not use it, preset robust "
            "does");
  EXPECT_EQ(dump_config(paper).find("min_contrast ="), std::string::npos);
  paper.selection.min_contrast = {3, ContrastUnit::kSigma};
  ASSERT_FALSE(paper.check());
  EXPECT_EQ(paper.check().error().option, "selection.min_contrast");
  EXPECT_EQ(paper.check().error().message,
            "selection.min_contrast is used with presets robust and fast only; the preset is "
            "paper");
  paper.selection.min_contrast = {};
  EXPECT_TRUE(paper.check());
  paper.selection.degc_per_count = 0.01;
  ASSERT_FALSE(paper.check());
  EXPECT_EQ(paper.check().error().option, "selection.degc_per_count");
}

std::string setting_error(const std::string& setting) {
  DetectorOptions options(Preset::kPaper);
  const Status status = apply_setting(setting, options);
  EXPECT_EQ(dump_config(options), dump_config(DetectorOptions(Preset::kPaper)));
  return status ? "" : status.error().message;
}

TEST(Setting, RefusesWhatIsNotAnOption) {
  EXPECT_EQ(setting_error("contours.gap_px"), "'contours.gap_px' should read stage.option=value");
  EXPECT_EQ(setting_error("magic=1"), "unknown option 'magic'; --dump-config lists all options");
  EXPECT_EQ(setting_error("link.gap_px=1"),
            "unknown option 'link.gap_px'; did you mean linking.gap_px?");
  EXPECT_EQ(setting_error("contours.gap_px=two"), "contours.gap_px = two should be a whole number");
  EXPECT_EQ(setting_error("contours.gap_px=2x"), "contours.gap_px = 2x should be a whole number");
  EXPECT_EQ(setting_error("linking.gap_px=33"), "linking.gap_px = 33 is out of range: 0 to 32");
  EXPECT_EQ(setting_error("linking.gap_px=nan"), "linking.gap_px = nan is out of range: 0 to 32");
  EXPECT_EQ(setting_error("bad_pixels.replace=yes"),
            "bad_pixels.replace = yes should be true or false");
}

TEST(Setting, RefusesAnOptionOfAnotherPresetAndNamesBoth) {
  DetectorOptions robust;
  EXPECT_EQ(
      apply_setting("canny.low_over_high=0.5", robust).error().message,
      "unknown option 'canny.low_over_high': preset robust does not use it, preset paper does");
  DetectorOptions paper(Preset::kPaper);
  EXPECT_EQ(
      apply_setting("graph.min_length_px=5", paper).error().message,
      "unknown option 'graph.min_length_px': preset paper does not use it, preset robust does");
  EXPECT_EQ(apply_setting("graph.min_length_px=5", paper).error().option, "graph.min_length_px");
}

TEST(Setting, CannotForgeThePreset) {
  DetectorOptions options;
  EXPECT_FALSE(apply_setting("preset=paper", options));
  EXPECT_EQ(options.preset(), Preset::kRobust);
}

TEST(Config, OfAFileForAnotherPresetOnlyItsChangesAreTaken) {
  DetectorOptions changed(Preset::kRobust);
  changed.selection.keep_edges = 9;
  changed.selection.min_contrast = {2.5, ContrastUnit::kSigma};
  changed.robust()->graph.min_length_px = 12;
  DetectorOptions options(Preset::kFast);
  ASSERT_TRUE(parse_config(dump_config(changed), "f.toml", PresetChoice::kFixed, options));
  DetectorOptions wanted(Preset::kFast);
  wanted.selection.keep_edges = 9;
  wanted.selection.min_contrast = {2.5, ContrastUnit::kSigma};
  wanted.robust()->graph.min_length_px = 12;
  EXPECT_EQ(dump_config(options), dump_config(wanted));

  DetectorOptions paper(Preset::kPaper);
  const Status status = parse_config(dump_config(changed), "f.toml", PresetChoice::kFixed, paper);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message,
            "f.toml: unknown option 'graph.min_length_px': preset paper does not use it, preset "
            "robust does");
  EXPECT_EQ(dump_config(paper), dump_config(DetectorOptions(Preset::kPaper)));

  ASSERT_TRUE(parse_config("preset = \"paper\"\n", "f.toml", PresetChoice::kFree, options));
  EXPECT_EQ(options.preset(), Preset::kPaper);
}

TEST(Config, ListsEveryOptionOnce) {
  const std::vector<OptionInfo> options = list_options();
  for (std::size_t i = 0; i < options.size(); ++i) {
    EXPECT_FALSE(options[i].help.empty()) << options[i].name;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NE(options[i].name, options[j].name);
    }
  }
  const auto find = [&](const std::string& name) {
    return *std::find_if(options.begin(), options.end(),
                         [&](const OptionInfo& option) { return option.name == name; });
  };
  EXPECT_EQ(find("denoise.method").choices,
            (std::vector<std::string>{"none", "gaussian", "nlm", "bm3d"}));
  EXPECT_EQ(find("denoise.method").value, "bm3d");
  EXPECT_EQ(find("bad_pixels.replace").choices, (std::vector<std::string>{"true", "false"}));
  EXPECT_EQ(find("canny.low_over_high").choices.size(), 0U);
}

TEST(Options, OfADenoiserThatIsNotTheChosenOneAreRefused) {
  DetectorOptions options;
  options.denoise.nlm.patch_px = 9;
  ASSERT_FALSE(options.check());
  EXPECT_EQ(options.check().error().message,
            "denoise.nlm.patch_px is used with denoise.method = \"nlm\" only; it is \"bm3d\"");
  options.denoise.method = DenoiseMethod::kNlm;
  EXPECT_TRUE(options.check());
}

TEST(Options, AtOddsWithEachOtherAreRefusedAtOnce) {
  DetectorOptions options;
  options.robust()->oriented_filter.high = 0.05;
  EXPECT_EQ(options.check().error().message, "oriented_filter.high must be at least low");
  options = DetectorOptions();
  options.denoise.method = DenoiseMethod::kNlm;
  options.denoise.nlm.patch_px = 6;
  EXPECT_EQ(options.check().error().message, "denoise.nlm.patch_px = 6: must be odd");
}

}  // namespace
}  // namespace thermedge::io
