// `thermedge evaluate` as a user types it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/edge_maps.hpp"
#include "support/program.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::test {
namespace {

// A circle of `radius` px as one line of JSON.
std::string circle_json(double radius, double contrast) {
  nlohmann::json points = nlohmann::json::array();
  for (int i = 0; i < 400; ++i) {
    const double angle = i * 0.0157079632679;
    points.push_back({40 + radius * std::cos(angle), 30 + radius * std::sin(angle)});
  }
  return nlohmann::json{
             {"width", 80},
             {"height", 60},
             {"sigma_counts", 5},
             {"edges",
              {{{"points", points}, {"contrast_counts", contrast}, {"closed", true}, {"id", 3}}}}}
             .dump() +
         "\n";
}

class EvaluateProgram : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(THERMEDGE_PROGRAM).empty()) {
      GTEST_SKIP() << "the program was not built (THERMEDGE_BUILD_CLI)";
    }
    for (const char* name : {"maps", "truth", "json"}) {
      std::filesystem::create_directory(directory_ / name);
    }
    for (unsigned i = 0; i < 3; ++i) {
      const auto map = random_edge_map(80, 60, 8, 2, i);
      const std::string name = "f" + std::to_string(i);
      write("maps/" + name + ".png", map.view());
      write("truth/" + name + "_1.png", annotated(map.view(), 1, 0, i).view());
      write("truth/" + name + "_2.png", annotated(map.view(), 0, 1, i).view());
      write_text((directory_ / "json" / (name + ".json")).string(), circle_json(20.25, 30));
    }
    write_text((directory_ / "truth.jsonl").string(),
               circle_json(20, 25) + circle_json(20, 25) + circle_json(20, 25));
  }
  void write(const std::string& name, ImageView<const std::uint8_t> map) {
    ASSERT_TRUE(io::write_picture((directory_ / name).string(), map));
  }
  ProgramRun run(const std::string& arguments) const {
    return run_program("evaluate " + arguments, directory_);
  }
  nlohmann::json json_of(const std::string& arguments) const {
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(count_lines(result.out), 1U);
    return nlohmann::json::parse(result.out);
  }
  void expect_page(const std::string& arguments, const std::vector<std::string>& parts) const {
    const auto result = run(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_LE(count_lines(result.out), 45U);
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 100U) << line;
    }
    for (const std::string& part : parts) {
      EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
    }
  }

  TemporaryDirectory temporary_;
  const std::filesystem::path& directory_ = temporary_.path();
};

TEST_F(EvaluateProgram, PrintsPages) {
  expect_page("maps truth", {"3 frames, strength maps at 99 thresholds", "(ODS)", "OIS", "AP",
                             "figure of merit", "spurs", "contours by length"});
  expect_page("maps truth --at 60", {"strength maps at one threshold", "at 60 of 255"});
  expect_page("json truth.jsonl", {"binary maps", "RMS", "Recall by contrast in counts",
                                   "Recall by contrast in units of the noise"});
  expect_page("maps", {"without truth", "repeatability", "Structure"});
  expect_page("maps --empty", {"False alarms in empty scenes", "per frame"});
}

TEST_F(EvaluateProgram, MeasuresPositionsOfCurves) {
  const auto json = json_of("json truth.jsonl --max-dist 0.02 --json");
  EXPECT_EQ(json["frames"], 3);
  EXPECT_NEAR(json["curves"]["rms_px"], 0.25, 0.01);
  EXPECT_NEAR(json["curves"]["mean_px"], -0.25, 0.01);  // outside: left of clockwise
  EXPECT_EQ(json["recall"], 1);
  EXPECT_EQ(json["curves"]["repeatability"], 1);
  double found = 0;
  for (const auto& bin : json["curves"]["recall_by_contrast_counts"]) {
    if (bin["from"] == 20) {
      found = bin["recall"];
      EXPECT_NEAR(bin["true_px"], 3 * 2 * 3.14159265 * 20, 1);
    } else {
      EXPECT_TRUE(bin["recall"].is_null()) << bin;
    }
  }
  EXPECT_EQ(found, 1);
  // 25 counts are 5 sigma, or 2.5 where the noise is said to be 10.
  for (const auto& [options, from] : {std::pair{"", 4}, {" --sigma 10", 2}}) {
    const auto bins = json_of("json truth.jsonl --json" +
                              std::string(options))["curves"]["recall_by_contrast_sigma"];
    for (const auto& bin : bins) {
      EXPECT_EQ(bin["true_px"] != 0, bin["from"] == from) << bin;
    }
  }
}

TEST_F(EvaluateProgram, AsksForStrongEdgesOnly) {
  write_text((directory_ / "weak.jsonl").string(), circle_json(20, 3));
  const auto json = json_of("json/f0.json weak.jsonl --least-contrast 10 --max-dist 0.02 --json");
  EXPECT_EQ(json["recall"], 0);
  EXPECT_EQ(json["precision"], 1);
}

TEST_F(EvaluateProgram, JudgesWithoutTruth) {
  const auto json = json_of("json --json");
  EXPECT_EQ(json["edges_per_frame"]["mean"], 1);
  EXPECT_EQ(json["pairs"], 2);
  EXPECT_EQ(json["repeatability"], 1);
}

TEST_F(EvaluateProgram, WritesAFile) {
  for (const std::string name : {"x.json", "x.txt"}) {
    const auto result = run("maps truth -o " + name);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(file_text(directory_ / name)[0], name == "x.json" ? '{' : 'm');
  }
}

TEST_F(EvaluateProgram, JudgesWhatDetectWrites) {
  const auto detected = run_program(
      "detect 'sim:desk?width=160&height=120&frames=2' --preset robust -o out --write json,mask",
      directory_);
  ASSERT_EQ(detected.exit_code, 0) << detected.err;
  const auto json = json_of("out/json out/mask --json");
  EXPECT_EQ(json["frames"], 2);
  EXPECT_GT(json["f"], 0.9);
}

TEST_F(EvaluateProgram, GoesOnAfterABadFile) {
  write_text((directory_ / "maps/f1.png").string(), "rubbish");
  const auto result = run("maps truth --json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(result.err), 1U) << result.err;
  EXPECT_NE(result.err.find("maps/f1.png"), std::string::npos) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["frames"], 2);
}

TEST_F(EvaluateProgram, SaysWhatIsWrongInOneLine) {
  std::filesystem::create_directory(directory_ / "empty");
  write_text((directory_ / "bad.npz").string(), "rubbish");
  write_text((directory_ / "bad.jsonl").string(), "{\"width\": 4}\n");
  expect_one_line_each(
      {{"evaluate missing truth", 1, "missing: no such file"},
       {"evaluate maps missing", 1, "missing: no such file"},
       {"evaluate empty truth", 1, "empty: no edge"},
       {"evaluate maps empty", 1, "empty/f0: no truth there"},
       {"evaluate maps/f0.png bad.npz", 1, "bad.npz: no NPZ archive"},
       {"evaluate bad.jsonl bad.jsonl", 1, "bad.jsonl:1: width and height"},
       {"evaluate json/f0.json truth.jsonl", 1, "truth of 3 frames, but there are results of 1"},
       {"evaluate maps truth.jsonl -o missing/x.json", 1, "missing/x.json"},
       {"evaluate maps truth --at 0", 2, "--at"},
       {"evaluate maps truth --max-dist 1", 2, "--max-dist"},
       {"evaluate maps truth --empty", 2, "--empty"},
       {"evaluate ", 2, "PRED"}},
      directory_);
}

}  // namespace
}  // namespace thermedge::test
