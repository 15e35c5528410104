// The sheet of the stages: its pictures are what the detector made of the frame, and its texts the
// numbers that it found.
#include "thermedge/figures/stages_sheet.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "drawn_text.hpp"
#include "raster.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/io/colour_map.hpp"
#include "thermedge/io/overlay.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::figures {
namespace {

constexpr int kWidth = 100;
constexpr int kHeight = 72;
constexpr int kZoom = 4;  // points a pixel

// A step in the middle and a weak disc; both without noise.
Image<std::uint16_t> step_and_disc() {
  Image<std::uint16_t> counts(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool disc = std::hypot(x - 24, y - 36) < 12;
      counts(x, y) = static_cast<std::uint16_t>(3000 + (x >= 60 ? 200 : 0) + (disc ? 60 : 0));
    }
  }
  return counts;
}

Image<std::uint16_t> desk() {
  auto scene = sim::render({.camera = {.width = kWidth, .height = kHeight}}, 0);
  EXPECT_TRUE(scene);
  return std::move(scene->counts);
}

DetectorOptions options_of(Preset preset) {
  DetectorOptions options(preset);
  options.denoise.method = DenoiseMethod::kGaussian;
  options.threads = 1;
  if (PaperOptions* paper = options.paper()) {
    paper->contours.min_component_px = 10;
  }
  return options;
}

// In the picture of a step, at a place of the frame (pixel centres at integers).
Rgb colour_at(const Image<Rgb>& picture, double x, double y) {
  constexpr double kUnit = kZoom * kWidth / 100.0;
  return picture(static_cast<int>(4 * kUnit + (x + 0.5) * kZoom),
                 static_cast<int>(9.4 * kUnit + (y + 0.5) * kZoom));
}

// The sheet and its steps, and what the detector says of the same frame.
struct Drawn {
  Drawn(const DetectorOptions& options, const Image<std::uint16_t>& frame, int bits = 16)
      : figures{Figure(1, 1, [](Canvas&) {}), {}} {
    auto detector = Detector::create(options);
    EXPECT_TRUE(detector);
    EXPECT_TRUE(detector->detect({frame, bits}, found, {&steps, {}}));
    auto sheet = StagesSheet::create(options, kZoom * kWidth);
    EXPECT_TRUE(sheet);
    forget_drawn_text();
    auto made = sheet->draw(frame, bits, "desk.png");
    EXPECT_TRUE(made);
    figures = std::move(*made);
  }

  [[nodiscard]] Image<Rgb> picture_of(std::string_view step) const {
    for (const NamedFigure& named : figures.steps) {
      if (named.name.substr(3) == step) {
        return rasterised(named.figure);
      }
    }
    ADD_FAILURE() << "no step " << step;
    return drawn(1000, 1000, [](Canvas&) {});
  }

  // The colours in the middle of the pixels of the frame.
  [[nodiscard]] Image<Rgb> pixels_of(std::string_view step) const {
    const auto picture = picture_of(step);
    Image<Rgb> pixels(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        pixels(x, y) = colour_at(picture, x, y);
      }
    }
    return pixels;
  }

  Detection found;
  Intermediates steps;
  StagesFigures figures;
};

// Of the inner pixels: the panel's border lies over the outermost ones.
void expect_grey(const Image<Rgb>& pixels, ImageView<const std::uint8_t> levels) {
  for (int y = 1; y < kHeight - 1; ++y) {
    for (int x = 1; x < kWidth - 1; ++x) {
      const Rgb wanted = {levels(x, y), levels(x, y), levels(x, y)};
      ASSERT_EQ(pixels(x, y), wanted) << x << ", " << y;
    }
  }
}

void expect_map(const Image<Rgb>& pixels, ImageView<const std::uint8_t> map) {
  for (int y = 1; y < kHeight - 1; ++y) {
    for (int x = 1; x < kWidth - 1; ++x) {
      ASSERT_EQ(pixels(x, y), map(x, y) != 0 ? kInk : kPaper) << x << ", " << y;
    }
  }
}

class StagesOfPreset : public testing::TestWithParam<Preset> {};

TEST_P(StagesOfPreset, PicturesAreTheStagesOwn) {
  const Drawn drawn(options_of(GetParam()), desk());
  expect_grey(drawn.pixels_of("levels"), drawn.steps.levels);
  expect_grey(drawn.pixels_of("denoised_gaussian"), drawn.steps.denoised);
  expect_map(drawn.pixels_of("edge_pixels"), drawn.steps.edge_map);
  Image<std::uint8_t> mask(kWidth, kHeight);
  draw_mask(drawn.found.edges, mask);
  expect_map(drawn.pixels_of("mask"), mask);
  Image<std::uint8_t> view(kWidth, kHeight);
  io::draw_view(drawn.steps.corrected, view);
  expect_grey(drawn.pixels_of("frame"), view);
}

TEST_P(StagesOfPreset, TextsTellTheNumbersOfTheResult) {
  const Drawn drawn(options_of(GetParam()), desk());
  const Detection& found = drawn.found;
  for (const std::string& part :
       {fmt::format("desk.png, 100 x 72 pixels, preset {}", preset_name(GetParam())),
        fmt::format("noise sigma {:.1f} counts", found.corrections.noise.sigma_counts),
        fmt::format("{} contours, ", drawn.steps.contours.items.size()),
        fmt::format("{} pixels; a new", drawn.steps.contours.points.size()),
        fmt::format("{} corners on {} edges", found.edges.corners.size(), found.edges.edges.size()),
        fmt::format("the best {} of {}", found.edges.kept, found.edges.edges.size()),
        std::string("the steps below go on from this one"), std::string("whole frame")}) {
    EXPECT_TRUE(is_written(part)) << part;
  }
  for (const StageTime& time : found.times) {
    EXPECT_TRUE(is_written(std::string(time.stage))) << time.stage;
  }
}

TEST_P(StagesOfPreset, TextsOfTheSheetKeepToTheirPlaces) {
  const Drawn drawn(options_of(GetParam()), desk());
  std::vector<DrawnText> on_sheet;
  std::copy_if(drawn_text().begin(), drawn_text().end(), std::back_inserter(on_sheet),
               [](const DrawnText& text) { return text.figure == drawn_text().front().figure; });
  EXPECT_EQ(on_sheet.front().text, "From the frame to its edges, step by step");
  EXPECT_LT(on_sheet.size(), drawn_text().size()) << "the steps have their own";
  expect_text_in_place(on_sheet, {0, 0, drawn.figures.sheet.width(), drawn.figures.sheet.height()});
}

TEST(Stages, TellWhichEdgesHadTooLittleContrastWhereThatIsAskedFor) {
  (void)Drawn(options_of(Preset::kFast), desk());
  EXPECT_FALSE(is_written("low contrast"));
  EXPECT_FALSE(is_written("beyond budget"));
  DetectorOptions options = options_of(Preset::kFast);
  options.selection.min_contrast = {30, ContrastUnit::kSigma};
  options.selection.keep_edges = 2;
  const Drawn drawn(options, desk());
  const auto& edges = drawn.found.edges.edges;
  const auto low = std::count_if(edges.begin(), edges.end(), [](const Edge& edge) {
    return edge.status == EdgeStatus::kLowContrast;
  });
  EXPECT_GT(low, 0);
  EXPECT_TRUE(is_written("low contrast " + std::to_string(low)));
  EXPECT_TRUE(is_written("beyond budget"));
  std::vector<DrawnText> on_sheet;
  std::copy_if(drawn_text().begin(), drawn_text().end(), std::back_inserter(on_sheet),
               [](const DrawnText& text) { return text.figure == drawn_text().front().figure; });
  expect_text_in_place(on_sheet, {0, 0, drawn.figures.sheet.width(), drawn.figures.sheet.height()});
}

// The best edge has the colour of the first rank along its whole length.
TEST_P(StagesOfPreset, TheBestEdgeHasTheColourOfTheFirstRank) {
  const Drawn drawn(options_of(GetParam()), step_and_disc());
  ASSERT_GE(drawn.found.edges.kept, 2U);
  const Edge& best = drawn.found.edges.edges[0];
  if (GetParam() != Preset::kPaper) {  // which prefers what is closed
    EXPECT_NEAR((best.box.x_min + best.box.x_max) / 2, 59.5, 1) << "the step";
  }
  const auto picture = drawn.picture_of("rank");
  for (const auto point : drawn.found.points(best)) {
    EXPECT_EQ(colour_at(picture, point.x, point.y), io::rank_colour(0))
        << point.x << ", " << point.y;
  }
  EXPECT_EQ(colour_at(picture, 42, 36), colour_at(picture, 42, 10)) << "no edge between them";
}

TEST_P(StagesOfPreset, OnlyTheKeptEdgesAreRanked) {
  DetectorOptions options = options_of(GetParam());
  options.selection.keep_edges = 1;
  const Drawn drawn(options, step_and_disc());
  ASSERT_EQ(drawn.found.edges.kept, 1U);
  EXPECT_TRUE(is_written(fmt::format("the best 1 of {}", drawn.found.edges.edges.size())));
  const BoundingBox& box = drawn.found.edges.edges[0].box;
  const auto pixels = drawn.pixels_of("rank");
  for (int y = 1; y < kHeight - 1; ++y) {
    for (int x = 1; x < kWidth - 1; ++x) {
      const auto column = static_cast<float>(x);
      const bool near = column > box.x_min - 2 && column < box.x_max + 2;
      const Rgb pixel = pixels(x, y);
      ASSERT_TRUE(near || (pixel.r == pixel.g && pixel.g == pixel.b)) << x << ", " << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, StagesOfPreset,
                         testing::Values(Preset::kRobust, Preset::kFast, Preset::kPaper));

TEST(StagesSheet, FramesOf8BitsAreTakenAsTheyAre) {
  Image<std::uint16_t> levels(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      levels(x, y) = static_cast<std::uint16_t>(x < 50 ? 80 : 160);
    }
  }
  const Drawn drawn(options_of(Preset::kPaper), levels, 8);
  EXPECT_TRUE(is_written("The input has 8 bits: taken as it is."));
  const auto pixels = drawn.pixels_of("levels");
  EXPECT_EQ(pixels(20, 30), (Rgb{80, 80, 80}));
  EXPECT_EQ(pixels(70, 30), (Rgb{160, 160, 160}));
}

TEST(StagesSheet, TellsHowMuchTheViewClips) {
  Image<std::uint16_t> counts(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      counts(x, y) = static_cast<std::uint16_t>(x < 12 ? 1000 : x >= 75 ? 9000 : 3000);
    }
  }
  const Drawn drawn(options_of(Preset::kPaper), counts);
  EXPECT_TRUE(is_written("around the median 3000"));
  EXPECT_TRUE(is_written("12.0 % black, 25.0 % white"));
  EXPECT_TRUE(is_written("1000 to 9000 counts"));
}

TEST(StagesSheet, ABadPixelIsNamed) {
  Image<std::uint16_t> counts = desk();
  counts(30, 30) = 60000;
  const Drawn drawn(options_of(Preset::kRobust), counts);
  const std::size_t bad = drawn.found.corrections.bad_pixels.size();
  ASSERT_GE(bad, 1U);
  EXPECT_TRUE(is_written("replaced."));
  EXPECT_EQ(is_written("1 bad pixel replaced"), bad == 1);
}

TEST(StagesSheet, AnEmptyFrameHasNoEdgeToShow) {
  Image<std::uint16_t> flat(kWidth, kHeight);
  fill_pixels(flat.view(), std::uint16_t{3000});
  const Drawn drawn(options_of(Preset::kPaper), flat);
  EXPECT_TRUE(is_written("no edge."));
  EXPECT_TRUE(is_written("0 contours, 0 closed"));
  EXPECT_TRUE(is_written("0 edges, 0 edge pixels"));
  for (const DrawnText& text : drawn_text()) {
    EXPECT_EQ(text.text.find("nan"), std::string::npos) << text.text;
  }
}

}  // namespace
}  // namespace thermedge::figures
