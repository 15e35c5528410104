// Inputs and outputs by name: which frames are read, in which order, and how their results are
// called.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "support/encoded_pictures.hpp"
#include "support/images.hpp"
#include "support/program.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 48;
constexpr int kHeight = 36;

class Inputs : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    auto scene = sim::render({.camera = {.width = kWidth, .height = kHeight}}, 0);
    ASSERT_TRUE(scene);
    counts_ = std::move(scene->counts);
  }

  void write_frame(const std::string& name) const {
    fs::create_directories((directory_ / name).parent_path());
    ASSERT_TRUE(io::write_picture(path(name), ImageView<const std::uint16_t>(counts_)));
  }

  // `source` of every line of JSON.
  static std::vector<std::string> sources_of(const std::string& lines) {
    std::vector<std::string> sources;
    std::istringstream text(lines);
    for (std::string line; std::getline(text, line);) {
      sources.push_back(nlohmann::json::parse(line, nullptr, false)["source"]);
    }
    return sources;
  }
  [[nodiscard]] std::vector<std::string> sources(const std::string& inputs) const {
    return sources_of(output_of("detect -o - --denoise none " + inputs));
  }

  // Relative to the directory, sorted.
  [[nodiscard]] std::set<std::string> files_in(const std::string& name) const {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(directory_ / name)) {
      if (entry.is_regular_file()) {
        files.insert(fs::relative(entry.path(), directory_ / name).string());
      }
    }
    return files;
  }

  // Two frames of the size of others.
  static std::string stack_of_two() {
    return npy_file("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 36, 48)}",
                    std::string(2 * kWidth * kHeight, 'x'));
  }

  Image<std::uint16_t> counts_;
};

using Names = std::vector<std::string>;
using Files = std::set<std::string>;

TEST_F(Inputs, DirectoriesAndGlobsAreReadInNaturalOrder) {
  for (const char* name :
       {"in/f10.png", "in/f2.png", "in/f1.pgm", "in/.hidden.png", "in/sub/x.png", "other.png"}) {
    write_frame(name);
  }
  write_text(path("in/notes.txt"), "not a picture");
  EXPECT_EQ(sources("in"), (Names{"in/f1.pgm", "in/f2.png", "in/f10.png"}));
  EXPECT_EQ(sources("'in/*.png'"), (Names{"in/f2.png", "in/f10.png"}));
  EXPECT_EQ(sources("'in/f?.p*'"), (Names{"in/f1.pgm", "in/f2.png"}));
  EXPECT_EQ(sources("other.png in/f10.png 'in/f?.png'"),
            (Names{"other.png", "in/f10.png", "in/f2.png"}))
      << "in the order given";
}

TEST_F(Inputs, StacksAndScenesNumberTheirFrames) {
  EXPECT_EQ(sources("'sim:desk?width=48&height=36&frames=2'"),
            (Names{"sim:desk?width=48&height=36&frames=2[0]",
                   "sim:desk?width=48&height=36&frames=2[1]"}));
  EXPECT_EQ(sources("'sim:desk?width=48&height=36'"), (Names{"sim:desk?width=48&height=36"}));
  const auto lines = [&](const std::string& seed) {
    auto json = nlohmann::json::parse(
        output_of("detect -o - --denoise gaussian 'sim:desk?width=96&height=72&seed=" + seed + "'"),
        nullptr, false);
    return json["edges"];
  };
  EXPECT_EQ(lines("3"), lines("3"));
  EXPECT_NE(lines("3"), lines("4"));
}

struct RawCase {
  std::string format;
  bool big_endian;
};

TEST_F(Inputs, StandardInputHoldsFramesInEveryRawFormat) {
  write_frame("frame.png");
  const auto edges_of = [](const std::string& line) {
    return nlohmann::json::parse(line, nullptr, false)["edges"];
  };
  const auto wanted = edges_of(output_of("detect frame.png -o - --denoise gaussian"));
  ASSERT_FALSE(wanted.empty());
  for (const RawCase& raw : {RawCase{"gray16le", false}, {"gray16be", true}}) {
    std::string bytes;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const char high = static_cast<char>(counts_(x, y) >> 8);
        const char low = static_cast<char>(counts_(x, y) & 255);
        bytes += raw.big_endian ? std::string{high, low} : std::string{low, high};
      }
    }
    write_text(path("frames.raw"), bytes + bytes);
    for (const std::string input : {"- < frames.raw", "frames.raw"}) {
      const std::string lines = output_of("detect -o - --denoise gaussian --raw-size 48x36 " +
                                          std::string("--raw-format ") + raw.format + " " + input);
      ASSERT_EQ(count_lines(lines), 2U) << input;
      EXPECT_EQ(edges_of(lines.substr(0, lines.find('\n'))), wanted) << raw.format;
      EXPECT_EQ(edges_of(lines.substr(lines.find('\n') + 1)), wanted) << raw.format;
    }
  }
}

TEST_F(Inputs, RawFramesOf8BitsStayAsTheyAre) {
  std::string bytes(kWidth * kHeight, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>(i * 37 % 251);
  }
  write_text(path("levels.raw"), bytes);
  ASSERT_EQ(output_of("denoise levels.raw --raw-size 48x36 --raw-format gray8 --method none "
                      "--set bad_pixels.replace=false --set stripes.remove=false -o x.pgm"),
            "");
  const std::string pgm = text_of("x.pgm");
  ASSERT_GT(pgm.size(), bytes.size());
  EXPECT_EQ(pgm.substr(0, 2), "P5");
  EXPECT_EQ(pgm.substr(pgm.size() - bytes.size()), bytes);
}

TEST_F(Inputs, WhatIsLeftOverOfARawStreamIsSaid) {
  write_text(path("frames.raw"), std::string(2 * kWidth * kHeight + 100, 'x'));
  const auto result = run("detect - --raw-size 48x36 --denoise none -o - < frames.raw");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(count_lines(result.out), 1U) << "the frames before are not lost";
  EXPECT_EQ(count_lines(without_summary(result.err)), 1U) << result.err;
  EXPECT_NE(result.err.find("100 bytes are left over"), std::string::npos) << result.err;
}

// -o DIR, for each command that writes files: frames of a sequence, a single frame, and a stem that
// comes twice.
TEST_F(Inputs, ResultsAreNamedAfterTheirFrames) {
  write_frame("a/x.png");
  write_frame("b/x.png");
  const std::string inputs = " a/x.png 'sim:desk?width=48&height=36&frames=2' b/x.png ";
  const Files pictures = {"x.png", "x_2.png", "desk_0000.png", "desk_0001.png"};
  for (const std::string command : {"scale --gain 0.1", "denoise --method gaussian"}) {
    ASSERT_EQ(output_of(command + inputs + "-o " + command.substr(0, 5)), "");
    EXPECT_EQ(files_in(command.substr(0, 5)), pictures) << command;
  }
  ASSERT_EQ(output_of("detect --denoise none" + inputs + "-o detect --write svg,json"), "");
  EXPECT_EQ(files_in("detect"),
            (Files{"svg/x.svg", "svg/x_2.svg", "svg/desk_0000.svg", "svg/desk_0001.svg",
                   "json/x.json", "json/x_2.json", "json/desk_0000.json", "json/desk_0001.json"}));
  ASSERT_EQ(output_of("trace --threshold 1" + inputs + "-o trace"), "");
  EXPECT_EQ(files_in("trace"),
            (Files{"mask/x.png", "mask/x_2.png", "mask/desk_0000.png", "mask/desk_0001.png"}));
  ASSERT_EQ(output_of("compare --set denoise.method=none --panel-px 100 --format svg --write log"
                      " a/x.png b/x.png -o compare"),
            "");
  EXPECT_EQ(files_in("compare"),
            (Files{"x/sheet.svg", "x/log.png", "x_2/sheet.svg", "x_2/log.png"}));
}

TEST_F(Inputs, OneFileForSeveralFramesIsOneErrorAtOnce) {
  write_frame("frame.png");
  write_text(path("stack.npy"), stack_of_two());
  for (const std::string command :
       {"scale --gain 0.1", "denoise --method gaussian", "detect --denoise none", "trace",
        "stages --panel-px 100 --denoise none",
        "compare --panel-px 100 --set denoise.method=none"}) {
    for (const std::string inputs :
         {"frame.png frame.png", "stack.npy", "frame.png sim:corridor"}) {
      const auto result = run(command + " " + inputs + " -o one.png");
      EXPECT_EQ(result.exit_code, 2) << command;
      EXPECT_EQ(result.err,
                "thermedge: error: -o one.png: has room for one frame, and the inputs hold 2; give "
                "a directory: -o DIR\n");
      EXPECT_FALSE(fs::exists(directory_ / "one.png")) << command << " " << inputs;
    }
  }
}

TEST_F(Inputs, EndingsThatAreNotWrittenAreErrors) {
  write_frame("frame.png");
  fs::create_directories(directory_ / "taken.jpg");
  struct Case {
    std::string command, endings;
  };
  for (const Case& c :
       {Case{"scale --gain 0.1", ".png, .tif, .tiff, .pgm, .npy or .raw"},
        {"denoise --method gaussian", ".png, .tif, .tiff, .pgm, .npy or .raw"},
        {"detect --denoise none", ".png, .json, .jsonl, .csv or .svg"},
        {"trace --threshold 1", ".png, .json, .jsonl, .csv or .svg"},
        {"stages --panel-px 100 --denoise none", ".png, .svg or .pdf"},
        {"compare --panel-px 100 --set denoise.method=none", ".png, .svg or .pdf"}}) {
    const auto result = run(c.command + " frame.png -o x.jpg");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err,
              "thermedge: error: -o x.jpg: .jpg files are not written; the name of a file should "
              "end in " +
                  c.endings + ", that of a new directory in /\n");
    EXPECT_FALSE(fs::exists(directory_ / "x.jpg"));
    EXPECT_EQ(output_of(c.command + " frame.png -o X.PNG"), "");
    EXPECT_EQ(text_of("X.PNG").substr(1, 3), "PNG") << c.command;
    fs::remove(directory_ / "X.PNG");
    EXPECT_EQ(output_of(c.command + " frame.png -o taken.jpg"), "") << "a directory";
    EXPECT_EQ(output_of(c.command + " frame.png -o new.d/"), "") << "a directory by its name";
    EXPECT_EQ(output_of(c.command + " frame.png -o run.2024-05-01"), "") << "no ending";
    for (const char* name : {"new.d", "run.2024-05-01"}) {
      EXPECT_TRUE(fs::is_directory(directory_ / name)) << c.command;
      fs::remove_all(directory_ / name);
    }
  }
}

// Recordings are what nobody can make again.
TEST_F(Inputs, AreNeverReplaced) {
  write_frame("in/a.png");
  write_frame("in/b.png");
  write_frame("in/mask/c.png");
  fs::create_symlink("in", directory_ / "by_link");
  fs::create_symlink("in/a.png", directory_ / "link.png");
  fs::create_hard_link(directory_ / "in/a.png", directory_ / "hard.png");
  const std::string before = text_of("in/a.png");
  for (const std::string command :
       {"scale --gain 0.1", "denoise --method gaussian", "detect --denoise none", "trace",
        "stages --panel-px 100 --denoise none",
        "compare --panel-px 100 --set denoise.method=none"}) {
    for (const std::string arguments :
         {"in -o in", "in -o ./in/", "in -o in/../in", "in -o by_link", "by_link -o in",
          "'in/*.png' -o in", "in/a.png -o in", "in/a.png -o in/a.png", "in/a.png -o ./in//a.png",
          "in/a.png -o link.png", "link.png -o in/a.png", "in/a.png -o hard.png", "link.png -o in",
          "in/a.png -o by_link/a.png"}) {
      const auto result = run(command + " " + arguments);
      EXPECT_EQ(result.exit_code, 2) << command << " " << arguments;
      EXPECT_EQ(count_lines(result.err), 1U) << result.err;
      EXPECT_NE(result.err.find("the input "), std::string::npos) << result.err;
    }
  }
  for (const std::string arguments :
       {"detect in/mask -o in", "detect in/mask/c.png -o in --write svg,mask",
        "detect in/b.png --mask in/a.png -o in/a.png", "probe in/a.png -o in/a.png",
        "probe in/a.png --toml hard.png", "evaluate in/a.png -o in/a.png",
        "evaluate in -o link.png",
        "compare in/a.png -o in/x.png --panel-px 100 --write log "
        "--mask in/x_log.png"}) {
    if (arguments.starts_with("compare")) {
      write_frame("in/x_log.png");
    }
    const auto result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << ": " << result.err;
    EXPECT_NE(result.err.find("the input "), std::string::npos) << result.err;
  }
  EXPECT_EQ(text_of("in/a.png"), before);
  EXPECT_TRUE(fs::is_symlink(directory_ / "link.png"));
  // Beside the inputs there is room.
  EXPECT_EQ(output_of("scale in/a.png --gain 0.1 -o in/a8.png"), "");
  EXPECT_EQ(run("scale in --gain 0.1 -o in/eight_bits").exit_code, 0);
}

TEST_F(Inputs, SceneFilesAreNotReplaced) {
  fs::create_directories(directory_ / "scenes");
  write_text(path("scenes/truth.jsonl"), "not even TOML");
  const auto result = run("simulate scenes/truth.jsonl -o scenes --frames 1");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("-o scenes/truth.jsonl: is the input"), std::string::npos)
      << result.err;
  EXPECT_EQ(text_of("scenes/truth.jsonl"), "not even TOML");
}

TEST_F(Inputs, AreCroppedByFlagAndFile) {
  write_frame("frame.png");
  write_text(path("half.toml"), "[source]\ncrop = \"bottom-half\"\n");
  const auto size_of = [&](const std::string& arguments) {
    const auto line = nlohmann::json::parse(
        output_of("detect frame.png -o - --denoise none " + arguments), nullptr, false);
    return std::to_string(line["width"].get<int>()) + "x" +
           std::to_string(line["height"].get<int>());
  };
  EXPECT_EQ(size_of(""), "48x36");
  EXPECT_EQ(size_of("--crop 4,2,40,30"), "40x30");
  EXPECT_EQ(size_of("--config half.toml"), "48x18");
  EXPECT_EQ(size_of("--set source.crop=top-half"), "48x18");
  EXPECT_EQ(size_of("--config half.toml --crop 0,0,20,20"), "20x20") << "the flag wins";
  EXPECT_EQ(size_of("--config half.toml --crop all"), "48x36");
  for (const std::string command : {"denoise --method none", "scale --gain 0.1"}) {
    ASSERT_EQ(output_of(command + " frame.png --crop 4,2,40,30 -o part.pgm"), "");
    EXPECT_EQ(text_of("part.pgm").substr(3, 5), "40 30") << command;
  }
  const std::string dumped =
      output_of("detect --dump-config --crop 1,2,30,20 --byte-order swapped --raw-header 16");
  EXPECT_NE(dumped.find("[source]\ncrop = \"1,2,30,20\""), std::string::npos) << dumped;
  write_text(path("all.toml"), dumped);
  EXPECT_EQ(output_of("detect --dump-config --config all.toml"), dumped);
  expect_one_line_each(
      {{"detect frame.png --crop 0,0,49,36", 1,
        "frame.png: crop 0,0,49,36: 49x36 pixels from (0, 0) do not lie within the frame of 48x36"},
       {"detect frame.png --crop half", 2, "--crop half: should be X,Y,WIDTH,HEIGHT"},
       {"detect frame.png --set source.crop=x", 2, "--set source.crop = x: should be X,Y"},
       {"detect frame.png --set source.cut=x", 2, "unknown option; there are source.crop, "},
       {"detect frame.png --byte-order both", 2,
        "--byte-order both: should be one of format, little, big, swapped"}},
      directory_);
  write_text(path("bad.toml"), "[source]\n\ncrop = \"x\"\n");
  expect_one_line_each(
      {{"detect frame.png --config bad.toml", 2, "bad.toml: line 3: source.crop = x: "}},
      directory_);
}

TEST_F(Inputs, MasksAreOfTheWholeFrameOrOfItsPart) {
  write_frame("frame.png");
  for (const auto& [name, width, height] :
       {std::tuple<std::string, int, int>{"whole.png", kWidth, kHeight}, {"part.png", 40, 30}}) {
    Image<std::uint8_t> mask(width, height);
    fill_pixels(mask.view(), std::uint8_t{255});
    mask(width - 10, height - 10) = 0;
    ASSERT_TRUE(io::write_picture(path(name), ImageView<const std::uint8_t>(mask)));
    const auto line = nlohmann::json::parse(
        output_of("detect frame.png -o - --crop 4,2,40,30 --denoise none --mask " + name), nullptr,
        false);
    EXPECT_EQ(line["stats"]["invalid_pixels"]["given"], 1) << name;
  }
}

TEST_F(Inputs, OfFloatsGiveTheEdgesOfTheirCounts) {
  write_frame("counts.png");
  std::string degc;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float value = static_cast<float>(counts_(x, y)) / 64 - 273;  // exact
      std::uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof(bits));
      degc += number(bits, 4, false);
    }
  }
  write_text(path("degc.npy"),
             npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (36, 48)}", degc));
  const auto edges_of = [&](const std::string& arguments) {
    return nlohmann::json::parse(output_of("detect -o - " + arguments), nullptr, false);
  };
  const auto counts = edges_of("counts.png");
  const auto values = edges_of("degc.npy");
  ASSERT_GT(counts["edges"].size(), 0U);
  EXPECT_EQ(values["edges"].size(), counts["edges"].size());
  EXPECT_NEAR(values["edges"][0]["contrast_counts"].get<double>(),
              counts["edges"][0]["contrast_counts"].get<double>() / 64, 0.05);
  ASSERT_EQ(output_of("denoise degc.npy --method none --set stripes.remove=false --set "
                      "bad_pixels.replace=false -o out"),
            "");
  const auto written = io::read_picture(path("out/degc.tif"));
  ASSERT_TRUE(written && written->is_float());
  EXPECT_NEAR(written->values(5, 5), counts_(5, 5) / 64.0 - 273, 0.02);
  expect_one_line_each({{"denoise degc.npy --method none -o x.png", 1,
                         "x.png: the name should end in .tif, .tiff, .npy or .raw"}},
                       directory_);
}

TEST_F(Inputs, NotesTellWhatIsPassedOver) {
  write_frame("frame.png");
  write_text(path("more.png"), text_of("frame.png") + "what the camera adds");
  const auto result = run("detect more.png --denoise none");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "thermedge: more.png: 20 bytes after the picture are passed over\n");
  EXPECT_EQ(run("detect more.png --denoise none --quiet").err, "");
}

TEST_F(Inputs, SheetsAreOfTheFormatAskedFor) {
  write_frame("frame.png");
  for (const std::string format : {"png", "svg", "pdf"}) {
    ASSERT_EQ(output_of("stages frame.png --denoise none --panel-px 100 -o out --format " + format),
              "");
    const std::string sheet = text_of("out/frame/sheet." + format);
    const std::string rank = text_of("out/frame/11_rank." + format);
    for (const std::string& bytes : {sheet, rank}) {
      EXPECT_EQ(bytes.substr(0, 4), format == "png"   ? "\x89PNG"
                                    : format == "svg" ? "<?xm"
                                                      : "%PDF");
    }
    EXPECT_GT(sheet.size(), rank.size());
  }
}

}  // namespace
}  // namespace thermedge::test
