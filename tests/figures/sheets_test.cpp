// Figures: what is drawn comes out, in every format, with colours that everybody can tell apart.
#include "thermedge/figures/figure.hpp"

#include <fontconfig/fontconfig.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "canvas.hpp"
#include "chart.hpp"
#include "frame_panels.hpp"
#include "sheet.hpp"
#include "support/files.hpp"
#include "support/images.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/figures/comparison_sheet.hpp"
#include "thermedge/figures/probe_sheet.hpp"
#include "thermedge/figures/stages_sheet.hpp"
#include "thermedge/io/colour_map.hpp"
#include "thermedge/io/overlay.hpp"
#include "thermedge/probe/probe.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge::figures {
namespace {

using test::file_text;
using test::TemporaryDirectory;

std::size_t dark_pixels(const Image<Rgb>& picture, int x0, int y0, int x1, int y1) {
  std::size_t count = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      count += picture(x, y).g < 128 ? 1 : 0;
    }
  }
  return count;
}

double lightness(Rgb colour) {  // CIE L* of sRGB
  const auto linear = [](int value) {
    const double share = value / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  const double luminance =
      0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
  return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
}

// What a person without red (protan) or green (deutan) cones sees: Machado, Oliveira, Fernandes
// 2009, severity 1.
using Matrix = std::array<std::array<double, 3>, 3>;
constexpr Matrix kProtan = {{{.152, 1.053, -.205}, {.115, .786, .099}, {-.004, -.048, 1.052}}};
constexpr Matrix kDeutan = {{{.367, .861, -.228}, {.280, .673, .047}, {-.012, .043, .969}}};

std::array<double, 3> seen_by(const Matrix& eye, Rgb colour) {
  std::array<double, 3> seen{};
  for (std::size_t i = 0; i < 3; ++i) {
    seen[i] = eye[i][0] * colour.r + eye[i][1] * colour.g + eye[i][2] * colour.b;
  }
  return seen;
}

TEST(Figure, PicturesComeOutPixelByPixel) {
  const Image<std::uint8_t> map = [] {
    Image<std::uint8_t> made = test::noise_image<std::uint8_t>(31, 17, 100, 60, 4);
    for (int y = 0; y < made.height(); ++y) {
      for (int x = 0; x < made.width(); ++x) {
        made(x, y) = made(x, y) > 100 ? 255 : 0;
      }
    }
    return made;
  }();
  const Figure figure(2 * 31 + 10, 2 * 17 + 10, [&](Canvas& canvas) {
    map_picture(map.view())(canvas, {5, 5, 62, 34});
  });
  const auto picture = figure.rasterise();
  ASSERT_TRUE(picture);
  ASSERT_EQ(picture->width(), 72);
  ASSERT_EQ(picture->height(), 44);
  for (int y = 0; y < 34; ++y) {
    for (int x = 0; x < 62; ++x) {
      ASSERT_EQ((*picture)(5 + x, 5 + y), map(x / 2, y / 2) != 0 ? kInk : kPaper) << x << "," << y;
    }
  }
  EXPECT_EQ((*picture)(4, 4), kPaper);
  EXPECT_EQ((*picture)(67, 39), kPaper);
}

TEST(Figure, LinesGoThroughThePixelsOfTheFrame) {
  const Figure figure(80, 60, [](Canvas& canvas) {
    canvas.inside_frame({0, 0, 80, 60}, 20, 15, [&] {
      const Point points[] = {{2, 3}, {12, 3}};
      canvas.line(points, false, kInk, 1);
    });
  });
  const auto picture = figure.rasterise();
  ASSERT_TRUE(picture);
  // Pixel (x, 3) of the frame is the square of 4 points from 4 x and 12.
  EXPECT_EQ((*picture)(4 * 7 + 2, 14), kInk);
  EXPECT_EQ((*picture)(4 * 7 + 2, 10), kPaper);
  EXPECT_EQ((*picture)(4 * 7 + 2, 17), kPaper);
  EXPECT_EQ((*picture)(4 * 14, 14), kPaper);
}

TEST(Figure, NothingIsDrawnOutsideTheFrame) {
  const Figure figure(60, 60, [](Canvas& canvas) {
    canvas.inside_frame({20, 20, 20, 20}, 10, 10, [&] {
      const Point points[] = {{-50, 5}, {50, 5}};
      canvas.line(points, false, kInk, 2);
    });
  });
  const auto picture = figure.rasterise();
  ASSERT_TRUE(picture);
  EXPECT_GT(dark_pixels(*picture, 20, 20, 40, 40), 40U);
  EXPECT_EQ(dark_pixels(*picture, 0, 0, 20, 60) + dark_pixels(*picture, 40, 0, 60, 60), 0U);
}

TEST(Figure, TextIsSetWhereItWasAsked) {
  const TextStyle style{.size = 20};
  double width = 0;
  const Figure figure(200, 60, [&](Canvas& canvas) {
    width = canvas.text_width("Edges 123", style);
    canvas.text({20, 40}, "Edges 123", style);
  });
  const auto picture = figure.rasterise();
  ASSERT_TRUE(picture);
  EXPECT_GT(width, 60);
  EXPECT_LT(width, 120);
  const int end = 20 + static_cast<int>(std::ceil(width));
  EXPECT_GT(dark_pixels(*picture, 20, 22, end, 44), 150U);
  EXPECT_EQ(dark_pixels(*picture, 0, 0, 19, 60), 0U);
  EXPECT_EQ(dark_pixels(*picture, end + 1, 0, 200, 60), 0U);
  EXPECT_EQ(dark_pixels(*picture, 0, 47, 200, 60), 0U);
}

bool has_font(const char* family) {
  FcPattern* pattern = FcPatternBuild(nullptr, FC_FAMILY, FcTypeString, family, nullptr);
  FcFontSet* fonts = FcFontList(nullptr, pattern, nullptr);
  const bool found = fonts != nullptr && fonts->nfont > 0;
  FcFontSetDestroy(fonts);
  FcPatternDestroy(pattern);
  return found;
}

TEST(Figure, DigitsAreOfOneWidthSoThatColumnsAlign) {
  if (!has_font("Open Sans")) {
    GTEST_SKIP() << "Open Sans is not installed; another typeface may have digits of any width";
  }
  Figure(10, 10, [](Canvas& canvas) {
    const TextStyle style{.size = 20};
    for (const char* digit : {"1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
      EXPECT_DOUBLE_EQ(canvas.text_width(digit, style), canvas.text_width("0", style)) << digit;
    }
  });
}

TEST(Figure, WrapsBetweenWords) {
  Figure(10, 10, [](Canvas& canvas) {
    const TextStyle style{.size = 10};
    const std::string text = "one two three four five six seven eight";
    const auto lines = canvas.wrap(text, 60, style);
    std::string joined;
    for (const std::string& line : lines) {
      EXPECT_LE(canvas.text_width(line, style), 60) << line;
      joined += (joined.empty() ? "" : " ") + line;
    }
    EXPECT_GT(lines.size(), 2U);
    EXPECT_EQ(joined, text);
    EXPECT_EQ(canvas.wrap("unbreakablyLongSingleWord", 5, style).size(), 1U);
    EXPECT_TRUE(canvas.wrap("", 60, style).empty());
  });
}

TEST(Figure, WritesPngSvgPdfAndTheSameBytesEachTime) {
  const TemporaryDirectory directory;
  const auto draw = [](Canvas& canvas) { canvas.text({5, 25}, "sigma", {.size = 20}); };
  for (const std::string ending : {"png", "svg", "pdf"}) {
    ASSERT_TRUE(Figure(90, 40, draw).write(directory / ("a." + ending)));
    ASSERT_TRUE(Figure(90, 40, draw).write(directory / ("b." + ending)));
    const std::string bytes = file_text(directory / ("a." + ending));
    EXPECT_GT(bytes.size(), 200U);
    // Cairo numbers the groups of its SVG files on from the figure before.
    EXPECT_TRUE(ending == "svg" || bytes == file_text(directory / ("b." + ending))) << ending;
  }
  EXPECT_EQ(file_text(directory / "a.png").substr(1, 3), "PNG");
  EXPECT_EQ(file_text(directory / "a.pdf").substr(0, 5), "%PDF-");
  EXPECT_NE(file_text(directory / "a.svg").find("</svg>"), std::string::npos);
}

TEST(Figure, SaysWhyItCannotBeWritten) {
  const TemporaryDirectory directory;
  const Figure figure(20, 20, [](Canvas&) {});
  for (const std::string name : {"x.jpg", "x", "missing/x.png", "missing/x.pdf"}) {
    const Status status = figure.write(directory / name);
    ASSERT_FALSE(status) << name;
    EXPECT_NE(status.error().message.find(name), std::string::npos) << status.error().message;
    EXPECT_FALSE(std::filesystem::exists(directory / name));
  }
  const Status status = Figure(40000, 20, [](Canvas&) {}).write(directory / "wide.png");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message.find('\n'), std::string::npos);
}

TEST(Colours, OfQuantitiesGetSteadilyLighter) {
  const double whole = lightness(io::plasma(1)) - lightness(io::plasma(0));
  for (int i = 1; i <= 50; ++i) {
    const double step = lightness(io::plasma(i / 50.0)) - lightness(io::plasma((i - 1) / 50.0));
    EXPECT_GT(step, 0.4 * whole / 50) << i;
    EXPECT_LT(step, 1.6 * whole / 50) << i;
    EXPECT_LT(lightness(io::rank_colour(i / 50.0)), lightness(io::rank_colour((i - 1) / 50.0)));
  }
  EXPECT_EQ(io::plasma(0), (Rgb{13, 8, 135}));
  EXPECT_EQ(io::plasma(1), (Rgb{240, 249, 33}));
  EXPECT_EQ(io::plasma(-3), io::plasma(0));
  EXPECT_EQ(io::plasma(7), io::plasma(1));
  EXPECT_EQ(io::rank_colour(0), io::plasma(1));
  EXPECT_EQ(io::rank_colour(2), io::rank_colour(1));
}

TEST(Colours, CategoriesCanBeToldApartWithoutRedOrGreenCones) {
  for (const Matrix& eye : {kProtan, kDeutan}) {
    for (std::size_t a = 0; a < 7; ++a) {
      for (std::size_t b = a + 1; b < 7; ++b) {
        const auto one = seen_by(eye, category_colour(a));
        const auto other = seen_by(eye, category_colour(b));
        const double distance = std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
        EXPECT_GT(distance, 30) << a << " and " << b;
      }
    }
  }
}

TEST(Sheet, HoldsEveryPanelInItsPlace) {
  std::vector<Panel> panels;
  std::vector<Box> boxes;
  for (int i = 0; i < 5; ++i) {
    panels.push_back({.title = "Panel",
                      .note = "a note",
                      .aspect = 0.5,
                      .draw = [&boxes](Canvas& canvas, const Box& box) {
                        boxes.push_back(box);
                        canvas.fill(box, kInk);
                      }});
  }
  const Figure sheet = make_sheet({"Title", "subtitle", "footer"}, panels, 3, 200);
  ASSERT_EQ(boxes.size(), 5U);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_DOUBLE_EQ(boxes[i].width, 200);
    EXPECT_DOUBLE_EQ(boxes[i].height, 100);
    EXPECT_LT(boxes[i].right(), sheet.width());
    EXPECT_LT(boxes[i].bottom(), sheet.height());
    EXPECT_DOUBLE_EQ(boxes[i].x, boxes[i % 3].x);
    EXPECT_DOUBLE_EQ(boxes[i].y, boxes[i / 3 * 3].y);
  }
  EXPECT_GT(boxes[1].x, boxes[0].right());
  EXPECT_GT(boxes[3].y, boxes[0].bottom());
}

TEST(Sheet, PanelsHaveAWholeNumberOfPointsAPixel) {
  for (const int width : {80, 160, 320, 382, 384, 640}) {
    const double points = panel_width_for(width, kPanelWidth);
    EXPECT_EQ(points, width * std::round(points / width)) << width;
    EXPECT_GE(points, 600) << width;
    EXPECT_LE(points, 1000) << width;
    EXPECT_LE(panel_width_for(width, 300), 450) << width;
  }
  EXPECT_EQ(panel_width_for(1920, kPanelWidth), 760);
}

Image<std::uint16_t> small_desk() {
  auto scene = sim::render({.camera = {.width = 96, .height = 72}}, 0);
  EXPECT_TRUE(scene);
  return std::move(scene->counts);
}

class Stages : public testing::Test {
 protected:
  static DetectorOptions quick() {
    DetectorOptions options(Preset::kPaper);
    options.denoise.method = DenoiseMethod::kNlm;
    options.paper()->contours.min_component_px = 10;
    options.threads = 1;
    return options;
  }
};

TEST_F(Stages, DrawEveryStepOfTheSimulatedDesk) {
  auto sheet = StagesSheet::create(quick());
  ASSERT_TRUE(sheet);
  const auto made = sheet->draw(small_desk(), 16, "desk");
  ASSERT_TRUE(made);
  std::vector<std::string> names;
  for (const NamedFigure& step : made->steps) {
    names.push_back(step.name);
    EXPECT_TRUE(step.figure.rasterise());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"01_frame", "02_levels", "03_denoised_nlm",
                                             "04_denoised_bm3d", "05_edge_pixels", "06_contours",
                                             "07_links", "08_corners", "09_score", "10_rank",
                                             "11_mask", "12_times"}));
  EXPECT_GT(made->sheet.width(), 4 * 700);
}

TEST_F(Stages, ShowAlsoTheChosenDenoiser) {
  DetectorOptions options = quick();
  options.denoise.method = DenoiseMethod::kGaussian;
  auto sheet = StagesSheet::create(options);
  ASSERT_TRUE(sheet);
  const auto made = sheet->draw(test::noise_image<std::uint16_t>(64, 48, 3000, 20, 1), 16, "noise");
  ASSERT_TRUE(made);
  EXPECT_EQ(made->steps.size(), 13U);
  EXPECT_EQ(made->steps[2].name, "03_denoised_gaussian");
  EXPECT_EQ(made->steps[12].name, "13_times");
}

TEST_F(Stages, TakeFramesOfEverySizeAndContent) {
  auto sheet = StagesSheet::create(quick());
  ASSERT_TRUE(sheet);
  for (const int size : {1, 2, 7, 8, 33}) {
    Image<std::uint16_t> flat(size, size);
    fill_pixels(flat.view(), std::uint16_t{65535});
    EXPECT_TRUE(sheet->draw(flat, 16, "flat")) << size;
    EXPECT_TRUE(sheet->draw(test::noise_image<std::uint16_t>(size, 8, 128, 30, 2), 8, "noise"));
  }
  EXPECT_FALSE(sheet->draw(ImageView<const std::uint16_t>(), 16, "nothing"));
}

TEST_F(Stages, RefuseOptionsOutOfRange) {
  DetectorOptions options = quick();
  options.paper()->grey_scale.gain = -1;
  const auto sheet = StagesSheet::create(options);
  ASSERT_FALSE(sheet);
  EXPECT_NE(sheet.error().message.find("gain"), std::string::npos);
}

TEST(ComparisonSheet, HoldsTheMapsOfEachDetector) {
  ComparisonOptions options;
  options.detector = DetectorOptions(Preset::kPaper);
  options.detector.denoise.method = DenoiseMethod::kGaussian;
  options.detector.paper()->contours.min_component_px = 10;
  options.classical_denoiser = DenoiseMethod::kNone;
  auto sheet = ComparisonSheet::create(options);
  ASSERT_TRUE(sheet);
  const Image<std::uint16_t> frame = small_desk();
  const auto made = sheet->draw(frame, 16, "desk");
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->sheet.rasterise());
  ASSERT_EQ(made->maps.size(), 6U);

  auto detector = Detector::create(options.detector);
  Detection detection;
  Intermediates steps;
  ASSERT_TRUE(detector->detect(frame, detection, {&steps, {}}));
  Image<float> levels(96, 72);
  copy_pixels(steps.levels.view(), levels.view());
  Image<std::uint8_t> wanted(96, 72);
  for (std::size_t i = 0; i < 6; ++i) {
    const ComparedMap& map = made->maps[i];
    if (i < 5) {
      EXPECT_EQ(map.name, kClassicalMethods[i].name);
      ASSERT_TRUE(
          ClassicalDetector().run(levels, kClassicalMethods[i].method, wanted, *make_runner(1)));
    } else {
      EXPECT_EQ(map.name, "thermedge");
      draw_mask(detection.edges, wanted);
    }
    EXPECT_TRUE(test::same_pixels<std::uint8_t>(map.edges.view(), wanted.view())) << map.name;
    EXPECT_EQ(map.edge_pixels, count_fragments(wanted.view()).edge_pixels);
    EXPECT_EQ(map.fragments, count_fragments(wanted.view()).fragments);
    EXPECT_GT(map.edge_pixels, 50U);
    EXPECT_GT(map.ms, 0);
  }
}

TEST(ComparisonSheet, DenoisesInFrontOfTheClassicalDetectors) {
  const auto noisy = sim::render({.camera = {.width = 160, .height = 120, .sigma_counts = 60}}, 0);
  ASSERT_TRUE(noisy);
  std::size_t fragments[2] = {};
  for (const auto method : {DenoiseMethod::kNone, DenoiseMethod::kNlm}) {
    ComparisonOptions options;
    options.detector.denoise.method = DenoiseMethod::kGaussian;
    options.classical_denoiser = method;
    auto sheet = ComparisonSheet::create(options);
    ASSERT_TRUE(sheet);
    const auto made = sheet->draw(noisy->counts, 16, "desk");
    ASSERT_TRUE(made);
    fragments[method == DenoiseMethod::kNlm ? 1 : 0] = made->maps[2].fragments;
  }
  EXPECT_LT(2 * fragments[1], fragments[0]);
}

TEST(ComparisonSheet, TakesFramesOfEverySize) {
  ComparisonOptions options;
  options.detector = DetectorOptions(Preset::kPaper);
  options.detector.denoise.method = DenoiseMethod::kNone;
  auto sheet = ComparisonSheet::create(options);
  ASSERT_TRUE(sheet);
  for (const int size : {1, 2, 9}) {
    EXPECT_TRUE(sheet->draw(test::noise_image<std::uint16_t>(size, 5, 128, 30, 2), 8, "noise"));
  }
  EXPECT_FALSE(sheet->draw(ImageView<const std::uint16_t>(), 16, "nothing"));
}

TEST(Ticks, AreRoundAndInside) {
  EXPECT_EQ(ticks({0, 10}, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks({-1, 1}, 4), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
  EXPECT_EQ(ticks({2434, 3758}, 6), (std::vector<double>{2500, 3000, 3500}));
  for (const double length : {1e-6, 0.37, 5.0, 123.0, 65535.0, 1e9}) {
    const auto values = ticks({7, 7 + length}, 6);
    EXPECT_GE(values.size(), 2U) << length;
    EXPECT_LE(values.size(), 8U) << length;
    EXPECT_GE(values.front(), 7 - 1e-9 * length);
    EXPECT_LE(values.back(), 7 + length * (1 + 1e-9));
  }
  EXPECT_GT(widened({3, 3}, 0).length(), 0);
}

TEST(ProbeSheet, IsDrawnForSequencesSingleFramesAndFlatOnes) {
  for (const int frames : {1, 5}) {
    for (const double sigma : {0.0, 8.0}) {
      for (const int bits : {8, 16}) {
        RecordingProbe probe;
        Image<std::uint16_t> first;
        for (int i = 0; i < frames; ++i) {
          Image<std::uint16_t> frame =
              test::noise_image<std::uint16_t>(80, 64, 120, sigma, static_cast<unsigned>(i + 1));
          ASSERT_TRUE(probe.add(frame, bits));
          first = std::move(frame);
        }
        const Figure sheet = draw_probe(probe.report(), first, "noise");
        const auto picture = sheet.rasterise();
        ASSERT_TRUE(picture);
        EXPECT_GT(dark_pixels(*picture, 0, 0, picture->width(), picture->height()), 1000U);
      }
    }
  }
}

}  // namespace
}  // namespace thermedge::figures
