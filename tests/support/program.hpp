// Runs the thermedge program as a user would.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "support/files.hpp"

namespace thermedge::test {

struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
};

// `arguments` as typed behind "thermedge" in a shell, in `directory`.
inline ProgramRun run_program(const std::string& arguments,
                              const std::filesystem::path& directory) {
  const auto out = directory / "stdout.txt";
  const auto err = directory / "stderr.txt";
  const std::string command = "cd '" + directory.string() + "' && '" + THERMEDGE_PROGRAM + "' " +
                              arguments + " >'" + out.string() + "' 2>'" + err.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_text(out), file_text(err)};
}

// What a run says besides the summary that a run over many frames ends with.
inline std::string without_summary(const std::string& err) {
  std::string rest;
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) {
    const bool is_summary = line.find(" frames a second; results: ") != std::string::npos;
    rest += is_summary ? "" : line + "\n";
  }
  return rest;
}

inline std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// A test that runs the program in a directory of its own.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(THERMEDGE_PROGRAM).empty()) {
      GTEST_SKIP() << "the program was not built (THERMEDGE_BUILD_CLI)";
    }
  }

  [[nodiscard]] ProgramRun run(const std::string& arguments) const {
    return run_program(arguments, directory_);
  }
  // What it prints, of a run without a fault.
  [[nodiscard]] std::string output_of(const std::string& arguments) const {
    const ProgramRun result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << ": " << result.err;
    EXPECT_EQ(without_summary(result.err), "") << arguments;
    return result.out;
  }
  [[nodiscard]] std::string path(const std::string& name) const { return temporary_ / name; }
  [[nodiscard]] std::string text_of(const std::string& name) const {
    return file_text(directory_ / name);
  }

  TemporaryDirectory temporary_;
  const std::filesystem::path& directory_ = temporary_.path();
};

struct BadCase {
  std::string arguments;
  int exit_code;
  std::string message;  // part of it
};

// One line on standard error, nothing on standard output.
inline void expect_one_line_each(const std::vector<BadCase>& cases,
                                 const std::filesystem::path& directory) {
  for (const BadCase& bad : cases) {
    const auto result = run_program(bad.arguments, directory);
    EXPECT_EQ(result.exit_code, bad.exit_code) << bad.arguments;
    EXPECT_EQ(count_lines(result.err), 1U) << bad.arguments << ": " << result.err;
    EXPECT_NE(result.err.find(bad.message), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "") << bad.arguments;
  }
}

}  // namespace thermedge::test
