// Streams: each line leaves the program with its frame, whatever ends the run leaves whole lines, a
// full standard output is an error, and the last line of a long run sums it up.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "support/program.hpp"
#include "support/running_program.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kThreeFrames = "'sim:desk?width=96&height=72&frames=3' --denoise gaussian ";

class Streams : public ProgramTest {
 protected:
  // The bytes of a frame of 96x72 with 16 bits.
  [[nodiscard]] std::string frame() const {
    EXPECT_EQ(run("denoise 'sim:desk?width=96&height=72' --method none -o frame.raw").exit_code, 0);
    return text_of("frame.raw");
  }
  // Waits until the file has `lines` lines.
  [[nodiscard]] bool wait_for_lines(const std::string& name, std::size_t lines) const {
    for (int i = 0; i < 1000; ++i) {
      if (count_lines(text_of(name)) >= lines) {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  static bool every_line_is_json(const std::string& text) {
    std::istringstream lines(text);
    bool good = text.empty() || text.back() == '\n';
    for (std::string line; std::getline(lines, line);) {
      good = good && nlohmann::json::accept(line);
    }
    return good;
  }
};

TEST_F(Streams, ALineOfJsonComesBeforeTheNextFrameIsThere) {
  const std::string counts = frame();
  ASSERT_EQ(counts.size(), 96U * 72 * 2);
  RunningProgram program({"detect", "-", "--raw-size", "96x72", "-o", "-"}, directory_);
  for (int i = 0; i < 3; ++i) {
    program.feed(counts);
    const auto line = nlohmann::json::parse(program.line(), nullptr, false);
    ASSERT_TRUE(line.is_object()) << i << ": " << program.errors();
    EXPECT_EQ(line["frame"], i);
    EXPECT_TRUE(line["stamp_ns"].is_null()) << "raw frames have none";
  }
  program.close_input();
  EXPECT_EQ(program.exit_code(), 0);
}

TEST_F(Streams, ALineForPeopleComesWithItsFrameToo) {
  const std::string counts = frame();
  RunningProgram program({"detect", "-", "--raw-size", "96x72"}, directory_);
  program.feed(counts);
  EXPECT_TRUE(program.line().starts_with("-[0]: 96x72, sigma ")) << program.errors();
  program.close_input();
  EXPECT_EQ(program.exit_code(), 0);
}

TEST_F(Streams, FilesGrowWithTheFrames) {
  const std::string counts = frame();
  for (const std::string name : {"x.jsonl", "x.csv"}) {
    RunningProgram program({"detect", "-", "--raw-size", "96x72", "-o", name}, directory_);
    program.feed(counts);
    ASSERT_TRUE(wait_for_lines(name, 1)) << name;
    program.feed(counts);
    program.close_input();
    EXPECT_EQ(program.exit_code(), 0) << program.errors();
  }
  EXPECT_EQ(count_lines(text_of("x.jsonl")), 2U);
  RunningProgram scale({"scale", "-", "--raw-size", "96x72", "--stable", "-o", "view"}, directory_);
  scale.feed(counts);
  EXPECT_TRUE(wait_for_lines("view/scale.jsonl", 1));
}

TEST_F(Streams, ASignalEndsARunThatWaitsForAFrame) {
  const std::string counts = frame();
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    RunningProgram program({"detect", "-", "--raw-size", "96x72", "-o", "-"}, directory_);
    program.feed(counts);
    EXPECT_NE(program.line(), "");
    program.send(signal_number);
    EXPECT_EQ(program.exit_code(), 128 + signal_number);
    EXPECT_TRUE(program.errors().starts_with("thermedge: interrupted after 1 frame, no failures, "))
        << program.errors();
  }
}

// Whatever frame is in work when the signal comes.
TEST_F(Streams, ASignalLeavesWholeFrames) {
  struct Run {
    std::vector<std::string> words;
    std::string lines;
    std::string pictures;
  };
  const std::vector<Run> runs = {
      {{"scale", "sim:desk?width=96&height=72&frames=100000", "--stable", "-o", "view"},
       "view/scale.jsonl",
       "view"},
      {{"simulate", "desk", "-o", "made", "--frames", "100000", "--set", "width=96", "--set",
        "height=72"},
       "made/truth.jsonl",
       "made/counts"},
      {{"detect", "sim:desk?width=96&height=72&frames=100000", "-o", "edges.jsonl"},
       "edges.jsonl",
       ""}};
  std::size_t least = 3;
  for (const int signal_number : {SIGTERM, SIGINT}) {
    for (const Run& run : runs) {
      fs::remove_all(directory_ / fs::path(run.lines));
      fs::remove_all(directory_ / fs::path(run.pictures.empty() ? "none" : run.pictures));
      RunningProgram program(run.words, directory_);
      ASSERT_TRUE(wait_for_lines(run.lines, least++)) << run.lines << program.errors();
      program.send(signal_number);
      EXPECT_EQ(program.exit_code(), 128 + signal_number);
      const std::string text = text_of(run.lines);
      EXPECT_TRUE(every_line_is_json(text)) << run.lines;
      EXPECT_NE(program.errors().find("interrupted after " + std::to_string(count_lines(text)) +
                                      " frames, no failures, "),
                std::string::npos)
          << program.errors();
      std::size_t pictures = 0;
      if (!run.pictures.empty()) {
        for (const auto& entry : fs::directory_iterator(directory_ / run.pictures)) {
          pictures += entry.path().extension() == ".png" ? 1 : 0;
          EXPECT_NE(entry.path().extension(), ".tmp");
        }
        EXPECT_EQ(pictures, count_lines(text)) << run.pictures;
      }
    }
  }
  EXPECT_EQ(count_lines(text_of("made/trajectory.txt")), count_lines(text_of("made/truth.jsonl")));
}

// The JSON of the first frame goes into a pipe that nobody reads yet, so the frame is in work, its
// mask already written, when the signal comes.
TEST_F(Streams, ASignalWaitsForTheFrameInWork) {
  fs::create_directories(directory_ / "out/json");
  ASSERT_EQ(::mkfifo(path("out/json/desk_0000.json").c_str(), 0600), 0);
  RunningProgram program(
      {"detect", "sim:desk?width=96&height=72&frames=3", "-o", "out", "--write", "mask,json"},
      directory_);
  for (int i = 0; i < 1000 && !fs::exists(path("out/mask/desk_0000.png")); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(fs::exists(path("out/mask/desk_0000.png"))) << program.errors();
  program.send(SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ASSERT_TRUE(program.is_running());
  EXPECT_TRUE(nlohmann::json::accept(text_of("out/json/desk_0000.json")));
  EXPECT_EQ(program.exit_code(), 128 + SIGTERM);
  EXPECT_FALSE(fs::exists(path("out/mask/desk_0001.png"))) << "no frame is begun after a signal";
}

TEST_F(Streams, AFullStandardOutputIsOneErrorEverywhere) {
  if (!fs::exists("/dev/full")) {
    GTEST_SKIP() << "there is no /dev/full";
  }
  ASSERT_EQ(run("scale 'sim:desk?width=96&height=72' -o frame.png").exit_code, 0);
  const std::string scene = kThreeFrames;
  for (const std::string& arguments :
       {"detect " + scene, "detect " + scene + "-o -", "detect " + scene + "-o - --json-log",
        "trace " + std::string("frame.png frame.png -o - --threshold 128"),
        std::string("probe frame.png"), std::string("probe frame.png --json"),
        std::string("bench frame.png --seconds 0"),
        std::string("bench frame.png --seconds 0 --json"),
        std::string("evaluate frame.png frame.png"), std::string("evaluate frame.png --json"),
        std::string("detect --dump-config"), std::string("denoise --dump-config"),
        std::string("--help"), std::string("detect --help"), std::string("--version")}) {
    // The test's own redirections follow behind the semicolon.
    (void)run(arguments + " 2>errors.txt >/dev/full; echo $? >code.txt; true");
    EXPECT_EQ(text_of("code.txt"), "1\n") << arguments;
    const std::string errors = text_of("errors.txt");
    EXPECT_EQ(count_lines(errors), 1U) << arguments << ": " << errors;
    EXPECT_NE(errors.find("standard output: cannot be written"), std::string::npos) << errors;
  }
}

TEST_F(Streams, AFullDiskEndsAStreamWithOneError) {
  if (!fs::exists("/dev/full")) {
    GTEST_SKIP() << "there is no /dev/full";
  }
  fs::create_symlink("/dev/full", directory_ / "full.jsonl");
  const auto result = run("detect " + std::string(kThreeFrames) + "-o full.jsonl");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(result.err), 1U) << result.err;
  EXPECT_NE(result.err.find("full.jsonl: cannot be written: No space left on device"),
            std::string::npos)
      << result.err;
}

TEST_F(Streams, QuietSaysNothing) {
  const std::string scene = "'sim:empty?width=96&height=72&frames=2' --quiet ";
  for (const std::string& arguments :
       {"detect " + scene, "detect -o out " + scene, "trace --threshold 3100 " + scene,
        "scale -o view " + scene,
        std::string("simulate desk --set width=96 --frames 2 -o made --quiet")}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << result.err;
    EXPECT_EQ(result.out + result.err, "") << arguments;
  }
  EXPECT_EQ(count_lines(output_of("detect -o - --quiet " + std::string(kThreeFrames))), 3U)
      << "what was asked for is no message";
}

TEST_F(Streams, TheBarHasRateAndTimeLeft) {
  if (std::system("command -v script >/dev/null") != 0) {
    GTEST_SKIP() << "there is no script(1), which gives the program a terminal";
  }
  const std::string command = "cd '" + directory_.string() + "' && script -qec \"'" +
                              std::string(THERMEDGE_PROGRAM) +
                              "' simulate desk -o out --frames 45 --threads 1 --write counts\" "
                              "/dev/null >bar.txt </dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string bar = text_of("bar.txt");
  EXPECT_TRUE(
      std::regex_search(bar, std::regex("\\[#+ +\\] [0-9]+/45, [0-9.]+ frames/s, [0-9.]+ s left")))
      << bar;
}

// Frames, failures, edges, frames a second, and where the results are.
TEST_F(Streams, TheLastLineSumsTheRunUp) {
  write_text(path("bad.png"), "no picture");
  const auto result =
      run("detect bad.png " + std::string(kThreeFrames) + "-o out --write mask,json");
  EXPECT_EQ(result.exit_code, 1);
  std::size_t edges = 0;
  for (const auto& entry : fs::directory_iterator(directory_ / "out/json")) {
    edges += nlohmann::json::parse(file_text(entry.path()))["edges"].size();
  }
  ASSERT_GT(edges, 10U);
  const std::string last = result.err.substr(result.err.find('\n') + 1);
  EXPECT_TRUE(std::regex_match(
      last, std::regex("thermedge: 4 frames, 1 failure, " + std::to_string(edges) +
                       " edges, [0-9.]+ frames a second; results: out/mask, out/json\n")))
      << last;
  const auto json = nlohmann::json::parse(
      run("detect " + std::string(kThreeFrames) + "-o all.jsonl --json-log").err);
  EXPECT_EQ(json["level"], "info");
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["failures"], 0);
  EXPECT_EQ(json["edges"], edges);
  EXPECT_EQ(json["results"], "all.jsonl");
  EXPECT_GT(json["frames_per_second"], 0);
  EXPECT_EQ(run("detect 'sim:desk?width=96&height=72' -o one.json").err, "")
      << "of one frame there is nothing to sum up";
}

}  // namespace
}  // namespace thermedge::test
