// Words on the command line: which one wins, what is said to a wrong one, and with which exit code
// the program ends.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

class Words : public ProgramTest {
 protected:
  [[nodiscard]] std::string dump(const std::string& arguments) const {
    return output_of("detect --dump-config " + arguments);
  }
};

TEST_F(Words, ALaterLevelWins) {
  write_text(path("robot.toml"), "preset = \"fast\"\nthreads = 4\n[selection]\nkeep_edges = 3\n");
  struct Case {
    std::string arguments;
    std::string line;
  };
  for (const Case& given : std::vector<Case>{
           {"--config robot.toml", "preset = \"fast\""},
           {"--config robot.toml --set preset=robust", "preset = \"robust\""},
           {"--set preset=paper --config robot.toml", "preset = \"paper\""},
           {"--set preset=paper --set preset=robust", "preset = \"robust\""},
           {"--config robot.toml --set preset=robust --preset paper", "preset = \"paper\""},
           {"--preset paper --set preset=robust", "preset = \"paper\""},
           {"--config robot.toml --preset paper", "keep_edges = 3"},
           {"--config robot.toml --set selection.keep_edges=4", "keep_edges = 4"},
           {"--keep 5 --set selection.keep_edges=4 --config robot.toml", "keep_edges = 5"},
           {"--config robot.toml --keep 0", "keep_edges = 0"},
           {"--config robot.toml", "threads = 4"},
           {"--config robot.toml --threads 0", "threads = 0"},
           {"--config robot.toml --set threads=2 --threads 1", "threads = 1"},
           {"--set denoise.sigma_counts=3 --sigma auto", "sigma_counts = 0"},
           {"--set source.crop=top-half --crop all", "crop = \"all\""}}) {
    EXPECT_NE(("\n" + dump(given.arguments)).find("\n" + given.line + "  #"), std::string::npos)
        << given.arguments << ": " << given.line;
  }
  write_text(path("denoise.toml"), "[denoise]\nsigma_counts = 3\n");
  EXPECT_NE(output_of("denoise --dump-config --config denoise.toml --sigma auto")
                .find("sigma_counts = 0"),
            std::string::npos);
}

// A preset is more than a name: all of its values come with it.
TEST_F(Words, AChosenPresetRunsThoughAFileHoldsAllOptionsOfAnother) {
  for (const std::string own : {"robust", "fast", "paper"}) {
    write_text(path("all.toml"), dump("--preset " + own));
    for (const std::string chosen : {"robust", "fast", "paper"}) {
      const std::string wanted = dump("--preset " + chosen);
      EXPECT_EQ(dump("--config all.toml --preset " + chosen), wanted) << own << " " << chosen;
      EXPECT_EQ(dump("--config all.toml --set preset=" + chosen), wanted) << own << " " << chosen;
    }
  }
  write_text(path("all.toml"), dump("--preset robust --keep 7 --set denoise.bm3d.profile=fast"));
  EXPECT_EQ(run("detect --dump-config --config all.toml --preset fast").exit_code, 2)
      << "fast has no BM3D";
  EXPECT_EQ(dump("--config all.toml --preset fast --denoise bm3d"),
            dump("--preset fast --keep 7 --set denoise.bm3d.profile=fast --denoise bm3d"));
  write_text(path("contrast.toml"), dump("--min-contrast 5"));
  expect_one_line_each({{"detect --dump-config --config contrast.toml --preset paper", 2,
                         "contrast.toml: unknown option 'selection.min_contrast': preset paper "
                         "does not use it, preset robust does"}},
                       directory_);
}

// What a file leaves open, a flag may settle.
TEST_F(Words, OptionsAreCheckedTogetherWhenAllAreRead) {
  write_text(path("nlm.toml"), "[denoise.nlm]\npatch_px = 9\n");
  EXPECT_NE(dump("--config nlm.toml --denoise nlm").find("patch_px = 9"), std::string::npos);
  EXPECT_NE(dump("--config nlm.toml --set denoise.method=nlm").find("patch_px = 9"),
            std::string::npos);
  EXPECT_EQ(run("detect --dump-config --config nlm.toml").exit_code, 2);
}

TEST_F(Words, AnEmptyFileIsTheDefaults) {
  write_text(path("empty.toml"), "");
  write_text(path("comment.toml"), "# nothing\n");
  EXPECT_EQ(dump("--config empty.toml"), dump(""));
  EXPECT_EQ(dump("--config comment.toml"), dump(""));
  EXPECT_EQ(dump("--config empty.toml --preset paper"), dump("--preset paper"));
  fs::create_directory(directory_ / "folder");
  expect_one_line_each({{"detect x --config missing.toml", 1, "missing.toml: no such file"},
                        {"detect x --config folder", 1, "folder: is a directory"},
                        {"denoise x -o y --config missing.toml", 1, "missing.toml: no such file"}},
                       directory_);
}

// Whatever it holds, it is one line with the file, the line and what would be right.
TEST_F(Words, DamagedTomlIsOneLine) {
  int number = 0;
  for (const std::string& text : std::vector<std::string>{
           "a = ", "[x", "a = [1\n2", "x y = 3", "a = 1\na = 2", std::string("\0\1", 2), "\xff\xfe",
           "a = 2024-13-45", "a = \"\\q\"", "= 3", "\"", "a = \"x\ny\"", "a = 'x\n", "[a]\n[a]\n",
           "a = 1 b = 2", "\r", "a = \"\"\"\n\n\n", "\x1b[31m"}) {
    const std::string name = "damaged" + std::to_string(number++) + ".toml";
    write_text(path(name), text);
    expect_one_line_each({{"detect --dump-config --config " + name, 1, name + ": line "}},
                         directory_);
    const std::string message = run("detect --dump-config --config " + name).err;
    EXPECT_NE(message.find("a line should read option = value"), std::string::npos) << message;
    EXPECT_EQ(message.find('\x1b'), std::string::npos);
  }
}

TEST_F(Words, AWrongWordIsAnsweredWithWhatWasMeant) {
  write_text(path("stage.toml"), "\n[selecton]\nkeep_edges = 3\n");
  write_text(path("key.toml"), "[selection]\nkeep_edge = 3\n");
  write_text(path("source.toml"), "[source]\ncorp = \"all\"\n");
  expect_one_line_each(
      {{"detct x", 2, "detct: no such command; did you mean detect?"},
       {"Detect x", 2, "did you mean detect?"},
       {"sim desk", 2, "did you mean simulate?"},
       {"hepl detect", 2, "hepl: no such command; did you mean help?"},
       {"zebra", 2, "zebra: no such command; there are detect, track, trace"},
       {"detect x --presett fast", 2,
        "--presett: detect has no such option; did you mean --preset?"},
       {"detect x --crpo=all", 2, "--crpo: detect has no such option; did you mean --crop?"},
       {"scale x -o y --stabel", 2, "did you mean --stable?"},
       {"detect x --zebra", 2, "--zebra: detect has no such option; thermedge detect --help"},
       {"simulate desk much -o out", 2, "much: one word too many; usage: thermedge simulate"},
       {"detect x --set selection.keepedges=3", 2, "did you mean selection.keep_edges?"},
       {"detect x --set keep_edges=3", 2, "did you mean selection.keep_edges?"},
       {"detect x --set source.corp=all", 2, "did you mean crop?"},
       {"detect x --config stage.toml", 2,
        "stage.toml: line 2: unknown option 'selecton'; did you mean selection?"},
       {"detect x --config key.toml", 2,
        "key.toml: line 2: unknown option 'selection.keep_edge'; did you mean "
        "selection.keep_edges?"},
       {"detect x --config source.toml", 2, "source.toml: line 2: source.corp = all"}},
      directory_);
}

TEST_F(Words, HelpAndVersionAreAlsoWords) {
  EXPECT_EQ(output_of("help"), output_of("--help"));
  EXPECT_EQ(output_of("help detect"), output_of("detect --help"));
  EXPECT_EQ(output_of("help detect"), output_of("detect -h"));
  for (const std::string arguments : {"-V", "detect --version", "detect -V", "scale -V"}) {
    EXPECT_EQ(output_of(arguments), output_of("--version")) << arguments;
  }
  EXPECT_EQ(run("help detct").exit_code, 2);
}

TEST_F(Words, EveryHelpHasGroupsExamplesAndPresets) {
  for (const std::string command :
       {"detect", "track", "trace", "scale", "denoise", "stages", "compare", "bench", "probe",
        "simulate", "evaluate", "completion", "man"}) {
    const std::string help = output_of(command + " --help");
    std::istringstream lines(help);
    std::size_t examples = 0;
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(line.size(), 100U) << command << ": " << line;
      examples += line.starts_with("  thermedge " + command) ||
                          line.starts_with("  source <(thermedge " + command)
                      ? 1
                      : 0;
    }
    EXPECT_EQ(examples, 2U) << command;
    EXPECT_NE(help.find("\nRun and messages:\n"), std::string::npos) << command;
    const bool has_presets = help.find("--preset NAME") != std::string::npos;
    EXPECT_EQ(help.find("\nPresets:\n  robust ") != std::string::npos, has_presets) << command;
  }
  const std::string help = output_of("detect --help");
  for (const std::string group : {"Input", "Output", "Configuration", "Options"}) {
    EXPECT_NE(help.find("\n" + group + ":\n"), std::string::npos) << group;
  }
}

TEST_F(Words, AWrongCommandLineIsJsonWhereMessagesAre) {
  for (const std::string arguments :
       {"detct --json-log", "--json-log", "detect --json-log --magic", "scale x --json-log",
        "detect x --preset best --json-log", "detect --json-log"}) {
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(count_lines(result.err), 1U) << result.err;
    const auto entry = nlohmann::json::parse(result.err, nullptr, false);
    ASSERT_TRUE(entry.is_object()) << result.err;
    EXPECT_EQ(entry["level"], "error");
    EXPECT_FALSE(entry["message"].get<std::string>().empty());
  }
  EXPECT_EQ(count_lines(run("detect x \"$(printf '%s\\n%s' --ma gic)\"").err), 1U);
}

TEST_F(Words, WriteTakesOneWordAndNoInput) {
  ASSERT_EQ(output_of("scale 'sim:desk?width=64&height=48' --gain 0.1 -o frame.png"), "");
  EXPECT_EQ(output_of("detect --write mask frame.png -o out"), "");
  EXPECT_TRUE(fs::exists(directory_ / "out/mask/frame.png"));
  EXPECT_EQ(output_of("compare --write all frame.png -o sheets"), "");
  for (const std::string map : {"prewitt", "roberts", "sobel", "log", "canny", "thermedge"}) {
    EXPECT_TRUE(fs::exists(directory_ / "sheets/frame" / (map + ".png"))) << map;
  }
  EXPECT_EQ(output_of("compare --write log,canny frame.png -o two"), "");
  EXPECT_FALSE(fs::exists(directory_ / "two/frame/sobel.png"));
  EXPECT_TRUE(fs::exists(directory_ / "two/frame/log.png"));
}

// A map of strengths or a photograph is no binary map.
TEST_F(Words, TraceOfMoreThanTwoValuesAsksForAThreshold) {
  const auto square = [&](char strong, char weak) {
    std::string pixels(40 * 40, '\0');
    for (int i = 8; i < 32; ++i) {
      pixels[static_cast<std::size_t>(40 * 8 + i)] = strong;
      pixels[static_cast<std::size_t>(40 * 31 + i)] = strong;
      pixels[static_cast<std::size_t>(40 * i + 8)] = weak;
      pixels[static_cast<std::size_t>(40 * i + 31)] = strong;
    }
    return "P5 40 40 255\n" + pixels;
  };
  write_text(path("two.pgm"), square('\xff', '\xff'));
  write_text(path("one.pgm"), square('\1', '\1'));
  write_text(path("three.pgm"), square('\xff', '\x40'));
  write_text(path("empty.pgm"), "P5 40 40 255\n" + std::string(1600, '\0'));
  const auto edges = [&](const std::string& arguments) {
    return nlohmann::json::parse(output_of("trace " + arguments + " -o -"))["edges"];
  };
  EXPECT_FALSE(edges("two.pgm").empty());
  EXPECT_EQ(edges("one.pgm"), edges("two.pgm"));
  EXPECT_TRUE(edges("empty.pgm").empty());
  EXPECT_EQ(edges("three.pgm --threshold 1"), edges("two.pgm"));
  EXPECT_NE(edges("three.pgm --threshold 65"), edges("two.pgm"));
  EXPECT_TRUE(edges("three.pgm --threshold 256").empty());
  expect_one_line_each({{"trace three.pgm -o -", 1, "--threshold VALUE"},
                        {"trace three.pgm -o - --threshold some", 2, "--threshold"}},
                       directory_);
}

// SCENE, then --set, then the flags, each over what was before, and the camera before all of them.
TEST_F(Words, SimulateKeepsToTheSameLevels) {
  const auto frames = [&](const std::string& arguments) {
    fs::remove_all(directory_ / "out");
    EXPECT_EQ(output_of("simulate " + arguments + " -o out --write counts"), "");
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(directory_ / "out/counts")) {
      ++count;
    }
    return count;
  };
  const std::string scene = "'desk?width=32&height=32&frames=2'";
  EXPECT_EQ(frames(scene), 2U);
  EXPECT_EQ(frames(scene + " --set frames=3"), 3U);
  EXPECT_EQ(frames(scene + " --frames 4 --set frames=3"), 4U);
  EXPECT_EQ(frames(scene + " --camera lepton35 --set camera=boson"), 2U);
  const auto header = text_of("out/counts/frame_000000.png").substr(16, 8);
  EXPECT_EQ(header, std::string("\0\0\0\x20\0\0\0\x20", 8)) << "the size stays as SCENE has it";
}

// The table of docs/command_line.md, as it stands there.
TEST_F(Words, ExitCodesAreThoseOfTheDocumentation) {
  write_text(path("frame.pgm"), "P5 8 6 255\n" + std::string(48, 'x'));
  write_text(path("damaged.png"), "\x89PNG\r\n\x1a\nrubbish");
  write_text(path("notes.txt"), "not a picture");
  write_text(path("three_values.pgm"), "P5 3 2 255\nabcabc");
  write_text(path("unknown.toml"), "[selection]\nkeep = 1\n");
  write_text(path("apart.toml"), "[denoise.nlm]\npatch_px = 5\n");
  write_text(path("damaged.toml"), "a = [1\n");
  fs::create_directory(directory_ / "empty");
  std::istringstream page(file_text(fs::path(THERMEDGE_TEST_DATA) / "../../docs/command_line.md"));
  std::size_t cases = 0;
  for (std::string line; std::getline(page, line);) {
    const std::size_t begin = line.find("| `thermedge");
    if (begin == std::string::npos) {
      continue;
    }
    const std::size_t end = line.find("` | ", begin);
    const std::string arguments = line.substr(begin + 12, end - begin - 12);
    const auto result = run(arguments);
    EXPECT_EQ(std::to_string(result.exit_code), line.substr(end + 4, 1)) << line;
    EXPECT_EQ(count_lines(result.err), 1U) << line << "\n" << result.err;
    EXPECT_EQ(result.out, "") << line;
    ++cases;
  }
  EXPECT_GT(cases, 25U);
}

}  // namespace
}  // namespace thermedge::test
