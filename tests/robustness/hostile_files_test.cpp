// Truncated and bit-flipped pictures: an error that names the file, or a picture within the limits;
// never a crash, a hang, a word on standard error, or much more memory than the limits allow.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <random>

#include "support/encoded_pictures.hpp"
#include "support/files.hpp"
#include "support/flir_files.hpp"
#include "support/images.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::io {
namespace {

using namespace std::string_literals;

constexpr Limits kLimits{.max_side_px = 4096, .max_bytes = 1 << 24};

struct Valid {
  std::string name;
  std::string (*make)();
  friend void PrintTo(const Valid& valid, std::ostream* out) { *out << valid.name; }
};

// As this project writes it.
std::string written(const std::string& ending, int bits) {
  const test::TemporaryDirectory directory;
  const std::string path = directory / ("x" + ending);
  const auto wide = test::noise_image<std::uint16_t>(23, 17, 3000, 300, 1);
  const auto narrow = test::noise_image<std::uint8_t>(23, 17, 100, 30, 1);
  EXPECT_TRUE(bits == 16 ? write_picture(path, wide.view()) : write_picture(path, narrow.view()));
  return test::file_text(path);
}

std::string interlaced_palette_png() {
  std::string rows;
  // A picture of 4x4 pixels has passes of 1, 0, 0, 1, 2, 4 and 8 pixels in 1, 0, 0, 1, 1, 2, 2
  // rows.
  for (const int width : {1, 1, 2, 2, 2, 4, 4}) {
    rows += '\0' + std::string(static_cast<std::size_t>(width), '\1');
  }
  return test::png_file({.width = 4,
                         .height = 4,
                         .colour = test::PngColour::kPalette,
                         .interlaced = true,
                         .before_pixels = test::png_chunk("PLTE", "\1\1\1\2\2\2") +
                                          test::png_chunk("tRNS", "\1\2") +
                                          test::png_chunk("tEXt", "Title\0text"s),
                         .rows = rows});
}

// Strips without compression and tiles with LZW, on two pages.
std::string paged_tiff(bool big_endian, bool big_tiff) {
  test::TiffWriter writer(big_endian, big_tiff);
  test::TiffPage page;
  page.tags = {{test::kWidth, 20},      {test::kHeight, 3},   {test::kBits, 8},
               {test::kPhotometric, 1}, {test::kChannels, 1}, {test::kCompression, 1}};
  test::TiffPage strips = page;
  strips.tags.emplace_back(test::kRowsPerStrip, 2);
  strips.parts = {std::string(40, 'a'), std::string(20, 'b')};
  writer.add_page(strips);
  test::TiffPage tiles = page;
  constexpr int kLzw = 5;
  tiles.tags.back() = {test::kCompression, kLzw};
  tiles.tiled = true;
  tiles.tags.emplace_back(test::kTileWidth, 16);
  tiles.tags.emplace_back(test::kTileHeight, 16);
  tiles.parts = {test::literal_lzw(std::string(256, 'c')),
                 test::literal_lzw(std::string(256, 'd'))};
  writer.add_page(tiles);
  return writer.file();
}

std::string samples_of(int width, int height) {
  std::string text;
  for (int i = 0; i < width * height; ++i) {
    text += test::number(static_cast<std::uint64_t>(3000 + i * i), 2, false);
  }
  return text;
}

std::string seq_file() {
  const std::string fff =
      test::fff_file({{test::kFlirCamera, test::flir_camera_record({})},
                      {test::kFlirRaw, test::flir_raw_record(5, 4, samples_of(5, 4))}});
  return fff + fff;
}

std::string flir_jpeg_with_png() {
  std::string rows;
  for (int y = 0; y < 4; ++y) {
    rows += '\0' + samples_of(5, 1);
  }
  const std::string png = test::png_file({.width = 5, .height = 4, .bits = 16, .rows = rows});
  return test::flir_jpeg(test::fff_file({{test::kFlirRaw, test::flir_raw_record(5, 4, png)},
                                         {test::kFlirCamera, test::flir_camera_record({})}},
                                        true),
                         300);
}

// A directory of ImageJ's, whose pictures are counted by its description.
std::string imagej_tiff() {
  const std::string description = "ImageJ=1\nimages=3\n"s + '\0';
  constexpr int kTags = 9;
  const std::size_t text_at = 8 + 2 + 12 * kTags + 4;
  std::string file = "II*\0"s + test::number(8, 4, false) + test::number(kTags, 2, false);
  const auto tag = [&](int name, int type, std::size_t count, std::size_t value) {
    file += test::number(static_cast<std::uint64_t>(name), 2, false) +
            test::number(static_cast<std::uint64_t>(type), 2, false) +
            test::number(count, 4, false) + test::number(value, 4, false);
  };
  tag(test::kWidth, 4, 1, 5);
  tag(test::kHeight, 4, 1, 2);
  tag(test::kBits, 4, 1, 16);
  tag(test::kCompression, 4, 1, 1);
  tag(test::kPhotometric, 4, 1, 1);
  tag(270, 2, description.size(), text_at);
  tag(test::kStripOffsets, 4, 1, text_at + description.size());
  tag(test::kRowsPerStrip, 4, 1, 2);
  tag(test::kStripBytes, 4, 1, 20);
  return file + test::number(0, 4, false) + description + samples_of(5, 6);
}

std::string float_npy() {
  return test::npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': (4, 3), }\n",
                        std::string(48, 'A'));
}

std::string fortran_stack_npy() {
  const std::string header = "{'descr': '>u2', 'fortran_order': True, 'shape': (3, 2, 5), }\n";
  return test::npy_file(header, std::string(60, 'x'), 2);
}

const std::vector<Valid> kValidFiles = {
    {"png16", [] { return written(".png", 16); }},
    {"png8", [] { return written(".png", 8); }},
    {"interlaced_palette_png", interlaced_palette_png},
    {"tiff16", [] { return written(".tif", 16); }},
    {"tiff8", [] { return written(".tif", 8); }},
    {"paged_tiff", [] { return paged_tiff(false, false); }},
    {"paged_big_endian_tiff", [] { return paged_tiff(true, false); }},
    {"paged_big_tiff", [] { return paged_tiff(false, true); }},
    {"pgm16", [] { return written(".pgm", 16); }},
    {"pgm8", [] { return written(".pgm", 8); }},
    {"text_pgm", [] { return "P2 # text\n4 2\n300\n0 1 2 3\n4 5 6 300"s; }},
    {"npy16", [] { return written(".npy", 16); }},
    {"npy8", [] { return written(".npy", 8); }},
    {"fortran_stack_npy", fortran_stack_npy},
    {"float_npy", float_npy},
    {"imagej_tiff", imagej_tiff},
    {"two_pgms", [] { return "P5 2 1 255\nabP5 1 2 65535\nabcd"s; }},
    {"seq", seq_file},
    {"flir_jpeg", flir_jpeg_with_png}};

// Decodes the first pages; the message where that fails.
std::string decode(const std::string& file) {
  const auto bytes = std::as_bytes(std::span(file));
  const auto pages = count_pages(bytes, "hostile", kLimits);
  if (!pages) {
    return pages.error().message;
  }
  io::SourceFrame frame;
  for (std::size_t page = 0; page < std::min<std::size_t>(*pages, 10); ++page) {
    if (const Status status = decode_picture(bytes, "hostile", kLimits, page, frame); !status) {
      return status.error().message;
    }
    EXPECT_LE(frame.counts.width(), kLimits.max_side_px);
    EXPECT_LE(frame.counts.height(), kLimits.max_side_px);
    EXPECT_FALSE(frame.counts.empty());
  }
  return "";
}

void expect_error_line(const std::string& message) {
  EXPECT_TRUE(message.starts_with("hostile: ")) << message;
  for (const char c : message) {
    EXPECT_TRUE(c >= ' ' && c <= '~') << message;
  }
}

long peak_kib() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

class HostileFiles : public testing::TestWithParam<Valid> {
 protected:
  void SetUp() override {
    peak_before_kib_ = peak_kib();
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
  }
  void TearDown() override {
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
#ifndef THERMEDGE_SANITIZED
    // The file unpacked, the frame, and what the decoder needs besides.
    EXPECT_LT(peak_kib() - peak_before_kib_, static_cast<long>(4 * kLimits.max_bytes / 1024));
#endif
  }

 private:
  long peak_before_kib_ = 0;
};

TEST_P(HostileFiles, AreValidBeforehand) { EXPECT_EQ(decode(GetParam().make()), ""); }

TEST_P(HostileFiles, TruncatedAnywhereAreAnError) {
  const std::string file = GetParam().make();
  // A number in text may be cut and still be a number, the end marker of a JPEG tells nothing, and
  // where one picture ends nothing is missing.
  const std::size_t last = file.size() - (GetParam().name == "text_pgm"    ? 3
                                          : GetParam().name == "flir_jpeg" ? 2
                                                                           : 0);
  for (std::size_t length = 0; length < last; ++length) {
    if ((GetParam().name == "seq" && length == file.size() / 2) ||
        (GetParam().name == "two_pgms" && length == 13)) {
      continue;
    }
    const std::string message = decode(file.substr(0, length));
    ASSERT_NE(message, "") << "cut at " << length << " of " << file.size();
    expect_error_line(message);
  }
}

TEST_P(HostileFiles, WithFlippedBitsAreAnErrorOrAPicture) {
  const std::string file = GetParam().make();
  std::mt19937 random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string damaged = file;
    // Headers are short: half of the flips go into the first 128 bytes.
    const std::size_t reach =
        trial % 2 == 0 ? std::min<std::size_t>(128, file.size()) : file.size();
    for (int flips = 1 + trial % 3; flips > 0; --flips) {
      damaged[random() % reach] ^= static_cast<char>(1U << random() % 8);
    }
    if (const std::string message = decode(damaged); !message.empty()) {
      expect_error_line(message);
    }
  }
}

TEST_P(HostileFiles, WithBytesOfExtremesAreAnErrorOrAPicture) {
  const std::string file = GetParam().make();
  for (std::size_t at = 0; at < std::min<std::size_t>(file.size(), 1000); ++at) {
    for (const char value : {'\x00', '\x7f', '\x80', '\xff'}) {
      std::string damaged = file;
      std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(at),
                  std::min<std::size_t>(4, file.size() - at), value);
      if (const std::string message = decode(damaged); !message.empty()) {
        expect_error_line(message);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, HostileFiles, testing::ValuesIn(kValidFiles),
                         [](const auto& valid) { return valid.param.name; });

}  // namespace
}  // namespace thermedge::io
