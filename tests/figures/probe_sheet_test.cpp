// The sheet of a recording's properties: its texts and curves say what the probe found.
#include "thermedge/figures/probe_sheet.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "drawn_text.hpp"
#include "raster.hpp"
#include "support/images.hpp"
#include "thermedge/io/colour_map.hpp"

namespace thermedge::figures {
namespace {

constexpr int kWidth = 80;
constexpr int kHeight = 64;
constexpr Rgb kData = {40, 90, 150};
constexpr Rgb kBars = {213, 94, 0};

struct Recording {
  RecordingReport report;
  Image<std::uint16_t> first;
};

// Frames of noise around `mean`, which rises by `drift` a frame.
Recording recorded(int frames, double mean, double sigma, int bits = 16, double drift = 0) {
  Recording made;
  RecordingProbe probe;
  for (int i = 0; i < frames; ++i) {
    auto frame = test::noise_image<std::uint16_t>(kWidth, kHeight, mean + drift * i, sigma,
                                                  static_cast<unsigned>(i + 1));
    EXPECT_TRUE(probe.add(frame, bits));
    if (i == 0) {
      made.first = std::move(frame);
    }
  }
  made.report = probe.report();
  return made;
}

Figure sheet_of(const Recording& recording) {
  forget_drawn_text();
  return draw_probe(recording.report, recording.first, "corridor.tif");
}

// The part of the sheet that the panel with this title fills, from its title to its note.
Extent extent_of_colour_under(const Image<Rgb>& picture, const std::string& title, Rgb colour) {
  const auto& texts = drawn_text();
  const auto heading = std::find_if(texts.begin(), texts.end(),
                                    [&](const DrawnText& drawn) { return drawn.text == title; });
  EXPECT_NE(heading, texts.end()) << title;
  const int left = static_cast<int>(heading->box.x) - 60;
  const int top = static_cast<int>(heading->box.bottom());
  return extent_of(picture, colour, {left, top, left + 840, top + 660});
}

TEST(ProbeSheet, TellsTheNumbersOfTheReport) {
  const Recording recording = recorded(4, 3000, 8);
  (void)sheet_of(recording);
  const RecordingReport& report = recording.report;
  for (const std::string& part :
       {std::string("What this recording is like"), std::string("corridor.tif: 4 frames"),
        fmt::format("SNR {:.0f}", report.snr.value()), std::string("80 x 64 pixels"),
        fmt::format("{} of 16 bits used", report.used_bits),
        fmt::format("within {:.0f} counts", report.robust_range_counts),
        fmt::format("sigma {:.2f} counts", report.sigma_counts),
        fmt::format("of sigma {:.2f} counts", report.column_sigma_counts),
        std::string("4 frames, 0 repeated")}) {
    EXPECT_TRUE(is_written(part)) << part;
  }
}

TEST(ProbeSheet, HasASeriesOnlyOfSequences) {
  (void)sheet_of(recorded(1, 3000, 8));
  EXPECT_TRUE(is_written("corridor.tif: 1 frame,"));
  EXPECT_TRUE(is_written("(f)"));
  EXPECT_FALSE(is_written("(g)"));
  EXPECT_FALSE(is_written("Median over time"));
  (void)sheet_of(recorded(2, 3000, 8));
  EXPECT_TRUE(is_written("(g)"));
  EXPECT_TRUE(is_written("Median over time"));
}

TEST(ProbeSheet, SpeaksOfLevelsWhereAPictureHas8Bits) {
  const Figure sheet = sheet_of(recorded(2, 120, 6, 8));
  EXPECT_TRUE(is_written("of 8 bits used"));
  EXPECT_TRUE(is_written("levels"));
  EXPECT_FALSE(is_written("counts"));
  // Algorithm 1 does not work on them, so there are no bars of its gains.
  EXPECT_FALSE(is_written("clipped"));
  EXPECT_EQ(extent_of(rasterised(sheet), kBars).pixels, 0);
}

TEST(ProbeSheet, SaysThatFlatFramesTellNoRatio) {
  const Figure sheet = sheet_of(recorded(3, 5000, 0));
  EXPECT_TRUE(is_written("SNR unknown"));
  EXPECT_TRUE(is_written("sigma 0.00 counts"));
  EXPECT_TRUE(is_written("3 frames, 2 repeated"));
  for (const DrawnText& drawn : drawn_text()) {
    EXPECT_EQ(drawn.text.find("nan"), std::string::npos) << drawn.text;
    EXPECT_EQ(drawn.text.find("inf"), std::string::npos) << drawn.text;
  }
}

TEST(ProbeSheet, TextsKeepToTheirPlaces) {
  for (const Recording& recording : {recorded(1, 3000, 8), recorded(5, 30000, 800),
                                     recorded(2, 120, 40, 8), recorded(3, 65535, 0)}) {
    const Figure sheet = sheet_of(recording);
    expect_text_in_place(drawn_text(), {0, 0, sheet.width(), sheet.height()});
  }
}

// A gain is shown as the range of counts that it keeps: 255 / gain wide, and 127 / gain of it below
// the median.
TEST(ProbeSheet, BarsSpanWhatAGainKeeps) {
  const Figure sheet = sheet_of(recorded(1, 3000, 400));
  const auto picture = rasterised(sheet);
  EXPECT_TRUE(is_written("gain 0.5:"));
  EXPECT_TRUE(is_written("gain 0.2:"));
  const Extent bars = extent_of_colour_under(picture, "Histogram", kBars);
  const Extent columns = extent_of_colour_under(picture, "Histogram", kData);
  EXPECT_GT(bars.pixels, 1000);
  EXPECT_LT(bars.bottom, columns.top) << "the bars have the upper part for themselves";
  const double median = (columns.left + columns.right) / 2.0;
  EXPECT_LT(bars.left, median);
  EXPECT_GT(bars.right, median);
}

// Rising medians are a line that rises.
TEST(ProbeSheet, TheMedianOverTimeRisesWithTheFrames) {
  const Figure sheet = sheet_of(recorded(6, 3000, 2, 16, 100));
  const auto picture = rasterised(sheet);
  const Extent line = extent_of_colour_under(picture, "Median over time", kData);
  const auto height_at = [&](int x) {
    int y = line.top;
    while (y < line.bottom && picture(x, y) != kData) {
      ++y;
    }
    return y;
  };
  ASSERT_GT(line.width(), 500);
  EXPECT_GT(line.height(), 300);
  EXPECT_GT(height_at(line.left + 60), height_at(line.left + line.width() / 2) + 50);
  EXPECT_GT(height_at(line.left + line.width() / 2), height_at(line.right - 60) + 50);
  EXPECT_TRUE(is_written("moves by 100"));
}

// A report made by hand, whose map of the noise has one tile that is noisier than the others.
TEST(ProbeSheet, NoisyTilesAreBright) {
  Recording recording = recorded(1, 3000, 8);
  NoiseMap& map = recording.report.noise_map;
  map.columns = 8;
  map.rows = 8;
  map.sigma_counts.assign(64, 5.0);
  for (int i = 0; i < 8; ++i) {
    map.sigma_counts[static_cast<std::size_t>(i)] = 9.0;
  }
  const auto picture = rasterised(sheet_of(recording));
  const Extent bright = extent_of_colour_under(picture, "Noise over the picture", io::plasma(1));
  const Extent dark = extent_of_colour_under(picture, "Noise over the picture", io::plasma(0));
  EXPECT_NEAR(bright.width(), 800, 4) << "the whole uppermost row of tiles";
  EXPECT_NEAR(bright.height(), 80, 4);
  EXPECT_NEAR(dark.height(), 560, 4);
  EXPECT_TRUE(is_written("5.00"));
  EXPECT_TRUE(is_written("9.00 counts"));
}

// A hundredth more noise in one tile is no other colour.
TEST(ProbeSheet, EvenNoiseIsOfOneColour) {
  Recording recording = recorded(1, 3000, 8);
  NoiseMap& map = recording.report.noise_map;
  map.columns = map.rows = 8;
  map.sigma_counts.assign(64, 8.0);
  map.sigma_counts[9] = 8.08;
  map.sigma_counts[10] = 7.92;
  const auto picture = rasterised(sheet_of(recording));
  EXPECT_EQ(extent_of_colour_under(picture, "Noise over the picture", io::plasma(1)).pixels, 0);
  EXPECT_EQ(extent_of_colour_under(picture, "Noise over the picture", io::plasma(0)).pixels, 0);
  EXPECT_TRUE(is_written("6.40"));
  EXPECT_TRUE(is_written("9.60 counts"));
}

// One cell of the spectrum is made dark and lies where its periods are written: 8 px across is the
// third column, 4 px down the fifth row.
TEST(ProbeSheet, TheSpectrumHasItsPeriodsOnItsAxes) {
  Recording recording = recorded(1, 3000, 8);
  RecordingReport& report = recording.report;
  report.spectrum = white_spectrum();
  report.spectrum[8 * 4 + 2] = 1.0F / 16;
  report.column_sigma_counts = report.row_sigma_counts = 0;
  report.noise_kind = NoiseKind::kWhite;
  const auto picture = rasterised(sheet_of(recording));
  const std::string title = "Spectrum of the noise: white";
  const Extent white = extent_of_colour_under(picture, title, io::plasma(4.0 / 6));
  const Extent dark = extent_of_colour_under(picture, title, io::plasma(0));
  EXPECT_NEAR(white.width(), white.height(), 2);
  const double cell = white.width() / 8.0;
  EXPECT_NEAR(dark.width(), cell, 2);
  EXPECT_NEAR(dark.left - white.left, 2 * cell, 2);
  EXPECT_NEAR(dark.top - white.top, 4 * cell, 2);
  EXPECT_TRUE(is_written("period across, px"));
  EXPECT_TRUE(is_written("neighbours have nothing in common"));
  EXPECT_FALSE(is_written("stripes: bright"));
  report.column_sigma_counts = report.sigma_counts / 2;
  (void)sheet_of(recording);
  EXPECT_TRUE(is_written("stripes: bright"));
}

}  // namespace
}  // namespace thermedge::figures
