// Files are written whole or not at all.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "support/decoding.hpp"
#include "support/files.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::io {
namespace {

namespace fs = std::filesystem;
using test::file_text;
using test::TemporaryDirectory;

std::size_t files_in(const TemporaryDirectory& directory) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory.path()), {}));
}

// While it lives, files cannot grow beyond so many bytes, like on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(WriteFile, ThatBreaksOffLeavesTheOldFile) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory / "x", "old"));
  Status status;
  {
    const FileSizeLimit limit(1000);
    status = write_file(directory / "x", std::string(5000, 'n'));
  }
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, (directory / "x") + ": cannot be written: File too large");
  EXPECT_EQ(status.error().code, ErrorCode::kIo);
  EXPECT_EQ(file_text(directory / "x"), "old");
  EXPECT_EQ(files_in(directory), 1U);
}

TEST(WriteFile, NamesWhatIsInTheWay) {
  const TemporaryDirectory directory;
  fs::create_directory(directory / "taken");
  const auto error = [&](const std::string& path) { return write_file(path, "x").error().message; };
  EXPECT_EQ(error(directory / "taken"),
            (directory / "taken") + ": cannot be written: it is a directory");
  EXPECT_EQ(error(directory / "none/x"), (directory / "none/x") +
                                             ": cannot be written: there is no directory " +
                                             (directory / "none"));
  ASSERT_TRUE(write_file(directory / "file", "x"));
  EXPECT_EQ(error(directory / "file/x"),
            (directory / "file/x") + ": cannot be written: Not a directory");
  EXPECT_EQ(files_in(directory), 2U);
}

TEST(WriteFile, GoesThroughSymbolicLinks) {
  const TemporaryDirectory directory;
  fs::create_directory(directory / "place");
  ASSERT_TRUE(write_file(directory / "place/x", "old"));
  fs::create_symlink("place/x", directory / "link");
  ASSERT_TRUE(write_file(directory / "link", "new"));
  EXPECT_TRUE(fs::is_symlink(directory / "link"));
  EXPECT_EQ(file_text(directory / "place/x"), "new");
}

// On a pipe of the test's own: should this break, a real device would be gone.
TEST(WriteFile, LeavesDevicesAndPipesWhatTheyAre) {
  const TemporaryDirectory directory;
  const std::string pipe = directory / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(end, 0);
  EXPECT_TRUE(write_file(pipe, "through"));
  std::string received(100, '\0');
  const ssize_t count = ::read(end, received.data(), received.size());
  ::close(end);
  EXPECT_EQ(received.substr(0, static_cast<std::size_t>(std::max<ssize_t>(count, 0))), "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(files_in(directory), 1U);
}

TEST(WriteFile, DoesNotFollowLinksInPlaceOfItsTemporaryFile) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(write_file(directory / "victim", "whole"));
  constexpr int kNames = 2000;
  for (int i = 0; i < kNames; ++i) {
    fs::create_symlink("victim", directory / (".thermedge-" + std::to_string(::getpid()) + "-" +
                                              std::to_string(i) + ".tmp"));
  }
  const Status status = write_file(directory / "x", "text");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, (directory / "x") +
                                        ": cannot be written: temporary files of "
                                        "earlier runs are in the way");
  EXPECT_EQ(file_text(directory / "victim"), "whole");
}

TEST(WriteFile, ByManyAtOnceGivesOneOfThem) {
  const TemporaryDirectory directory;
  const std::string path = directory / "x";
  std::vector<std::thread> writers;
  for (const char letter : {'a', 'b', 'c', 'd'}) {
    writers.emplace_back([&path, letter] {
      for (int i = 0; i < 50; ++i) {
        EXPECT_TRUE(write_file(path, std::string(10000, letter)));
      }
    });
  }
  for (std::thread& writer : writers) {
    writer.join();
  }
  const std::string text = file_text(path);
  EXPECT_EQ(text, std::string(10000, text.at(0)));
  EXPECT_EQ(files_in(directory), 1U);
}

TEST(WriteFile, InTheWorkingDirectoryNeedsNoPath) {
  const TemporaryDirectory directory;
  const fs::path before = fs::current_path();
  fs::current_path(directory.path());
  EXPECT_TRUE(write_file("x", "text"));
  fs::current_path(before);
  EXPECT_EQ(file_text(directory / "x"), "text");
}

TEST(WritePicture, OfAStridedViewWritesItsPixelsOnly) {
  const TemporaryDirectory directory;
  Image<std::uint16_t> image(5, 4);
  for (int i = 0; i < 20; ++i) {
    image(i % 5, i / 5) = static_cast<std::uint16_t>(i * 300);
  }
  const ImageView<const std::uint16_t> part = image.view().crop(1, 2, 3, 2);
  const std::vector expected = {11 * 300, 12 * 300, 13 * 300, 16 * 300, 17 * 300, 18 * 300};
  for (const std::string name : {"x.png", "x.tif", "x.pgm", "x.npy"}) {
    ASSERT_TRUE(write_picture(directory / name, part));
    EXPECT_EQ(test::pixels_of(read_picture(directory / name)), expected) << name;
  }
}

TEST(WritePicture, AsRawIsLittleEndianWithoutHeader) {
  const TemporaryDirectory directory;
  Image<std::uint16_t> image(2, 1);
  image(0, 0) = 0x0102;
  image(1, 0) = 0xFFFE;
  ASSERT_TRUE(write_picture(directory / "x.raw", image.view()));
  EXPECT_EQ(file_text(directory / "x.raw"), "\x02\x01\xFE\xFF");
}

TEST(WritePicture, RefusesWhatTheFormatCannotHold) {
  const Image<std::uint16_t> empty;
  EXPECT_EQ(write_picture("x.png", empty.view()).error().message,
            "x.png: a picture without pixels");
  const Image<Rgb> colour(1, 1);
  EXPECT_EQ(write_picture("x.tif", colour.view()).error().message,
            "x.tif: the name should end in .png");
}

}  // namespace
}  // namespace thermedge::io
