// Parts of frames, and streams with headers.
#include "thermedge/io/crop.hpp"

#include <gtest/gtest.h>

#include "support/decoding.hpp"
#include "support/encoded_pictures.hpp"
#include "support/files.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::io {
namespace {

using test::TemporaryDirectory;
using test::write_text;

std::string error_of(const Result<Crop>& crop) { return crop ? "" : crop.error().message; }

TEST(Crop, IsARectangleOrAHalf) {
  EXPECT_EQ(*parse_crop("all"), Crop{});
  EXPECT_EQ(parse_crop("top-half")->part, Crop::Part::kTopHalf);
  EXPECT_EQ(*parse_crop("1,2,30,40"), (Crop{Crop::Part::kRectangle, {1, 2, 30, 40}}));
  for (const std::string text : {"all", "top-half", "bottom-half", "0,0,160,120"}) {
    EXPECT_EQ(crop_text(*parse_crop(text)), text);
  }
  for (const std::string text : {"", "half", "1,2,3", "1,2,3,4,5", "1,2,3,4x", "-1,0,2,2",
                                 "0,0,0,2", "0,0,2,0", "1 2 3 4", "1,2,3,99999999999"}) {
    EXPECT_EQ(
        error_of(parse_crop(text)),
        "crop " + text + ": should be X,Y,WIDTH,HEIGHT in pixels, top-half, bottom-half or all");
  }
}

TEST(Crop, LiesWithinTheFrame) {
  EXPECT_EQ(*Crop{}.within(7, 5), (Rectangle{0, 0, 7, 5}));
  EXPECT_EQ(*parse_crop("top-half")->within(256, 384), (Rectangle{0, 0, 256, 192}));
  EXPECT_EQ(*parse_crop("bottom-half")->within(256, 384), (Rectangle{0, 192, 256, 192}));
  EXPECT_EQ(*parse_crop("bottom-half")->within(4, 5), (Rectangle{0, 3, 4, 2}));
  EXPECT_FALSE(parse_crop("top-half")->within(4, 1));
  EXPECT_EQ(*parse_crop("0,0,640,512")->within(640, 514), (Rectangle{0, 0, 640, 512}));
  const auto outside = parse_crop("1,0,640,512")->within(640, 514);
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().message,
            "crop 1,0,640,512: 640x512 pixels from (1, 0) do not lie within the frame of 640x514");
  EXPECT_FALSE(parse_crop("0,2147483647,1,1")->within(4, 4));
  EXPECT_FALSE(parse_crop("3,3,2147483647,1")->within(4, 4));
}

// Rows of letters, of each frame, or the error.
std::vector<std::string> rows_of(const std::vector<std::string>& inputs,
                                 const SourceOptions& options) {
  std::vector<std::string> rows;
  const auto source = open_files(inputs, options);
  if (!source) {
    return {source.error().message};
  }
  SourceFrame frame;
  for (;;) {
    const auto more = (*source)->next(frame);
    if (more && !*more) {
      return rows;
    }
    if (!more) {
      rows.push_back(more.error().message);
      continue;
    }
    for (int y = 0; y < frame.counts.height(); ++y) {
      rows.emplace_back();
      for (int x = 0; x < frame.counts.width(); ++x) {
        rows.back() += static_cast<char>(frame.counts(x, y));
      }
    }
  }
}

using Rows = std::vector<std::string>;

TEST(Crop, IsTakenOfEveryFrame) {
  const TemporaryDirectory directory;
  const std::string path = directory / "x.pgm";
  write_text(path, "P5 3 2 255\nabcdefP5 2 2 255\nghijP5 3 3 255\nklmnopqrs");
  SourceOptions options;
  options.crop = *parse_crop("1,0,2,2");
  EXPECT_EQ(
      rows_of({path}, options),
      (Rows{"bc", "ef",
            path + "[1]: crop 1,0,2,2: 2x2 pixels from (1, 0) do not lie within the frame of 2x2",
            "lm", "op"}));
  options.crop = *parse_crop("bottom-half");
  EXPECT_EQ(rows_of({path}, options), (Rows{"def", "ij", "qrs"}));
}

TEST(Crop, TakesValuesAndValidityAlong) {
  const TemporaryDirectory directory;
  const std::string path = directory / "x.npy";
  write_text(path, test::npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 3)}",
                                  test::number(0x3FC00000, 4, false) +       // 1.5
                                      test::number(0x7FC00000, 4, false) +   // NaN
                                      test::number(0x40200000, 4, false)));  // 2.5
  SourceOptions options;
  options.crop = *parse_crop("1,0,2,1");
  const auto source = open_files({path}, options);
  SourceFrame frame;
  ASSERT_EQ((*source)->next(frame), true);
  EXPECT_EQ(frame.width(), 2);
  EXPECT_EQ(frame.values(1, 0), 2.5F);
  EXPECT_EQ(frame.valid(0, 0), 0);
  EXPECT_EQ(frame.valid(1, 0), 1);
}

SourceOptions raw_8bit(int width, int height) {
  SourceOptions options;
  options.raw_width = width;
  options.raw_height = height;
  options.raw_format = RawFormat::kGray8;
  return options;
}

TEST(RawFiles, HaveAnyEndingWhereTheirSizeIsGiven) {
  const TemporaryDirectory directory;
  for (const std::string name : {"1.bin", "2.dat", "3.frames", "4"}) {
    write_text(directory / name, "abcd");
    EXPECT_EQ(rows_of({directory / name}, raw_8bit(2, 2)), (Rows{"ab", "cd"})) << name;
  }
  write_text(directory / "5.bin", "P5 1 1 255\nz");
  EXPECT_EQ(rows_of({directory / "5.bin"}, raw_8bit(2, 2)), (Rows{"z"})) << "a picture is one";
  write_text(directory / "notes.txt", "abcd");
  EXPECT_EQ(rows_of({directory.path().string()}, raw_8bit(4, 1)), (Rows{"abcd", "abcd", "z"}))
      << "of a directory, the usual endings";
  const Rows without = rows_of({directory / "1.bin"}, {});
  ASSERT_EQ(without.size(), 1U);
  EXPECT_NE(without[0].find("frames without a header need --raw-size WxH"), std::string::npos);
}

TEST(RawFiles, MayHaveHeaders) {
  const TemporaryDirectory directory;
  const std::string path = directory / "x.raw";
  SourceOptions options = raw_8bit(2, 1);
  options.raw_header_bytes = 5;
  options.raw_frame_header_bytes = 3;
  write_text(path, "HEADE---ab---cd");
  EXPECT_EQ(rows_of({path}, options), (Rows{"ab", "cd"}));
  const auto source = open_files({path}, options);
  SourceFrame frame;
  ASSERT_EQ((*source)->next(frame), true);
  EXPECT_EQ((*source)->size_hint(), 2U);
  write_text(path, "HEADE---ab---c");
  EXPECT_EQ(
      rows_of({path}, options),
      (Rows{"ab", path + ": 4 bytes are left over after 1 frame of 5 bytes (2x1, 8 bits and a "
                         "header of 3); do --raw-size and --raw-format fit, and is there a "
                         "header (--raw-header, --raw-frame-header)?"}));
  write_text(path, "HEA");
  EXPECT_EQ(rows_of({path}, options),
            (Rows{path + ": ends after 3 bytes, within the header of --raw-header 5"}));
}

TEST(RawFiles, MayHoldFloats) {
  const TemporaryDirectory directory;
  const std::string path = directory / "x.raw";
  SourceOptions options = raw_8bit(1, 1);
  for (const bool big : {false, true}) {
    options.raw_format = big ? RawFormat::kGrayF32Be : RawFormat::kGrayF32Le;
    write_text(path, test::number(0x41A40000, 4, big));
    const auto source = open_files({path}, options);
    SourceFrame frame;
    ASSERT_EQ((*source)->next(frame), true);
    EXPECT_EQ(frame.values(0, 0), 20.5F);
  }
}

TEST(ByteOrder, IsAnsweredForByTheUser) {
  const TemporaryDirectory directory;
  const std::string little("\x10\x20", 2);
  const std::string header = "', 'fortran_order': False, 'shape': (1, 1)}";
  write_text(directory / "1.npy", test::npy_file("{'descr': '<u2" + header, little));
  write_text(directory / "2.npy", test::npy_file("{'descr': '>u2" + header, little));
  write_text(directory / "3.pgm", "P5 1 1 65535\n" + little);
  write_text(
      directory / "4.png",
      test::png_file({.width = 1, .height = 1, .bits = 16, .rows = std::string(1, '\0') + little}));
  test::TiffWriter tiff(false, false);
  test::TiffPage page;
  page.tags = {{test::kWidth, 1},       {test::kHeight, 1},   {test::kBits, 16},
               {test::kPhotometric, 1}, {test::kChannels, 1}, {test::kCompression, 1}};
  page.parts = {little};
  tiff.add_page(page);
  write_text(directory / "5.tif", tiff.file());
  write_text(directory / "6.raw", little);
  const auto counts = [&](SampleOrder order) {
    SourceOptions options;
    options.raw_width = options.raw_height = 1;
    options.byte_order = order;
    std::vector<int> values;
    const auto source = open_files({directory.path().string()}, options);
    SourceFrame frame;
    while ((*source)->next(frame) == true) {
      values.push_back(frame.counts(0, 0));
    }
    return values;
  };
  constexpr int kLittle = 0x2010;
  constexpr int kBig = 0x1020;
  EXPECT_EQ(counts(SampleOrder::kAsFormat),
            (std::vector{kLittle, kBig, kBig, kBig, kLittle, kLittle}));
  EXPECT_EQ(counts(SampleOrder::kSwapped),
            (std::vector{kBig, kLittle, kLittle, kLittle, kBig, kBig}));
  EXPECT_EQ(counts(SampleOrder::kLittle), std::vector(6, kLittle));
  EXPECT_EQ(counts(SampleOrder::kBig), std::vector(6, kBig));
}

}  // namespace
}  // namespace thermedge::io
