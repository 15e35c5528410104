// `thermedge probe` as a user types it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "support/program.hpp"
#include "support/recordings.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::test {
namespace {

// The numbers of a file of counts as hundredths, in float32.
void write_float_npy(const std::filesystem::path& path, const std::filesystem::path& counts) {
  const auto picture = io::read_picture(counts.string());
  ASSERT_TRUE(picture);
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                       std::to_string(picture->height()) + ", " + std::to_string(picture->width()) +
                       "), }";
  header.resize(117, ' ');
  std::string text("\x93NUMPY\x01\x00\x76\x00", 10);
  text += header + "\n";
  for (int y = 0; y < picture->height(); ++y) {
    for (int x = 0; x < picture->width(); ++x) {
      const float value = static_cast<float>(picture->counts(x, y)) / 100;
      text.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }
  write_text(path, text);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

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
  EXPECT_NE(result.out.find("degC: implausible"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("--camera linear:DEGC_PER_COUNT,DEGC_AT_ZERO"), std::string::npos);
  EXPECT_EQ(result.out.find("counts = "), std::string::npos) << "no other degrees\n" << result.out;
  const auto doubted =
      nlohmann::json::parse(run("probe 'sim:desk?width=96&height=72' --camera optris --json").out);
  EXPECT_TRUE(doubted["degc_per_count"].is_null());
  EXPECT_TRUE(doubted["range"]["min_degc"].is_null());
  EXPECT_TRUE(doubted["noise"]["sigma_degc"].is_null());
  EXPECT_GT(doubted["range"]["implausible_degc"][0], 100);
  const auto json = nlohmann::json::parse(
      run("probe 'sim:desk?width=96&height=72' --camera linear:0.04,-100 --json").out);
  EXPECT_EQ(json["degc_per_count"], 0.04);
  EXPECT_NEAR(json["range"]["min_degc"], 0.04 * json["range"]["min_counts"].get<double>() - 100,
              1e-6);
}

// Of counts, levels, floats and parts of frames, under every preset.
TEST_F(ProbeProgram, CallsSigmaWhatDetectDoes) {
  ASSERT_EQ(run("simulate 'desk?width=96&height=72' --frames 1 -o sim --format npy").exit_code, 0);
  ASSERT_EQ(run("scale sim/counts/frame_000000.npy -o levels.png --gain 0.1").exit_code, 0);
  write_float_npy(directory_ / "degrees.npy", directory_ / "sim/counts/frame_000000.npy");
  for (const std::string input :
       {"sim/counts/frame_000000.npy", "levels.png", "degrees.npy", "'sim:corridor?sigma=12'",
        "sim/counts/frame_000000.npy --crop 10,10,64,48",
        "sim/counts/frame_000000.npy --invalid 2500"}) {
    for (const std::string preset : {"robust", "fast", "paper"}) {
      const std::string arguments = input + " --preset " + preset;
      const auto detected = nlohmann::json::parse(run("detect " + arguments + " -o -").out);
      const auto probed = nlohmann::json::parse(run("probe " + arguments + " --json").out);
      const auto& noise = probed["noise"];
      const double sigma =
          (noise["sigma_value"].is_null() ? noise["sigma_counts"] : noise["sigma_value"])
              .get<double>();
      // Of float frames probe measures the nearest counts.
      EXPECT_NEAR(detected["sigma_counts"].get<double>() / sigma, 1,
                  noise["sigma_value"].is_null() ? 1e-3 : 1e-2)
          << arguments;
    }
  }
}

// A file with the camera's calibration tells temperatures without --camera.
TEST_F(ProbeProgram, KnowsTheResponseThatAFileHolds) {
  THERMEDGE_NEEDS_SHARED("data/flir");
  const auto folder = test::shared_directory() / "data" / "flir";
  for (const std::string file : {"flir_example.jpg", "frame_000000_le.fff"}) {
    const std::string path = "'" + (folder / file).string() + "'";
    const auto json = nlohmann::json::parse(run("probe " + path + " --json").out);
    EXPECT_GT(json["range"]["min_degc"], 10) << file;
    EXPECT_LT(json["range"]["max_degc"], 80) << file;
    EXPECT_FALSE(json["degc_per_count_assumed"]) << file;
    EXPECT_TRUE(json["input"].empty()) << file;
    const auto told =
        nlohmann::json::parse(run("probe " + path + " --json --degc-per-count 0.04").out);
    EXPECT_EQ(told["degc_per_count"], 0.04) << "what is told comes first";
    EXPECT_TRUE(told["range"]["min_degc"].is_null());
  }
}

// Written, found, and mended by what is suggested: what is left has no fault and the noise of the
// frames before.
TEST_F(ProbeProgram, TheOptionThatMendsTheInputMendsIt) {
  const auto frames = test::scene_frames("sim:office?frames=2&camera=lepton35");
  const double sigma = nlohmann::json::parse(
      run("probe 'sim:office?frames=2&camera=lepton35' --json").out)["noise"]["sigma_counts"];
  std::string telemetry, swapped, doubled, bordered;
  const auto add = [](int count, std::string& to) {
    to += {static_cast<char>(count & 255), static_cast<char>(count >> 8)};
  };
  for (const auto& frame : frames) {
    std::string plain, view;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const int count = frame(x, y);
        add(count, plain);
        add(std::clamp((count - 2000) / 8, 0, 255), view);
        add((count & 255) << 8 | count >> 8, swapped);
      }
    }
    telemetry += plain;
    for (int x = 0; x < 320; ++x) {
      add(x % 160 < 40 ? 40503 * (x + 1) & 65535 : 0, telemetry);
    }
    doubled += view + plain;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 168; ++x) {
        add(x < 160 ? frame(x, y) : 0, bordered);
      }
    }
  }
  struct Case {
    std::string name, pixels, raw_size, flag, value;
  };
  for (const Case& made : {Case{"telemetry", telemetry, "160x122", "--crop", "0,0,160,120"},
                           Case{"swapped", swapped, "160x120", "--byte-order", "swapped"},
                           Case{"doubled", doubled, "160x240", "--crop", "bottom-half"},
                           Case{"bordered", bordered, "168x120", "--invalid", "0"}}) {
    SCOPED_TRACE(made.name);
    write_text(directory_ / (made.name + ".raw"), made.pixels);
    const std::string probe = "probe " + made.name + ".raw --raw-size " + made.raw_size;
    const auto json = nlohmann::json::parse(run(probe + " --json").out);
    ASSERT_EQ(json["input"].size(), 1U) << json["input"];
    EXPECT_EQ(json["input"][0]["flag"], made.flag);
    EXPECT_EQ(json["input"][0]["value"], made.value);
    const std::string option = " " + made.flag + " " + made.value;
    EXPECT_NE(run(probe).out.find(option), std::string::npos);
    const auto mended = nlohmann::json::parse(run(probe + option + " --json").out);
    EXPECT_TRUE(mended["input"].empty()) << mended["input"];
    EXPECT_NEAR(mended["noise"]["sigma_counts"].get<double>() / sigma, 1, 0.03);
    // As options of a file, where there are such.
    ASSERT_EQ(run(probe + " --toml robot.toml").exit_code, 0);
    const std::string detect =
        "detect " + made.name + ".raw --raw-size " + made.raw_size + " --preset fast -o - ";
    const auto edges = nlohmann::json::parse(first_line(
        run(detect + (made.flag == "--invalid" ? option : "") + " --config robot.toml").out));
    const auto by_flag = nlohmann::json::parse(first_line(run(detect + option).out));
    EXPECT_EQ(edges["edges"], by_flag["edges"]);
    EXPECT_FALSE(edges["edges"].empty());
  }
}

TEST_F(ProbeProgram, NamesTheOtherOrderWhereOneWasGiven) {
  write_text(directory_ / "big.raw", [] {
    std::string pixels;
    const auto frame = std::move(test::scene_frames("sim:desk?width=64&height=48")[0]);
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        pixels += {static_cast<char>(frame(x, y) >> 8), static_cast<char>(frame(x, y) & 255)};
      }
    }
    return pixels;
  }());
  const auto value = [&](const std::string& options) {
    const auto json =
        nlohmann::json::parse(run("probe big.raw --raw-size 64x48 --json " + options).out);
    return json["input"].empty() ? "" : json["input"][0]["value"].get<std::string>();
  };
  EXPECT_EQ(value(""), "swapped");
  EXPECT_EQ(value("--byte-order swapped"), "");
  EXPECT_EQ(value("--byte-order little"), "big");
  EXPECT_EQ(value("--raw-format gray16be"), "");
  EXPECT_EQ(value("--raw-format gray16be --byte-order swapped"), "format");
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
