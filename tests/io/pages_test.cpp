// Every frame of a file arrives, or is named: several pictures in one file, stacks of ImageJ,
// copies among the pages, and what is left over at the end.
#include <gtest/gtest.h>

#include <span>

#include "support/decoding.hpp"
#include "support/encoded_pictures.hpp"
#include "support/files.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::io {
namespace {

using test::decoded;
using test::error_of;
using test::number;
using test::pixels_of;
using namespace std::string_literals;

// What a file gives, frame by frame: its name less the directory, and its pixels; or the error.
std::vector<std::string> story_of(const std::string& bytes,
                                  std::vector<std::string>* notes = nullptr,
                                  const std::string& name = "x") {
  const test::TemporaryDirectory directory;
  const std::string path = directory / name;
  test::write_text(path, bytes);
  const auto relative = [&](std::string text) {
    const std::size_t at = text.find(path);
    return at == std::string::npos ? text : text.replace(at, path.size(), name);
  };
  SourceOptions options;
  options.note = [&](const std::string& note) {
    if (notes != nullptr) {
      notes->push_back(relative(note));
    }
  };
  std::vector<std::string> story;
  const auto source = open_files({path}, options);
  SourceFrame frame;
  while (source) {
    const auto more = (*source)->next(frame);
    if (more && !*more) {
      break;
    }
    std::string line = more ? relative(frame.source) + ":" : relative(more.error().message);
    for (int y = 0; more && y < frame.counts.height(); ++y) {
      for (int x = 0; x < frame.counts.width(); ++x) {
        line += " " + std::to_string(frame.counts(x, y));
      }
    }
    story.push_back(line);
  }
  return story;
}

using Story = std::vector<std::string>;

TEST(Pgm, MayHoldSeveralPictures) {
  EXPECT_EQ(story_of("P5 2 1 255\nabP5\n1 2 65535\n\1\2\1\3P2 1 1 9 7\nP5 1 1 255\nz"s),
            (Story{"x[0]: 97 98", "x[1]: 258 259", "x[2]: 7", "x[3]: 122"}));
  EXPECT_EQ(story_of("P5 1 1 255\na\n"s), Story{"x: 97"}) << "a line end after it is nothing";
}

TEST(Pgm, NamesWhatIsLeftOver) {
  EXPECT_EQ(story_of("P5 1 1 255\nabcd"s),
            (Story{"x: 97", "x: 3 bytes are left over after the picture"}));
  EXPECT_EQ(story_of("P5 1 1 255\naP5 1 1 255\nbc"s),
            (Story{"x[0]: 97", "x[1]: 98", "x: 1 byte is left over after the picture"}));
  EXPECT_EQ(story_of("P5 1 1 255\naP5 9 1 255\nbc"s),
            (Story{"x: 97", "x: damaged PGM: the file ends early"}));
  EXPECT_EQ(story_of("P2 2 1 9\n1 2 3\n"s),
            (Story{"x: 1 2", "x: 3 bytes are left over after the picture"}));
}

TEST(Pgm, HasCommentsAndLineEndsAfterItsMaximum) {
  EXPECT_EQ(pixels_of(decoded("P5\n2 1\n255\n# a comment\nab"s)), (std::vector{97, 98}));
  EXPECT_EQ(pixels_of(decoded("P5\n2 1\n255 # a comment\nab"s)), (std::vector{97, 98}));
  EXPECT_EQ(pixels_of(decoded("P5\n2 1\n255\n# one\n# two\nab"s)), (std::vector{97, 98}));
  EXPECT_EQ(pixels_of(decoded("P5\r\n2 1\r\n255\r\nab"s)), (std::vector{97, 98}));
  EXPECT_EQ(pixels_of(decoded("P5\r\n2 1\r\n255\r\na\n"s)), (std::vector{97, 10}));
  // Pixels that look like one or the other.
  EXPECT_EQ(pixels_of(decoded("P5\n2 1\n255\n#b"s)), (std::vector{35, 98}));
  EXPECT_EQ(pixels_of(decoded("P5\n2 1\n255\r\nb"s)), (std::vector{10, 98}));
  EXPECT_EQ(story_of("P5\n2 1\n255\n#\nP5\r\n1 1\r\n255\r\nz"s),
            (Story{"x[0]: 35 10", "x[1]: 122"}));
}

std::string grey_png(char value) {
  return test::png_file({.width = 1, .height = 1, .rows = "\0"s + value});
}

TEST(Png, MayFollowEachOther) {
  std::vector<std::string> notes;
  EXPECT_EQ(story_of(grey_png('a') + grey_png('b'), &notes), (Story{"x[0]: 97", "x[1]: 98"}));
  EXPECT_EQ(notes, Story{});
  EXPECT_EQ(story_of(grey_png('a') + "what the camera adds", &notes), Story{"x: 97"});
  EXPECT_EQ(notes, Story{"x: 20 bytes after the picture are passed over"});
}

std::string npy(const std::string& shape, const std::string& data) {
  return test::npy_file("{'descr': '|u1', 'fortran_order': False, 'shape': " + shape + "}", data);
}

TEST(Npy, MayHoldSeveralArrays) {
  EXPECT_EQ(story_of(npy("(2, 1, 1)", "ab") + npy("(1, 2)", "cd")),
            (Story{"x[0]: 97", "x[1]: 98", "x[2]: 99 100"}));
  EXPECT_EQ(story_of(npy("(1, 1)", "a") + "bc"),
            (Story{"x: 97", "x: 2 bytes are left over after the array"}));
  EXPECT_EQ(story_of(npy("(1, 1)", "a") + npy("(9, 9)", "b")),
            (Story{"x: 97", "x: damaged NPY: the file ends early"}));
}

TEST(Npy, WithItsFramesLastGetsAHint) {
  const auto refused = decoded(npy("(80, 70, 5)", std::string(80 * 70 * 5, 'x')));
  EXPECT_EQ(error_of(refused),
            "file: an NPY of shape (80, 70, 5), which looks like (height, width, frames or "
            "channels); a stack is (frames, height, width): numpy.save(FILE, numpy.moveaxis(a, -1, "
            "0)) makes it (5, 80, 70)");
  std::vector<std::string> notes;
  EXPECT_EQ(story_of(npy("(3, 4, 2)", std::string(24, 'x')), &notes).size(), 3U);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(
      notes[0].starts_with("x: the array (3, 4, 2) is read as 3 frames of 2x4 pixels; "
                           "should it be (height, width, frames)"))
      << notes[0];
  notes.clear();
  EXPECT_EQ(story_of(npy("(2, 3, 4)", std::string(24, 'x')), &notes).size(), 2U);
  EXPECT_EQ(notes, Story{});
}

constexpr std::uint16_t kSubfileType = 254;
constexpr std::uint16_t kDescription = 270;
constexpr std::uint16_t kExtraSamples = 338;
constexpr std::uint16_t kPlanes = 284;

test::TiffPage page_of(const std::string& pixels, std::uint64_t channels = 1, int bits = 8) {
  test::TiffPage page;
  const std::size_t pixel_bytes = channels * static_cast<std::size_t>(bits) / 8;
  page.tags = {{test::kWidth, pixels.size() / pixel_bytes},
               {test::kHeight, 1},
               {test::kBits, static_cast<std::uint64_t>(bits)},
               {test::kPhotometric, channels == 1 ? 1U : 2U},
               {test::kChannels, channels},
               {test::kCompression, 1}};
  page.parts = {pixels};
  return page;
}

test::TiffPage with(test::TiffPage page, std::uint16_t tag, std::uint64_t value) {
  page.tags.emplace_back(tag, value);
  return page;
}

std::string tiff(const std::vector<test::TiffPage>& pages) {
  test::TiffWriter writer(false, false);
  for (const test::TiffPage& page : pages) {
    writer.add_page(page);
  }
  return writer.file();
}

TEST(TiffPages, GoOnAfterOneThatIsRefused) {
  EXPECT_EQ(
      story_of(tiff(
          {page_of("a"), page_of("xyz", 3), page_of("b"), page_of("xyz", 1, 24), page_of("c")})),
      (Story{"x[0]: 97", "x[1]: a colour picture; frames have a single channel (grey)", "x[2]: 98",
             "x[3]: a TIFF page of 24 bits; frames are whole numbers of 8, 16 or 32 bits or "
             "floats of 16, 32 or 64",
             "x[4]: 99"}));
}

TEST(TiffPages, ThatAreAllRefusedAreNotAllTold) {
  const std::vector<test::TiffPage> pages(40, page_of("xyz", 3));
  const Story story = story_of(tiff(pages));
  ASSERT_EQ(story.size(), 16U);
  EXPECT_EQ(story.back(),
            "x[15]: a colour picture; frames have a single channel (grey); so were the 15 pages "
            "before it, and pages 16 to 39 are not tried");
}

TEST(TiffPages, ThatAreCopiesArePassedOver) {
  std::vector<std::string> notes;
  EXPECT_EQ(story_of(tiff({page_of("ab"), with(page_of("c"), kSubfileType, 1)}), &notes),
            Story{"x: 97 98"})
      << "a single frame";
  EXPECT_EQ(notes, Story{"x: page 1 is a reduced-resolution copy or a mask and is passed over"});
  notes.clear();
  EXPECT_EQ(story_of(tiff({with(page_of("a"), kSubfileType, 1), page_of("b"),
                           with(page_of("c"), kSubfileType, 4), page_of("d")}),
                     &notes),
            (Story{"x[1]: 98", "x[3]: 100"}));
  EXPECT_EQ(notes,
            Story{"x: pages 0, 2 are reduced-resolution copies or masks and are passed over"});
  EXPECT_EQ(story_of(tiff({with(page_of("a"), kSubfileType, 1)})), Story{"x: 97"})
      << "where there is nothing else";
  EXPECT_EQ(story_of(tiff({with(page_of("a"), kSubfileType, 2), page_of("b")})),
            (Story{"x[0]: 97", "x[1]: 98"}))
      << "a page of several";
}

TEST(TiffColours, ThatAreEqualAreGrey) {
  EXPECT_EQ(pixels_of(decoded(tiff({page_of("aaabbb", 3)}))), (std::vector{97, 98}));
  EXPECT_EQ(pixels_of(decoded(tiff({page_of("abababcdcdcd", 3, 16)}))),
            (std::vector{0x6261, 0x6463}));
  EXPECT_EQ(pixels_of(decoded(tiff({with(page_of("aaa\1bbb\2", 4), kExtraSamples, 2)}))),
            (std::vector{97, 98}))
      << "whatever alpha is";
  test::TiffPage planes = with(page_of("ababab", 3), kPlanes, 2);
  planes.parts = {"ab", "ab", "ab"};
  EXPECT_EQ(pixels_of(decoded(tiff({planes}))), (std::vector{97, 98}));
  planes.parts = {"ab", "ab", "ac"};
  EXPECT_EQ(error_of(decoded(tiff({planes}))),
            "file: a colour picture; frames have a single channel (grey)");
}

// ImageJ's own layout: one directory, a description, all pictures behind each other.
std::string imagej(const std::string& pixels, std::size_t width, int images, int bits,
                   bool big_endian,
                   std::vector<std::pair<std::uint16_t, std::uint64_t>> more = {}) {
  std::string description =
      "ImageJ=1.53k\nimages=" + std::to_string(images) + "\nslices=2\n"s + '\0';
  std::vector<std::pair<std::uint16_t, std::uint64_t>> tags = {
      {test::kWidth, width},    {test::kHeight, 1},
      {test::kBits, bits},      {test::kCompression, 1},
      {test::kPhotometric, 1},  {test::kChannels, 1},
      {test::kRowsPerStrip, 1}, {test::kStripBytes, width * static_cast<std::size_t>(bits) / 8}};
  tags.insert(tags.end(), more.begin(), more.end());
  const std::size_t directory_bytes = 2 + 12 * (tags.size() + 2) + 4;
  const std::size_t text_at = 8 + directory_bytes;
  tags.emplace_back(kDescription, text_at);
  tags.emplace_back(test::kStripOffsets, text_at + description.size());
  std::sort(tags.begin(), tags.end());
  const auto n = [&](std::uint64_t value, int bytes) { return number(value, bytes, big_endian); };
  std::string file = (big_endian ? "MM" : "II") + n(42, 2) + n(8, 4) + n(tags.size(), 2);
  for (const auto& [tag, value] : tags) {
    const bool text = tag == kDescription;
    file += n(tag, 2) + n(text ? 2 : 4, 2) + n(text ? description.size() : 1, 4) + n(value, 4);
  }
  return file + n(0, 4) + description + pixels;
}

TEST(ImageJ, StacksHaveOneDirectory) {
  for (const bool big : {false, true}) {
    const std::string pixels = number(1, 2, big) + number(2, 2, big) + number(300, 2, big) +
                               number(4, 2, big) + number(5, 2, big) + number(600, 2, big);
    EXPECT_EQ(story_of(imagej(pixels, 2, 3, 16, big)),
              (Story{"x[0]: 1 2", "x[1]: 300 4", "x[2]: 5 600"}))
        << big;
  }
  EXPECT_EQ(story_of(imagej("abcd", 2, 2, 8, true)), (Story{"x[0]: 97 98", "x[1]: 99 100"}));
}

TEST(ImageJ, StacksOfFloatsAreRead) {
  const std::string pixels = number(0x41A40000, 4, true) + number(0x41A80000, 4, true);
  const std::string file = imagej(pixels, 1, 2, 32, true, {{test::kSampleFormat, 3}});
  const auto frame = decoded(file, 1);
  ASSERT_TRUE(frame) << frame.error().message;
  ASSERT_TRUE(frame->is_float());
  EXPECT_EQ(frame->values(0, 0), 21.0F);
}

TEST(ImageJ, StacksThatEndEarlySaySo) {
  EXPECT_EQ(story_of(imagej("abcde", 2, 4, 8, true)),
            (Story{"x[0]: 97 98", "x[1]: 99 100",
                   "x: damaged TIFF: the file ends early: it holds 2 of the 4 images that ImageJ "
                   "counts"}));
}

TEST(ImageJ, SinglePicturesAreSingle) {
  EXPECT_EQ(story_of(imagej("ab", 2, 1, 8, true)), Story{"x: 97 98"});
}

}  // namespace
}  // namespace thermedge::io
