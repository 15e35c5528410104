// Files, directories, globs and streams as sequences of frames.
#include "thermedge/io/source.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/files.hpp"

namespace thermedge::io {
namespace {

using test::TemporaryDirectory;
using test::write_text;

// A PGM of one pixel, to be known by its value.
std::string pixel(char value) { return std::string("P5 1 1 255\n") + value; }

struct Sequence {
  std::string pixels;  // the first pixel of each frame
  std::vector<std::string> stems;
  std::vector<std::string> errors;
};

Sequence read_all(const std::vector<std::string>& inputs, const SourceOptions& options = {}) {
  Sequence sequence;
  const auto source = open_files(inputs, options);
  if (!source) {
    sequence.errors.push_back(source.error().message);
    return sequence;
  }
  SourceFrame frame;
  for (;;) {
    const auto more = (*source)->next(frame);
    if (!more) {
      sequence.errors.push_back(more.error().message);
    } else if (*more) {
      sequence.pixels += static_cast<char>(frame.counts(0, 0));
      sequence.stems.push_back(frame.stem);
    } else {
      return sequence;
    }
  }
}

TEST(Source, ReadsADirectoryInNaturalOrder) {
  const TemporaryDirectory directory;
  write_text(directory / "f10.pgm", pixel('c'));
  write_text(directory / "f2.pgm", pixel('b'));
  write_text(directory / "f01.pgm", pixel('a'));
  write_text(directory / "g", pixel('d'));  // a picture by content
  write_text(directory / "notes.txt", "no picture");
  write_text(directory / ".hidden.pgm", pixel('x'));
  std::filesystem::create_directory(directory / "f3.pgm");
  const auto sequence = read_all({directory.path().string()});
  EXPECT_EQ(sequence.pixels, "abcd");
  EXPECT_EQ(sequence.stems, (std::vector<std::string>{"f01", "f2", "f10", "g"}));
  EXPECT_TRUE(sequence.errors.empty());
}

TEST(Source, ExpandsGlobsAndKeepsTheOrderOfInputs) {
  const TemporaryDirectory directory;
  write_text(directory / "a9.pgm", pixel('1'));
  write_text(directory / "a10.pgm", pixel('2'));
  write_text(directory / "b.pgm", pixel('3'));
  EXPECT_EQ(read_all({directory / "b.pgm", directory / "a*.pgm"}).pixels, "312");
  EXPECT_EQ(read_all({directory / "c*.pgm"}).errors,
            std::vector{(directory / "c*.pgm") + ": no file matches"});
}

TEST(Source, GoesOnBehindABadFile) {
  const TemporaryDirectory directory;
  write_text(directory / "1.pgm", pixel('a'));
  write_text(directory / "2.pgm", "P5 1 1 255\n");
  write_text(directory / "3.png", "rubbish");
  write_text(directory / "4.pgm", pixel('b'));
  const auto sequence = read_all({directory.path().string()});
  EXPECT_EQ(sequence.pixels, "ab");
  ASSERT_EQ(sequence.errors.size(), 2U);
  EXPECT_NE(sequence.errors[0].find("2.pgm"), std::string::npos);
  EXPECT_NE(sequence.errors[1].find("3.png"), std::string::npos);
}

TEST(Source, NamesWhatIsNotThere) {
  const TemporaryDirectory directory;
  EXPECT_EQ(read_all({directory / "x.png"}).errors,
            std::vector{(directory / "x.png") + ": no such file or directory"});
  EXPECT_EQ(
      read_all({directory.path().string()}).errors,
      std::vector{
          directory.path().string() +
          ": no pictures in this directory (PNG, TIFF, PGM, NPY, FLIR JPEG, FFF and SEQ, .raw; "
          "with --raw-size .bin and .dat, too)"});
  const auto device = read_all({"/dev/null"});
  ASSERT_EQ(device.errors.size(), 1U);
  EXPECT_TRUE(device.errors[0].starts_with("/dev/null: a device; pipe a camera in: ffmpeg"));
}

TEST(Source, ReadsRawFramesOfEachFormat) {
  const TemporaryDirectory directory;
  write_text(directory / "x.raw", std::string("a\0\0\0b\0\0\0", 8));
  SourceOptions options;
  options.raw_width = 2;
  options.raw_height = 1;
  const auto little = read_all({directory / "x.raw"}, options);
  EXPECT_EQ(little.pixels, "ab");
  EXPECT_EQ(little.stems, (std::vector<std::string>{"x_0000", "x_0001"}));
  options.raw_format = RawFormat::kGray8;
  EXPECT_EQ(read_all({directory / "x.raw"}, options).pixels, std::string("a\0b\0", 4));
  write_text(directory / "x.raw", std::string("\0c\0\0", 4));
  options.raw_format = RawFormat::kGray16Be;
  EXPECT_EQ(read_all({directory / "x.raw"}, options).pixels, "c");
}

TEST(Source, RefusesRawFramesThatDoNotFit) {
  const TemporaryDirectory directory;
  write_text(directory / "x.raw", "12345");
  EXPECT_EQ(read_all({directory / "x.raw"}).errors,
            std::vector{(directory / "x.raw") +
                        ": frames without a header; say how large they are: --raw-size WxH"});
  SourceOptions options;
  options.raw_width = 2;
  options.raw_height = 1;
  const auto sequence = read_all({directory / "x.raw"}, options);
  EXPECT_EQ(sequence.pixels.size(), 1U);
  ASSERT_EQ(sequence.errors.size(), 1U);
  EXPECT_NE(sequence.errors[0].find("1 byte is left over after 1 frame of 4 bytes"),
            std::string::npos);
}

TEST(Source, ReadsAPipeFrameByFrame) {
  const TemporaryDirectory directory;
  const std::string pipe = directory / "pipe.raw";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string command =
      "(printf 'a\\0\\0\\0'; sleep 0.1; printf 'b\\0\\0\\0') > '" + pipe + "' &";
  ASSERT_EQ(std::system(command.c_str()), 0);
  SourceOptions options;
  options.raw_width = 2;
  options.raw_height = 1;
  EXPECT_EQ(read_all({pipe}, options).pixels, "ab");
}

TEST(Source, NumbersThePagesOfAStack) {
  const TemporaryDirectory directory;
  const std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 1, 1), }\n";
  write_text(directory / "s.npy", std::string("\x93NUMPY\x01\0", 8) +
                                      static_cast<char>(header.size()) + '\0' + header + "abc");
  const auto sequence = read_all({directory / "s.npy"});
  EXPECT_EQ(sequence.pixels, "abc");
  EXPECT_EQ(sequence.stems, (std::vector<std::string>{"s_0000", "s_0001", "s_0002"}));
}

}  // namespace
}  // namespace thermedge::io
