// Formats: what is written is read back; what is refused, and how.
#include <gtest/gtest.h>

#include <array>
#include <tuple>

#include "support/files.hpp"
#include "support/images.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::io {
namespace {

using test::same_pixels;
using test::TemporaryDirectory;
using namespace std::string_literals;

Image<std::uint16_t> extremes(int width, int height, int largest) {
  const std::array values = {0, 1, 127, 255, 256, 257, 32768, 65534, 65535};
  Image<std::uint16_t> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y) = static_cast<std::uint16_t>(
          std::min(values[static_cast<std::size_t>(y * 31 + x) % values.size()], largest));
    }
  }
  return image;
}

Image<std::uint8_t> narrowed(const Image<std::uint16_t>& image) {
  Image<std::uint8_t> result(image.width(), image.height());
  copy_pixels(image.view(), result.view());
  return result;
}

class EveryFormat : public testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(EveryFormat, ReadsBackWhatItWrote) {
  const auto& [ending, bits] = GetParam();
  const TemporaryDirectory directory;
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 5}, {3, 200}, {382, 288}}) {
    const std::string path = directory / ("x" + ending);
    const auto image = extremes(width, height, bits == 8 ? 255 : 65535);
    const Status written =
        bits == 8 ? write_picture(path, narrowed(image).view()) : write_picture(path, image.view());
    ASSERT_TRUE(written) << written.error().message;
    const auto frame = read_picture(path);
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(frame->bits, bits);
    EXPECT_EQ(frame->stem, "x");
    EXPECT_TRUE(same_pixels<std::uint16_t>(frame->counts, image));
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryFormat,
                         testing::Combine(testing::Values(".png", ".tif", ".tiff", ".pgm", ".npy"),
                                          testing::Values(8, 16)));

TEST(Kind, IsFoundByContent) {
  const TemporaryDirectory directory;
  const auto image = extremes(9, 4, 65535);
  ASSERT_TRUE(write_picture(directory / "a.png", image.view()));
  std::filesystem::rename(directory / "a.png", directory / "a.tiff");
  const auto frame = read_picture(directory / "a.tiff");
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_TRUE(same_pixels<std::uint16_t>(frame->counts, image));
}

Result<SourceFrame> decoded(const std::string& bytes, std::size_t page = 0) {
  SourceFrame frame;
  return decode_picture(std::as_bytes(std::span(bytes)), "file", {}, page, frame).map([&] {
    return std::move(frame);
  });
}

std::vector<int> pixels(const Result<SourceFrame>& frame) {
  EXPECT_TRUE(frame) << frame.error().message;
  std::vector<int> values;
  for (int y = 0; frame && y < frame->counts.height(); ++y) {
    for (int x = 0; x < frame->counts.width(); ++x) {
      values.push_back(frame->counts(x, y));
    }
  }
  return values;
}

TEST(Pgm, IsBigEndianAndHasComments) {
  EXPECT_EQ(pixels(decoded("P5 # a comment\n2 # two\n1\n65535\n\x01\x02\xff\xfe"s)),
            (std::vector{0x0102, 0xfffe}));
  EXPECT_EQ(pixels(decoded("P5\n2 1\n255\n\x05\xff"s)), (std::vector{5, 255}));
  EXPECT_EQ(pixels(decoded("P2\n3 1\n1000\n0 7\n1000\n")), (std::vector{0, 7, 1000}));
}

TEST(Pgm, OfTextTooShortForItsPixelsIsRefusedBeforeTheyAreRead) {
  const auto frame = decoded("P2\n300 300\n255\n1 2 3");
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().message, "file: damaged PGM: the file ends early");
}

std::string npy(const std::string& type, const std::string& order, const std::string& shape,
                const std::string& data, char version = 1) {
  const std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
  std::string file = "\x93NUMPY"s + version + '\0' + static_cast<char>(header.size()) + '\0';
  return file + (version > 1 ? "\0\0"s : ""s) + header + data;
}

TEST(Npy, KnowsByteAndIndexOrders) {
  EXPECT_EQ(pixels(decoded(npy("<u2", "False", "(1, 2)", "\x01\x02\x03\x04"s))),
            (std::vector{0x0201, 0x0403}));
  EXPECT_EQ(pixels(decoded(npy(">u2", "False", "(1, 2)", "\x01\x02\x03\x04"s, 2))),
            (std::vector{0x0102, 0x0304}));
  EXPECT_EQ(pixels(decoded(npy("|u1", "False", "(2, 3)", "abcdef", 3))),
            (std::vector<int>{'a', 'b', 'c', 'd', 'e', 'f'}));
  EXPECT_EQ(pixels(decoded(npy("|u1", "True", "(2, 3)", "abcdef"))),
            (std::vector<int>{'a', 'c', 'e', 'b', 'd', 'f'}));
}

TEST(Npy, IsAStackWithThreeDimensions) {
  EXPECT_EQ(pixels(decoded(npy("|u1", "False", "(2, 1, 2)", "abcd"), 1)),
            (std::vector<int>{'c', 'd'}));
  EXPECT_EQ(pixels(decoded(npy("|u1", "True", "(2, 1, 2)", "abcd"), 1)),
            (std::vector<int>{'b', 'd'}));
}

// A TIFF by hand: one strip, uncompressed, both byte orders.
std::string tiff(bool big, int photometric, int pages = 1) {
  const auto number = [&](unsigned value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) {
      text += static_cast<char>(value >> 8 * (big ? bytes - 1 - i : i) & 0xFF);
    }
    return text;
  };
  const auto entry = [&](unsigned tag, unsigned value) {
    return number(tag, 2) + number(3, 2) + number(1, 4) + number(value, 2) + "\0\0"s;
  };
  std::string file =
      (big ? "MM"s : "II"s) + number(42, 2) + number(12, 4) + number(0x0102, 2) + number(0xfffe, 2);
  for (int page = 1; page <= pages; ++page) {
    const auto next = static_cast<unsigned>(file.size() + 2 + 9 * 12 + 4);
    file += number(9, 2) + entry(256, 2) + entry(257, 1) + entry(258, 16) + entry(259, 1) +
            entry(262, static_cast<unsigned>(photometric)) + entry(273, 8) + entry(277, 1) +
            entry(278, 1) + entry(279, 4) + number(page < pages ? next : 0, 4);
  }
  return file;
}

TEST(Tiff, HasBothByteOrdersAndBothPolarities) {
  for (const bool big : {false, true}) {
    EXPECT_EQ(pixels(decoded(tiff(big, 1))), (std::vector{0x0102, 0xfffe}));
    EXPECT_EQ(pixels(decoded(tiff(big, 0))), (std::vector{0xfefd, 0x0001}));
  }
}

TEST(Tiff, HasPages) {
  const std::string file = tiff(false, 1, 3);
  const auto pages = count_pages(std::as_bytes(std::span(file)), "file", {});
  ASSERT_TRUE(pages) << pages.error().message;
  EXPECT_EQ(*pages, 3U);
  EXPECT_EQ(pixels(decoded(file, 2)), (std::vector{0x0102, 0xfffe}));
  EXPECT_FALSE(decoded(file, 3));
}

TEST(Png, ColourIsReadWhereItIsGreyAndRefusedWhereNot) {
  const TemporaryDirectory directory;
  Image<Rgb> colour(4, 2);
  fill_pixels(colour.view(), Rgb{9, 9, 9});
  ASSERT_TRUE(write_picture(directory / "x.png", colour.view()));
  EXPECT_EQ(pixels(read_picture(directory / "x.png")), std::vector(8, 9));
  colour(3, 1) = {9, 9, 10};
  ASSERT_TRUE(write_picture(directory / "x.png", colour.view()));
  const auto refused = read_picture(directory / "x.png");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            (directory / "x.png") + ": a colour picture; frames have a single channel (grey)");
}

struct Refused {
  std::string bytes;
  std::string message;
};

TEST(Decoder, SaysWhatItRefuses) {
  for (const Refused& refused : {
           Refused{"", "file: the file is empty"},
           Refused{"hello", "file: not a picture"},
           Refused{"\xff\xd8\xff\xe0", "file: a JPEG picture without raw counts"},
           Refused{"RIFF1234AVI ", "file: an AVI video; pipe it in: ffmpeg -i FILE"},
           Refused{"P5\n0 4\n255\n", "file: the picture has no pixels (0x4)"},
           Refused{"P5\n99999 4\n255\n", "file: 99999x4 is larger than 16384 pixels a side"},
           Refused{"P5\n99999999999 4\n255\n", "file: damaged PGM"},
           Refused{"P5\n4 4\n65536\n", "file: damaged PGM"},
           Refused{"P5\n4 4\n255\n123", "file: damaged PGM: the file ends early"},
           Refused{"P2\n2 1\n255\n1 256", "file: damaged PGM: a pixel is above the maximum"},
           Refused{npy("<c8", "False", "(1, 1)", "12345678"), "file: an NPY of '<c8'; frames are"},
           Refused{npy("|u1", "False", "(4,)", "1234"), "file: an NPY of 1 dimensions"},
           Refused{npy("|u1", "False", "(-1, 4)", "1234"), "file: damaged NPY: its shape"},
           Refused{npy("|u1", "False", "(2, 4)", "1234"), "file: damaged NPY: the file ends early"},
           Refused{npy("|u1", "False", "(4294967296, 4294967296)", ""), "file: 4294967296x"},
           Refused{npy("|u1", "False", "(18446744073709551615, 1, 2)", "1234"),
                   "file: damaged NPY: the file ends early"},
       }) {
    const auto result = decoded(refused.bytes);
    ASSERT_FALSE(result) << refused.message;
    EXPECT_TRUE(result.error().message.starts_with(refused.message)) << result.error().message;
    EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
  }
}

TEST(Limits, AreCheckedBeforeAllocation) {
  Limits tight;
  tight.max_bytes = 100;
  SourceFrame frame;
  const std::string file = "P5\n11 10\n255\n" + std::string(110, 'x');
  const Status status = decode_picture(std::as_bytes(std::span(file)), "file", tight, 0, frame);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kLimitExceeded);
}

TEST(WriteFile, LeavesTheOldFileAndNoOtherOnFailure) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory / "x", "old"));
  ASSERT_TRUE(write_file(directory / "x", "new"));
  EXPECT_EQ(test::file_text(directory / "x"), "new");
  const Status missing = write_file(directory / "nowhere/x", "text");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, (directory / "nowhere/x") +
                                         ": cannot be written: there is no directory " +
                                         (directory / "nowhere"));
  std::filesystem::create_directory(directory / "taken");
  EXPECT_FALSE(write_file(directory / "taken", "text"));
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(directory.path())) {
    ++files;
  }
  EXPECT_EQ(files, 2U) << "x and taken, nothing half-written";
}

TEST(WritePicture, NamesTheEndingsThatItKnows) {
  Image<std::uint8_t> image(2, 2);
  const Status status = write_picture("x.jpg", ImageView<const std::uint8_t>(image.view()));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message,
            "x.jpg: the name should end in .png, .tif, .tiff, .pgm, .npy or .raw");
}

}  // namespace
}  // namespace thermedge::io
