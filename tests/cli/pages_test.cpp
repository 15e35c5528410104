// Pages for people: their numbers are those of the JSON for programs, and their words fit them.
#include <gtest/gtest.h>

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/edge_maps.hpp"
#include "support/images.hpp"
#include "support/program.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/simd.hpp"

namespace thermedge::test {
namespace {

using Json = nlohmann::json;

class Pages : public ProgramTest {
 protected:
  [[nodiscard]] Json json_of(const std::string& arguments) const {
    return Json::parse(output_of(arguments + " --json"), nullptr, false);
  }
  // A row of a page: the label, then the value.
  static void expect_row(const std::string& page, const std::string& label,
                         const std::string& value) {
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t at = line.find_first_not_of(' ');
      if (at != std::string::npos && line.compare(at, label.size() + 1, label + " ") == 0) {
        EXPECT_EQ(line.find(value, at + label.size()),
                  line.find_first_not_of(' ', at + label.size()))
            << line << " instead of " << value;
        return;
      }
    }
    ADD_FAILURE() << "no row " << label << " in\n" << page;
  }
  static double number(const Json& value) { return value.get<double>(); }
};

// Strong noise, as of frames with swapped bytes.
TEST_F(Pages, ProbeKeepsTheNumbersOfTheMapApart) {
  const std::string page = output_of("probe 'sim:desk?width=96&height=72&frames=2&sigma=2000'");
  const std::size_t map = page.find("map: sigma over the picture");
  ASSERT_NE(map, std::string::npos) << page;
  std::istringstream row(page.substr(page.find('\n', page.find('\n', map) + 1)));
  for (int column = 0; column < 3; ++column) {
    double sigma = 0;
    row >> sigma;
    EXPECT_GT(sigma, 1000) << page;
    EXPECT_LT(sigma, 3000) << page;
    EXPECT_EQ(row.peek(), ' ') << page;
  }
}

TEST_F(Pages, ProbeTellsTheNumbersOfItsJson) {
  const std::string probe = "probe 'sim:desk?width=96&height=72&frames=6&sigma=6'";
  const std::string page = output_of(probe);
  const Json json = json_of(probe);
  const Json& noise = json["noise"];
  const Json& range = json["range"];
  EXPECT_TRUE(page.starts_with("sim:desk?width=96&height=72&frames=6&sigma=6: 6 frames of 96x72"));
  expect_row(page, "sigma",
             fmt::format("{:.2f} counts = {:.3f} degC", number(noise["sigma_counts"]),
                         number(noise["sigma_degc"])));
  expect_row(page, "pixel to pixel", fmt::format("{:.2f}", number(noise["pixel_sigma_counts"])));
  expect_row(page, "spectrum", noise["kind"].get<std::string>());
  expect_row(page, "of all frames",
             fmt::format("{} to {} counts", range["min_counts"].get<int>(),
                         range["max_counts"].get<int>()));
  expect_row(page, "SNR", fmt::format("{:.0f}", number(noise["snr"])));
  expect_row(page, "lasting", std::to_string(json["bad_pixels"].get<int>()));
  expect_row(page, "columns", fmt::format("{:.2f}", number(noise["column_sigma_counts"])));
  EXPECT_NE(page.find(" vertical stripes: "), std::string::npos) << page;
  EXPECT_NE(page.find(" horizontal stripes: "), std::string::npos) << page;
  expect_row(page, "repeated", "0 frames");
  for (const Json& entry : json["clipping"]) {
    const double gain = number(entry["gain"]);
    if (gain == 0.5 || gain == 0.2) {
      expect_row(page, fmt::format("gain {}", gain),
                 fmt::format("{:.1f} % clipped", 100 * number(entry["clipped_share"])));
    }
  }
}

// Noise that is four times as strong in the right half, and smooth: the map has both levels, the
// spectrum is blank at its lower right.
TEST_F(Pages, ProbeDrawsMapAndSpectrumAsText) {
  const auto noise = noise_image<std::uint16_t>(241, 201, 3000, 20, 5);
  Image<std::uint16_t> frame(240, 200);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 240; ++x) {
      const int sum = noise(x, y) + noise(x + 1, y) + noise(x, y + 1) + noise(x + 1, y + 1);
      frame(x, y) = static_cast<std::uint16_t>(3000 + (x < 120 ? 1 : 4) * (sum - 12000) / 4);
    }
  }
  ASSERT_TRUE(io::write_picture(path("smooth.png"), ImageView<const std::uint16_t>(frame.view())));
  const std::string page = output_of("probe smooth.png");
  expect_row(page, "spectrum", "smooth");
  std::istringstream rest(page.substr(page.find("downwards along the columns\n") + 28));
  std::vector<std::string> rows(8);
  for (std::string& row : rows) {
    std::getline(rest, row);
  }
  for (int i = 0; i < 4; ++i) {
    std::istringstream cells(rows[static_cast<std::size_t>(i)]);
    double left = 0;
    double right = 0;
    cells >> left >> right >> right >> right >> right >> right;
    EXPECT_NEAR(left, 16, 3) << rows[static_cast<std::size_t>(i)];
    EXPECT_NEAR(right, 57, 12) << rows[static_cast<std::size_t>(i)];
  }
  EXPECT_NE(rows[1].find("o o o"), std::string::npos) << rows[1];
  EXPECT_EQ(rows[7].find_first_not_of(" .", 5), std::string::npos) << rows[7];
}

TEST_F(Pages, ProbeNamesTheGainThatClipsLess) {
  const std::string page = output_of("probe --preset paper 'sim:desk?width=96&height=72'");
  EXPECT_NE(page.find("edges there are lost: use --set grey_scale.gain=0.2"), std::string::npos)
      << page;
}

struct NoiseWord {
  const char* sigma;
  const char* word;
};

TEST_F(Pages, ProbeGradesTheNoise) {
  for (const NoiseWord& noise : {NoiseWord{"2", "very good for an uncooled camera"},
                                 {"5", "usual for an uncooled camera"},
                                 {"10", "noisy: a denoiser is worth its time"},
                                 {"25", "very noisy: a denoiser is needed"}}) {
    const std::string page =
        output_of("probe 'sim:desk?width=96&height=72&sigma=" + std::string(noise.sigma) + "'");
    EXPECT_NE(page.find(noise.word), std::string::npos) << noise.sigma << "\n" << page;
    EXPECT_NE(page.find("1 frame of"), std::string::npos);
  }
}

TEST_F(Pages, ProbeSeesAShutter) {
  const std::string still =
      output_of("probe 'sim:desk?width=96&height=72&frames=12&shutter_every=100'");
  EXPECT_NE(still.find("none: good"), std::string::npos) << still;
  EXPECT_EQ(still.find("shutter (FFC)"), std::string::npos);
  const std::string page =
      output_of("probe 'sim:desk?width=96&height=72&frames=12&shutter_every=5&shutter_frames=3'");
  expect_row(page, "repeated", "5 frames");
  expect_row(page, "longest freeze", "3 frames");
  EXPECT_NE(page.find("a shutter (FFC)"), std::string::npos);
}

TEST_F(Pages, ProbeOf8BitsSpeaksOfLevelsAlone) {
  ASSERT_EQ(output_of("scale 'sim:desk?width=96&height=72' -o view.png --quiet"), "");
  const std::string page = output_of("probe view.png");
  expect_row(page, "bits", "8 of 8 used");
  EXPECT_NE(page.find("scaled already"), std::string::npos);
  EXPECT_EQ(page.find("degC"), std::string::npos) << page;
  EXPECT_EQ(page.find("Algorithm 1"), std::string::npos) << page;
}

TEST_F(Pages, ProbeOfAConstantFrameHasNoNoise) {
  write_text(path("flat.pgm"), "P5 32 24 255\n" + std::string(32 * 24, 'x'));
  const std::string page = output_of("probe flat.pgm");
  expect_row(page, "sigma", "none");
  EXPECT_EQ(page.find("nan"), std::string::npos) << page;
  EXPECT_EQ(page.find("inf "), std::string::npos) << page;
}

// The name of several inputs, and what is left out.
TEST_F(Pages, ProbeNamesTheFirstOfItsInputs) {
  const std::string page =
      output_of("probe 'sim:desk?width=96&height=72' 'sim:corridor?width=96&height=72'");
  EXPECT_TRUE(page.starts_with("sim:desk?width=96&height=72 and 1 more: 2 frames of 96x72"))
      << page;
}

class EvaluationPages : public Pages {
 protected:
  void SetUp() override {
    Pages::SetUp();
    for (const char* name : {"maps", "truth", "grey"}) {
      std::filesystem::create_directory(directory_ / name);
    }
    for (unsigned i = 0; i < 2; ++i) {
      const auto map = random_edge_map(80, 60, 8, 2, i);
      const std::string name = "/f" + std::to_string(i) + ".png";
      write("maps" + name, binary(map.view()));
      write("grey" + name, map);
      write("truth" + name, binary(annotated(map.view(), 1, 0, i).view()));
    }
  }
  void write(const std::string& name, const Image<std::uint8_t>& map) {
    ASSERT_TRUE(io::write_picture(path(name), ImageView<const std::uint8_t>(map)));
  }
  static Image<std::uint8_t> binary(ImageView<const std::uint8_t> map) {
    Image<std::uint8_t> made(map.width(), map.height());
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        made(x, y) = map(x, y) != 0 ? 255 : 0;
      }
    }
    return made;
  }
};

TEST_F(EvaluationPages, TellTheNumbersOfTheirJson) {
  for (const std::string arguments : {"maps truth", "grey truth", "grey truth --at 100",
                                      "grey truth --thresholds 9", "maps truth --max-dist 0.02"}) {
    const std::string page = output_of("evaluate " + arguments);
    const Json json = json_of("evaluate " + arguments);
    for (const auto& [label, key] :
         {std::pair{"F", "f"}, {"precision", "precision"}, {"recall", "recall"}}) {
      expect_row(page, label, fmt::format("{:.4f}", number(json[key])));
    }
    const bool swept = arguments.starts_with("grey") && arguments.find("--at") == std::string::npos;
    EXPECT_EQ(page.find("OIS") != std::string::npos, swept) << page;
    EXPECT_NE(page.find("2 frames"), std::string::npos);
  }
  EXPECT_NE(output_of("evaluate grey truth --thresholds 9").find("strength maps at 9 thresholds"),
            std::string::npos);
  EXPECT_NE(output_of("evaluate maps truth --max-dist 0.02").find("within 0.02 of the diagonal"),
            std::string::npos);
}

TEST_F(EvaluationPages, OfOneFrameIsInTheSingular) {
  EXPECT_NE(output_of("evaluate maps/f0.png truth/f0.png").find(": 1 frame,"), std::string::npos);
  const std::string alone = output_of("evaluate maps/f0.png");
  EXPECT_NE(alone.find("1 frame, without truth"), std::string::npos) << alone;
  EXPECT_EQ(alone.find("repeatability"), std::string::npos) << "which needs two frames";
}

TEST_F(EvaluationPages, PerfectMapsScoreOne) {
  Image<std::uint8_t> thin(80, 60);
  fill_pixels(thin.view(), std::uint8_t{0});
  for (int x = 10; x < 70; ++x) {
    thin(x, 20) = 255;
    thin(x, 50 - x / 4) = 255;
  }
  write("thin.png", thin);
  const std::string page = output_of("evaluate thin.png thin.png");
  for (const char* label : {"F", "precision", "recall", "figure of merit"}) {
    expect_row(page, label, "1.0000");
  }
}

TEST_F(EvaluationPages, EmptyScenesCountFalseAlarms) {
  Image<std::uint8_t> empty(80, 60);
  fill_pixels(empty.view(), std::uint8_t{0});
  std::filesystem::create_directory(directory_ / "none");
  write("none/f0.png", empty);
  write("none/f1.png", empty);
  const std::string none = output_of("evaluate none --empty");
  expect_row(none, "edges", "0.00");
  expect_row(none, "edge pixels", "0.0");
  const std::string some = output_of("evaluate maps --empty");
  EXPECT_EQ(some.find("Structure"), std::string::npos) << "of noise is no figure of merit";
  EXPECT_EQ(some.find("nan"), std::string::npos);
}

class BenchPages : public Pages {};

TEST_F(BenchPages, HaveARowForEveryStage) {
  const std::string bench =
      "bench 'sim:desk?width=96&height=72&frames=3' --denoise gaussian "
      "--threads 1 --seconds 0";
  const std::string page = output_of(bench);
  const Json json = json_of(bench);
  EXPECT_TRUE(page.starts_with("96x72 pixels, 1 thread, ")) << page;
  EXPECT_NE(page.find(", 3 frames timed"), std::string::npos) << page;
  EXPECT_NE(page.find(json["simd"].get<std::string>()), std::string::npos);
  EXPECT_NE(page.find(fmt::format("{:.1f} MB", number(json["memory_bytes"]) / 1e6)),
            std::string::npos)
      << "the memory of a size of frames is always the same";
  for (const auto& stage : json["stages"].items()) {
    EXPECT_NE(page.find("\n" + stage.key() + " "), std::string::npos) << stage.key();
  }
  EXPECT_NE(page.find("\ntotal "), std::string::npos);
}

TEST_F(BenchPages, NameTheInstructionSetThatRan) {
  for (const std::string& target : simd_targets()) {
    const std::string bench = "bench 'sim:desk?width=48&height=36' --seconds 0 --simd " + target;
    EXPECT_EQ(json_of(bench)["simd"], target);
    EXPECT_NE(output_of(bench).find(" " + target + ","), std::string::npos) << target;
  }
}

TEST_F(BenchPages, TakeAsManyFramesAsTheyAreTold) {
  const std::string bench =
      "bench 'sim:desk?width=96&height=72&frames=5' --denoise none "
      "--threads 2 --seconds 0 ";
  EXPECT_EQ(json_of(bench + "--frames 2")["frames"], 2);
  EXPECT_EQ(json_of(bench)["frames"], 5);
  EXPECT_EQ(json_of(bench)["threads"], 2);
  const Json longer = json_of("bench 'sim:desk?width=96&height=72' --denoise none --seconds 0.1");
  EXPECT_GT(longer["frames"], 1) << "the frame is repeated for the time";
  const std::string one = output_of(bench + "--frames 1");
  EXPECT_NE(one.find(", 2 threads, "), std::string::npos) << one;
  EXPECT_NE(one.find(", 1 frame timed\n"), std::string::npos) << one;
}

}  // namespace
}  // namespace thermedge::test
