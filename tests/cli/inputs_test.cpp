// Inputs and outputs by name: which frames are read, in which order, and how their results are
// called.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/images.hpp"
#include "support/program.hpp"
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
  EXPECT_EQ(count_lines(result.err), 1U) << result.err;
  EXPECT_NE(result.err.find("100 bytes are left over"), std::string::npos) << result.err;
}

// -o DIR, for each command that writes files: frames of a sequence, a single frame, and a stem that
// comes twice.
TEST_F(Inputs, ResultsAreNamedAfterTheirFrames) {
  write_frame("a/x.png");
  write_frame("b/x.png");
  const std::string inputs = " a/x.png 'sim:desk?width=48&height=36&frames=2' b/x.png ";
  const Files pictures = {"x.png", "x_2.png", "desk_0000.png", "desk_0001.png"};
  for (const std::string command : {"scale --gain 0.2", "denoise --method gaussian"}) {
    ASSERT_EQ(output_of(command + inputs + "-o " + command.substr(0, 5)), "");
    EXPECT_EQ(files_in(command.substr(0, 5)), pictures) << command;
  }
  ASSERT_EQ(output_of("detect --denoise none" + inputs + "-o detect --write svg,json"), "");
  EXPECT_EQ(files_in("detect"),
            (Files{"svg/x.svg", "svg/x_2.svg", "svg/desk_0000.svg", "svg/desk_0001.svg",
                   "json/x.json", "json/x_2.json", "json/desk_0000.json", "json/desk_0001.json"}));
  ASSERT_EQ(output_of("trace" + inputs + "-o trace"), "");
  EXPECT_EQ(files_in("trace"),
            (Files{"mask/x.png", "mask/x_2.png", "mask/desk_0000.png", "mask/desk_0001.png"}));
  ASSERT_EQ(output_of("compare --set denoise.method=none --panel-px 100 --format svg --write log"
                      " a/x.png b/x.png -o compare"),
            "");
  EXPECT_EQ(files_in("compare"),
            (Files{"x/sheet.svg", "x/log.png", "x_2/sheet.svg", "x_2/log.png"}));
}

TEST_F(Inputs, OneFileHoldsTheFirstFrameOnly) {
  write_frame("frame.png");
  for (const std::string command :
       {"scale --gain 0.2", "denoise --method gaussian", "detect --denoise none", "trace",
        "stages --panel-px 100 --denoise none",
        "compare --panel-px 100 --set denoise.method=none"}) {
    ASSERT_EQ(output_of(command + " frame.png -o alone.png"), "");
    const auto result = run(command + " frame.png sim:corridor -o one.png");
    EXPECT_EQ(result.exit_code, 1) << command;
    EXPECT_EQ(count_lines(result.err), 1U) << result.err;
    EXPECT_NE(result.err.find("sim:corridor: one.png holds the first frame"), std::string::npos)
        << result.err;
    // Sheets tell times, which differ from run to run.
    const bool sheet = command.starts_with("stages") || command.starts_with("compare");
    EXPECT_TRUE(sheet || text_of("one.png") == text_of("alone.png")) << command;
    EXPECT_EQ(text_of("one.png").substr(1, 3), "PNG") << command;
  }
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
