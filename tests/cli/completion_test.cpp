// Completions as the shells run them, and manual pages.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

class Completion : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_text(path("frame one.png"), "");
    write_text(path("robot.toml"), "");
  }
  // Lines that a script prints in a shell, sorted.
  [[nodiscard]] std::vector<std::string> lines_of(const std::string& shell,
                                                  const std::string& script) const {
    write_text(path("script"), script);
    const std::string command =
        "cd '" + directory_.string() + "' && " + shell + " script > lines.txt 2> errors.txt";
    EXPECT_EQ(std::system(command.c_str()), 0) << text_of("errors.txt");
    EXPECT_EQ(text_of("errors.txt"), "");
    std::istringstream text(text_of("lines.txt"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) {
      lines.push_back(line);
    }
    std::sort(lines.begin(), lines.end());
    return lines;
  }
  // What bash offers for the last of `words`, which it has split as it does.
  [[nodiscard]] std::vector<std::string> bash(const std::string& words) const {
    return lines_of("bash --norc", "source <('" + std::string(THERMEDGE_PROGRAM) +
                                       "' completion bash)\nCOMP_WORDS=(thermedge " + words +
                                       ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_thermedge\n"
                                       "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  }
};

using Lines = std::vector<std::string>;

bool has(const Lines& lines, const std::string& line) {
  return std::find(lines.begin(), lines.end(), line) != lines.end();
}

TEST_F(Completion, BashKnowsCommandsOptionsValuesAndFiles) {
  EXPECT_EQ(bash("det"), Lines{"detect"});
  EXPECT_TRUE(has(bash("''"), "simulate"));
  EXPECT_EQ(bash("help comp"), (Lines{"compare", "completion"}));
  EXPECT_EQ(bash("detect --pre"), Lines{"--preset"});
  EXPECT_EQ(bash("detect --preset ''"), (Lines{"fast", "paper", "robust"}));
  EXPECT_EQ(bash("detect --preset = f"), Lines{"fast"}) << "--preset=f";
  EXPECT_EQ(bash("detect --preset ="), (Lines{"fast", "paper", "robust"}));
  EXPECT_EQ(bash("detect frame.png --denoise n"), (Lines{"nlm", "none"}));
  EXPECT_EQ(bash("detect --set denoise.meth"), Lines{"denoise.method="});
  EXPECT_EQ(bash("detect --set denoise.method = b"), Lines{"bm3d"});
  EXPECT_EQ(bash("detect --set preset"), Lines{"preset="});
  EXPECT_EQ(bash("detect --set source.cr"), Lines{"source.crop="});
  EXPECT_EQ(bash("detect --config rob"), Lines{"robot.toml"});
  EXPECT_EQ(bash("detect fr"), Lines{"frame one.png"});
  EXPECT_EQ(bash("simulate cor"), Lines{"corridor"});
  EXPECT_EQ(bash("detect --keep ''"), Lines{""}) << "a number: nothing to offer";
  EXPECT_EQ(bash("man sca"), Lines{"scale"});
  EXPECT_EQ(bash("completion f"), Lines{"fish"});
}

// All options of --help, of every command.
TEST_F(Completion, BashHasEveryOptionOfTheHelp) {
  for (const std::string command :
       {"detect", "track", "trace", "scale", "denoise", "stages", "compare", "bench", "probe",
        "simulate", "evaluate", "completion", "man"}) {
    std::istringstream help(output_of(command + " --help"));
    const Lines offered = bash(command + " --");
    std::size_t options = 0;
    for (std::string line; std::getline(help, line);) {
      const std::size_t at = line.find("--");
      if (at == 2 || (at == 6 && line.starts_with("  -"))) {
        EXPECT_TRUE(has(offered, line.substr(at, line.find_first_of(" ,", at) - at))) << line;
        ++options;
      }
    }
    EXPECT_EQ(offered.size(), options) << command;
    EXPECT_GE(options, 2U) << command;
  }
}

TEST_F(Completion, ZshReadsItsScript) {
  if (!is_installed("zsh")) {
    GTEST_SKIP() << "zsh is not installed";
  }
  write_text(path("_thermedge"), output_of("completion zsh"));
  const Lines lines = lines_of("zsh -f",
                               "fpath=($PWD $fpath)\nautoload -Uz compinit\n"
                               "compinit -u -d $PWD/dump\nprint -r -- $_comps[thermedge]\n"
                               "autoload +X _thermedge && print loaded\n"
                               "source ./_thermedge && print read\n");
  EXPECT_EQ(lines, (Lines{"_thermedge", "loaded", "read"}));
  // The completer itself, with the functions that collect what is offered replaced by ones that
  // print it.
  const Lines offered = lines_of(
      "zsh -f",
      "compdef() { : }\n_arguments() { print -rl -- $@ }\n_describe() { print -rl -- ${(P)2} }\n"
      "source ./_thermedge\nwords=(thermedge detect --pre)\nCURRENT=3\n_thermedge\n"
      "words=(thermedge '')\nCURRENT=2\n_thermedge\n");
  EXPECT_TRUE(has(offered,
                  "--preset[named set of defaults\\: robust, fast or paper]:NAME:(robust "
                  "fast paper)"));
  EXPECT_TRUE(has(offered, "*:INPUT:_files"));
  EXPECT_TRUE(has(offered, "detect:find edges in frames"));
}

TEST_F(Completion, FishOffersWhatBashDoes) {
  if (!is_installed("fish")) {
    GTEST_SKIP() << "fish is not installed";
  }
  write_text(path("thermedge.fish"), output_of("completion fish"));
  const auto fish = [&](const std::string& line) {
    return lines_of("HOME=. fish --no-config", "source thermedge.fish\ncomplete -C '" + line +
                                                   "' | string split -f1 \\t\ntrue\n");
  };
  EXPECT_EQ(fish("thermedge det"), Lines{"detect"});
  EXPECT_EQ(fish("thermedge detect --preset "), (Lines{"fast", "paper", "robust"}));
  EXPECT_EQ(fish("thermedge detect --pre"), Lines{"--preset"});
  EXPECT_EQ(fish("thermedge detect --set denoise.meth"), Lines{"denoise.method="});
  EXPECT_EQ(fish("thermedge detect --config rob"), Lines{"robot.toml"});
  EXPECT_EQ(fish("thermedge help comp"), (Lines{"compare", "completion"}));
}

TEST_F(Completion, ManualPagesHaveEveryOption) {
  ASSERT_EQ(output_of("man -o pages"), "");
  EXPECT_EQ(text_of("pages/thermedge-detect.1"), output_of("man detect"));
  EXPECT_EQ(text_of("pages/thermedge.1"), output_of("man"));
  const std::string page = output_of("man detect");
  for (const std::string part :
       {".TH THERMEDGE\\-DETECT 1", ".SH SYNOPSIS\nthermedge detect [OPTIONS] INPUT...",
        "\n.B \\-\\-preset NAME\n", ".SH PRESETS\n", ".SH EXIT STATUS\n", ".SH EXAMPLES\n"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  if (!is_installed("groff")) {
    GTEST_SKIP() << "groff is not installed: the pages are not rendered";
  }
  std::size_t pages = 0;
  for (const auto& entry : fs::directory_iterator(directory_ / "pages")) {
    const std::string command = "groff -man -Tascii -P-cbou -ww '" + entry.path().string() +
                                "' > '" + path("rendered.txt") + "' 2> '" + path("warnings.txt") +
                                "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(text_of("warnings.txt"), "") << entry.path();
    EXPECT_NE(text_of("rendered.txt").find("EXAMPLES"), std::string::npos);
    ++pages;
  }
  EXPECT_EQ(pages, 16U);
}

}  // namespace
}  // namespace thermedge::test
