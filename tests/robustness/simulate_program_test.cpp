// `thermedge simulate` as a user types it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

class Simulate : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(THERMEDGE_PROGRAM).empty()) {
      GTEST_SKIP() << "the program was not built (THERMEDGE_BUILD_CLI)";
    }
  }

  ProgramRun run(const std::string& arguments) const {
    return run_program("simulate " + arguments, directory_);
  }

  static constexpr const char* kSmall = " --set width=96 --set height=72 ";

  TemporaryDirectory temporary_;
  const fs::path& directory_ = temporary_.path();
};

TEST_F(Simulate, WritesFramesAndTheirTruth) {
  const auto result = run("office -o out --frames 3 --path drive --seed 4" + std::string(kSmall));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out + without_summary(result.err), "");
  for (const std::string kind : {"counts", "clean", "depth"}) {
    for (const std::string frame : {"frame_000000", "frame_000001", "frame_000002"}) {
      const auto picture =
          io::read_picture((directory_ / "out" / kind / (frame + ".png")).string());
      ASSERT_TRUE(picture) << kind;
      EXPECT_EQ(picture->counts.width(), 96);
      EXPECT_EQ(picture->bits, 16);
    }
  }
  std::istringstream lines(file_text(directory_ / "out" / "truth.jsonl"));
  std::string line;
  int frames = 0;
  while (std::getline(lines, line)) {
    const auto truth = nlohmann::json::parse(line);
    EXPECT_EQ(truth["frame"], frames);
    EXPECT_EQ(truth["stamp_ns"], frames * 12500000);
    EXPECT_EQ(truth["width"], 96);
    EXPECT_EQ(truth["pose"]["position_m"].size(), 3U);
    EXPECT_EQ(truth["pose"]["orientation_xyzw"].size(), 4U);
    EXPECT_TRUE(truth["shutter"].is_null());
    ASSERT_GT(truth["edges"].size(), 20U);
    for (const auto& edge : truth["edges"]) {
      EXPECT_GE(edge["contrast_counts"], 10);
      EXPECT_GE(edge["points"].size(), 4U);
      EXPECT_TRUE(edge["kind"] == "occluding" || edge["kind"] == "material" ||
                  edge["kind"] == "crease");
    }
    ++frames;
  }
  EXPECT_EQ(frames, 3);
  const std::string trajectory = file_text(directory_ / "out" / "trajectory.txt");
  EXPECT_EQ(count_lines(trajectory), 3U);
  EXPECT_EQ(trajectory.substr(0, 12), "0.000000000 ");
}

TEST_F(Simulate, GivesTheSameBytesForOneSeed) {
  const std::string what = "desk --frames 2 --write counts,truth" + std::string(kSmall);
  ASSERT_EQ(run(what + "-o a --seed 3 --threads 1").exit_code, 0);
  ASSERT_EQ(run(what + "-o b --seed 3 --threads 2").exit_code, 0);
  ASSERT_EQ(run(what + "-o c --seed 4").exit_code, 0);
  for (const std::string file : {"counts/frame_000001.png", "truth.jsonl", "trajectory.txt"}) {
    EXPECT_EQ(file_text(directory_ / "a" / file), file_text(directory_ / "b" / file));
    EXPECT_NE(file_text(directory_ / "a" / file), file_text(directory_ / "c" / file));
  }
  EXPECT_FALSE(fs::exists(directory_ / "a" / "clean"));
  EXPECT_FALSE(fs::exists(directory_ / "a" / "depth"));
}

TEST_F(Simulate, TakesSceneFilesAndShutterEvents) {
  write_text(directory_ / "ball.toml",
             "[view]\nposition_m = [0, 0, 0]\nlook_at_m = [0, 1, 0]\n[[object]]\ntype = 'sphere'\n"
             "centre_m = [0, 2, 0]\nradius_m = 0.3\ntemperature_degc = 30\n");
  const auto result =
      run("ball.toml -o out --frames 8 --write truth --set shutter_every=4 --set shutter_frames=2" +
          std::string(kSmall));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(file_text(directory_ / "out" / "truth.jsonl"));
  std::string line;
  std::string states;
  while (std::getline(lines, line)) {
    const auto shutter = nlohmann::json::parse(line)["shutter"];
    states += shutter.is_null() ? '.' : shutter["frozen"] == true ? 'f' : 'j';
  }
  EXPECT_EQ(states, "....ffj.");
}

TEST_F(Simulate, SaysWhatIsWrong) {
  write_text(directory_ / "cold.toml",
             "[view]\nposition_m = [0, 0, 0]\nlook_at_m = [0, 1, 0]\n[[object]]\ntype = 'sphere'\n"
             "centre_m = [0, 2, 0]\nradius_m = 0.3\ntemperature_degc = -280\n");
  write_text(directory_ / "file", "");
  expect_one_line_each(
      {{"simulate moon -o out", 1, "moon: no such scene; there are desk, corridor"},
       {"simulate missing.toml -o out", 1, "missing.toml: cannot be read as a scene file"},
       {"simulate cold.toml -o out", 1, "cold.toml: object '1': temperature_degc = -280"},
       {"simulate desk -o out --set colour=1", 2, "unknown key 'colour'"},
       {"simulate desk -o out --netd-mk loud", 2, "netd_mk=loud should be a number"},
       {"simulate desk -o file", 1, "file"},
       {"simulate desk", 2, "--output"},
       {"simulate -o out", 2, "SCENE"},
       {"simulate desk -o out --camera kodak", 2, "kodak"},
       {"simulate desk -o out --path zigzag", 2, "zigzag"},
       {"simulate desk -o out --frames 0", 2, "0"},
       {"simulate desk -o out --write colours", 2, "--write colours: should be some of counts"}},
      directory_);
}

}  // namespace
}  // namespace thermedge::test
