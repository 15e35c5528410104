// TIFF in every byte order, layout and compression, put together by hand.
#include <gtest/gtest.h>

#include <array>
#include <tuple>

#include "support/decoding.hpp"
#include "support/encoded_pictures.hpp"

namespace thermedge::io {
namespace {

using namespace std::string_literals;
using test::decoded;
using test::error_of;
using test::pixels_of;
using test::TiffPage;
using test::TiffWriter;

constexpr int kWidth = 19;
constexpr int kHeight = 21;
constexpr int kNone = 1;
constexpr int kLzw = 5;
constexpr int kDeflate = 8;
constexpr int kBlackIsZero = 1;

int value_at(int x, int y, int bits) { return (x * 977 + y * 3331 + 65000) % (1 << bits); }

std::vector<int> all_values(int bits) {
  std::vector<int> values;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      values.push_back(value_at(x, y, bits));
    }
  }
  return values;
}

struct Layout {
  int bits = 16;
  bool big_endian = false;
  int compression = kNone;
  bool predicted = false;  // differences along the row
};

// A part of the picture, rows of `width` pixels; what lies outside the picture is 0.
std::string part(const Layout& layout, int x0, int y0, int width, int height) {
  std::string data;
  for (int y = y0; y < y0 + height; ++y) {
    int before = 0;
    for (int x = x0; x < x0 + width; ++x) {
      const int value = x < kWidth && y < kHeight ? value_at(x, y, layout.bits) : 0;
      const int stored = layout.predicted ? value - before : value;
      data += test::number(static_cast<unsigned>(stored), layout.bits / 8, layout.big_endian);
      before = value;
    }
  }
  return layout.compression == kLzw       ? test::literal_lzw(data)
         : layout.compression == kDeflate ? test::stored_zlib(data)
                                          : data;
}

TiffPage empty_page(const Layout& layout) {
  TiffPage page;
  page.tags = {{test::kWidth, kWidth},
               {test::kHeight, kHeight},
               {test::kBits, layout.bits},
               {test::kCompression, layout.compression},
               {test::kPhotometric, kBlackIsZero},
               {test::kChannels, 1},
               {test::kPredictor, layout.predicted ? 2 : 1}};
  return page;
}

TiffPage strips(const Layout& layout, int rows) {
  TiffPage page = empty_page(layout);
  page.tags.emplace_back(test::kRowsPerStrip, rows);
  for (int y = 0; y < kHeight; y += rows) {
    page.parts.push_back(part(layout, 0, y, kWidth, std::min(rows, kHeight - y)));
  }
  return page;
}

TiffPage tiles(const Layout& layout) {
  constexpr int kSide = 16;
  TiffPage page = empty_page(layout);
  page.tiled = true;
  page.tags.emplace_back(test::kTileWidth, kSide);
  page.tags.emplace_back(test::kTileHeight, kSide);
  for (int y = 0; y < kHeight; y += kSide) {
    for (int x = 0; x < kWidth; x += kSide) {
      page.parts.push_back(part(layout, x, y, kSide, kSide));
    }
  }
  return page;
}

std::string file_of(const std::vector<TiffPage>& pages, bool big_endian = false,
                    bool big_tiff = false) {
  TiffWriter writer(big_endian, big_tiff);
  for (const TiffPage& page : pages) {
    writer.add_page(page);
  }
  return writer.file();
}

struct Packing {
  int compression = kNone;
  bool predicted = false;
};
using Variant = std::tuple<int, bool, Packing, bool>;
class EveryTiff : public testing::TestWithParam<Variant> {};

TEST_P(EveryTiff, IsRead) {
  const auto& [bits, big_endian, packing, big_tiff] = GetParam();
  const Layout layout{bits, big_endian, packing.compression, packing.predicted};
  for (const TiffPage& page :
       {strips(layout, 1), strips(layout, 8), strips(layout, kHeight), tiles(layout)}) {
    const auto frame = decoded(file_of({page}, big_endian, big_tiff));
    EXPECT_EQ(pixels_of(frame), all_values(bits));
    EXPECT_EQ(frame->bits, bits);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryTiff,
                         testing::Combine(testing::Values(8, 16), testing::Bool(),
                                          testing::Values(Packing{kNone}, Packing{kLzw},
                                                          Packing{kLzw, true}, Packing{kDeflate},
                                                          Packing{kDeflate, true}),
                                          testing::Bool()));

// `page` with another value, or with one more tag.
TiffPage with(TiffPage page, std::uint16_t tag, std::uint64_t value) {
  for (auto& [known, old] : page.tags) {
    if (known == tag) {
      old = value;
      return page;
    }
  }
  page.tags.emplace_back(tag, value);
  return page;
}

TEST(Tiff, WhiteMayBeZero) {
  const auto frame = decoded(file_of({with(strips({8}, 5), test::kPhotometric, 0)}));
  std::vector<int> expected = all_values(8);
  for (int& value : expected) {
    value = 255 - value;
  }
  EXPECT_EQ(pixels_of(frame), expected);
}

TEST(Tiff, SaysWhatItRefuses) {
  const auto refusal = [](std::uint16_t tag, std::uint64_t value) {
    return error_of(decoded(file_of({with(strips({8}, kHeight), tag, value)})));
  };
  EXPECT_EQ(refusal(test::kPhotometric, 2),
            "file: a colour picture; frames have a single channel (grey)");
  EXPECT_EQ(refusal(test::kChannels, 2),
            "file: a TIFF page of 2 channels; frames have a single one (grey)");
  EXPECT_EQ(
      refusal(test::kBits, 12),
      "file: a TIFF page of 12 bits; frames are whole numbers of 8, 16 or 32 bits or floats of "
      "16, 32 or 64");
  EXPECT_TRUE(
      refusal(test::kSampleFormat, 3).starts_with("file: a TIFF page of 8 bits; frames are"));
  EXPECT_EQ(refusal(test::kCompression, 7),
            "file: a TIFF page with compression 7; none, LZW, deflate and PackBits are read");
}

TEST(Tiff, PagesMayDiffer) {
  const std::string file =
      file_of({strips({16}, 4), strips({8, false, kLzw}, 7), tiles({16, false, kDeflate, true})});
  const auto pages = count_pages(std::as_bytes(std::span(file)), "file", {});
  ASSERT_TRUE(pages) << pages.error().message;
  EXPECT_EQ(*pages, 3U);
  EXPECT_EQ(pixels_of(decoded(file, 0)), all_values(16));
  EXPECT_EQ(pixels_of(decoded(file, 1)), all_values(8));
  EXPECT_EQ(pixels_of(decoded(file, 2)), all_values(16));
  EXPECT_EQ(error_of(decoded(file, 3)), "file: has no page 3 (the first is 0)");
}

TEST(Tiff, ACutRecordingStillHasItsFirstPages) {
  const std::string file = file_of({strips({16}, 4), strips({16}, 4)});
  const std::string first = file_of({strips({16}, 4)});
  for (const std::size_t length : {first.size(), first.size() + 50, file.size() - 60}) {
    const std::string cut = file.substr(0, length);
    const auto pages = count_pages(std::as_bytes(std::span(cut)), "file", {});
    ASSERT_TRUE(pages) << pages.error().message;
    ASSERT_GE(*pages, 2U);
    EXPECT_EQ(pixels_of(decoded(cut, 0)), all_values(16));
    EXPECT_TRUE(error_of(decoded(cut, 1)).starts_with("file: damaged TIFF: "));
  }
  EXPECT_EQ(error_of(decoded(first.substr(0, 6))),
            "file: damaged TIFF: page 0 lies past the end of the file");
}

TEST(Tiff, ACircleOfPagesIsAnError) {
  constexpr std::size_t kNoPages = 0;
  for (const bool big_tiff : {false, true}) {
    TiffWriter writer(false, big_tiff);
    writer.add_page(strips({8}, kHeight));
    const auto first_directory =
        writer.file().size() - (big_tiff ? 8 + 10 * 20 + 8 : 2 + 10 * 12 + 4);
    writer.add_page(strips({8}, kHeight));
    writer.add_page(strips({8}, kHeight));
    writer.link_to(first_directory);
    const auto pages = count_pages(std::as_bytes(std::span(writer.file())), "file", {});
    EXPECT_EQ(pages.value_or(kNoPages), kNoPages);
    EXPECT_EQ(pages.error().message, "file: damaged TIFF: its pages follow each other in a circle");
    EXPECT_EQ(error_of(decoded(writer.file(), 1'000'000)), pages.error().message);
  }
}

TEST(Tiff, AbsurdHeadersAreErrors) {
  const TiffPage page = strips({8}, kHeight);
  const auto error_with = [&](std::uint16_t tag, std::uint64_t value) {
    return error_of(decoded(file_of({with(page, tag, value)})));
  };
  EXPECT_EQ(error_with(test::kWidth, 0x7FFFFFFF),
            "file: 2147483647x21 is larger than 16384 pixels a side");
  EXPECT_EQ(error_with(test::kHeight, 0xFFFFFFFF),
            "file: damaged TIFF: Cannot handle zero number of strips");
  for (const auto& [tag, value] : {std::pair{test::kWidth, 0U},
                                   {test::kHeight, 0U},
                                   {test::kWidth, 16384U},
                                   {test::kHeight, 16384U},
                                   {test::kBits, 0U}}) {
    EXPECT_TRUE(error_with(tag, value).starts_with("file: ")) << error_with(tag, value);
  }
  const TiffPage many_strips = with(with(page, test::kRowsPerStrip, 1), test::kHeight, 16000);
  EXPECT_TRUE(error_of(decoded(file_of({many_strips}))).starts_with("file: damaged TIFF: "));
  for (const std::uint32_t side : {0U, 7U, 0x10000U, 0xFFFFFFF0U}) {
    const TiffPage tiled = with(with(tiles({8}), test::kTileWidth, side), test::kTileHeight, side);
    const std::string error = error_of(decoded(file_of({tiled})));
    EXPECT_TRUE(error.starts_with("file: damaged TIFF: ")) << error;
  }
}

TEST(Tiff, NoPagesIsAnError) {
  EXPECT_EQ(error_of(decoded(TiffWriter(false, false).file())),
            "file: damaged TIFF: it has no pages");
  EXPECT_FALSE(count_pages(std::as_bytes(std::span(TiffWriter(true, true).file())), "file", {}));
}

}  // namespace
}  // namespace thermedge::io
