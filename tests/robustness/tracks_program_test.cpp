// `thermedge evaluate --tracks` as a user types it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "support/program.hpp"

namespace thermedge::test {
namespace {

using Json = nlohmann::json;

class TracksProgram : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    EXPECT_EQ(output_of("simulate desk -o scene --frames 3 --write truth --quiet --set width=160 "
                        "--set height=120"),
              "");
    std::istringstream lines(text_of("scene/truth.jsonl"));
    std::string tracks;
    for (std::string line; std::getline(lines, line);) {
      Json frame = Json::parse(line);
      for (Json& edge : frame["edges"]) {
        edge["track"] = edge["id"].get<int>() + 1000;
        edge["smooth"] = edge["points"];
      }
      tracks += frame.dump() + "\n";
    }
    write_text(directory_ / "tracks.jsonl", tracks);
  }
};

TEST_F(TracksProgram, FindsTheTruthItselfWithoutFault) {
  const std::string arguments =
      "evaluate --tracks tracks.jsonl scene/truth.jsonl --least-frames 3 ";
  const Json json = Json::parse(output_of(arguments + "--json"));
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["identities"]["found"], 1);
  EXPECT_EQ(json["identities"]["purity"], 1);
  // Where two true edges lie on top of each other, one of them has the other's identity.
  EXPECT_GT(json["identities"]["kept"], 0.99);
  EXPECT_GT(json["hota"]["mean"]["hota"], 0.99);
  EXPECT_GT(json["repeatability"]["points"], 500);
  EXPECT_GT(json["repeatability"]["share"], 0.99);
  EXPECT_EQ(json["smooth"]["measured_rms_px"], json["smooth"]["smooth_rms_px"]);
  const std::string page = output_of(arguments);
  EXPECT_LE(count_lines(page), 45U);
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100U) << line;
  }
  for (const char* part : {"kept", "purity", "HOTA", "repeatability", "px RMS"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part << page;
  }
  EXPECT_EQ(output_of(arguments + "-o page.txt"), "");
  EXPECT_EQ(text_of("page.txt"), page);
}

TEST_F(TracksProgram, TellsWhatItCanWithoutTruth) {
  const Json json = Json::parse(output_of("evaluate --tracks tracks.jsonl --json"));
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["labelled"], 1);
  EXPECT_EQ(json["aged"], 0);
  EXPECT_EQ(json["median_life_frames"], 3);
  EXPECT_NE(output_of("evaluate --tracks tracks.jsonl").find("half of them last 3 frames"),
            std::string::npos);
}

TEST_F(TracksProgram, SaysWhatIsWrongInOneLine) {
  write_text(directory_ / "bad.jsonl", "\n{\"frame\":0,\"edges\":[{\"points\":[[1]]}]}\n");
  write_text(directory_ / "other.jsonl", "{\"frame\":99,\"edges\":[]}\n");
  std::string long_edge = "{\"frame\":0,\"edges\":[{\"points\":[";
  for (int i = 0; i < 1000; ++i) {
    long_edge += i % 2 == 0 ? "[0,0]," : "[150,100],";
  }
  write_text(directory_ / "long.jsonl", long_edge + "[1,1]]}]}\n");
  const std::string all = "evaluate --tracks tracks.jsonl scene/truth.jsonl ";
  expect_one_line_each(
      {{"evaluate --tracks bad.jsonl scene/truth.jsonl", 1,
        "bad.jsonl:2: edge 0: points should be"},
       {"evaluate --tracks tracks.jsonl bad.jsonl", 1, "bad.jsonl:2: stamp_ns should be"},
       {"evaluate --tracks missing.jsonl scene/truth.jsonl", 1, "missing.jsonl"},
       {"evaluate --tracks other.jsonl scene/truth.jsonl", 1, "other.jsonl: neither stamp_ns nor"},
       {"evaluate --tracks long.jsonl scene/truth.jsonl", 1, "frame 0: edges of 180"},
       {all, 1, "shows in 30 frames or more"},
       {all + "--least-contrast 9000 --least-frames 1", 1, "no edge of at least 9000 counts"},
       {all + "-o tracks.jsonl", 2, "tracks.jsonl"},
       {all + "--at 3", 2, "--at"},
       {all + "--reach 0", 2, "--reach"},
       {"evaluate tracks.jsonl scene/truth.jsonl --reach 2", 2, "--tracks"},
       {"evaluate --tracks bad.jsonl", 1, "bad.jsonl:2: edge 0: points should be"}},
      directory_);
}

TEST_F(TracksProgram, SurvivesDamagedLines) {
  const std::string good = text_of("tracks.jsonl");
  std::mt19937 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    std::string bad = good;
    for (int k = 0; k < 3; ++k) {
      bad[random() % bad.size()] = static_cast<char>(random() % 256);
    }
    bad.resize(trial % 3 == 0 ? random() % bad.size() : bad.size());
    write_text(directory_ / "damaged.jsonl", bad);
    const ProgramRun result =
        run("evaluate --tracks damaged.jsonl scene/truth.jsonl --least-frames 1");
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << result.err;
    EXPECT_EQ(count_lines(result.err), result.exit_code == 0 ? 0U : 1U) << result.err;
  }
}

}  // namespace
}  // namespace thermedge::test
