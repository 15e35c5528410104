// Faults of the input that are made are found, with the option that mends them; frames without
// faults have none.
#include "probe_input.hpp"

#include <gtest/gtest.h>

#include "support/recordings.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::detail {
namespace {

using Frame16 = Image<std::uint16_t>;
using test::scene_frames;

const std::vector<std::string>& scenes() {
  static const std::vector<std::string> list = {
      "sim:desk?frames=2",
      "sim:desk?frames=2&sigma=0",
      "sim:desk?frames=2&sigma=30",
      "sim:corridor?frames=2&camera=boson",
      "sim:office?frames=2&camera=lepton35",
      "sim:road?frames=2&camera=pi450",
      "sim:empty?frames=2",
      "sim:desk?frames=2&width=160&height=120&bad_pixels=200"};
  return list;
}

std::vector<InputFault> faults_of(const std::vector<Frame16>& frames, int bits = 16) {
  InputFaultFinder finder;
  for (const Frame16& frame : frames) {
    finder.add(frame, {}, bits);
  }
  return finder.faults();
}

std::string text_of(const std::vector<InputFault>& faults) {
  std::string text;
  for (const InputFault& fault : faults) {
    text += (text.empty() ? "" : " ") + fault.flag + " " + fault.value;
  }
  return text;
}

template <class F>
std::vector<Frame16> changed(const std::vector<Frame16>& frames, int more_rows, F&& change) {
  std::vector<Frame16> out;
  for (const Frame16& frame : frames) {
    Frame16& made = out.emplace_back(frame.width(), frame.height() + more_rows);
    fill_pixels(made.view(), std::uint16_t{0});
    copy_pixels(frame.view(), made.view().crop(0, 0, frame.width(), frame.height()));
    change(made, frame, static_cast<int>(out.size()));
  }
  return out;
}

TEST(InputFaults, OfSimulatedFramesAreNone) {
  for (const std::string& scene : scenes()) {
    const auto frames = scene_frames(scene);
    EXPECT_EQ(text_of(faults_of(frames)), "") << scene;
  }
}

TEST(InputFaults, OfRecordedFramesAreNone) {
  THERMEDGE_NEEDS_SHARED("data");
  for (const std::string folder :
       {"optris_pi450", "fieldscale_road", "calib_board", "denoise/noisy", "denoise/clean",
        "flir/flir_example.jpg", "flir/frame_000000_le.fff", "flir/example_radiometric.tiff"}) {
    const auto path = test::shared_directory() / "data" / folder;
    const auto source = io::open_files({path.string()}, {});
    ASSERT_TRUE(source) << folder;
    io::SourceFrame frame;
    for (;;) {
      const auto more = (*source)->next(frame);
      ASSERT_TRUE(more) << more.error().message;
      if (!*more) {
        break;
      }
      InputFaultFinder finder;
      finder.add(frame.counts, frame.valid, frame.bits);
      EXPECT_EQ(text_of(finder.faults()), "") << frame.source;
    }
  }
}

// A word a pixel: a counter, flags, serial numbers, and zeros. As Lepton (160x122) and Boson
// (640x514) send them.
void write_telemetry(Frame16& frame, int row, int number, double share) {
  std::mt19937 random(7);
  for (int x = 0; x < frame.width(); ++x) {
    const bool has_word = x < share * frame.width();
    frame(x, row) = has_word ? static_cast<std::uint16_t>(random()) : std::uint16_t{0};
  }
  frame(1, row) = static_cast<std::uint16_t>(number);
}

TEST(InputFaults, TelemetryRowsAreCutOff) {
  struct Case {
    std::string scene;
    int rows;
    std::string crop;
  };
  for (const Case& camera : {Case{"sim:office?frames=3&camera=lepton35", 2, "--crop 0,0,160,120"},
                             Case{"sim:corridor?frames=2&camera=boson", 2, "--crop 0,0,640,512"},
                             Case{"sim:desk?frames=2&width=80&height=60", 3, "--crop 0,0,80,60"},
                             Case{"sim:desk?frames=2", 1, "--crop 0,0,382,288"},
                             Case{"sim:road?frames=2&sigma=0", 8, "--crop 0,0,382,288"},
                             Case{"sim:empty?frames=2", 2, "--crop 0,0,382,288"}}) {
    for (const double share : {0.1, 1.0}) {
      const auto frames = changed(scene_frames(camera.scene), camera.rows,
                                  [&](Frame16& made, const Frame16& frame, int number) {
                                    for (int row = 0; row < camera.rows; ++row) {
                                      write_telemetry(made, frame.height() + row, number, share);
                                    }
                                  });
      EXPECT_EQ(text_of(faults_of(frames)), camera.crop) << camera.scene << " " << share;
    }
  }
}

// Whatever the words are.
TEST(InputFaults, TelemetryIsKnownByWhatAPictureIsNot) {
  using Word = std::uint16_t (*)(int x, int number);
  for (const Word word :
       {+[](int x, int) { return static_cast<std::uint16_t>(x); },
        +[](int x, int number) { return static_cast<std::uint16_t>(x == 3 ? number : 0); },
        +[](int x, int) { return static_cast<std::uint16_t>(2600 + x * 7919 % 600); },
        +[](int x, int) { return static_cast<std::uint16_t>(x % 2 == 0 ? 0xFFFF : x); }}) {
    const auto frames = changed(scene_frames("sim:office?frames=3&camera=lepton35"), 2,
                                [&](Frame16& made, const Frame16& frame, int number) {
                                  for (int x = 0; x < 160; ++x) {
                                    made(x, frame.height()) = word(x, number);
                                    made(x, frame.height() + 1) = word(x, number);
                                  }
                                });
    EXPECT_EQ(text_of(faults_of(frames)), "--crop 0,0,160,120") << word(1, 7);
  }
}

TEST(InputFaults, TelemetryAboveThePictureIsCutOff) {
  const auto frames = changed(scene_frames("sim:office?frames=3&camera=lepton35"), 2,
                              [&](Frame16& made, const Frame16& frame, int number) {
                                copy_pixels(frame.view(), made.view().crop(0, 2, 160, 120));
                                write_telemetry(made, 0, number, 0.4);
                                write_telemetry(made, 1, number, 0.4);
                              });
  const auto faults = faults_of(frames);
  EXPECT_EQ(text_of(faults), "--crop 0,2,160,120");
  EXPECT_EQ(faults[0].option, "source.crop");
  EXPECT_EQ(faults[0].reason, "2 rows at the top are telemetry, no picture");
}

// The view of 8 bits that the camera made of the same frame above or below the counts.
TEST(InputFaults, OfADoublePictureTheHalfWithCountsIsTaken) {
  for (const std::string scene :
       {"sim:desk?frames=2&width=256&height=192", "sim:office?frames=2&width=256&height=192",
        "sim:road?frames=2&width=256&height=192&sigma=12",
        "sim:corridor?frames=2&camera=lepton35"}) {
    for (const bool counts_below : {true, false}) {
      std::vector<Frame16> frames;
      for (const Frame16& frame : scene_frames(scene)) {
        const int height = frame.height();
        Frame16& made = frames.emplace_back(frame.width(), 2 * height);
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < frame.width(); ++x) {
            made(x, y + (counts_below ? height : 0)) = frame(x, y);
            made(x, y + (counts_below ? 0 : height)) =
                static_cast<std::uint16_t>(std::clamp((frame(x, y) - 2000) / 8, 0, 255));
          }
        }
      }
      EXPECT_EQ(text_of(faults_of(frames)), counts_below ? "--crop bottom-half" : "--crop top-half")
          << scene;
    }
  }
}

// Luma and two chromas in turns, read as counts of 16 bits.
TEST(InputFaults, OfADoublePictureWithColoursTheOtherHalfIsTaken) {
  std::vector<Frame16> frames;
  for (const Frame16& frame : scene_frames("sim:desk?frames=2&width=256&height=192")) {
    Frame16& made = frames.emplace_back(256, 384);
    for (int y = 0; y < 192; ++y) {
      for (int x = 0; x < 256; ++x) {
        const int level = std::clamp((frame(x, y) - 2000) / 8, 0, 255);
        made(x, y) = static_cast<std::uint16_t>((x % 2 == 0 ? 90 : 160) << 8 | level);
        made(x, y + 192) = frame(x, y);
      }
    }
  }
  EXPECT_EQ(text_of(faults_of(frames)), "--crop bottom-half");
}

TEST(InputFaults, SwappedBytesAreSwappedBack) {
  for (const std::string& scene : scenes()) {
    if (scene.find("sigma=0") != std::string::npos) {
      continue;  // without noise the low byte is as even as the high one
    }
    const auto frames = changed(scene_frames(scene), 0, [](Frame16& made, const Frame16&, int) {
      for (int y = 0; y < made.height(); ++y) {
        for (int x = 0; x < made.width(); ++x) {
          made(x, y) = static_cast<std::uint16_t>(made(x, y) << 8 | made(x, y) >> 8);
        }
      }
    });
    EXPECT_EQ(text_of(faults_of(frames)), "--byte-order swapped") << scene;
    EXPECT_EQ(text_of(faults_of(frames, 8)), "") << "levels have one byte";
  }
}

// Frames of fewer bits that were shifted up look a little like it.
TEST(InputFaults, ShiftedCountsAreNotTakenForSwappedOnes) {
  for (const int shift : {1, 2, 4, 6, 7, 8}) {
    const auto frames =
        changed(scene_frames("sim:desk?frames=2"), 0, [&](Frame16& made, const Frame16&, int) {
          for (int y = 0; y < made.height(); ++y) {
            for (int x = 0; x < made.width(); ++x) {
              made(x, y) = static_cast<std::uint16_t>((made(x, y) >> shift) << shift);
            }
          }
        });
    EXPECT_EQ(text_of(faults_of(frames)), "") << shift;
  }
}

TEST(InputFaults, ABorderOfOneCountIsNoMeasurement) {
  struct Border {
    std::uint16_t count;
    int left, top, right, bottom;  // px
  };
  for (const std::string scene :
       {"sim:desk?frames=2", "sim:office?frames=2&camera=lepton35", "sim:corridor?frames=2"}) {
    for (const Border& border : {Border{0, 8, 0, 8, 0}, Border{0, 0, 12, 0, 0},
                                 Border{65535, 3, 3, 3, 3}, Border{16383, 0, 0, 0, 24}}) {
      const auto frames = changed(scene_frames(scene), 0, [&](Frame16& made, const Frame16&, int) {
        for (int y = 0; y < made.height(); ++y) {
          for (int x = 0; x < made.width(); ++x) {
            const bool is_inside = x >= border.left && x < made.width() - border.right &&
                                   y >= border.top && y < made.height() - border.bottom;
            made(x, y) = is_inside ? made(x, y) : border.count;
          }
        }
      });
      EXPECT_EQ(text_of(faults_of(frames)), "--invalid " + std::to_string(border.count)) << scene;
    }
  }
}

TEST(InputFaults, PixelsThatAreKnownToBeInvalidAreNoFault) {
  auto frames = scene_frames("sim:desk?frames=1");
  Image<std::uint8_t> valid(frames[0].width(), frames[0].height());
  fill_pixels(valid.view(), std::uint8_t{1});
  for (int y = 0; y < valid.height(); ++y) {
    for (int x = 0; x < 10; ++x) {
      frames[0](x, y) = 0;
      valid(x, y) = 0;
    }
  }
  EXPECT_EQ(find_input_faults(frames[0], {}, 16).invalid_counts, 0);
  EXPECT_EQ(find_input_faults(frames[0], valid, 16), FrameFaults());
}

TEST(InputFaults, MustBeInAllFrames) {
  auto frames = scene_frames("sim:desk?frames=3");
  for (int x = 0; x < frames[1].width(); ++x) {
    frames[1](x, 0) = 0;
    frames[1](x, 1) = 0;
  }
  EXPECT_EQ(text_of(faults_of(frames)), "") << "a line that was lost once";
}

TEST(InputFaults, OfConstantAndTinyFramesAreNone) {
  std::vector<Frame16> frames;
  for (const int side : {1, 8, 23, 24, 64}) {
    Frame16& frame = frames.emplace_back(side, side);
    fill_pixels(frame.view(), std::uint16_t{3008});
    InputFaultFinder finder;
    finder.add(frame, {}, 16);
    EXPECT_TRUE(finder.faults().empty()) << side;
  }
  for (int side = 2; side <= 30; ++side) {
    InputFaultFinder finder;
    finder.add(test::noise_image<std::uint16_t>(side, 40, 3000, 20, 1), {}, 16);
    EXPECT_EQ(text_of(finder.faults()), "") << side;
  }
}

}  // namespace
}  // namespace thermedge::detail
