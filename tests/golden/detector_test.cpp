// The edges of two simulated frames, compared with those on file: a missing edge fails, and so does
// an extra one. To renew them after an intended change: run the commands in
// tests/data/golden/README.md.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/program.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

using nlohmann::json;

json detect(const std::string& spec, Preset preset) {
  const auto scene = sim::parse_scene(spec);
  EXPECT_TRUE(scene);
  const auto frame = sim::render(*scene, 0);
  EXPECT_TRUE(frame);
  auto detector = Detector::create(preset_options(preset));
  EXPECT_TRUE(detector);
  const auto detection = detector->detect(frame->counts);
  EXPECT_TRUE(detection);
  return json::parse(io::edges_to_json(**detection, {spec, std::string(preset_name(preset))}));
}

// Results are promised to be equal to the bit; the tolerance is for the decimals of the file only.
void expect_same_number(const json& found, const json& wanted, const std::string& what) {
  ASSERT_EQ(found.is_null(), wanted.is_null()) << what;
  if (!wanted.is_null()) {
    EXPECT_NEAR(found.get<double>(), wanted.get<double>(),
                1e-9 * (1 + std::abs(wanted.get<double>())))
        << what;
  }
}

struct Golden {
  std::string spec;
  Preset preset;
  std::string file;
};

class GoldenEdges : public testing::TestWithParam<Golden> {};

TEST_P(GoldenEdges, AreAllThereAndNoOthers) {
  const auto& [spec, preset, file] = GetParam();
  const auto path = std::filesystem::path(THERMEDGE_TEST_DATA) / "golden" / (file + ".json");
  const json wanted = json::parse(test::file_text(path));
  const json found = detect(spec, preset);
  ASSERT_GT(wanted["edges"].size(), 5U);
  ASSERT_EQ(found["edges"].size(), wanted["edges"].size());
  EXPECT_EQ(found["junctions"], wanted["junctions"]);
  for (std::size_t i = 0; i < wanted["edges"].size(); ++i) {
    const json& a = found["edges"][i];
    const json& b = wanted["edges"][i];
    const std::string what = "edge " + std::to_string(i);
    for (const char* key : {"id", "rank", "closed", "corners", "connected", "points"}) {
      EXPECT_EQ(a[key], b[key]) << what << " " << key;
    }
    for (const char* key : {"score", "es", "z", "log10_nfa", "length_px", "contrast_counts"}) {
      expect_same_number(a[key], b[key], what + " " + key);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, GoldenEdges,
    testing::Values(Golden{"sim:desk", Preset::kPaper, "paper_desk"},
                    Golden{"sim:corridor?sigma=20", Preset::kPaper, "paper_corridor_sigma20"},
                    Golden{"sim:desk?sigma=20", Preset::kRobust, "robust_desk_sigma20"},
                    Golden{"sim:corridor?sigma=8", Preset::kRobust, "robust_corridor_sigma8"}),
    [](const auto& test) { return test.param.file; });

}  // namespace
}  // namespace thermedge
