// Exit codes and messages of every command: 1 for bad input, 2 for bad usage, one line that names
// what is wrong.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/program.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCommands[] = {"detect",  "track", "trace", "scale",    "denoise", "stages",
                                     "compare", "bench", "probe", "simulate", "evaluate"};

class Messages : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_text(path("bad.png"), "\x89PNG\r\n\x1a\nrubbish");
    write_text(path("empty.png"), "");
    write_text(path("frame.pgm"), "P5 8 6 255\n" + std::string(48, 'x'));
    write_text(path("frame.raw"), std::string(96, 'x'));
    write_text(path("file"), "");
    fs::create_directory(directory_ / "empty");
  }
};

TEST_F(Messages, UnknownWordsAreBadUsage) {
  std::vector<BadCase> cases = {
      {"", 2, "a command is missing; there are detect, track, trace"},
      {"detekt frame.pgm", 2, "detekt: no such command; did you mean detect?"},
      {"--magic", 2, "--magic: no such command"}};
  for (const std::string command : kCommands) {
    cases.push_back({command + " frame.pgm -o x --magic", 2, "--magic"});
    cases.push_back({command + " frame.pgm -o x --threads 1025", 2, "--threads"});
    cases.push_back({command + " frame.pgm -o x --threads some", 2, "--threads"});
    cases.push_back({command + " frame.pgm -o", 2, "-"});
  }
  expect_one_line_each(cases, directory_);
}

// Of a frame a quarter of which is far hotter than the rest, and of one of which a twentieth is.
TEST_F(Messages, MuchClippingIsToldOnceARunWithARemedy) {
  const auto half_hot = [](int hot_columns) {
    std::string pixels;
    for (int i = 0; i < 40 * 40; ++i) {
      const int counts = (i % 40 < hot_columns ? 4000 : 3000) + i % 7;
      pixels += {static_cast<char>(counts & 255), static_cast<char>(counts >> 8)};
    }
    return pixels;
  };
  write_text(path("two.raw"), half_hot(10) + half_hot(10));
  write_text(path("little.raw"), half_hot(2));
  const std::string kept =
      "thermedge: warning: two.raw[0]: a gain of 0.5 grey levels a count clips 25.0 % of the "
      "pixels "
      "(0.0 % below, 25.0 % above), and no edges can be seen there: ";
  struct Case {
    std::string arguments;
    std::string remedy;
  };
  for (const Case& given : {Case{"detect two.raw --preset paper",
                                 "--set grey_scale.gain=0.1 clips 0.0 %, and --preset robust or "
                                 "fast scale nothing"},
                            {"scale two.raw -o out", "--gain 0.1 clips 0.0 %"}}) {
    const auto result = run(given.arguments + " --raw-size 40x40");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(without_summary(result.err),
              kept + given.remedy + " (later frames are not checked)\n");
    EXPECT_EQ(run(given.arguments + " --raw-size 40x40 --quiet").err, "");
  }
  EXPECT_EQ(without_summary(run("detect two.raw --raw-size 40x40").err), "");
  EXPECT_EQ(without_summary(run("scale two.raw -o out --stable --raw-size 40x40").err), "");
  EXPECT_EQ(without_summary(run("scale two.raw -o out --stable --gain 0.5 --raw-size 40x40").err),
            "thermedge: warning: frames with more than 5 % of their pixels clipped: 2 of 2; the "
            "most, 25.0 %, in two.raw[0]; a smaller --gain, or none, clips less\n");
  EXPECT_EQ(run("detect little.raw --preset paper --raw-size 40x40").err, "");
  EXPECT_EQ(run("scale little.raw -o little.png --raw-size 40x40").err, "");
  const auto json = run("scale two.raw -o out --raw-size 40x40 --json-log").err;
  EXPECT_TRUE(json.starts_with("{\"level\":\"warning\",\"message\":\"two.raw[0]: a gain")) << json;
}

// The commands that read frames share these.
TEST_F(Messages, BadFramesAreBadInput) {
  std::vector<BadCase> cases;
  for (const std::string command : {"detect", "trace", "scale -o x", "denoise -o x", "stages -o x",
                                    "compare -o x", "bench", "probe"}) {
    cases.push_back({command + " missing.png", 1, "missing.png: no such file"});
    cases.push_back({command + " bad.png", 1, "bad.png"});
    cases.push_back({command + " empty.png", 1, "empty.png"});
    cases.push_back({command + " empty", 1, "empty"});
    cases.push_back({command + " '*.tiff'", 1, "*.tiff"});
    cases.push_back({command + " frame.raw", 1, "--raw-size"});
    cases.push_back({command + " sim:nowhere", 1, "nowhere"});
    cases.push_back({command + " frame.raw --raw-size 8x6 --raw-format gray4", 2, "gray4"});
    cases.push_back({command + " frame.raw --raw-size 8", 2, "--raw-size 8"});
    cases.push_back({command + " frame.raw --raw-size -8x6", 2, "--raw-size"});
    cases.push_back({command + " frame.pgm --simd mmx", 2, "--simd"});
  }
  expect_one_line_each(cases, directory_);
  EXPECT_FALSE(fs::exists(directory_ / "x")) << "nothing is made where there is nothing to write";
}

// 8-bit frames are grey levels already, whatever the gain.
TEST_F(Messages, EightBitFramesAreNotScaled) {
  for (const std::string options : {"", " --gain 0.1", " --stable"}) {
    const auto result = run("scale frame.pgm -o x.png" + options);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.err.find("frame.pgm: 8-bit frames are grey levels already"), std::string::npos)
        << result.err;
    const auto picture = io::read_picture(path("x.png"));
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->counts(3, 2), 'x');
  }
}

TEST_F(Messages, OptionsOfTheDetectorAreChecked) {
  std::vector<BadCase> cases;
  for (const std::string command : {"detect", "trace", "stages -o x", "compare -o x", "bench"}) {
    const std::string call = command + " frame.pgm ";
    cases.push_back({call + "--preset best", 2, "--preset"});
    cases.push_back({call + "--keep -1", 2, "--keep"});
    cases.push_back({call + "--keep 2.5", 2, "should be a whole number"});
    cases.push_back({call + "--max-edgels many", 2, "--max-edgels"});
    cases.push_back({call + "--max-false-alarms -1", 2, "--max-false-alarms"});
    cases.push_back({call + "--set", 2, "--set"});
    cases.push_back({call + "--set 'selection' should read", 2, "--set 'selection' should read"});
    cases.push_back({call + "--set selection.keep_edges", 2, "should read stage.option=value"});
    cases.push_back({call + "--set selection.magic=1", 2, "selection.magic"});
    cases.push_back({call + "--config missing.toml", 1, "missing.toml"});
  }
  expect_one_line_each(cases, directory_);
}

TEST_F(Messages, OptionsOfEachCommandAreChecked) {
  expect_one_line_each(
      {{"detect frame.pgm --denoise strong", 2, "--denoise: denoise.method = 'strong'"},
       {"detect frame.pgm --sigma 0", 2, "--sigma 0"},
       {"detect frame.pgm --sigma -3", 2, "--sigma"},
       {"detect frame.pgm --sigma 3counts", 2, "--sigma 3counts"},
       {"detect frame.pgm -o - --write json", 2, "--write needs a directory"},
       {"detect frame.pgm -o x.csv --write json", 2, "-o x.csv: --write needs a directory"},
       {"detect frame.pgm -o - --points angle", 2,
        "--points angle: should be of position, normal, strength, sigma"},
       {"detect frame.pgm -o x.csv --points sigma", 2, "--points: is for JSON"},
       {"detect frame.pgm --points sigma", 2, "--points: is for JSON"},
       {"detect frame.pgm -o out --write mask,svg --all-edges", 2,
        "--all-edges: is for JSON and CSV"},
       {"detect frame.pgm -o file --write json", 1, "file/json"},
       {"detect frame.pgm -o missing/x.json", 1, "missing/x.json"},
       {"trace frame.pgm --denoise none", 2, "--denoise"},
       {"trace frame.pgm -o out --write colours", 2, "--write colours"},
       {"scale frame.pgm", 2, "--output is required"},
       {"scale frame.pgm -o x.png --gain loud", 2, "--gain"},
       {"scale frame.pgm -o x.png --gain -1", 2, "--gain"},
       {"scale frame.pgm -o x.png --dead-band 3", 2, "--stable"},
       {"scale frame.pgm -o x.png --stable --slew 256", 2, "--slew"},
       {"scale frame.raw --raw-size 8x6 -o missing/x.png", 1, "missing/x.png"},
       {"denoise frame.pgm", 2, "-o is required"},
       {"denoise -o x.png", 2, "INPUT is required"},
       {"denoise frame.pgm -o x.png --method strong", 2, "--method"},
       {"denoise frame.pgm -o x.png --sigma none", 2, "--sigma none"},
       {"denoise frame.pgm -o x.png --set selection.keep_edges=1", 2, "selection.keep_edges"},
       {"stages frame.pgm -o x.png --panel-px 99", 2, "--panel-px"},
       {"stages frame.pgm -o x --format jpg", 2, "--format"},
       {"compare frame.pgm -o x.png --denoise strong", 2, "--denoise"},
       {"compare frame.pgm -o x.png --log-kernel 62", 2, "--log-kernel"},
       {"compare frame.pgm -o x.png --canny-high 3sigmas", 2, "--canny-high 3sigmas"},
       {"compare frame.pgm -o x.png --canny-low 3", 2, "needs the high one"},
       {"compare frame.pgm -o x.png --canny-low 3 --canny-high 2", 2, "above the high one"},
       {"detect frame.pgm -o x --explain", 2, "--write overlay"},
       {"compare frame.pgm -o x.png --write log,hough", 2, "--write hough"},
       {"radiation", 2, "--output is required"},
       {"radiation -o x", 2, "-o x: should be a file"},
       {"radiation -o x.jpg", 2, "-o x.jpg: should be a file, .png, .svg or .pdf\n"},
       {"snr frame.pgm", 2, "-o is required: a .png, .svg or .pdf\n"},
       {"snr frame.pgm -o x.jpg", 2, "-o x.jpg: should be a file, .png, .svg or .pdf\n"},
       {"snr frame.pgm -o frame.pgm/", 2, "should be a file, .png, .svg or .pdf\n"},
       {"simulate desk -o x.png", 2, "where its name has a dot in it, end it in /"},
       {"compare --write frame.pgm -o x.png", 2,
        "INPUT is required: a file, directory, glob, - or sim:NAME (a word after an option that "
        "takes a value is that value)"},
       {"radiation -o x.png --kelvin 20", 2, "20 K"},
       {"radiation -o x.png --band-from 20", 2, "20 to 13 um"},
       {"snr frame.pgm -o x", 2, "-o x: should be a file"},
       {"snr frame.pgm -o x.png --degc-per-count 0", 2, "--degc-per-count"},
       {"bench frame.pgm --frames 0", 2, "--frames"},
       {"bench frame.pgm --seconds forever", 2, "--seconds"},
       {"bench frame.pgm -o x.txt", 2, "redirect it to a file"},
       {"probe frame.pgm --preset best", 2, "--preset"},
       {"probe frame.pgm --degc-per-count 1e4", 2, "--degc-per-count"},
       {"probe frame.pgm --camera planck:1,2", 2, "--camera"},
       {"probe frame.pgm --panel-px 5000", 2, "--panel-px"},
       {"evaluate frame.pgm frame.pgm --thresholds 0", 2, "--thresholds"},
       {"evaluate frame.pgm frame.pgm --at 256", 2, "--at"},
       {"evaluate frame.pgm --shift 65", 2, "--shift"},
       {"evaluate frame.pgm frame.pgm --sigma -1", 2, "--sigma"},
       {"simulate desk -o out --seed x", 2, "seed"},
       {"simulate desk -o out --format gif", 2, "--format"},
       {"simulate desk -o out --set width=0", 2, "width"},
       {"simulate desk -o out --set width", 2, "width"}},
      directory_);
  EXPECT_FALSE(fs::exists(directory_ / "x.png"));
  EXPECT_FALSE(fs::exists(directory_ / "out"));
}

TEST_F(Messages, EveryCommandHasHelp) {
  const std::string all = output_of("--help");
  for (const std::string command : kCommands) {
    EXPECT_NE(all.find("\n  " + command + " "), std::string::npos) << command;
    const std::string help = output_of(command + " --help");
    for (const std::string option : {"--threads", "--quiet", "--json-log", "--output"}) {
      EXPECT_NE(help.find(option), std::string::npos) << command << " " << option;
    }
  }
  EXPECT_EQ(output_of("--version").substr(0, 10), "thermedge ");
}

}  // namespace
}  // namespace thermedge::test
