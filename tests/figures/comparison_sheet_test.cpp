// The sheet of the comparison: each map in its panel, and a table of the numbers that were counted.
#include "thermedge/figures/comparison_sheet.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "drawn_text.hpp"
#include "raster.hpp"
#include "support/images.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::figures {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
constexpr int kZoom = 4;

class ComparedDesk : public testing::Test {
 protected:
  static ComparisonOptions options_of(Preset preset) {
    ComparisonOptions options;
    options.detector = DetectorOptions(preset);
    options.detector.denoise.method = DenoiseMethod::kGaussian;
    options.detector.threads = 1;
    options.panel_width = kZoom * kWidth;
    return options;
  }

  static Comparison compared(const ComparisonOptions& options) {
    auto scene = sim::render({.camera = {.width = kWidth, .height = kHeight}}, 0);
    EXPECT_TRUE(scene);
    auto sheet = ComparisonSheet::create(options);
    EXPECT_TRUE(sheet);
    forget_drawn_text();
    auto made = sheet->draw(scene->counts, 16, "desk.png");
    EXPECT_TRUE(made);
    return std::move(*made);
  }

  // Where the picture under a title begins.
  static Point picture_under(const std::string& letter) {
    for (const DrawnText& text : drawn_text()) {
      if (text.text == letter) {
        return {text.at.x, text.at.y + 1.6 * kZoom * kWidth / 100};
      }
    }
    ADD_FAILURE() << "no panel " << letter;
    return {};
  }
};

TEST_F(ComparedDesk, EveryMapIsInItsPanel) {
  const Comparison made = compared(options_of(Preset::kRobust));
  const auto picture = rasterised(made.sheet);
  // (a) is the frame and (e) the table.
  const std::string letters[] = {"(b)", "(c)", "(d)", "(f)", "(g)", "(h)"};
  ASSERT_EQ(made.maps.size(), std::size(letters));
  for (std::size_t i = 0; i < made.maps.size(); ++i) {
    SCOPED_TRACE(made.maps[i].name);
    const Point corner = picture_under(letters[i]);
    for (int y = 1; y < kHeight - 1; ++y) {
      for (int x = 1; x < kWidth - 1; ++x) {
        ASSERT_EQ(picture(static_cast<int>(corner.x + (x + 0.5) * kZoom),
                          static_cast<int>(corner.y + (y + 0.5) * kZoom)),
                  made.maps[i].edges(x, y) != 0 ? kInk : kPaper)
            << x << ", " << y;
      }
    }
  }
}

// Title and note of each panel, and its row of the table, cell by cell.
TEST_F(ComparedDesk, TheNumbersAreThoseOfTheMaps) {
  const Comparison made = compared(options_of(Preset::kRobust));
  const auto& texts = drawn_text();
  auto row = std::find_if(texts.begin(), texts.end(),
                          [](const DrawnText& text) { return text.text == "/1000 px"; });
  ASSERT_NE(row, texts.end());
  row += 2;  // behind "ms", the last cell of the heading
  for (const ComparedMap& map : made.maps) {
    ASSERT_GE(texts.end() - row, 5);
    const auto pixels = static_cast<double>(map.edge_pixels);
    EXPECT_EQ(row[0].text, map.display);
    EXPECT_EQ(row[1].text, std::to_string(map.edge_pixels));
    EXPECT_EQ(row[2].text, std::to_string(map.fragments));
    EXPECT_EQ(row[3].text,
              fmt::format("{:.1f}", 1000 * static_cast<double>(map.fragments) / pixels));
    EXPECT_EQ(row[4].text, fmt::format("{:.1f}", map.ms));
    EXPECT_TRUE(is_written(fmt::format("{} edge pixels, {} fragments, {:.1f} ms", map.edge_pixels,
                                       map.fragments, map.ms)))
        << map.name;
    row += 5;
  }
}

TEST_F(ComparedDesk, SaysWhatRanAndOnWhat) {
  struct Case {
    Preset preset;
    std::optional<DenoiseMethod> classical;
    const char* name;
    const char* view;
  };
  for (const Case& run :
       {Case{Preset::kRobust, {}, "thermedge (robust)", ""},
        {Preset::kRobust, DenoiseMethod::kNone, "thermedge (robust)", "view, not denoised"},
        {Preset::kPaper, DenoiseMethod::kGaussian, "thermedge (paper)", "view after Gaussian"},
        {Preset::kFast, DenoiseMethod::kNlm, "thermedge (fast)", "view after NL-means"}}) {
    ComparisonOptions options = options_of(run.preset);
    options.classical_denoiser = run.classical;
    const Comparison made = compared(options);
    EXPECT_EQ(made.maps.back().display, run.name);
    EXPECT_TRUE(is_written(run.name));
    EXPECT_TRUE(is_written(
        run.classical
            ? "desk.png; the classical detectors run on its 8-bit " + std::string(run.view)
            : "desk.png; all detectors run on the same picture, denoised by Gaussian"))
        << run.view;
    expect_text_in_place(drawn_text(), {0, 0, made.sheet.width(), made.sheet.height()});
  }
}

// What each preset's own steps make of the frame is what all the others get.
TEST_F(ComparedDesk, AllDetectorsRunOnTheSameDenoisedPicture) {
  for (const Preset preset : {Preset::kRobust, Preset::kPaper}) {
    const ComparisonOptions options = options_of(preset);
    const Comparison made = compared(options);
    auto scene = sim::render({.camera = {.width = kWidth, .height = kHeight}}, 0);
    ASSERT_TRUE(scene);
    auto detector = Detector::create(options.detector);
    ASSERT_TRUE(detector);
    Detection detection;
    Intermediates steps;
    ASSERT_TRUE(detector->detect(Frame(ImageView<const std::uint16_t>(scene->counts), 16),
                                 detection, {&steps, {}}));
    ClassicalDetector classical;
    const auto runner = make_runner(1);
    for (std::size_t i = 0; i < kClassicalMethods.size(); ++i) {
      Image<std::uint8_t> edges(kWidth, kHeight);
      ASSERT_TRUE(
          classical.run(steps.denoised_values, kClassicalMethods[i].method, edges, *runner));
      EXPECT_TRUE(test::same_pixels<std::uint8_t>(edges.view(), made.maps[i].edges.view()))
          << made.maps[i].name;
    }
  }
}

// Thresholds in counts and in units of the noise are the same gradients.
TEST_F(ComparedDesk, CannyHasTheThresholdsThatAreAskedFor) {
  ComparisonOptions options = options_of(Preset::kRobust);
  options.canny_thresholds = {{3, GradientUnit::kCounts}, {1, GradientUnit::kCounts}};
  const Comparison low = compared(options);
  options.canny_thresholds.high.value = 30;
  const Comparison high = compared(options);
  EXPECT_TRUE(
      is_written("Canny: high threshold 30 counts a pixel, low threshold 1 counts a pixel"));
  const auto canny = [](const Comparison& made) { return made.maps[4].edge_pixels; };
  EXPECT_GT(canny(low), canny(high));
  EXPECT_EQ(high.maps[3].edge_pixels, low.maps[3].edge_pixels);

  ASSERT_GT(canny(high), 0U);
  options.canny_thresholds = {{1e5, GradientUnit::kCounts}, {}};
  EXPECT_EQ(canny(compared(options)), 0U);

  auto scene = sim::render({.camera = {.width = kWidth, .height = kHeight}}, 0);
  auto detector = Detector::create(options.detector);
  Detection detection;
  ASSERT_TRUE(detector->detect(ImageView<const std::uint16_t>(scene->counts), detection));
  ASSERT_GT(detection.sigma_counts, 0);
  options.canny_thresholds = {{2, GradientUnit::kSigma}, {1, GradientUnit::kSigma}};
  const Comparison by_sigma = compared(options);
  options.canny_thresholds = {{2 * detection.sigma_counts, GradientUnit::kCounts},
                              {detection.sigma_counts, GradientUnit::kCounts}};
  const Comparison by_counts = compared(options);
  EXPECT_TRUE(test::same_pixels<std::uint8_t>(by_sigma.maps[4].edges.view(),
                                              by_counts.maps[4].edges.view()));
}

TEST_F(ComparedDesk, AMapWithoutAnEdgeHasNoFragments) {
  Image<std::uint16_t> flat(kWidth, kHeight);
  fill_pixels(flat.view(), std::uint16_t{3000});
  auto sheet = ComparisonSheet::create(options_of(Preset::kRobust));
  ASSERT_TRUE(sheet);
  forget_drawn_text();
  const auto made = sheet->draw(flat, 16, "flat");
  ASSERT_TRUE(made);
  for (const ComparedMap& map : made->maps) {
    EXPECT_EQ(map.edge_pixels, 0U) << map.name;
    EXPECT_EQ(map.fragments, 0U) << map.name;
  }
  EXPECT_TRUE(is_written("0 edge pixels, 0 fragments"));
  for (const DrawnText& text : drawn_text()) {
    EXPECT_EQ(text.text.find("nan"), std::string::npos) << text.text;
  }
}

TEST_F(ComparedDesk, RefusesOptionsOutOfRange) {
  ComparisonOptions kernel = options_of(Preset::kRobust);
  kernel.classical.log_kernel_px = 4;
  ComparisonOptions keep = options_of(Preset::kRobust);
  keep.detector.selection.keep_edges = -1;
  for (const auto& [options, part] : {std::pair{kernel, "log_kernel"}, {keep, "keep_edges"}}) {
    const auto sheet = ComparisonSheet::create(options);
    ASSERT_FALSE(sheet) << part;
    EXPECT_NE(sheet.error().message.find(part), std::string::npos) << sheet.error().message;
  }
}

}  // namespace
}  // namespace thermedge::figures
