// Samples that are no 16-bit counts: floats, signed and wide whole numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "support/decoding.hpp"
#include "support/encoded_pictures.hpp"

namespace thermedge::io {
namespace {

using test::decoded;
using test::error_of;
using test::number;
using test::pixels_of;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

template <class Bits, class T>
std::string bytes_of(const std::vector<T>& values, bool big_endian) {
  std::string text;
  for (const T value : values) {
    Bits bits = 0;
    static_assert(sizeof(bits) == sizeof(value));
    std::memcpy(&bits, &value, sizeof(bits));
    text += number(bits, sizeof(bits), big_endian);
  }
  return text;
}

std::string npy(const std::string& type, const std::string& data, std::size_t width) {
  return test::npy_file("{'descr': '" + type + "', 'fortran_order': False, 'shape': (1, " +
                            std::to_string(width) + "), }\n",
                        data);
}

std::string tiff(int kind, int bits, const std::string& data, std::size_t width, bool big_endian) {
  test::TiffWriter writer(big_endian, false);
  test::TiffPage page;
  page.tags = {{test::kWidth, width},
               {test::kHeight, 1},
               {test::kBits, static_cast<std::uint64_t>(bits)},
               {test::kPhotometric, 1},
               {test::kChannels, 1},
               {test::kCompression, 1},
               {test::kSampleFormat, static_cast<std::uint64_t>(kind)}};
  page.parts = {data};
  writer.add_page(page);
  return writer.file();
}

constexpr int kSigned = 2;
constexpr int kFloat = 3;

std::vector<float> values_of(const Result<SourceFrame>& frame) {
  if (!frame) {
    ADD_FAILURE() << frame.error().message;
    return {};
  }
  EXPECT_EQ(frame->values.height(), frame->is_float() ? 1 : 0);
  return frame->is_float() ? std::vector<float>(frame->values.row(0),
                                                frame->values.row(0) + frame->values.width())
                           : std::vector<float>{};
}

TEST(FloatFrames, KeepTheirValues) {
  const std::vector<float> degc = {20.125F, -3.7F, 451.25F};
  const std::vector<double> wide(degc.begin(), degc.end());
  for (const bool big : {false, true}) {
    const std::string order = big ? ">" : "<";
    EXPECT_EQ(values_of(decoded(npy(order + "f4", bytes_of<std::uint32_t>(degc, big), 3))), degc);
    EXPECT_EQ(values_of(decoded(npy(order + "f8", bytes_of<std::uint64_t>(wide, big), 3))), degc);
    EXPECT_EQ(values_of(decoded(tiff(kFloat, 32, bytes_of<std::uint32_t>(degc, big), 3, big))),
              degc);
    EXPECT_EQ(values_of(decoded(tiff(kFloat, 64, bytes_of<std::uint64_t>(wide, big), 3, big))),
              degc);
  }
}

// 1, -2, 65504 (the largest), 2^-24 (the least), 1/3 as nearly as it goes.
TEST(FloatFrames, MayHaveHalfTheBits) {
  const std::vector<std::uint16_t> halves = {0x3c00, 0xc000, 0x7bff, 0x0001, 0x3555};
  const std::vector<float> wanted = {1, -2, 65504, std::ldexp(1.0F, -24), 0.333251953125F};
  for (const bool big : {false, true}) {
    const std::string data = bytes_of<std::uint16_t>(halves, big);
    EXPECT_EQ(values_of(decoded(npy(big ? ">f2" : "<f2", data, 5))), wanted);
    EXPECT_EQ(values_of(decoded(tiff(kFloat, 16, data, 5, big))), wanted);
  }
}

TEST(FloatFrames, WithoutNumbersAreInvalidThere) {
  const float infinite = std::numeric_limits<float>::infinity();
  const std::vector<float> values = {1.5F, kNan, 2.5F, -infinite};
  const auto frame = decoded(npy("<f4", bytes_of<std::uint32_t>(values, false), 4));
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->valid.width(), 4);
  EXPECT_EQ(std::vector<int>(frame->valid.row(0), frame->valid.row(0) + 4),
            (std::vector{1, 0, 1, 0}));
  const std::vector<std::uint16_t> halves = {0x7e00, 0x7c00, 0x3c00};
  const auto half = decoded(npy("<f2", bytes_of<std::uint16_t>(halves, false), 3));
  ASSERT_TRUE(half);
  EXPECT_EQ(std::vector<int>(half->valid.row(0), half->valid.row(0) + 3), (std::vector{0, 0, 1}));
  const auto whole = decoded(npy("<f4", bytes_of<std::uint32_t>(std::vector<float>{1}, false), 1));
  EXPECT_TRUE(whole->valid.empty());
}

TEST(FloatFrames, HaveCountsThatStandForThem) {
  const std::vector<float> values = {20.5F, 21, 22.25F};
  const auto frame = decoded(npy("<f4", bytes_of<std::uint32_t>(values, false), 3));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->bits, 16);
  for (int x = 0; x < 3; ++x) {
    EXPECT_NEAR(frame->scale.to_value(frame->counts(x, 0)),
                static_cast<double>(values[static_cast<std::size_t>(x)]), 1e-4);
  }
}

TEST(WholeNumbers, AreCountsWhereTheyFit) {
  const std::vector<std::int16_t> narrow = {0, 300, 32767};
  const std::vector<std::int32_t> wide = {0, 300, 65535};
  const std::vector<std::int64_t> wider = {0, 300, 65535};
  for (const bool big : {false, true}) {
    const std::string order = big ? ">" : "<";
    EXPECT_EQ(pixels_of(decoded(npy(order + "i2", bytes_of<std::uint16_t>(narrow, big), 3))),
              (std::vector{0, 300, 32767}));
    for (const auto& frame :
         {decoded(npy(order + "i4", bytes_of<std::uint32_t>(wide, big), 3)),
          decoded(npy(order + "u4", bytes_of<std::uint32_t>(wide, big), 3)),
          decoded(npy(order + "i8", bytes_of<std::uint64_t>(wider, big), 3)),
          decoded(npy(order + "u8", bytes_of<std::uint64_t>(wider, big), 3)),
          decoded(tiff(kSigned, 32, bytes_of<std::uint32_t>(wide, big), 3, big)),
          decoded(tiff(1, 32, bytes_of<std::uint32_t>(wide, big), 3, big))}) {
      EXPECT_EQ(pixels_of(frame), (std::vector{0, 300, 65535}));
      EXPECT_FALSE(frame->is_float());
      EXPECT_EQ(frame->bits, 16);
    }
  }
}

TEST(WholeNumbers, AreFloatsWhereTheyDoNot) {
  const std::vector<std::int16_t> negative = {-40, 300, 32767};
  const std::vector<std::int8_t> small = {-1, 2, 127};
  const std::vector<std::int32_t> large = {0, 65536, 16777216};
  const std::vector<float> wanted = {-40, 300, 32767};
  for (const bool big : {false, true}) {
    const std::string data = bytes_of<std::uint16_t>(negative, big);
    EXPECT_EQ(values_of(decoded(npy(big ? ">i2" : "<i2", data, 3))), wanted);
    EXPECT_EQ(values_of(decoded(tiff(kSigned, 16, data, 3, big))), wanted);
    EXPECT_EQ(values_of(decoded(tiff(1, 32, bytes_of<std::uint32_t>(large, big), 3, big))),
              (std::vector<float>{0, 65536, 16777216}));
  }
  EXPECT_EQ(values_of(decoded(npy("|i1", bytes_of<std::uint8_t>(small, false), 3))),
            (std::vector<float>{-1, 2, 127}));
}

TEST(WholeNumbers, TooLargeForAFloatAreRefused) {
  const std::vector<std::int32_t> large = {0, 16777217};
  const std::vector<std::int32_t> low = {0, -16777217};
  const std::string message =
      "file: whole numbers of 32 bits beyond 16777216; up to there they are read as they are";
  EXPECT_EQ(error_of(decoded(npy("<i4", bytes_of<std::uint32_t>(large, false), 2))), message);
  EXPECT_EQ(error_of(decoded(npy("<i4", bytes_of<std::uint32_t>(low, false), 2))), message);
}

}  // namespace
}  // namespace thermedge::io
