// Files of results: what the program writes is what the library finds on the same frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/images.hpp"
#include "support/program.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/frame_denoiser.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/io/overlay.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::test {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;

// Without the times, which differ from run to run.
nlohmann::json timeless(const std::string& text) {
  nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_object() && json.contains("stats")) {
    json["stats"].erase("ms");
  }
  return json;
}

// A frame of the simulated desk as the file frame.png, and what the library finds in it with
// `--denoise gaussian`.
class Results : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    auto scene = sim::render({.camera = {.width = kWidth, .height = kHeight}}, 0);
    ASSERT_TRUE(scene);
    counts_ = std::move(scene->counts);
    ASSERT_TRUE(io::write_picture(path("frame.png"), ImageView<const std::uint16_t>(counts_)));
    options_.denoise.method = DenoiseMethod::kGaussian;
  }

  [[nodiscard]] Detection found() const { return found_with(options_, Frame(counts_, 16)); }

  static Detection found_with(const DetectorOptions& options, const Frame& frame) {
    auto detector = Detector::create(options);
    EXPECT_TRUE(detector);
    auto detection = detector->detect(frame);
    EXPECT_TRUE(detection);
    return std::move(*detection);
  }

  [[nodiscard]] io::SourceFrame read(const std::string& name) const {
    auto picture = io::read_picture(path(name));
    EXPECT_TRUE(picture) << name;
    return picture ? std::move(*picture) : io::SourceFrame{};
  }

  // Of a picture with 8 or 16 bits that holds the same values as `wanted`.
  template <class T>
  void expect_picture(const std::string& name, const Image<T>& wanted) const {
    const io::SourceFrame picture = read(name);
    EXPECT_EQ(picture.bits, static_cast<int>(8 * sizeof(T))) << name;
    Image<std::uint16_t> wide(wanted.width(), wanted.height());
    copy_pixels(wanted.view(), wide.view());
    EXPECT_TRUE(same_pixels<std::uint16_t>(picture.counts.view(), wide.view())) << name;
  }

  Image<std::uint16_t> counts_;
  DetectorOptions options_;
};

TEST_F(Results, EveryKindIsWhatTheLibraryGives) {
  EXPECT_EQ(output_of("detect frame.png --denoise gaussian -o out --write "
                      "mask,strength,labels,json,csv,svg,overlay"),
            "");
  const Detection detection = found();
  ASSERT_GT(detection.edges.kept, 5U);
  EXPECT_EQ(timeless(text_of("out/json/frame.json")),
            timeless(io::edges_to_json(detection, "frame.png")));
  EXPECT_EQ(text_of("out/csv/frame.csv"),
            std::string(io::edges_csv_header()) + io::edges_to_csv_rows(detection));
  EXPECT_EQ(text_of("out/svg/frame.svg"), io::edges_to_svg(detection, "frame.png"));
  Image<std::uint8_t> levels(kWidth, kHeight);
  draw_mask(detection.edges, levels);
  expect_picture("out/mask/frame.png", levels);
  draw_strength(detection.edges, levels);
  expect_picture("out/strength/frame.png", levels);
  Image<std::uint16_t> labels(kWidth, kHeight);
  draw_labels(detection.edges, labels);
  expect_picture("out/labels/frame.png", labels);
  Image<io::Rgb> overlay;
  io::draw_overlay(detection, counts_, overlay);
  ASSERT_TRUE(io::write_picture(path("overlay.png"), ImageView<const io::Rgb>(overlay)));
  EXPECT_EQ(text_of("out/overlay/frame.png"), text_of("overlay.png"));
}

// The distance to the nearest pixel of the mask, in 1/256 px.
TEST_F(Results, DistancesAreThoseToTheMask) {
  ASSERT_EQ(output_of("detect frame.png --denoise gaussian -o out --write mask,distance"), "");
  const io::SourceFrame mask = read("out/mask/frame.png");
  const io::SourceFrame distance = read("out/distance/frame.png");
  ASSERT_EQ(distance.bits, 16);
  for (int y = 0; y < kHeight; y += 3) {
    for (int x = 0; x < kWidth; x += 3) {
      double nearest = 1e9;
      for (int v = 0; v < kHeight; ++v) {
        for (int u = 0; u < kWidth; ++u) {
          nearest = mask.counts(u, v) != 0 ? std::min(nearest, std::hypot(u - x, v - y)) : nearest;
        }
      }
      ASSERT_NEAR(distance.counts(x, y), 256 * nearest, 1) << x << ", " << y;
    }
  }
}

TEST_F(Results, FarFromEveryEdgeTheDistanceIsItsLimit) {
  Image<std::uint16_t> flat(kWidth, kHeight);
  fill_pixels(flat.view(), std::uint16_t{3000});
  ASSERT_TRUE(io::write_picture(path("flat.png"), ImageView<const std::uint16_t>(flat)));
  ASSERT_EQ(output_of("detect flat.png -o out --write distance,json"), "");
  EXPECT_TRUE(timeless(text_of("out/json/flat.json"))["edges"].empty());
  Image<std::uint16_t> limit(kWidth, kHeight);
  fill_pixels(limit.view(), std::uint16_t{255 * 256});
  expect_picture("out/distance/flat.png", limit);
}

// The points of the file lie on the mask, and the labels number the edges of the file.
TEST_F(Results, FilesOfOneFrameAgreeWithEachOther) {
  ASSERT_EQ(output_of("detect frame.png --denoise gaussian -o out --write mask,labels,json,svg"),
            "");
  const auto json = timeless(text_of("out/json/frame.json"));
  const io::SourceFrame mask = read("out/mask/frame.png");
  const io::SourceFrame labels = read("out/labels/frame.png");
  std::size_t points = 0;
  for (const auto& edge : json["edges"]) {
    for (const auto& point : edge["points"]) {
      const int x = static_cast<int>(std::lround(point[0].get<double>()));
      const int y = static_cast<int>(std::lround(point[1].get<double>()));
      EXPECT_EQ(mask.counts(x, y), 255) << point;
      // Where edges cross, the better one is seen.
      EXPECT_GE(labels.counts(x, y), 1) << point;
      EXPECT_LE(labels.counts(x, y), edge["index"].get<int>() + 1) << point;
      ++points;
    }
  }
  std::size_t set = 0;
  for (int y = 0; y < kHeight; ++y) {
    set +=
        static_cast<std::size_t>(std::count(mask.counts.row(y), mask.counts.row(y) + kWidth, 255));
  }
  EXPECT_GT(set, points / 2);
  EXPECT_LE(set, points);
  const std::string svg = text_of("out/svg/frame.svg");
  std::size_t paths = 0;
  for (std::size_t at = svg.find("<path"); at != std::string::npos;
       at = svg.find("<path", at + 1)) {
    ++paths;
  }
  EXPECT_EQ(paths, json["edges"].size());
  EXPECT_NE(svg.find("viewBox=\"-0.5 -0.5 96 72\""), std::string::npos);
}

TEST_F(Results, TheSameJsonInAFileOnStandardOutputAndInADirectory) {
  ASSERT_EQ(output_of("detect frame.png --denoise gaussian -o one.json"), "");
  ASSERT_EQ(output_of("detect frame.png --denoise gaussian -o out --write json"), "");
  const auto line = timeless(output_of("detect frame.png --denoise gaussian -o -"));
  EXPECT_EQ(line["source"], "frame.png");
  EXPECT_EQ(timeless(text_of("one.json")), line);
  EXPECT_EQ(timeless(text_of("out/json/frame.json")), line);
}

TEST_F(Results, JsonLinesAndCsvHoldAllFrames) {
  const std::string frames = "frame.png frame.png --denoise gaussian --all-edges ";
  ASSERT_EQ(output_of("detect " + frames + "-o x.jsonl --points strength,normal,sigma"), "");
  ASSERT_EQ(output_of("detect " + frames + "-o x.csv"), "");
  ASSERT_EQ(output_of("detect " + frames + "-o out --write csv"), "");
  const std::string csv = text_of("x.csv");
  const std::string header(io::edges_csv_header());
  EXPECT_EQ(text_of("out/csv/frame.csv").size() + text_of("out/csv/frame_2.csv").size(),
            csv.size() + header.size());
  std::istringstream rows(csv);
  std::istringstream lines(text_of("x.jsonl"));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row + "\n", header);
  const auto expect_rows = [&](const nlohmann::json& frame, const nlohmann::json& edge,
                               const std::string& status) {
    for (std::size_t i = 0; i < edge["points"].size(); ++i) {
      ASSERT_TRUE(std::getline(rows, row));
      std::vector<std::string> cells(1);
      for (const char c : row) {
        c == ',' ? void(cells.emplace_back()) : cells.back().push_back(c);
      }
      ASSERT_EQ(cells.size(), 14U);
      const auto number = [&](std::size_t cell) {
        return std::strtod(cells[cell].c_str(), nullptr);
      };
      EXPECT_EQ(number(0), frame["frame"]);
      EXPECT_EQ(number(2), edge["index"]);
      EXPECT_EQ(cells[3], status);
      EXPECT_EQ(number(4), edge["score"]);
      EXPECT_EQ(number(6), i);
      EXPECT_EQ(nlohmann::json({number(7), number(8)}), edge["points"][i]);
      EXPECT_EQ(nlohmann::json({number(9), number(10)}), edge["normals"][i]);
      EXPECT_EQ(number(11), edge["strength_counts_per_px"][i]);
      EXPECT_EQ(number(12), edge["position_sigma_px"][i]);
      const auto& corners = edge["corners"];
      EXPECT_EQ(number(13) != 0, std::find(corners.begin(), corners.end(), i) != corners.end());
    }
  };
  int frame_number = 0;
  for (std::string line; std::getline(lines, line); ++frame_number) {
    const auto frame = nlohmann::json::parse(line);
    EXPECT_EQ(frame["frame"], frame_number);
    EXPECT_EQ(frame["dropped_edges"].size() + frame["edges"].size(),
              frame["stats"]["edges_found"].get<std::size_t>());
    EXPECT_GT(frame["dropped_edges"].size(), 0U);
    for (const auto& edge : frame["edges"]) {
      expect_rows(frame, edge, "kept");
    }
    for (const auto& edge : frame["dropped_edges"]) {
      expect_rows(frame, edge, edge["reason"]);
    }
  }
  EXPECT_EQ(frame_number, 2);
  EXPECT_FALSE(std::getline(rows, row));
}

// A normal points to the side with more counts, and is as long as 1.
TEST_F(Results, NormalsPointToTheWarmerSide) {
  const auto json = timeless(output_of("detect frame.png --denoise gaussian -o - --keep 5"));
  int warmer = 0;
  int all = 0;
  for (const auto& edge : json["edges"]) {
    for (std::size_t i = 0; i < edge["points"].size(); ++i) {
      const double x = edge["points"][i][0], y = edge["points"][i][1];
      const double nx = edge["normals"][i][0], ny = edge["normals"][i][1];
      EXPECT_NEAR(std::hypot(nx, ny), 1, 2e-4);
      const auto at = [&](double step) {
        const int u = std::clamp(static_cast<int>(std::lround(x + step * nx)), 0, kWidth - 1);
        const int v = std::clamp(static_cast<int>(std::lround(y + step * ny)), 0, kHeight - 1);
        return counts_(u, v);
      };
      warmer += at(2) > at(-2) ? 1 : 0;
      ++all;
    }
  }
  ASSERT_GT(all, 100);
  EXPECT_GT(warmer, 0.95 * all);
}

// Fields that were not there in files of the first version of the program change nothing.
TEST_F(Results, OldJsonIsEvaluatedAsNewJsonIs) {
  ASSERT_EQ(output_of("simulate desk -o s --frames 2 --seed 3 --set width=96 --set height=72"), "");
  ASSERT_EQ(output_of("detect s/counts --denoise gaussian -o new.jsonl --all-edges --points "
                      "normal,strength,sigma"),
            "");
  std::istringstream lines(text_of("new.jsonl"));
  std::string old;
  for (std::string line; std::getline(lines, line);) {
    auto frame = nlohmann::json::parse(line);
    for (const char* key : {"format_version", "frame", "stamp_ns", "dropped_edges"}) {
      EXPECT_EQ(frame.erase(key), 1U) << key;
    }
    for (auto& edge : frame["edges"]) {
      for (const char* key : {"normals", "strength_counts_per_px", "position_sigma_px"}) {
        EXPECT_EQ(edge.erase(key), 1U) << key;
      }
      edge["score"] = edge["score"].get<double>() + 1e-9 / 3;  // numbers had all their digits
    }
    old += frame.dump() + "\n";
  }
  write_text(path("old.jsonl"), old);
  const auto scores = [&](const std::string& name) {
    auto json = timeless(output_of("evaluate " + name + " s/truth.jsonl --json"));
    EXPECT_GT(json["f"], 0.3);
    json.erase("found");
    return json;
  };
  EXPECT_EQ(scores("old.jsonl"), scores("new.jsonl"));
}

TEST_F(Results, WithoutAnOutputALineTellsTheNumbers) {
  options_.selection.keep_edges = 3;
  const Detection detection = found();
  ASSERT_GT(detection.edges.edges.size(), detection.edges.kept);
  std::size_t edgels = 0;
  for (const Edge& edge : detection.kept_edges()) {
    edgels += edge.edgels.count;
  }
  char sigma[32];
  std::snprintf(sigma, sizeof(sigma), "%.2f", detection.sigma_counts);
  const std::string line = output_of("detect frame.png --denoise gaussian --keep 3");
  EXPECT_EQ(count_lines(line), 1U);
  EXPECT_TRUE(line.starts_with("frame.png: 96x72, sigma " + std::string(sigma) + " counts, " +
                               std::to_string(detection.edges.kept) + " of " +
                               std::to_string(detection.edges.edges.size()) + " edges kept, " +
                               std::to_string(edgels) + " edgels, "))
      << line;
}

TEST_F(Results, PicturesOf8BitsAreDetectedAsSuch) {
  ASSERT_EQ(output_of("scale frame.png -o view.png --quiet"), "");
  const io::SourceFrame view = read("view.png");
  ASSERT_EQ(view.bits, 8);
  for (const Preset preset : {Preset::kRobust, Preset::kPaper}) {
    DetectorOptions options(preset);
    options.denoise.method = DenoiseMethod::kGaussian;
    const Detection detection = found_with(options, Frame(view.counts, 8));
    const auto line = timeless(output_of("detect view.png -o - --denoise gaussian --preset " +
                                         std::string(preset_name(preset))));
    EXPECT_EQ(line, timeless(io::edges_to_json(detection, "view.png")));
  }
}

TEST_F(Results, TraceIsTheSecondHalfOfTheDetector) {
  Image<std::uint8_t> map(kWidth, kHeight);
  draw_mask(found().edges, map);
  ASSERT_TRUE(io::write_picture(path("map.png"), ImageView<const std::uint8_t>(map)));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      map(x, y) = map(x, y) != 0 ? 1 : 0;  // any value but 0 is an edge
    }
  }
  ASSERT_TRUE(io::write_picture(path("ones.png"), ImageView<const std::uint8_t>(map)));
  auto detector = Detector::create();
  ASSERT_TRUE(detector);
  const auto traced = detector->trace(map);
  ASSERT_TRUE(traced);
  ASSERT_GT(traced->edges.kept, 0U);
  for (const std::string name : {"map.png", "ones.png"}) {
    EXPECT_EQ(timeless(output_of("trace " + name + " -o -")),
              timeless(io::edges_to_json(*traced, name)));
  }
}

TEST_F(Results, ScaledPicturesAreThoseOfAlgorithm1) {
  for (const double gain : {0.5, 0.05, 3.0}) {
    Image<std::uint8_t> levels(kWidth, kHeight);
    GreyScaleOptions options;
    options.gain = gain;
    ASSERT_TRUE(scale_to_8bit(counts_, options, levels));
    for (const std::string ending : {"png", "tif", "pgm", "npy"}) {
      const std::string name = "view." + ending;
      ASSERT_EQ(output_of("scale frame.png -o " + name + " --quiet --gain " + std::to_string(gain)),
                "");
      expect_picture(name, levels);
    }
  }
}

TEST_F(Results, DenoisedFramesAreThoseOfTheLibrary) {
  const auto runner = make_runner(1);
  for (const std::string method : {"gaussian", "nlm", "bm3d", "none"}) {
    FrameDenoiserOptions options;
    for (const auto& known : kDenoiseMethods) {
      options.denoise.method = known.name == method ? known.value : options.denoise.method;
    }
    options.denoise.sigma_counts = 6;
    FrameDenoiser denoiser(options);
    const auto counts = denoiser.run(Frame(counts_, 16), *runner);
    ASSERT_TRUE(counts);
    ASSERT_EQ(output_of("denoise frame.png -o x.png --sigma 6 --method " + method), "");
    EXPECT_TRUE(same_pixels<std::uint16_t>(read("x.png").counts.view(), *counts)) << method;
  }
}

}  // namespace
}  // namespace thermedge::test
