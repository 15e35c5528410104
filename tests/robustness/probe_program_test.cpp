// `thermedge probe` as a user types it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program.hpp"

namespace thermedge::test {
namespace {

class ProbeProgram : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(THERMEDGE_PROGRAM).empty()) {
      GTEST_SKIP() << "the program was not built (THERMEDGE_BUILD_CLI)";
    }
  }
  ProgramRun run(const std::string& arguments) const { return run_program(arguments, directory_); }

  TemporaryDirectory temporary_;
  const std::filesystem::path& directory_ = temporary_.path();
};

TEST_F(ProbeProgram, PrintsAPage) {
  const auto result = run("probe 'sim:desk?frames=8&sigma=6'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_GE(count_lines(result.out), 25U);
  EXPECT_LE(count_lines(result.out), 50U);
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100U) << line;
  }
  for (const std::string part : {"8 frames of 382x288 pixels", "usual for an uncooled camera",
                                 "gain 0.5", "Suggested options"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  }
}

// Pages of the kinds of input that leave parts out.
TEST_F(ProbeProgram, PagesKeepTheirWidth) {
  ASSERT_EQ(run("scale sim:desk -o view.png").exit_code, 0);
  for (const std::string input : {"sim:desk", "view.png", "'sim:desk?sigma=200&frames=5'",
                                  "'sim:desk?width=16&height=16'", "'sim:corridor?sigma=0'"}) {
    const auto result = run("probe " + input);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 100U) << line;
    }
  }
}

TEST_F(ProbeProgram, PrintsJson) {
  const auto result =
      run("probe 'sim:desk?frames=3&width=96&height=72' --json --degc-per-count 0.04");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count_lines(result.out), 1U);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["degc_per_count"], 0.04);
  EXPECT_NEAR(json["noise"]["sigma_degc"], 0.04 * json["noise"]["sigma_counts"].get<double>(),
              1e-6);
}

TEST_F(ProbeProgram, WritesOptionsThatDetectTakes) {
  const auto probed =
      run("probe 'sim:desk?width=96&height=72&frames=3' --preset paper --toml robot.toml");
  ASSERT_EQ(probed.exit_code, 0) << probed.err;
  const auto dumped = run("detect --config robot.toml --dump-config");
  ASSERT_EQ(dumped.exit_code, 0) << dumped.err;
  EXPECT_NE(dumped.out.find("min_component_px = 13"), std::string::npos) << dumped.out;
}

TEST_F(ProbeProgram, DrawsAPictureAndKnowsCameras) {
  const auto result = run("probe 'sim:desk?width=96&height=72&frames=3' --camera lepton -o x.svg");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(std::filesystem::file_size(directory_ / "x.svg"), 1000U);
  // The scene lies near 2700 counts: 27 K at 0.01 K a count.
  EXPECT_NE(result.out.find("as temperatures of black bodies"), std::string::npos) << result.out;
  const auto json = nlohmann::json::parse(
      run("probe 'sim:desk?width=96&height=72' --camera linear:0.04,-100 --json").out);
  EXPECT_EQ(json["degc_per_count"], 0.04);
  EXPECT_NEAR(json["range"]["min_degc"], 0.04 * json["range"]["min_counts"].get<double>() - 100,
              1e-6);
}

TEST_F(ProbeProgram, LeavesOutFramesOfAnotherSize) {
  const auto result =
      run("probe 'sim:desk?width=96&height=72' 'sim:desk?width=64&height=48' --json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(result.err), 1U) << result.err;
  EXPECT_NE(result.err.find("64x48"), std::string::npos) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["frames"], 1);
}

TEST_F(ProbeProgram, SaysWhatIsWrongInOneLine) {
  std::ofstream(directory_ / "bad.png") << "\x89PNG\r\n\x1a\nrubbish";
  std::filesystem::create_directory(directory_ / "empty");
  std::ofstream(directory_ / "nothing.raw").flush();
  expect_one_line_each({{"probe missing.png", 1, "missing.png"},
                        {"probe bad.png", 1, "bad.png"},
                        {"probe empty", 1, "empty"},
                        {"probe sim:nowhere", 1, "nowhere"},
                        {"probe sim:desk --degc-per-count 0", 2, "--degc-per-count"},
                        {"probe sim:desk --camera magic", 2, "--camera: camera magic"},
                        {"probe sim:desk --camera lepton --degc-per-count 1", 2, "--camera"},
                        {"probe sim:desk -o x.jpg", 2, "-o x.jpg"},
                        {"probe sim:desk -o missing/x.png", 1, "missing/x.png"},
                        {"probe sim:desk --toml missing/x.toml", 1, "missing/x.toml"},
                        {"probe - --raw-size 8x8 < nothing.raw", 1, "standard input"},
                        {"probe", 2, "INPUT"}},
                       directory_);
}

}  // namespace
}  // namespace thermedge::test
