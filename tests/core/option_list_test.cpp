// Ranges of options, and limits of pictures.
#include "thermedge/option_list.hpp"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "thermedge/limits.hpp"

namespace thermedge {
namespace {

enum class Colour { kRed, kBlue };
constexpr std::array kColours = {EnumName{Colour::kRed, "red"}, EnumName{Colour::kBlue, "blue"}};

enum class Length { kMetres, kFeet };
constexpr std::array kLengths = {EnumName{Length::kMetres, "m"}, EnumName{Length::kFeet, "ft"}};

struct Ladder {
  Quantity<Length> height = {};
};
template <OptionsOf<Ladder> O, class V>
void visit_options(O& o, V&& v) {
  v("height", o.height, QuantityRange{Bounds{0, 20}, kLengths}, "");
}

struct Inner {
  double share = 0.5;
  int count = 3;
};
template <OptionsOf<Inner> O, class V>
void visit_options(O& o, V&& v) {
  v("share", o.share, Bounds{0, 1}, "");
  v("count", o.count, Bounds{-2, 7}, "");
}

struct Outer {
  bool on = false;
  Colour colour = Colour::kRed;
  Inner inner;
  Inner other;
  double last = 10;
};
template <OptionsOf<Outer> O, class V>
void visit_options(O& o, V&& v) {
  v("on", o.on, Bounds{0, 1}, "");
  v("colour", o.colour, kColours, "");
  v.group("inner", o.inner);
  v.group("other", o.other);
  v("last", o.last, Bounds{10, 1e9}, "");
}

TEST(CheckRanges, TakesBothBoundsAndNothingBeyond) {
  for (const int count : {-3, -2, 0, 7, 8}) {
    Inner options;
    options.count = count;
    EXPECT_EQ(check_ranges(options, "").has_value(), count >= -2 && count <= 7) << count;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double share : {0.0, 1.0, std::nextafter(1.0, 0.0)}) {
    EXPECT_TRUE(check_ranges(Inner{share, 0}, "")) << share;
  }
  for (const double share :
       {std::nextafter(0.0, -1.0), std::nextafter(1.0, 2.0), std::nan(""), kInfinity, -kInfinity}) {
    EXPECT_FALSE(check_ranges(Inner{share, 0}, "")) << share;
  }
}

TEST(CheckRanges, NamesTheOptionOfAGroupInFull) {
  Outer options;
  EXPECT_TRUE(check_ranges(options, "stage."));
  options.inner.count = 8;
  const Status status = check_ranges(options, "stage.");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(status.error().option, "stage.inner.count");
  EXPECT_EQ(status.error().message, "stage.inner.count = 8 is out of range: -2 to 7");
}

TEST(CheckRanges, NamesTheFirstOfSeveral) {
  Outer options{.inner = {2.5, 100}, .other = {-1, 0}, .last = 3};
  EXPECT_EQ(check_ranges(options, "").error().message, "inner.share = 2.5 is out of range: 0 to 1");
  options.inner.share = 1;
  EXPECT_EQ(check_ranges(options, "").error().option, "inner.count");
  options.inner.count = 1;
  EXPECT_EQ(check_ranges(options, "").error().option, "other.share");
  options.other.share = 0;
  EXPECT_EQ(check_ranges(options, "").error().message, "last = 3 is out of range: 10 to 1e+09");
}

TEST(CheckRanges, LooksAtTheNumberOfAQuantityWhateverItsUnit) {
  for (const Length unit : {Length::kMetres, Length::kFeet}) {
    EXPECT_TRUE(check_ranges(Ladder{{20, unit}}, ""));
    const Status status = check_ranges(Ladder{{20.5, unit}}, "house.");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "house.height = 20.5 is out of range: 0 to 20");
    EXPECT_FALSE(check_ranges(Ladder{{std::nan(""), unit}}, ""));
  }
}

TEST(QuantityText, NamesTheUnitUnlessItIsTheFirst) {
  EXPECT_EQ(detail::quantity_text(Quantity<Length>{2.5}, kLengths), "2.5");
  EXPECT_EQ(detail::quantity_text(Quantity<Length>{12, Length::kFeet}, kLengths), "12ft");
}

TEST(ShortestText, ReadsBackAsTheSameNumber) {
  std::mt19937_64 random(71);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int i = 0; i < 2000; ++i) {
    const double value = (i % 2 == 0 ? 1 : -1) * std::pow(10, exponent(random));
    const std::string text = detail::shortest_text(value);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    EXPECT_EQ(back, value) << text;
  }
  EXPECT_EQ(detail::shortest_text(0.1), "0.1");
  EXPECT_EQ(detail::shortest_text(-5), "-5");
}

TEST(CheckLimits, SidesUpToTheLimitAndNoFarther) {
  const Limits limits{.max_side_px = 100, .max_bytes = 1'000'000};
  EXPECT_TRUE(check_limits(limits, "x", 100, 100, 2));
  for (const auto& [width, height] : {std::pair{101U, 1U}, {1U, 101U}}) {
    const Status status = check_limits(limits, "x", width, height, 2);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, ErrorCode::kLimitExceeded);
    EXPECT_EQ(status.error().message, "x: " + std::to_string(width) + "x" + std::to_string(height) +
                                          " is larger than 100 pixels a side");
  }
}

TEST(CheckLimits, BytesUpToTheLimitAndNoFarther) {
  const Limits limits{.max_side_px = 100, .max_bytes = 119};
  EXPECT_TRUE(check_limits(limits, "x", 59, 1, 2));
  EXPECT_TRUE(check_limits(limits, "x", 17, 7, 1));
  EXPECT_FALSE(check_limits(limits, "x", 60, 1, 2));
  EXPECT_EQ(check_limits(limits, "x", 10, 12, 1).error().message,
            "x: 10x12 needs more than 119 bytes");
}

TEST(CheckLimits, NoPixelsAreBadDataHoweverLongTheOtherSide) {
  constexpr std::uint64_t kHuge = std::numeric_limits<std::uint64_t>::max();
  for (const auto& [width, height] : {std::pair{std::uint64_t{0}, kHuge}, {kHuge, 0}, {0, 0}}) {
    EXPECT_EQ(check_limits({}, "x", width, height, 2).error().code, ErrorCode::kBadData);
  }
  EXPECT_EQ(check_limits({}, "x", kHuge, kHuge, 2).error().code, ErrorCode::kLimitExceeded);
}

}  // namespace
}  // namespace thermedge
