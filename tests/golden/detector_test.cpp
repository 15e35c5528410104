// The edges of simulated frames and of traced edge maps, compared with those on file: a missing
// edge fails, and so does an extra one. To renew them after an intended change: run the commands in
// tests/data/golden/README.md.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/oracle.hpp"
#include "support/program.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

using nlohmann::json;

std::filesystem::path data_directory() { return THERMEDGE_TEST_DATA; }

Detector make_detector(Preset preset) {
  auto detector = Detector::create(DetectorOptions(preset));
  EXPECT_TRUE(detector);
  return std::move(*detector);
}

json to_json(const Result<Detection>& detection, const std::string& source) {
  EXPECT_TRUE(detection);
  return json::parse(io::edges_to_json(*detection, source));
}

json detect(const std::string& spec, Preset preset) {
  const auto scene = sim::parse_scene(spec);
  EXPECT_TRUE(scene);
  const auto frame = sim::render(*scene, 0);
  EXPECT_TRUE(frame);
  auto detector = make_detector(preset);
  return to_json(detector.detect(frame->counts), spec);
}

json trace(const std::string& map, Preset preset) {
  const auto edges = test::read_edge_map(data_directory() / "classical" / (map + ".png"));
  auto detector = make_detector(preset);
  return to_json(detector.trace(edges), map);
}

// Results are promised to be equal to the bit; the tolerance is for the digits of the file only.
void expect_same_number(const json& found, const json& wanted, const std::string& what) {
  ASSERT_EQ(found.is_null(), wanted.is_null()) << what;
  if (!wanted.is_null()) {
    EXPECT_NEAR(found.get<double>(), wanted.get<double>(),
                1e-9 * (1 + std::abs(wanted.get<double>())))
        << what;
  }
}

void expect_same_edges(const json& found, const std::string& file) {
  const json wanted = json::parse(test::file_text(data_directory() / "golden" / (file + ".json")));
  ASSERT_GT(wanted["edges"].size(), 5U);
  ASSERT_EQ(found["edges"].size(), wanted["edges"].size());
  EXPECT_EQ(found["junctions"], wanted["junctions"]);
  for (std::size_t i = 0; i < wanted["edges"].size(); ++i) {
    const json& a = found["edges"][i];
    const json& b = wanted["edges"][i];
    const std::string what = "edge " + std::to_string(i);
    for (const char* key :
         {"index", "rank", "closed", "corners", "connected", "points", "normals"}) {
      EXPECT_EQ(a[key], b[key]) << what << " " << key;
    }
    for (const char* key : {"score", "es", "z", "log10_nfa", "length_px", "contrast_counts"}) {
      expect_same_number(a[key], b[key], what + " " + key);
    }
  }
}

struct Golden {
  std::string input;  // the simulator's scene, or the name of an edge map
  Preset preset;
  std::string file;
};

void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.file; }

std::string file_of(const testing::TestParamInfo<Golden>& test) { return test.param.file; }

class GoldenEdges : public testing::TestWithParam<Golden> {};

TEST_P(GoldenEdges, AreAllThereAndNoOthers) {
  const auto& [spec, preset, file] = GetParam();
  expect_same_edges(detect(spec, preset), file);
}

INSTANTIATE_TEST_SUITE_P(
    All, GoldenEdges,
    testing::Values(Golden{"sim:desk", Preset::kPaper, "paper_desk"},
                    Golden{"sim:corridor?sigma=20", Preset::kPaper, "paper_corridor_sigma20"},
                    Golden{"sim:desk?sigma=20", Preset::kRobust, "robust_desk_sigma20"},
                    Golden{"sim:corridor?sigma=8", Preset::kRobust, "robust_corridor_sigma8"},
                    Golden{"sim:desk?sigma=20", Preset::kFast, "fast_desk_sigma20"},
                    Golden{"sim:office?camera=lepton35&sigma=8", Preset::kFast,
                           "fast_small_office_sigma8"}),
    file_of);

class GoldenTraces : public testing::TestWithParam<Golden> {};

TEST_P(GoldenTraces, AreAllThereAndNoOthers) {
  const auto& [map, preset, file] = GetParam();
  expect_same_edges(trace(map, preset), file);
}

INSTANTIATE_TEST_SUITE_P(
    All, GoldenTraces,
    testing::Values(Golden{"desk_20_sobel", Preset::kPaper, "trace_paper_desk_20_sobel"},
                    Golden{"desk_20_sobel", Preset::kRobust, "trace_robust_desk_20_sobel"},
                    Golden{"corridor_6_prewitt", Preset::kPaper, "trace_paper_corridor_6_prewitt"},
                    Golden{"corridor_6_prewitt", Preset::kRobust,
                           "trace_robust_corridor_6_prewitt"}),
    file_of);

}  // namespace
}  // namespace thermedge
