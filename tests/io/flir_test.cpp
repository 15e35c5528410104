// FLIR's files: raw pictures of every kind, where records lie, and what the camera says of itself.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "support/decoding.hpp"
#include "support/files.hpp"
#include "support/flir_files.hpp"
#include "support/images.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::io {
namespace {

using test::decoded;
using test::error_of;
using test::fff_file;
using test::flir_camera_record;
using test::flir_raw_record;
using test::kFlirCamera;
using test::kFlirRaw;
using test::number;
using test::pixels_of;

const std::vector<int> kSmooth = {0x3010, 0x3012, 0x3020, 0x3041, 0x3033, 0x3050};

std::string samples(const std::vector<int>& values, bool big_endian) {
  std::string text;
  for (const int value : values) {
    text += number(static_cast<std::uint64_t>(value), 2, big_endian);
  }
  return text;
}

// Rows of three pixels.
std::string png(const std::vector<int>& values, bool big_endian) {
  std::string rows;
  for (std::size_t i = 0; i < values.size(); i += 3) {
    rows += '\0' + samples({values[i], values[i + 1], values[i + 2]}, big_endian);
  }
  return test::png_file({.width = 3,
                         .height = static_cast<std::uint32_t>(values.size() / 3),
                         .bits = 16,
                         .rows = rows});
}

TEST(Fff, HoldsSamplesOfBothByteOrders) {
  for (const bool header : {false, true}) {
    for (const bool record : {false, true}) {
      const std::string file =
          fff_file({{kFlirRaw, flir_raw_record(3, 2, samples(kSmooth, record), record)}}, header);
      const auto frame = decoded(file);
      EXPECT_EQ(pixels_of(frame), kSmooth) << header << record;
      EXPECT_EQ(frame->width(), 3);
      EXPECT_EQ(frame->bits, 16);
      EXPECT_FALSE(frame->counts_model.has_value());
    }
  }
}

TEST(Fff, PutsTheBytesOfAPngRight) {
  for (const bool big_endian : {false, true}) {
    const std::string file =
        fff_file({{kFlirRaw, flir_raw_record(3, 2, png(kSmooth, big_endian))}});
    EXPECT_EQ(pixels_of(decoded(file)), kSmooth) << "the order in which it is smooth";
  }
}

TEST(Fff, HoldsATiff) {
  test::TiffWriter tiff(false, false);
  test::TiffPage page;
  page.tags = {{test::kWidth, 3},       {test::kHeight, 2},   {test::kBits, 16},
               {test::kPhotometric, 1}, {test::kChannels, 1}, {test::kCompression, 1}};
  page.parts = {samples(kSmooth, false)};
  tiff.add_page(page);
  EXPECT_EQ(pixels_of(decoded(fff_file({{kFlirRaw, flir_raw_record(3, 2, tiff.file())}}))),
            kSmooth);
}

TEST(Fff, PassesOtherAndUnusedRecordsOver) {
  EXPECT_EQ(
      pixels_of(decoded(fff_file({{0, ""},
                                  {0x0e, "another picture"},
                                  {kFlirRaw, flir_raw_record(3, 2, samples(kSmooth, false))},
                                  {kFlirRaw, flir_raw_record(3, 2, samples(kSmooth, true))}}))),
      kSmooth)
      << "the first raw picture";
}

TEST(Fff, KnowsItsTemperaturesAndItsTime) {
  test::FlirCameraValues values;
  values.emissivity = 0.9F;
  values.reflected_k = 300;
  values.seconds = 1500000000;
  values.ms = 0x12340000 | 250;
  for (const bool big_endian : {false, true}) {
    const auto frame =
        decoded(fff_file({{kFlirCamera, flir_camera_record(values, big_endian)},
                          {kFlirRaw, flir_raw_record(3, 2, samples(kSmooth, false))}}));
    ASSERT_TRUE(frame && frame->counts_model.has_value());
    EXPECT_EQ(frame->stamp_ns, 1500000000250000000);
    // Counts of an object of 350 K, of which the camera sees 9 tenths, and 1 tenth of 300 K.
    const auto counts = [&](double kelvin) {
      return 16000.0 / (static_cast<double>(values.r2) * (std::exp(1420 / kelvin) - 1)) + 5000;
    };
    const double seen = 0.9 * counts(350) + 0.1 * counts(300);
    EXPECT_NEAR(frame->counts_model->to_degc(seen), 350 - 273.15, 1e-4);
  }
}

TEST(Fff, WithoutSensibleConstantsHasNoTemperatures) {
  test::FlirCameraValues values;
  values.r1 = std::nanf("");
  const auto frame =
      decoded(fff_file({{kFlirCamera, flir_camera_record(values)},
                        {kFlirRaw, flir_raw_record(3, 2, samples(kSmooth, false))}}));
  ASSERT_TRUE(frame);
  EXPECT_FALSE(frame->counts_model.has_value());
}

TEST(Fff, SaysWhatIsWrong) {
  const std::string raw = flir_raw_record(3, 2, samples(kSmooth, false));
  const std::string good = fff_file({{kFlirRaw, raw}});
  EXPECT_EQ(error_of(decoded(good.substr(0, good.size() - 1))),
            "file: damaged FLIR file: record 0 lies past the end of the file");
  EXPECT_EQ(error_of(decoded(fff_file({{kFlirCamera, flir_camera_record({})}}))),
            "file: damaged FLIR file: it has no record of a raw picture");
  EXPECT_EQ(error_of(decoded(fff_file({{kFlirRaw, raw.substr(0, raw.size() - 1)}}))),
            "file: damaged FLIR file: the record of its raw picture ends early");
  EXPECT_EQ(error_of(decoded(fff_file({{kFlirRaw, flir_raw_record(0, 2, "xx")}}))),
            "file: the picture has no pixels (0x2)");
  EXPECT_TRUE(error_of(decoded(fff_file({{kFlirRaw, flir_raw_record(3, 2, "\xff\xd8\xff\xf7")}})))
                  .starts_with("file: a FLIR recording with compressed pictures (JPEG-LS"));
  std::string many = good;
  many.replace(0x1c, 4, number(0x07FFFFFF, 4, false));
  EXPECT_EQ(error_of(decoded(many)),
            "file: damaged FLIR file: its list of records lies past the end of the file");
}

TEST(Seq, IsFffAfterFff) {
  std::vector<int> other = kSmooth;
  other[0] = 7;
  const std::string first = fff_file({{kFlirRaw, flir_raw_record(3, 2, samples(kSmooth, false))}});
  const std::string second = fff_file({{kFlirRaw, flir_raw_record(3, 2, samples(other, false))}});
  const std::string file = first + second + std::string(5, '\0') + first;
  EXPECT_EQ(count_pages(std::as_bytes(std::span(file)), "file", {}), 3U);
  EXPECT_EQ(pixels_of(decoded(file, 1)), other);
  EXPECT_EQ(pixels_of(decoded(file, 2)), kSmooth) << "after bytes that belong to no record";

  const std::string padded = first + std::string(9, '\0');
  EXPECT_EQ(count_pages(std::as_bytes(std::span(padded)), "file", {}), 1U);
  EXPECT_EQ(error_of(decoded(first + "FF", 1)), "file: 2 bytes are left over after the picture");
  const std::string cut = file.substr(0, file.size() - 1);
  EXPECT_EQ(count_pages(std::as_bytes(std::span(cut)), "file", {}), 3U);
  EXPECT_EQ(pixels_of(decoded(cut, 1)), other);
  EXPECT_EQ(error_of(decoded(cut, 2)),
            "file: damaged FLIR file: record 0 lies past the end of the file");
}

TEST(FlirJpeg, IsPutTogetherFromItsSegments) {
  const std::string fff = fff_file({{kFlirCamera, flir_camera_record({})},
                                    {kFlirRaw, flir_raw_record(3, 2, png(kSmooth, false))}},
                                   true);
  for (const std::size_t part_bytes : {60000U, 500U, 100U}) {
    const auto frame = decoded(test::flir_jpeg(fff, part_bytes));
    EXPECT_EQ(pixels_of(frame), kSmooth) << part_bytes;
    EXPECT_TRUE(frame->counts_model.has_value());
  }
}

TEST(FlirJpeg, WithAPartMissingIsAnError) {
  const std::string fff = fff_file({{kFlirRaw, flir_raw_record(3, 2, samples(kSmooth, false))}});
  std::string file = test::flir_jpeg(fff, 60);
  const std::size_t second = file.find(std::string("FLIR\0\1\1", 7));
  ASSERT_NE(second, std::string::npos);
  file.replace(second, 4, "flir");
  EXPECT_EQ(error_of(decoded(file)),
            "file: damaged FLIR JPEG: part 2 of 3 of its raw picture is missing");
}

// Of the pictures in ../shared/data/flir, checked against what other programs read from them: the
// T420 stores raw samples, the handheld camera a PNG with swapped bytes.
TEST(FlirSamples, AreReadDirectly) {
  THERMEDGE_NEEDS_SHARED("data/flir");
  const std::filesystem::path folder = test::shared_directory() / "data/flir";
  const auto fff = read_picture((folder / "frame_000000_le.fff").string());
  ASSERT_TRUE(fff) << fff.error().message;
  EXPECT_EQ(fff->width(), 320);
  EXPECT_EQ(fff->height(), 240);
  EXPECT_EQ(fff->counts(0, 0), 0x470f);
  EXPECT_EQ(fff->stamp_ns, 1724423364092000000);
  ASSERT_TRUE(fff->counts_model.has_value());

  const auto jpeg = read_picture((folder / "flir_example.jpg").string());
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  EXPECT_EQ(jpeg->width(), 240);
  EXPECT_EQ(jpeg->height(), 320);
  ASSERT_TRUE(jpeg->counts_model.has_value());
  // A mug of something hot on a desk in a room.
  const double mug = jpeg->counts_model->to_degc(jpeg->counts(100, 200));
  const double desk = jpeg->counts_model->to_degc(jpeg->counts(20, 20));
  EXPECT_GT(mug, 40);
  EXPECT_LT(mug, 100);
  EXPECT_GT(desk, 15);
  EXPECT_LT(desk, 30);
}

}  // namespace
}  // namespace thermedge::io
