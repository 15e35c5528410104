// PNG of every kind of pixel, put together by hand.
#include <gtest/gtest.h>

#include <array>

#include "support/decoding.hpp"
#include "support/encoded_pictures.hpp"

namespace thermedge::io {
namespace {

using namespace std::string_literals;
using test::decoded;
using test::error_of;
using test::pixels_of;
using test::png_chunk;
using test::png_file;
using test::PngColour;
using test::PngParts;

TEST(Png, NarrowPixelsBecomeLevelsOf8Bits) {
  const auto read = [](int bits, std::uint32_t width, const std::string& row) {
    const auto frame = decoded(png_file({.width = width, .bits = bits, .rows = "\0"s + row}));
    EXPECT_TRUE(frame && frame->bits == 8);
    return pixels_of(frame);
  };
  EXPECT_EQ(read(1, 3, "\xA0"s), (std::vector{255, 0, 255}));
  EXPECT_EQ(read(2, 4, "\x1B"s), (std::vector{0, 85, 170, 255}));
  EXPECT_EQ(read(4, 3, "\x0F\x10"s), (std::vector{0, 255, 17}));
  EXPECT_EQ(read(8, 3, "\x00\x01\xFF"s), (std::vector{0, 1, 255}));
}

TEST(Png, WidePixelsKeepAll16Bits) {
  const auto frame =
      decoded(png_file({.width = 3, .bits = 16, .rows = "\0\x01\x02\xFF\xFE\x00\x07"s}));
  EXPECT_EQ(pixels_of(frame), (std::vector{0x0102, 0xFFFE, 7}));
  EXPECT_EQ(frame->bits, 16);
}

TEST(Png, FiltersAreUndone) {
  // Sub, then up, then Paeth.
  const auto frame = decoded(
      png_file({.width = 2, .height = 3, .rows = "\1\x05\x02"s + "\2\x01\x01"s + "\4\x02\x01"s}));
  EXPECT_EQ(pixels_of(frame), (std::vector{5, 7, 6, 8, 8, 9}));
}

TEST(Png, ColourWithoutColourIsGrey) {
  EXPECT_EQ(pixels_of(decoded(png_file(
                {.width = 2, .colour = PngColour::kRgb, .rows = "\0\x05\x05\x05\x09\x09\x09"s}))),
            (std::vector{5, 9}));
  EXPECT_EQ(pixels_of(decoded(png_file({.bits = 16,
                                        .colour = PngColour::kRgba,
                                        .rows = "\0\x01\x02\x01\x02\x01\x02\x00\x00"s}))),
            std::vector{0x0102});
  EXPECT_EQ(pixels_of(decoded(png_file(
                {.width = 2, .colour = PngColour::kGreyAlpha, .rows = "\0\x05\x00\x09\xFF"s}))),
            (std::vector{5, 9}));
  const PngParts palette{.width = 3,
                         .bits = 2,
                         .colour = PngColour::kPalette,
                         .before_pixels = png_chunk("PLTE", "\x0A\x0A\x0A\x14\x14\x14\x1E\x1E\x1E"),
                         .rows = "\0\x24"s};
  EXPECT_EQ(pixels_of(decoded(png_file(palette))), (std::vector{10, 30, 20}));
}

TEST(Png, ColourIsRefused) {
  const std::string refusal = "file: a colour picture; frames have a single channel (grey)";
  EXPECT_EQ(error_of(decoded(png_file({.colour = PngColour::kRgb, .rows = "\0\x05\x05\x06"s}))),
            refusal);
  EXPECT_EQ(error_of(decoded(png_file(
                {.bits = 16, .colour = PngColour::kRgb, .rows = "\0\x01\x02\x01\x03\x01\x02"s}))),
            refusal);
  EXPECT_EQ(error_of(decoded(png_file({.bits = 1,
                                       .colour = PngColour::kPalette,
                                       .before_pixels = png_chunk("PLTE", "\x0A\x0B\x0A"),
                                       .rows = "\0\x00"s}))),
            refusal);
}

// A pass of Adam7: where it starts and how far its pixels are apart.
struct Pass {
  int x0, y0, dx, dy;
};
constexpr std::array<Pass, 7> kAdam7 = {{{0, 0, 8, 8},
                                         {4, 0, 8, 8},
                                         {0, 4, 4, 8},
                                         {2, 0, 4, 4},
                                         {0, 2, 2, 4},
                                         {1, 0, 2, 2},
                                         {0, 1, 1, 2}}};

TEST(Png, InterlacedIsReadLikePlain) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {8, 8}, {13, 9}}) {
    std::vector<int> expected;
    for (int i = 0; i < width * height; ++i) {
      expected.push_back(i * 557 % 65536);
    }
    std::string rows;
    for (const Pass& pass : kAdam7) {
      for (int y = pass.y0; y < height && pass.x0 < width; y += pass.dy) {
        rows += '\0';
        for (int x = pass.x0; x < width; x += pass.dx) {
          rows += test::number(
              static_cast<unsigned>(expected[static_cast<std::size_t>(y * width + x)]), 2, true);
        }
      }
    }
    EXPECT_EQ(pixels_of(decoded(png_file({.width = static_cast<std::uint32_t>(width),
                                          .height = static_cast<std::uint32_t>(height),
                                          .bits = 16,
                                          .interlaced = true,
                                          .rows = rows}))),
              expected);
  }
}

TEST(Png, SkipsTextsButTestsTheirChecksums) {
  PngParts parts{.before_pixels = png_chunk("tEXt", "Title\0a picture"s), .rows = "\0\x05"s};
  EXPECT_EQ(pixels_of(decoded(png_file(parts))), std::vector{5});
  parts.before_pixels[10] ^= 1;
  EXPECT_TRUE(error_of(decoded(png_file(parts))).starts_with("file: damaged PNG: "));
}

TEST(Png, RefusesTextsThatWouldFillMemory) {
  const auto with = [](const std::string& chunks) {
    return decoded(png_file({.before_pixels = chunks, .rows = "\0\x05"s}));
  };
  const std::string refusal =
      "file: damaged PNG: more than 1000 texts, or 16 MiB of texts and profiles";
  const std::string small = png_chunk("tEXt", "Title\0text"s);
  std::string many;
  for (int i = 0; i < 1000; ++i) {
    many += small;
  }
  EXPECT_EQ(pixels_of(with(many)), std::vector{5});
  EXPECT_EQ(error_of(with(many + small)), refusal);
  const std::string large = "Title\0"s + std::string(std::size_t{16} << 20, 'x');
  EXPECT_EQ(error_of(with(png_chunk("tEXt", large))), refusal);
}

TEST(Png, IgnoresWhatFollowsButMissesTheEnd) {
  const std::string file = png_file({.rows = "\0\x05"s});
  EXPECT_EQ(pixels_of(decoded(file + "more")), std::vector{5});
  EXPECT_EQ(error_of(decoded(file.substr(0, file.size() - 12))),
            "file: damaged PNG: the file ends early");
}

TEST(Png, AbsurdSizesAreErrors) {
  const auto sized = [](std::uint32_t width, std::uint32_t height) {
    return error_of(decoded(png_file({.width = width, .height = height, .rows = "\0\x05"s})));
  };
  EXPECT_TRUE(sized(0, 1).starts_with("file: damaged PNG: ")) << sized(0, 1);
  EXPECT_TRUE(sized(0x80000000, 1).starts_with("file: damaged PNG: ")) << sized(0x80000000, 1);
  EXPECT_EQ(sized(0x7FFFFFFF, 0x7FFFFFFF),
            "file: 2147483647x2147483647 is larger than 16384 pixels a side");
  EXPECT_EQ(sized(16384, 16384), "file: the file is too short for 16384x16384 pixels");
}

TEST(Png, HasASinglePage) {
  EXPECT_EQ(error_of(decoded(png_file({.rows = "\0\x05"s}), 1)),
            "file: has no page 1 (the first is 0)");
}

}  // namespace
}  // namespace thermedge::io
