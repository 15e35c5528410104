// The program as a user types it: results, messages, exit codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

class Program : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(THERMEDGE_PROGRAM).empty()) {
      GTEST_SKIP() << "the program was not built (THERMEDGE_BUILD_CLI)";
    }
  }

  ProgramRun run(const std::string& arguments) const { return run_program(arguments, directory_); }

  // Small and quick: 96x72 without a slow denoiser.
  static constexpr const char* kScene = "'sim:desk?width=96&height=72'";
  static constexpr const char* kQuick = " --denoise gaussian ";

  TemporaryDirectory temporary_;
  const fs::path& directory_ = temporary_.path();
};

TEST_F(Program, WritesAMaskEdgesAndVectorsOfOneFrame) {
  for (const std::string name : {"x.png", "x.json", "x.svg"}) {
    const auto result = run(std::string("detect ") + kScene + kQuick + "-o " + name);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    EXPECT_GT(fs::file_size(directory_ / name), 100U);
  }
  const auto mask = io::read_picture((directory_ / "x.png").string());
  ASSERT_TRUE(mask);
  EXPECT_EQ(mask->counts.width(), 96);
  EXPECT_EQ(mask->bits, 8);
}

TEST_F(Program, WritesEveryKindForEveryFrame) {
  const auto result = run("detect 'sim:desk?width=96&height=72&frames=3'" + std::string(kQuick) +
                          "-o out --write mask,strength,labels,json,svg,overlay,distance");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const std::string kind :
       {"mask", "strength", "labels", "json", "svg", "overlay", "distance"}) {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(directory_ / "out" / kind)) {
      EXPECT_TRUE(entry.path().stem().string().starts_with("desk_000")) << entry.path();
      ++files;
    }
    EXPECT_EQ(files, 3U) << kind;
  }
}

TEST_F(Program, JsonHasWhatIsPromised) {
  ASSERT_EQ(run(std::string("detect ") + kScene + kQuick + "--keep 3 -o x.json").exit_code, 0);
  const auto json = nlohmann::json::parse(file_text(directory_ / "x.json"));
  EXPECT_EQ(json["width"], 96);
  EXPECT_EQ(json["height"], 72);
  EXPECT_EQ(json["preset"], "robust");
  ASSERT_EQ(json["edges"].size(), 3U);
  for (const auto& edge : json["edges"]) {
    for (const std::string key :
         {"index", "rank", "score", "es", "z", "log10_nfa", "closed", "length_px",
          "contrast_counts", "corners", "connected", "points"}) {
      EXPECT_TRUE(edge.contains(key)) << key;
    }
    EXPECT_EQ(edge["points"][0].size(), 2U);
    for (const auto& corner : edge["corners"]) {
      EXPECT_LT(corner.get<std::size_t>(), edge["points"].size());
    }
  }
  EXPECT_TRUE(json["stats"]["ms"].contains("denoise"));
}

// The paper's own way: ranked by the edge score ES, the smallest first, and options of its stages
// work.
TEST_F(Program, PresetPaperGoesItsOwnWay) {
  const std::string detect =
      std::string("detect ") + kScene + " --preset paper --denoise gaussian ";
  const auto edges = [&](const std::string& arguments) {
    EXPECT_EQ(run(arguments + " -o x.json").exit_code, 0) << arguments;
    const auto json = nlohmann::json::parse(file_text(directory_ / "x.json"));
    EXPECT_EQ(json["preset"], "paper");
    return json["edges"];
  };
  const auto all = edges(detect + "--set contours.min_component_px=10");
  ASSERT_GT(all.size(), 3U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i]["score"].get<double>(), -all[i]["es"].get<double>());
    EXPECT_TRUE(i == 0 || all[i - 1]["es"] <= all[i]["es"]) << i;
  }
  EXPECT_LT(edges(detect + "--set contours.min_component_px=100").size(), all.size());
  ASSERT_EQ(run(detect + "-o map.png").exit_code, 0);
  const auto traced = edges("trace map.png --preset paper");
  ASSERT_FALSE(traced.empty());
  EXPECT_TRUE(traced[0]["z"].is_null());
  EXPECT_TRUE(edges("trace map.png --preset paper --set contours.min_component_px=5000").empty());
}

TEST_F(Program, JsonLinesGoToStandardOutput) {
  const auto result =
      run("detect 'sim:desk?width=96&height=72&frames=2' -o -" + std::string(kQuick));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ASSERT_EQ(count_lines(result.out), 2U);
  EXPECT_TRUE(nlohmann::json::accept(result.out.substr(0, result.out.find('\n'))));
}

TEST_F(Program, GoesOnAfterABadFileAndExitsWith1) {
  ASSERT_EQ(run(std::string("denoise --method none ") + kScene + " -o good.png").exit_code, 0);
  std::ofstream(directory_ / "bad.png") << "\x89PNG\r\n\x1a\nrubbish";
  const auto result = run("scale bad.png good.png missing.png good.png --gain 0.05 -o out");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(without_summary(result.err)), 2U) << result.err;
  EXPECT_NE(result.err.find("bad.png"), std::string::npos);
  EXPECT_NE(result.err.find("missing.png"), std::string::npos);
  EXPECT_NE(result.err.find("thermedge: 4 frames, 2 failures, "), std::string::npos) << result.err;
  EXPECT_TRUE(fs::exists(directory_ / "out/good.png"));
  EXPECT_TRUE(fs::exists(directory_ / "out/good_2.png")) << "the same stem twice";
}

TEST_F(Program, TraceTakesAnEdgeMapAndMeasuresNoContrast) {
  ASSERT_EQ(run(std::string("detect ") + kScene + kQuick + "-o map.png").exit_code, 0);
  ASSERT_EQ(run("trace map.png -o x.json").exit_code, 0);
  const auto json = nlohmann::json::parse(file_text(directory_ / "x.json"));
  ASSERT_GT(json["edges"].size(), 0U);
  EXPECT_TRUE(json["edges"][0]["z"].is_null());
  EXPECT_TRUE(json["edges"][0]["contrast_counts"].is_null());
}

TEST_F(Program, DenoiseKeeps16Bits) {
  ASSERT_EQ(run(std::string("denoise ") + kScene + " --method nlm --sigma 6 -o x.png").exit_code,
            0);
  const auto picture = io::read_picture((directory_ / "x.png").string());
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->bits, 16);
}

TEST_F(Program, DenoiseKeeps8Bits) {
  ASSERT_EQ(run(std::string("scale ") + kScene + " -o view.png").exit_code, 0);
  ASSERT_EQ(run("denoise view.png --method gaussian -o x.png").exit_code, 0);
  const auto picture = io::read_picture((directory_ / "x.png").string());
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->bits, 8);
}

TEST_F(Program, ReadsRawFramesFromStandardInput) {
  std::ofstream(directory_ / "frames.raw", std::ios::binary) << std::string(2 * 96 * 72 * 2, 'x');
  const auto result = run("detect - --raw-size 96x72 -o - --denoise none < frames.raw");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count_lines(result.out), 2U);
}

TEST_F(Program, StagesWritesASheetAndEveryStep) {
  const auto result = run(std::string("stages ") + kScene + kQuick + "-o out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out + result.err, "");
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(directory_ / "out" / "desk")) {
    EXPECT_EQ(entry.path().extension(), ".png");
    ++files;
  }
  EXPECT_EQ(files, 14U);  // the sheet, ten steps and three denoisers
  for (const std::string name : {"sheet.png", "sheet.svg", "sheet.pdf"}) {
    EXPECT_EQ(run(std::string("stages ") + kScene + kQuick + "-o " + name).exit_code, 0);
    EXPECT_GT(fs::file_size(directory_ / name), 1000U);
  }
}

TEST_F(Program, CompareWritesASheetAndSingleMaps) {
  const auto result =
      run(std::string("compare ") + kScene + " --set denoise.method=gaussian -o x.png --write all");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const std::string name :
       {"x", "x_prewitt", "x_roberts", "x_sobel", "x_log", "x_canny", "x_thermedge"}) {
    EXPECT_TRUE(fs::exists(directory_ / (name + ".png"))) << name;
  }
  const auto map = io::read_picture((directory_ / "x_sobel.png").string());
  ASSERT_TRUE(map);
  EXPECT_EQ(map->counts.width(), 96);

  const auto some =
      run("compare 'sim:desk?width=96&height=72&frames=2' --set "
          "denoise.method=gaussian --denoise gaussian -o out --write log");
  ASSERT_EQ(some.exit_code, 0) << some.err;
  for (const std::string stem : {"desk_0000", "desk_0001"}) {
    EXPECT_TRUE(fs::exists(directory_ / "out" / stem / "sheet.png"));
    EXPECT_TRUE(fs::exists(directory_ / "out" / stem / "log.png"));
    EXPECT_FALSE(fs::exists(directory_ / "out" / stem / "canny.png"));
  }
}

TEST_F(Program, TheStableViewSaysWhatItDid) {
  std::ofstream(directory_ / "bad.png") << "no picture";
  const auto result =
      run("scale 'sim:desk?width=96&height=72&frames=3' bad.png "
          "'sim:desk?width=96&height=72' --stable -o out");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(without_summary(result.err)), 1U) << result.err;
  const std::string lines = file_text(directory_ / "out" / "scale.jsonl");
  ASSERT_EQ(count_lines(lines), 4U) << lines;
  std::istringstream text(lines);
  int index = 0;
  double offset = 0;
  for (std::string line; std::getline(text, line); ++index) {
    const auto entry = nlohmann::json::parse(line);
    EXPECT_EQ(entry["frame"], index < 3 ? index : index + 1) << "the bad picture has a number, too";
    EXPECT_GT(entry["gain"], 0.1);
    EXPECT_LE(entry["gain"], 2);
    EXPECT_TRUE(index == 0 ? entry["event"] == "start" : entry["event"].is_null());
    EXPECT_LT(entry["clipped_low_share"], 0.02);
    EXPECT_TRUE(index == 0 || entry["offset"] == offset);
    offset = entry["offset"];
  }
  EXPECT_TRUE(fs::exists(directory_ / "out" / "desk_0002.png"));
  EXPECT_TRUE(fs::exists(directory_ / "out" / "desk.png"));
}

TEST_F(Program, BenchTimesEveryStage) {
  const auto result = run("bench 'sim:desk?width=96&height=72&frames=3' " + std::string(kQuick) +
                          "--threads 1 --seconds 0 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["width"], 96);
  EXPECT_EQ(json["height"], 72);
  EXPECT_EQ(json["threads"], 1);
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["stages"].size(), 10U);
  double sum = 0;
  for (const auto& [name, stage] : json["stages"].items()) {
    EXPECT_GE(stage["p99_ms"], stage["median_ms"]) << name;
    sum += stage["median_ms"].get<double>();
  }
  const double total = json["total"]["median_ms"];
  EXPECT_GT(total, 0.5 * sum);
  EXPECT_NEAR(json["fps"], 1000 / total, 0.01 * 1000 / total);

  const auto table = run(std::string("bench ") + kScene + kQuick + "--seconds 0");
  EXPECT_EQ(table.exit_code, 0);
  for (const std::string word : {"96x72", "denoise", "total", "frames a second"}) {
    EXPECT_NE(table.out.find(word), std::string::npos) << word;
  }
}

TEST_F(Program, BenchLeavesFramesOfAnotherSizeOut) {
  EXPECT_EQ(run("scale 'sim:desk?width=64&height=48' -o other.pgm").exit_code, 0);
  const auto result =
      run(std::string("bench ") + kScene + " other.pgm " + kQuick + "--seconds 0 --json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(result.err), 1U) << result.err;
  EXPECT_NE(result.err.find("other.pgm: 64x48"), std::string::npos) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["frames"], 1);
}

TEST_F(Program, ASheetHasRoomForOneFrame) {
  const auto result =
      run("stages 'sim:desk?width=96&height=72&frames=2' " + std::string(kQuick) + "-o one.png");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(count_lines(result.err), 1U) << result.err;
  EXPECT_NE(result.err.find("one.png"), std::string::npos);
  EXPECT_FALSE(fs::exists(directory_ / "one.png"));
}

TEST_F(Program, DumpedConfigurationIsReadBack) {
  const auto dumped = run("detect --preset paper --set contours.gap_px=2 --keep 7 --dump-config");
  ASSERT_EQ(dumped.exit_code, 0);
  std::ofstream(directory_ / "robot.toml") << dumped.out;
  EXPECT_EQ(run("detect --config robot.toml --dump-config").out, dumped.out);
  EXPECT_EQ(run("detect --config robot.toml --preset paper --dump-config").out, dumped.out);
  const auto torn = run("detect --config robot.toml --preset fast --dump-config");
  EXPECT_EQ(torn.exit_code, 2);
  EXPECT_NE(torn.err.find("'contours.gap_px': preset fast does not use it"), std::string::npos)
      << torn.err;
}

struct BadUsage {
  std::string arguments;
  std::string says;
};

TEST_F(Program, BadUsageIsOneLineAndExitsWith2) {
  const std::string scene = kScene;
  for (const BadUsage& usage : {
           BadUsage{"detect " + scene + " --preset paper --set contours.gap_px=99",
                    "contours.gap_px = 99"},
           BadUsage{"detect " + scene + " --set contours.gap_px=2",
                    "preset robust does not use it"},
           BadUsage{"detect " + scene + " --set preset=magic", "robust, fast, paper"},
           BadUsage{"detect " + scene + " --set denoise.nlm.patch_px=5", "denoise.nlm.patch_px"},
           BadUsage{"detect " + scene + " --set oriented_filter.high=0.01", "high must be"},
           BadUsage{"detect " + scene + " --set nonsense=1", "nonsense"},
           BadUsage{"detect " + scene + " --sigma loud", "--sigma loud"},
           BadUsage{"detect " + scene + " --simd mmx", "mmx"},
           BadUsage{"detect " + scene + " -o out --write mask,magic", "magic"},
           BadUsage{"detect " + scene + " --write mask", "-o DIR"},
           BadUsage{"detect", "INPUT"},
           BadUsage{"stages " + scene, "-o"},
           BadUsage{"stages -o x.png", "INPUT"},
           BadUsage{"compare " + scene, "-o"},
           BadUsage{"scale " + scene + " -o x.png --slew 2", "--stable"},
           BadUsage{"scale " + scene + " -o x.png --gain 0", "gain"},
           BadUsage{"scale " + scene + " -o x.png --stable --dead-band nan",
                    "dead_band_levels = nan"},
           BadUsage{"bench " + scene + " -o x.json", "-o"},
           BadUsage{"bench " + scene + " --seconds -1", "--seconds"},
           BadUsage{"compare " + scene + " -o x.png --write magic", "--write magic"},
           BadUsage{"compare " + scene + " -o x.png --log-kernel 8", "log_kernel"},
           BadUsage{"scale - --raw-size 3by4 -o x.png", "--raw-size 3by4"},
       }) {
    const auto result = run(usage.arguments);
    EXPECT_EQ(result.exit_code, 2) << usage.arguments;
    EXPECT_EQ(count_lines(result.err), 1U) << result.err;
    EXPECT_NE(result.err.find(usage.says), std::string::npos) << result.err;
  }
  for (const std::string arguments : {"", "magic", "detect x.png --magic", "scale x.png",
                                      "detect x.png --denoise magic", "detect x.png --keep -1"}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(count_lines(result.err), 1U) << result.err;
  }
}

TEST_F(Program, BadInputIsOneLineAndExitsWith1) {
  std::ofstream(directory_ / "notes.txt") << "not a picture";
  fs::create_directories(directory_ / "empty");
  for (const std::string input :
       {"missing.png", "notes.txt", "empty", "'*.tiff'", "sim:magic", "'sim:desk?magic=1'"}) {
    const auto result = run("detect " + input + " -o x.png");
    EXPECT_EQ(result.exit_code, 1) << input;
    EXPECT_EQ(count_lines(result.err), 1U) << result.err;
    EXPECT_FALSE(fs::exists(directory_ / "x.png"));
  }
}

TEST_F(Program, AFailedWriteLeavesTheOldFile) {
  fs::create_directories(directory_ / "out/desk.png");
  const auto result = run(std::string("scale ") + kScene + " -o out");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("out/desk.png"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::is_directory(directory_ / "out/desk.png"));
}

TEST_F(Program, LogsAsJsonOnRequest) {
  const auto result = run("detect missing.png --json-log");
  EXPECT_EQ(result.exit_code, 1);
  const auto entry = nlohmann::json::parse(result.err);
  EXPECT_EQ(entry["level"], "error");
}

TEST_F(Program, HelpsAndTellsItsVersion) {
  for (const std::string arguments : {"--help", "detect --help", "--version"}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_FALSE(result.out.empty());
    EXPECT_EQ(result.err, "");
  }
}

}  // namespace
}  // namespace thermedge::test
