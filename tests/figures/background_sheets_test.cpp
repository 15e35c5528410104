// The figures of the paper's section 2: radiation, and frames of high and low signal-to-noise
// ratio.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <utility>

#include "drawn_text.hpp"
#include "support/images.hpp"
#include "thermedge/figures/radiation_sheet.hpp"
#include "thermedge/figures/snr_sheet.hpp"

namespace thermedge::figures {
namespace {

TEST(RadiationSheet, TellsTheMaximaAndWhatTheBandHolds) {
  forget_drawn_text();
  const std::array temperatures = {250.0, 300.0};
  const auto figure = draw_radiation(temperatures);
  ASSERT_TRUE(figure);
  // Wien: 2897.77 um K over the temperature.
  EXPECT_TRUE(is_written("11.6 um at 250 K"));
  EXPECT_TRUE(is_written("9.66 um at 300 K"));
  EXPECT_TRUE(is_written("0.483 um at 6000 K"));
  // From tables of the fraction of black-body radiation up to lambda T: 2250 um K .125 and 3900 um
  // K .465 at 300 K.
  EXPECT_TRUE(is_written("35 % at 300 K"));
  expect_text_in_place(drawn_text(), {0, 0, figure->width(), figure->height()});
}

TEST(RadiationSheet, RefusesWhatItCannotDraw) {
  EXPECT_FALSE(draw_radiation({}));
  const std::array<double, 9> many{};
  EXPECT_FALSE(draw_radiation(many));
  for (const double kelvin : {0.0, 99.0, 10001.0, std::numeric_limits<double>::quiet_NaN()}) {
    const std::array one = {kelvin};
    EXPECT_FALSE(draw_radiation(one)) << kelvin;
  }
  const std::array good = {300.0};
  EXPECT_FALSE(draw_radiation(good, {13, 7.5}));
  EXPECT_FALSE(draw_radiation(good, {0, 7.5}));
}

// The numbers of the text: 2217 to 3342 counts are 11.25 degC, 2560 to 2692 are 1.32.
TEST(SnrSheet, WorksOutTheTextsExamples) {
  const auto frame_between = [](int low, int high) {
    auto frame = test::noise_image<std::uint16_t>(64, 48, (low + high) / 2.0, 5, 1);
    fill_pixels(frame.view().crop(0, 0, 8, 8), static_cast<std::uint16_t>(low));
    fill_pixels(frame.view().crop(56, 40, 8, 8), static_cast<std::uint16_t>(high));
    frame(30, 20) = 0;  // a dead pixel
    return frame;
  };
  const auto high = frame_between(2217, 3342);
  const auto low = frame_between(2560, 2692);
  const std::array frames = {SnrFrame{high.view(), "high"}, SnrFrame{low.view(), "low"}};
  forget_drawn_text();
  const auto figure = draw_snr(frames);
  ASSERT_TRUE(figure);
  EXPECT_TRUE(is_written("(3342 - 2217) x 0.01 = 11.25 degC"));
  EXPECT_TRUE(is_written("(2692 - 2560) x 0.01 = 1.32 degC"));
  EXPECT_TRUE(is_written("Raw: high"));
  EXPECT_TRUE(is_written("Grey: low"));
  EXPECT_TRUE(is_written("0.02 degC a level"));
  expect_text_in_place(drawn_text(), {0, 0, figure->width(), figure->height()});
}

TEST(SnrSheet, RefusesWhatItCannotDraw) {
  const auto frame = test::noise_image<std::uint16_t>(16, 12, 3000, 5, 1);
  const SnrFrame one{frame.view(), "one"};
  EXPECT_FALSE(draw_snr({}));
  EXPECT_FALSE(draw_snr(std::vector<SnrFrame>(7, one)));
  EXPECT_FALSE(draw_snr(std::vector<SnrFrame>(1, one), {.gain = 0}));
  EXPECT_FALSE(draw_snr(std::vector<SnrFrame>(1, one), {}, 0));
  EXPECT_TRUE(draw_snr(std::vector<SnrFrame>(6, one)));
}

}  // namespace
}  // namespace thermedge::figures
