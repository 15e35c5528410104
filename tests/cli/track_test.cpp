// `track`: what the program writes is what the library finds, and what goes wrong is one line.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.hpp"
#include "thermedge/image.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/tracks_file.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/sequence/sequence_detector.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSequence = "sim:desk?width=120&height=90&frames=5&seed=1011";

std::vector<nlohmann::json> lines_of(const std::string& text) {
  std::vector<nlohmann::json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(nlohmann::json::parse(line));
    lines.back()["stats"].erase("ms");
  }
  return lines;
}

class Track : public ProgramTest {};

TEST_F(Track, WritesWhatTheLibraryFinds) {
  const ProgramRun ran = run(std::string("track '") + kSequence + "' -o -");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto lines = lines_of(ran.out);
  ASSERT_EQ(lines.size(), 5U);
  auto renderer = sim::Renderer::create(*sim::parse_scene(kSequence));
  const auto runner = make_runner(1);
  auto detector = SequenceDetector::create();
  TrackedFrame result;
  for (int i = 0; i < 5; ++i) {
    const auto truth = renderer->render(i, *runner);
    Frame frame(truth->counts);
    frame.index = i;
    frame.stamp_ns = truth->stamp_ns;
    ASSERT_TRUE(detector->process(frame, result));
    auto expected = nlohmann::json::parse(io::tracks_to_json(result, ""));
    expected["stats"].erase("ms");
    expected["source"] = lines[static_cast<std::size_t>(i)]["source"];
    EXPECT_EQ(lines[static_cast<std::size_t>(i)], expected) << i;
  }
}

TEST_F(Track, EveryLineTellsOfIdentitiesMotionAndEvents) {
  const ProgramRun ran =
      run("track 'sim:corridor?width=160&height=120&frames=12&freeze_every=6&"
          "freeze_frames=3' -o t.jsonl");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto lines = lines_of(file_text(path("t.jsonl")));
  ASSERT_EQ(lines.size(), 12U);
  std::set<std::int64_t> born;
  int frozen = 0;
  for (const nlohmann::json& line : lines) {
    for (const auto& id : line["born"]) {
      EXPECT_TRUE(born.insert(id.get<std::int64_t>()).second) << "an identity is given once";
    }
    if (!line["valid"]) {
      ++frozen;
      EXPECT_EQ(line["events"], nlohmann::json({"frozen"}));
      EXPECT_TRUE(line["edges"].empty());
      EXPECT_TRUE(line["motion"].is_null());
      continue;
    }
    for (const nlohmann::json& edge : line["edges"]) {
      const std::size_t points = edge["points"].size();
      EXPECT_EQ(edge["smooth"].size(), points);
      EXPECT_EQ(edge["track"].is_null(), edge["tracks"].empty());
      std::size_t end = 0;
      for (const nlohmann::json& part : edge["tracks"]) {
        EXPECT_GE(part[0].get<std::size_t>(), end);
        EXPECT_GT(part[1].get<std::size_t>(), part[0].get<std::size_t>());
        end = part[1].get<std::size_t>();
        EXPECT_EQ(born.count(part[2].get<std::int64_t>()), 1U);
      }
      EXPECT_LE(end, points);
    }
  }
  EXPECT_EQ(frozen, 3);
  EXPECT_FALSE(born.empty());
  EXPECT_TRUE(lines[0]["motion"].is_null());
  EXPECT_EQ(lines[1]["motion"]["homography"].size(), 9U);
}

TEST_F(Track, FillsADirectory) {
  const ProgramRun ran =
      run(std::string("track '") + kSequence + "' -o out --write json,csv,overlay,distance");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(count_lines(file_text(path("out/tracks.jsonl"))), 5U);
  const std::string csv = file_text(path("out/tracks.csv"));
  EXPECT_EQ(csv.substr(0, 15), "frame,stamp_ns,");
  EXPECT_GT(count_lines(csv), 500U);
  const auto overlay = io::read_picture(path("out/distance/desk_0004.png"));
  ASSERT_TRUE(overlay);
  EXPECT_EQ(overlay->width(), 120);
  EXPECT_TRUE(fs::exists(path("out/overlay/desk_0004.png")));
}

TEST_F(Track, IdentitiesHaveTheirColoursOverTheFrameOrOnBlack) {
  TrackedFrame frame;
  Image<io::Rgb> picture;
  frame.detection.width = 30;
  frame.detection.height = 20;
  frame.detection.edges.edgels.resize(2);
  frame.detection.edges.edgels.x = {5, 20};
  frame.detection.edges.edgels.y = {10, 10};
  Edge edge;
  edge.edgels = {0, 2};
  frame.detection.edges.edges.push_back(edge);
  frame.detection.edges.kept = 1;
  frame.tracks.track = {3, 3};
  io::draw_tracks(frame, {}, picture);
  EXPECT_EQ(picture.width(), 60);
  const io::Rgb line = picture.view()(20, 21);
  const io::Rgb expected = io::track_colour(3);
  EXPECT_EQ(line.r, expected.r);
  EXPECT_EQ(line.g, expected.g);
  EXPECT_EQ(line.b, expected.b);
  frame.tracks.track = {-1, -1};
  io::draw_tracks(frame, {}, picture);
  EXPECT_EQ(picture.view()(20, 21).r, picture.view()(20, 21).b) << "grey without an identity";
  EXPECT_NE(io::track_colour(0).b, io::track_colour(1).b);
}

TEST_F(Track, SaysWhatIsWrong) {
  const std::string track = std::string("track '") + kSequence + "' ";
  const auto message = [&](const std::string& arguments) {
    const ProgramRun ran = run(track + arguments);
    EXPECT_EQ(ran.exit_code, 2) << arguments;
    EXPECT_EQ(count_lines(ran.err), 1U) << ran.err;
    return ran.err;
  };
  EXPECT_NE(message("-o x.png").find("x.png"), std::string::npos);
  EXPECT_NE(message("-o out --write mask").find("json, csv, overlay, distance"), std::string::npos);
  EXPECT_NE(message("-o x.jsonl --write csv").find("-o DIR"), std::string::npos);
  EXPECT_NE(message("-o x.jsonl --lines-only").find("--lines-only"), std::string::npos);
  EXPECT_NE(message("--rate 0 -o -").find("tracker.rate_hz"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("x.jsonl")));
}

TEST_F(Track, AFrameOfAnotherSizeBeginsANewSequenceWithAWord) {
  const ProgramRun ran =
      run("track 'sim:desk?width=96&height=72&frames=2' "
          "'sim:desk?width=120&height=90&frames=2' -o t.jsonl");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.err.find("120x90 pixels after 96x72"), std::string::npos) << ran.err;
  const auto lines = lines_of(file_text(path("t.jsonl")));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_TRUE(lines[2]["motion"].is_null());
  EXPECT_FALSE(lines[2]["ended"].empty());
}

}  // namespace
}  // namespace thermedge::test
