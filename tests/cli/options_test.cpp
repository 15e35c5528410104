// Options of the program: what they change, which of them wins, and that they come back from a
// file.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/program.hpp"
#include "thermedge/simd.hpp"

namespace thermedge::test {
namespace {

constexpr const char* kScene = "'sim:desk?width=96&height=72'";

class Options : public ProgramTest {
 protected:
  [[nodiscard]] nlohmann::json edges(const std::string& arguments) const {
    const std::string line =
        output_of("detect " + std::string(kScene) + " -o - --quiet " + arguments);
    return nlohmann::json::parse(line, nullptr, false)["edges"];
  }
  static std::size_t edgels_of(const nlohmann::json& edges) {
    std::size_t edgels = 0;
    for (const auto& edge : edges) {
      edgels += edge["points"].size();
    }
    return edgels;
  }
};

// All options as --dump-config prints them give the same edges as those they came from.
TEST_F(Options, ADumpedConfigurationGivesTheSameEdges) {
  for (const std::string options :
       {"--denoise gaussian", "--preset fast --keep 4", "--min-contrast 15sigma",
        "--min-contrast 3degC --camera optris",
        "--preset paper --denoise gaussian --set contours.min_component_px=12 --set "
        "linking.gap_px=4.5",
        "--denoise none --sigma 4.25 --max-false-alarms 0.5 --set bad_pixels.threshold_sigmas=9"}) {
    write_text(path("robot.toml"), output_of("detect --dump-config " + options));
    const auto wanted = edges(options);
    EXPECT_FALSE(wanted.empty()) << options;
    EXPECT_EQ(edges("--config robot.toml"), wanted) << options;
  }
}

TEST_F(Options, EveryCommandWithOptionsDumpsWhatItReadsBack) {
  for (const std::string command : {"detect", "trace", "stages", "compare", "bench"}) {
    const std::string dumped = output_of(command + " --dump-config --preset fast --keep 5");
    EXPECT_NE(dumped.find("preset = \"fast\""), std::string::npos) << command;
    EXPECT_NE(dumped.find("keep_edges = 5"), std::string::npos) << command;
    write_text(path("robot.toml"), dumped);
    EXPECT_EQ(output_of(command + " --dump-config --config robot.toml"), dumped) << command;
  }
  const std::string dumped = output_of("denoise --dump-config --method nlm --sigma 3.5");
  EXPECT_NE(dumped.find("method = \"nlm\""), std::string::npos);
  EXPECT_NE(dumped.find("sigma_counts = 3.5"), std::string::npos);
  write_text(path("denoise.toml"), dumped);
  EXPECT_EQ(output_of("denoise --dump-config --config denoise.toml"), dumped);
}

// The preset, then the file, then --set, then the option's own flag.
TEST_F(Options, TheMoreParticularOneWins) {
  write_text(path("robot.toml"), "[selection]\nkeep_edges = 3\n[denoise]\nmethod = \"gaussian\"\n");
  struct Case {
    std::string arguments;
    std::size_t kept;
  };
  for (const Case& given :
       {Case{"--config robot.toml", 3},
        {"--config robot.toml --set selection.keep_edges=4", 4},
        {"--set selection.keep_edges=4 --config robot.toml", 4},
        {"--config robot.toml --set selection.keep_edges=4 --keep 5", 5},
        {"--keep 5 --set selection.keep_edges=4 --config robot.toml", 5},
        {"--config robot.toml --set selection.keep_edges=4 --set selection.keep_edges=2", 2}}) {
    EXPECT_EQ(edges(given.arguments).size(), given.kept) << given.arguments;
  }
}

// Inputs may stand behind it.
TEST_F(Options, SetTakesOneWord) {
  const std::string scene = kScene;
  for (const std::string& arguments :
       {scene + " --set selection.keep_edges=2 --set denoise.method=gaussian -o -",
        "--set selection.keep_edges=2 --set denoise.method=gaussian " + scene + " -o -",
        "-o - --set selection.keep_edges=2 " + scene + " --set denoise.method=gaussian"}) {
    const std::string line = output_of("detect " + arguments);
    EXPECT_EQ(nlohmann::json::parse(line, nullptr, false)["edges"].size(), 2U) << arguments;
  }
  ASSERT_EQ(output_of("simulate --set width=48 --set height=36 desk -o out --frames 1"), "");
  EXPECT_TRUE(std::filesystem::exists(directory_ / "out" / "counts" / "frame_000000.png"));
}

TEST_F(Options, KeepTakesTheBestEdges) {
  const auto all = edges("--denoise gaussian --keep 0");
  ASSERT_GT(all.size(), 6U);
  for (const std::size_t keep : {std::size_t{1}, std::size_t{5}, all.size(), 10 * all.size()}) {
    const auto kept = edges("--denoise gaussian --keep " + std::to_string(keep));
    ASSERT_EQ(kept.size(), std::min(keep, all.size()));
    for (std::size_t i = 0; i < kept.size(); ++i) {
      EXPECT_EQ(kept[i]["points"], all[i]["points"]) << i;
      EXPECT_EQ(kept[i]["rank"], i);
    }
  }
}

TEST_F(Options, MaxEdgelsIsABudget) {
  const auto all = edges("--denoise gaussian --max-edgels 0");
  const std::size_t best = all[0]["points"].size();
  for (const std::size_t most :
       {std::size_t{1}, best - 1, best, std::size_t{200}, edgels_of(all), 2 * edgels_of(all)}) {
    const auto kept = edges("--denoise gaussian --max-edgels " + std::to_string(most));
    EXPECT_LE(edgels_of(kept), most);
    EXPECT_EQ(kept.empty(), most < best) << most;
    EXPECT_EQ(kept == all, most >= edgels_of(all)) << most;
  }
}

TEST_F(Options, FewerFalseAlarmsAreFewerEdges) {
  std::vector<std::size_t> found;
  for (const std::string most : {"1e-12", "1e-3", "1", "0"}) {
    found.push_back(edges("--max-false-alarms " + most).size());
  }
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  EXPECT_LT(found.front(), found.back());
}

// One option in three units, whose worth the frame and the camera tell.
TEST_F(Options, MinContrastDropsTheEdgesThatHaveLess) {
  const auto all = edges("");
  const auto wanted = [&](const std::string& key, double least) {
    nlohmann::json kept = nlohmann::json::array();
    for (const auto& edge : all) {
      if (edge[key].get<double>() >= least) {
        kept.push_back(edge["points"]);
      }
    }
    EXPECT_GT(kept.size(), 0U);
    EXPECT_LT(kept.size(), all.size());
    return kept;
  };
  const auto points = [&](const std::string& arguments) {
    nlohmann::json kept = nlohmann::json::array();
    for (const auto& edge : edges(arguments)) {
      kept.push_back(edge["points"]);
    }
    return kept;
  };
  EXPECT_EQ(points("--min-contrast 90"), wanted("contrast_counts", 90));
  EXPECT_EQ(points("--min-contrast 90counts"), wanted("contrast_counts", 90));
  EXPECT_EQ(points("--min-contrast 15sigma"), wanted("contrast_sigmas", 15));
  EXPECT_EQ(points("--min-contrast 0.9degC --degc-per-count 0.01"), wanted("contrast_counts", 90));
  EXPECT_EQ(points("--min-contrast 9degC --camera optris"), wanted("contrast_counts", 90));
  EXPECT_EQ(points("--min-contrast 0"), points(""));
  const std::string line = output_of("detect " + std::string(kScene) + " -o - --min-contrast 90");
  const auto dropped = nlohmann::json::parse(line, nullptr, false)["stats"]["edges_dropped"];
  EXPECT_EQ(dropped["low_contrast"], all.size() - wanted("contrast_counts", 90).size());
}

TEST_F(Options, AContrastInDegreesNeedsACameraInProportionToThem) {
  expect_one_line_each(
      {{"detect x --min-contrast 0.5degC", 2, "--degc-per-count or --camera"},
       {"detect x --min-contrast 0.5K", 2, "--min-contrast: selection.min_contrast = '0.5K'"},
       {"detect x --min-contrast 1degC --camera nikon", 2, "--camera: camera nikon"},
       {"detect x --min-contrast 1degC --camera planck:17096,1428,1,-342,0.0466", 2,
        "not in proportion"},
       {"detect x --preset paper --min-contrast 3", 2, "preset paper does not use it"},
       {"detect x --preset paper --camera optris", 2, "selection.degc_per_count is used with"}},
      directory_);
}

TEST_F(Options, ThreadsAndInstructionSetsDoNotShow) {
  const auto wanted = edges("--threads 1");
  for (const int threads : {0, 2, 7, 64}) {
    EXPECT_EQ(edges("--threads " + std::to_string(threads)), wanted) << threads;
  }
  for (const std::string& target : simd_targets()) {
    EXPECT_EQ(edges("--simd " + target), wanted) << target;
  }
}

TEST_F(Options, ANoiseThatIsToldIsUsed) {
  const auto sigma_of = [&](const std::string& arguments) {
    return nlohmann::json::parse(output_of("detect " + std::string(kScene) + " -o - " + arguments),
                                 nullptr, false)["sigma_counts"]
        .get<double>();
  };
  EXPECT_EQ(sigma_of("--denoise gaussian --sigma 12.5"), 12.5);
  const double measured = sigma_of("--denoise gaussian");
  EXPECT_NEAR(measured, 6, 1);
  EXPECT_EQ(sigma_of("--denoise gaussian --sigma auto"), measured);
}

// What goes wrong is said in the same words as a line of text and as JSON, even when told to be
// quiet.
TEST_F(Options, ErrorsAreTextOrJsonAndNeverQuiet) {
  for (const std::string arguments :
       {"detect missing.png", "scale missing.png -o x.png", "denoise missing.png -o x.png",
        "trace missing.png", "stages missing.png -o x.png", "compare missing.png -o x.png",
        "bench missing.png", "probe missing.png", "evaluate missing.png",
        "simulate missing.toml -o out"}) {
    const auto text = run(arguments);
    EXPECT_EQ(text.exit_code, 1) << arguments;
    ASSERT_TRUE(text.err.starts_with("thermedge: error: ")) << text.err;
    EXPECT_NE(text.err.find("missing."), std::string::npos) << text.err;
    EXPECT_EQ(run(arguments + " --quiet").err, text.err) << arguments;
    const auto json = run(arguments + " --json-log");
    EXPECT_EQ(json.exit_code, 1) << arguments;
    EXPECT_EQ(count_lines(json.err), 1U) << json.err;
    const auto entry = nlohmann::json::parse(json.err, nullptr, false);
    ASSERT_TRUE(entry.is_object()) << json.err;
    EXPECT_EQ(entry["level"], "error");
    EXPECT_EQ("thermedge: error: " + entry["message"].get<std::string>() + "\n", text.err);
  }
}

TEST_F(Options, AFileOfOptionsIsCheckedLikeThem) {
  struct Case {
    std::string text;
    int exit_code;  // 1: no TOML, 2: options that are wrong
    std::string message;
  };
  std::vector<BadCase> cases;
  for (const Case& file :
       {Case{"preset = \"magic\"\n", 2, "preset = 'magic' is none of robust, fast, paper"},
        {"[selection]\nkeep_edges = \"many\"\n", 2, "line 2: selection.keep_edges = 'many'"},
        {"[selection]\nkeep_edges = -1\n", 2, "selection.keep_edges = -1 is out of range"},
        {"[canny]\nhigh_share = 0.5\n", 2, "line 1: unknown option 'canny': preset"},
        {"[nonsense]\nx = 1\n", 2, "line 1: unknown option 'nonsense'"},
        {"keep = [1\n", 1, "line 1: not TOML"}}) {
    const std::string name = "bad" + std::to_string(cases.size()) + ".toml";
    write_text(path(name), file.text);
    cases.push_back(
        {"detect --dump-config --config " + name, file.exit_code, name + ": " + file.message});
  }
  cases.push_back({"detect --dump-config --config missing.toml", 1, "missing.toml"});
  expect_one_line_each(cases, directory_);
}

}  // namespace
}  // namespace thermedge::test
