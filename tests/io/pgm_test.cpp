// PGM: what is understood of its header and its text, and what is not.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "codecs/codecs.hpp"
#include "support/decoding.hpp"

namespace thermedge::io {
namespace {

using namespace std::string_literals;
using test::decoded;
using test::error_of;
using test::pixels_of;

TEST(PgmHeader, MayBeSpacedAndCommentedAnywhere) {
  for (const std::string& header :
       {"P5 2 1 255\n"s, "P5\t2\v1\f255\r"s, "P5\r\n2\r\n\r\n1\r\n255 "s,
        "P5#2 2\n2#9 9\n1\n255\n"s, "P5 # a\n# b\n#\n   2 #\n 1 # c\n 255 "s,
        "P5\n0002 01\n00255\n"s}) {
    const auto frame = decoded(header + "\x00\x80"s);
    EXPECT_EQ(pixels_of(frame), (std::vector{0, 128})) << header;
    EXPECT_EQ(frame->bits, 8);
  }
}

// A pixel may look like white space or the sign of a comment.
TEST(PgmPixels, BeginBehindOneWhiteSpaceWhateverTheyAre) {
  EXPECT_EQ(pixels_of(decoded("P5 3 1 255\n\n# ")), (std::vector<int>{'\n', '#', ' '}));
  EXPECT_EQ(pixels_of(decoded("P5 1 1 255\r\n")), std::vector<int>{'\n'});
  EXPECT_TRUE(error_of(decoded("P5 1 1 255xy")).starts_with("file: damaged PGM"));
}

TEST(PgmPixels, AreOf16BitsWhereTheMaximumIsAbove255) {
  for (const auto& [largest, bits] : {std::pair{1, 8}, {255, 8}, {256, 16}, {65535, 16}}) {
    const std::string header = "2 2 " + std::to_string(largest) + "\n";
    const auto text = decoded("P2 " + header + "0 1 1 0");
    ASSERT_TRUE(text) << error_of(text);
    EXPECT_EQ(text->bits, bits);
    EXPECT_EQ(pixels_of(text), (std::vector{0, 1, 1, 0}));
    const std::string binary = bits == 8 ? "\0\1\1\0"s : "\0\0\0\1\0\1\0\0"s;
    EXPECT_EQ(pixels_of(decoded("P5 " + header + binary)), (std::vector{0, 1, 1, 0}));
    EXPECT_EQ(error_of(decoded("P5 " + header + binary.substr(1))),
              "file: damaged PGM: the file ends early");
  }
}

TEST(PgmPixels, OfTextMayBeSpacedAndCommentedAnywhere) {
  EXPECT_EQ(pixels_of(decoded("P2 3 2 70\n1 2\t70#8\n\r\n 4# 5\n# 6 6 6\n5\n\n  006 # end")),
            (std::vector{1, 2, 70, 4, 5, 6}));
  EXPECT_EQ(pixels_of(decoded("P2 1 1 9\n9")), std::vector{9});
}

TEST(PgmPixels, OfTextThatAreNoNumbersAreErrors) {
  for (const char* pixels :
       {"1 2 x 4", "1 2 -3 4", "1 2 3     ", "1 2 3 # 4", "1 2 3 4294967296"}) {
    EXPECT_EQ(error_of(decoded("P2 2 2 255\n"s + pixels)),
              "file: damaged PGM: the file ends early, or a pixel is no number")
        << pixels;
  }
  EXPECT_EQ(error_of(decoded("P2 2 2 255\n1 2 3 256")),
            "file: damaged PGM: a pixel is above the maximum of the header");
  EXPECT_EQ(error_of(decoded("P2 2 2 255\n1 2 3 4294967295")),
            "file: damaged PGM: a pixel is above the maximum of the header");
}

TEST(PgmHeader, OfOtherThanThreeNumbersIsAnError) {
  for (const char* header :
       {"P5", "P5 ", "P5 4 4", "P5 4 4 ", "P5 4 x 255\n", "P5 -4 4 255\n", "P5 4 4 0\n",
        "P5 4.0 4 255\n", "P5 4 4 65536\n", "P5 4 4 4294967551\n", "P2 4 4 # 255"}) {
    EXPECT_TRUE(
        error_of(decoded(header + std::string(64, '1')))
            .starts_with(std::string(header) == "P5" ? "file: not a picture" : "file: damaged PGM"))
        << header << ": " << error_of(decoded(header + std::string(64, '1')));
  }
}

TEST(PgmHeader, OfASizeThatTheFileCannotHoldIsRefusedBeforeAllocation) {
  EXPECT_EQ(error_of(decoded("P5 16384 16384 65535\n12")),
            "file: the file is too short for 16384x16384 pixels");
  EXPECT_EQ(error_of(decoded("P5 100 100 255\n12")), "file: damaged PGM: the file ends early");
}

TEST(EncodePgm, WritesWhatTheFormatSays) {
  const std::uint16_t wide[] = {0x0102, 0xFFFE, 7, 0x8000, 0, 9};
  const Samples of_two_rows{
      .data = wide, .row_bytes = 6, .width = 2, .height = 2, .bits = 16, .channels = 1};
  EXPECT_EQ(encode_pgm(of_two_rows), "P5\n2 2\n65535\n\x01\x02\xff\xfe\x80\x00\x00\x00"s);
  const Samples of_bytes{
      .data = "abcd", .row_bytes = 2, .width = 1, .height = 2, .bits = 8, .channels = 1};
  EXPECT_EQ(encode_pgm(of_bytes), "P5\n1 2\n255\nac");
}

TEST(Pgm, TextAndBytesOfOnePictureAreRead) {
  std::mt19937 random(102);
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {13, 1}, {7, 5}}) {
    const std::string size = std::to_string(width) + " " + std::to_string(height) + " 65535\n";
    std::string text = "P2\n" + size;
    std::string binary = "P5\n" + size;
    std::vector<int> expected;
    for (int i = 0; i < width * height; ++i) {
      const int value = static_cast<int>(random() >> (16 + random() % 16));
      expected.push_back(value);
      text += std::to_string(value) + (random() % 4 == 0 ? "\n" : " ");
      binary += static_cast<char>(value >> 8);
      binary += static_cast<char>(value & 0xFF);
    }
    EXPECT_EQ(pixels_of(decoded(text)), expected);
    EXPECT_EQ(pixels_of(decoded(binary)), expected);
    EXPECT_EQ(pixels_of(decoded(binary + "another picture")), expected);
  }
}

}  // namespace
}  // namespace thermedge::io
