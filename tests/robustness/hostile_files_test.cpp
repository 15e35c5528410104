// Truncated and bit-flipped pictures: an error that names the file, or a picture within the limits;
// never a crash, a hang or a word on standard error.
#include <gtest/gtest.h>

#include <random>

#include "support/files.hpp"
#include "support/images.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::io {
namespace {

class HostileFiles : public testing::TestWithParam<std::string> {
 protected:
  // A small valid picture of the format.
  std::string valid_file() {
    const test::TemporaryDirectory directory;
    const std::string path = directory / ("x" + GetParam());
    const auto image = test::noise_image<std::uint16_t>(23, 17, 3000, 300, 1);
    EXPECT_TRUE(write_picture(path, image.view()));
    return test::file_text(path);
  }

  // Decodes all pages; the message where that fails.
  static std::string decode(const std::string& file) {
    const auto bytes = std::as_bytes(std::span(file));
    const Limits limits{.max_side_px = 4096, .max_bytes = 1 << 24};
    const auto pages = count_pages(bytes, "hostile", limits);
    if (!pages) {
      return pages.error().message;
    }
    Frame frame;
    for (std::size_t page = 0; page < std::min<std::size_t>(*pages, 10); ++page) {
      if (const Status status = decode_picture(bytes, "hostile", limits, page, frame); !status) {
        return status.error().message;
      }
      EXPECT_LE(frame.counts.width(), limits.max_side_px);
      EXPECT_LE(frame.counts.height(), limits.max_side_px);
    }
    return "";
  }
};

void expect_error_line(const std::string& message) {
  EXPECT_TRUE(message.starts_with("hostile: ")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST_P(HostileFiles, TruncatedAnywhereIsAnError) {
  const std::string file = valid_file();
  testing::internal::CaptureStderr();
  for (std::size_t length = 0; length < file.size(); ++length) {
    const std::string message = decode(file.substr(0, length));
    ASSERT_NE(message, "") << "cut at " << length << " of " << file.size();
    expect_error_line(message);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_P(HostileFiles, FlippedBitsAreAnErrorOrAPicture) {
  const std::string file = valid_file();
  std::mt19937 random(7);
  testing::internal::CaptureStderr();
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
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(All, HostileFiles, testing::Values(".png", ".tiff", ".pgm", ".npy"),
                         [](const auto& format) { return format.param.substr(1); });

}  // namespace
}  // namespace thermedge::io
