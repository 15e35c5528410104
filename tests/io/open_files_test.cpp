// Sequences: names, order, streams, and what a bad file does to those behind it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>

#include "codecs/codecs.hpp"
#include "support/encoded_pictures.hpp"
#include "support/files.hpp"
#include "thermedge/io/files.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::io {
namespace {

namespace fs = std::filesystem;
using test::TemporaryDirectory;
using test::write_text;

// A PGM of one pixel, to be known by its value.
std::string pixel(char value) { return std::string("P5 1 1 255\n") + value; }

std::string stack(const std::string& values) {
  return test::npy_file("{'descr': '|u1', 'fortran_order': False, 'shape': (" +
                            std::to_string(values.size()) + ", 1, 1)}",
                        values);
}

// What a source gives: pixels as letters, '!' for an error.
std::string letters(FrameSource& source) {
  std::string text;
  SourceFrame frame;
  for (;;) {
    const auto more = source.next(frame);
    if (more && !*more) {
      return text;
    }
    text += more ? static_cast<char>(frame.counts(0, 0)) : '!';
  }
}

std::string letters(const std::vector<std::string>& inputs, const SourceOptions& options = {}) {
  const auto source = open_files(inputs, options);
  return source ? letters(**source) : source.error().message;
}

SourceOptions raw(int width, int height, RawFormat format = RawFormat::kGray8) {
  SourceOptions options;
  options.raw_width = width;
  options.raw_height = height;
  options.raw_format = format;
  return options;
}

// Standard input as a pipe that the test writes to.
class StandardInput {
 public:
  StandardInput() : before_(::dup(STDIN_FILENO)) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
    write_end_ = ends[1];
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;
  ~StandardInput() {
    end();
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }

  void write(const std::string& text) const {
    EXPECT_EQ(::write(write_end_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void end() {
    if (write_end_ >= 0) {
      ::close(write_end_);
      write_end_ = -1;
    }
  }
  [[nodiscard]] static int waiting_bytes() {
    int count = 0;
    EXPECT_EQ(::ioctl(STDIN_FILENO, FIONREAD, &count), 0);
    return count;
  }

 private:
  int before_;
  int write_end_ = -1;
};

TEST(NaturalOrder, ComparesNumbersAsNumbers) {
  const std::vector<std::string> sorted = {"",
                                           "a",
                                           "a0",
                                           "a00",
                                           "a01",
                                           "a1",
                                           "a1.png",
                                           "a2.png",
                                           "a10.png",
                                           "a10b2",
                                           "a10b10",
                                           "a99999999999999999999998",
                                           "a99999999999999999999999",
                                           "b"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      EXPECT_EQ(natural_less(sorted[i], sorted[j]), i < j) << sorted[i] << " and " << sorted[j];
    }
  }
}

TEST(StandardInputFrames, ComeOneByOneWithoutReadingAhead) {
  StandardInput input;
  const auto source = open_files({"-"}, raw(2, 1, RawFormat::kGray16Le));
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ((*source)->size_hint(), 1U) << "until it is opened, an input is one frame";
  SourceFrame frame;
  input.write(std::string("a\0b\0c\0", 6));
  ASSERT_EQ((*source)->next(frame), true);
  EXPECT_EQ(StandardInput::waiting_bytes(), 2);
  EXPECT_EQ(frame.counts(1, 0), 'b');
  EXPECT_EQ(frame.source, "-[0]");
  EXPECT_EQ(frame.stem, "stdin_0000");
  EXPECT_EQ((*source)->size_hint(), 0U) << "a pipe has no known length";
  input.write(std::string("d\0", 2));
  ASSERT_EQ((*source)->next(frame), true);
  EXPECT_EQ(frame.counts(0, 0), 'c');
  EXPECT_EQ(frame.index, 1);
  input.end();
  EXPECT_EQ((*source)->next(frame), false);
  EXPECT_EQ((*source)->next(frame), false);
}

TEST(StandardInputFrames, ThatEndEarlyAreAnError) {
  for (const auto& [text, message] : {
           std::pair<std::string, std::string>{
               "", "standard input: empty; there should be frames of 4 bytes (2x2, 8 bits)"},
           {"abcdefg",
            "standard input: 3 bytes are left over after 1 frame of 4 bytes (2x2, 8 bits); do "
            "--raw-size and --raw-format fit, and is there a header (--raw-header, "
            "--raw-frame-header)?"},
       }) {
    StandardInput input;
    input.write(text);
    input.end();
    const auto source = open_files({"-"}, raw(2, 2));
    SourceFrame frame;
    Result<bool> more = (*source)->next(frame);
    if (more && *more) {
      more = (*source)->next(frame);
    }
    ASSERT_FALSE(more);
    EXPECT_EQ(more.error().message, message);
    EXPECT_EQ((*source)->next(frame), false);
  }
}

TEST(RawFiles, OfOneFrameAreNamedLikePictures) {
  const TemporaryDirectory directory;
  write_text(directory / "x.raw", "abcd");
  write_text(directory / "empty.raw", "");
  for (const auto& [width, stem] : {std::pair{4, "x"}, {2, "x_0000"}}) {
    const auto source = open_files({directory / "x.raw"}, raw(width, 1));
    SourceFrame frame;
    ASSERT_EQ((*source)->next(frame), true);
    EXPECT_EQ(frame.stem, stem);
    EXPECT_EQ((*source)->size_hint(), 4U / static_cast<unsigned>(width));
  }
  EXPECT_EQ(letters({directory / "empty.raw"}, raw(4, 1)), "!");
  EXPECT_EQ(letters({directory / "x.raw"}, raw(99999, 1)), "!") << "more than the limits allow";
}

TEST(Inputs, BadFilesDoNotStopThoseBehindThem) {
  const TemporaryDirectory directory;
  write_text(directory / "1.npy", stack("ab"));
  write_text(directory / "2.npy", stack("cd").substr(0, 50));
  write_text(directory / "3.jpg.png", "\xff\xd8\xff");
  write_text(directory / "4.raw", "e");
  write_text(directory / "5.pgm", pixel('f'));
  EXPECT_EQ(letters({directory.path().string()}, raw(1, 1)), "ab!!ef");
  EXPECT_EQ(letters({directory.path().string()}), "ab!!!f") << "no size for the raw file";
}

TEST(Inputs, PagesAfterABadOneAreRead) {
  const TemporaryDirectory directory;
  test::TiffWriter writer(true, false);
  test::TiffPage page;
  page.tags = {{test::kWidth, 1},       {test::kHeight, 1},   {test::kBits, 8},
               {test::kPhotometric, 1}, {test::kChannels, 1}, {test::kCompression, 1}};
  page.parts = {"a"};
  writer.add_page(page);
  page.tags[2] = {test::kBits, 32};
  writer.add_page(page);
  page.tags[2] = {test::kBits, 8};
  writer.add_page(page);
  write_text(directory / "1.tif", writer.file());
  write_text(directory / "2.pgm", pixel('b'));
  const auto source = open_files({directory / "*"}, {});
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(letters(**source), "a!ab") << "the pages after a bad one are read";
  EXPECT_EQ((*source)->size_hint(), 4U);
}

TEST(Inputs, GlobsMatchDirectoriesToo) {
  const TemporaryDirectory directory;
  for (const std::string run : {"run10", "run9", "run1x"}) {
    fs::create_directory(directory / run);
  }
  write_text(directory / "run9/1.pgm", pixel('a'));
  write_text(directory / "run9/readme.txt", "nothing to see");
  write_text(directory / "run10/1.pgm", pixel('b'));
  fs::create_directory(directory / "run10/deeper");
  write_text(directory / "run10/deeper/1.pgm", pixel('c'));
  EXPECT_EQ(letters({directory / "run*"}), "ab");
  EXPECT_EQ(letters({directory / "run[0-9]/?.pgm"}), "a");
  EXPECT_EQ(letters({directory / "run1x*"}), (directory / "run1x*") + ": no file matches");
  write_text(directory / "a[1].pgm", pixel('d'));
  EXPECT_EQ(letters({directory / "a[1].pgm"}), "d") << "a file of that very name";
}

TEST(Inputs, ThatAreNotThereAreErrorsAtOnce) {
  const TemporaryDirectory directory;
  write_text(directory / "a.pgm", pixel('a'));
  EXPECT_EQ(letters({directory / "a.pgm", directory / "b.pgm"}),
            (directory / "b.pgm") + ": no such file or directory");
  EXPECT_EQ(letters(std::vector<std::string>{}), "");
}

TEST(Inputs, AreReadWithinTheLimits) {
  const TemporaryDirectory directory;
  write_text(directory / "a.pgm", pixel('a') + std::string(1000, 'x'));
  SourceOptions options;
  options.limits.max_bytes = 1000;
  const auto source = open_files({directory / "a.pgm"}, options);
  SourceFrame frame;
  const auto more = (*source)->next(frame);
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().code, ErrorCode::kLimitExceeded);
  EXPECT_EQ(more.error().message,
            (directory / "a.pgm") + ": 1012 bytes are more than the limit of 1000");
}

TEST(Inputs, TellHowFarTheyReach) {
  const TemporaryDirectory directory;
  write_text(directory / "1.npy", stack("abc"));
  write_text(directory / "2.pgm", pixel('d'));
  const auto source = open_files({directory.path().string()}, {});
  EXPECT_EQ((*source)->size_hint(), 2U);
  SourceFrame frame;
  ASSERT_EQ((*source)->next(frame), true);
  EXPECT_EQ((*source)->size_hint(), 4U);
  EXPECT_EQ(letters(**source), "bcd");
  EXPECT_EQ((*source)->size_hint(), 4U);
}

TEST(Inputs, ReuseTheMemoryOfTheFrame) {
  const TemporaryDirectory directory;
  write_text(directory / "1.npy", stack("abc"));
  const auto source = open_files({directory / "1.npy"}, {});
  SourceFrame frame;
  ASSERT_EQ((*source)->next(frame), true);
  const std::uint16_t* pixels = frame.counts.row(0);
  ASSERT_EQ((*source)->next(frame), true);
  EXPECT_EQ(frame.counts.row(0), pixels);
}

TEST(Messages, AreOneLineWhateverAFileSays) {
  const std::string name = "file";
  const Limits limits;
  EXPECT_EQ(damaged({{}, name, limits}, "PNG", "a\nb\x1b[2J\xff").value().message,
            "file: damaged PNG: a?b?[2J?");
}

TEST(Kinds, ThatPeopleTryAreNamed) {
  const TemporaryDirectory directory;
  const std::string path = directory / "x.png";
  for (const auto& [bytes, says] : {
           std::pair<std::string, std::string>{"\xff\xd8\xff\xe0",
                                               "a JPEG picture without raw counts"},
           {"BM123456", "a BMP picture; not a picture"},
           {"GIF89a", "a GIF picture; not a picture"},
           {std::string("\0\0\0\x18", 4) + "ftypmp42", "an MP4 or MOV video; pipe it in: ffmpeg"},
           {"RIFF1234AVI LIST", "an AVI video; pipe it in: ffmpeg"},
           {"P5x",
            "not a picture that thermedge reads (PNG, TIFF, PGM, NPY, FLIR JPEG, FFF and SEQ)"},
           {std::string("FFF\0x", 5), "damaged FLIR file: its header is not one of an FFF"},
       }) {
    write_text(path, bytes);
    const auto frame = read_picture(path);
    ASSERT_FALSE(frame);
    EXPECT_TRUE(frame.error().message.starts_with(path + ": " + says)) << frame.error().message;
  }
}

}  // namespace
}  // namespace thermedge::io
