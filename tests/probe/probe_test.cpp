// What was planted in simulated recordings is found again.
#include "thermedge/probe/probe.hpp"

#include <gtest/gtest.h>

#include "support/recordings.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/io/probe_file.hpp"
#include "thermedge/stages/noise.hpp"

namespace thermedge {
namespace {

using test::add_noise;
using test::clean_frames;
using test::noise_image;
using test::scene_frames;

RecordingReport probe(const std::vector<Image<std::uint16_t>>& frames, int bits = 16) {
  RecordingProbe recording;
  for (const Image<std::uint16_t>& frame : frames) {
    const Status status = recording.add(frame, bits);
    EXPECT_TRUE(status) << status.error().message;
  }
  return recording.report();
}

auto even(double sigma) {
  return [sigma](int, int) { return sigma; };
}

std::vector<Image<std::uint16_t>> moving(int frames, double sigma, double pattern_sigma) {
  std::vector<Image<std::uint16_t>> recording;
  for (const Image<float>& clean :
       clean_frames("sim:desk?width=256&height=192&frames=" + std::to_string(frames))) {
    recording.push_back(add_noise(clean.view(), even(sigma), pattern_sigma,
                                  static_cast<unsigned>(recording.size())));
  }
  return recording;
}

// Frames of noise alone, and what is done to them.
using Frames = std::vector<Image<std::uint16_t>>;

Frames noise_frames_of(double sigma, unsigned seed) {
  Frames frames;
  frames.push_back(test::noise_image<std::uint16_t>(240, 200, 3000, sigma, seed));
  return frames;
}

Frames noise_frames(double sigma) {
  Frames frames;
  for (unsigned i = 0; i < 2; ++i) {
    frames.push_back(test::noise_image<std::uint16_t>(240, 200, 3000, sigma, 31 + i));
  }
  return frames;
}

// Means of `side` x `side` pixels.
Frames blurred(const Frames& frames, int side) {
  Frames out;
  for (const auto& frame : frames) {
    Image<std::uint16_t>& made = out.emplace_back(frame.width(), frame.height());
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        int sum = 0;
        for (int v = 0; v < side; ++v) {
          for (int u = 0; u < side; ++u) {
            sum += frame(std::min(x + u, frame.width() - 1), std::min(y + v, frame.height() - 1));
          }
        }
        made(x, y) = static_cast<std::uint16_t>((sum + side * side / 2) / (side * side));
      }
    }
  }
  return out;
}

class ProbeOfScene : public testing::TestWithParam<const char*> {};

TEST_P(ProbeOfScene, FindsNoiseAndStripes) {
  for (const double sigma : {2.0, 20.0}) {
    SCOPED_TRACE(sigma);
    const double columns = sigma / 2;
    const double rows = sigma / 3;
    const auto report = probe(scene_frames(
        std::string("sim:") + GetParam() + "?frames=8&bad_pixels=0&sigma=" + std::to_string(sigma) +
        "&column_sigma=" + std::to_string(columns) + "&row_sigma=" + std::to_string(rows)));
    EXPECT_NEAR(report.sigma_counts / sigma, 1, 0.1) << "stripes on strong edges add to it";
    EXPECT_NEAR(report.pixel_sigma_counts / sigma, 1, 0.03);
    EXPECT_NEAR(report.frame_sigma_counts / sigma, 1, 0.03);
    ASSERT_TRUE(report.temporal_sigma_counts);
    EXPECT_NEAR(*report.temporal_sigma_counts / sigma, 1, 0.03);
    EXPECT_NEAR(report.column_sigma_counts / columns, 1, 0.15);
    EXPECT_NEAR(report.row_sigma_counts / rows, 1, 0.3);
    EXPECT_LT(report.fixed_pattern_share.value_or(0), 0.05) << "stripes are no pixel offsets";
    EXPECT_EQ(report.bad_pixels, 0);
    EXPECT_GE(report.scene_moved, 2) << "the hand begins slowly";
    EXPECT_EQ(report.snr, report.robust_range_counts / report.sigma_counts);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ProbeOfScene, testing::Values("desk", "corridor"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Probe, TellsTheFixedPatternFromTemporalNoise) {
  struct Noise {
    double temporal, fixed;
  };
  for (const Noise noise : {Noise{5, 3}, Noise{3, 5}, Noise{6, 0}}) {
    SCOPED_TRACE(noise.fixed);
    const auto report = probe(moving(12, noise.temporal, noise.fixed));
    const double both = std::hypot(noise.temporal, noise.fixed);
    const double share = noise.fixed * noise.fixed / (both * both);
    EXPECT_NEAR(report.pixel_sigma_counts / both, 1, 0.03);
    EXPECT_NEAR(report.temporal_sigma_counts.value_or(0) / noise.temporal, 1, 0.03);
    EXPECT_NEAR(report.fixed_pattern_sigma_counts.value_or(0), noise.fixed,
                noise.fixed > 0 ? 0.1 * noise.fixed : 0.9);
    EXPECT_NEAR(report.fixed_pattern_share.value_or(0), share, 0.03);
    EXPECT_NEAR(report.offset_map_gain_limit.value_or(0), 1 - std::sqrt(1 - share), 0.03);
    EXPECT_LE(*report.offset_map_gain_8_frames, *report.offset_map_gain_limit);
  }
}

// As cameras send them that enlarge or smooth their picture: neighbours are alike, and the noise of
// a pixel is what differences of frames show.
TEST(Probe, TemporalNoiseIsThatOfAPixelThoughACameraRepeatsOrAveragesThem) {
  const auto clean = clean_frames("sim:desk?width=256&height=192&frames=4");
  const auto repeated = [](const Image<std::uint16_t>& frame, int side) {
    Image<std::uint16_t> out(frame.width(), frame.height());
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) {
        out(x, y) = frame(x / side * side, y / side * side);
      }
    }
    return out;
  };
  const auto averaged = [](const Image<std::uint16_t>& frame, int side) {
    Image<std::uint16_t> out(frame.width(), frame.height());
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) {
        int sum = 0;
        for (int k = 0; k < side * side; ++k) {
          sum += frame(std::min(x + k % side, out.width() - 1),
                       std::min(y + k / side, out.height() - 1));
        }
        out(x, y) = static_cast<std::uint16_t>((sum + side * side / 2) / (side * side));
      }
    }
    return out;
  };
  for (const bool is_moving : {false, true}) {
    for (const int side : {1, 2, 3, 4}) {
      for (const bool is_averaged : {false, true}) {
        RecordingProbe recording;
        for (unsigned i = 0; i < 4; ++i) {
          const auto frame =
              add_noise(clean[is_moving ? i : 0].view(), even(is_averaged ? 4 * side : 4), 0, i);
          ASSERT_TRUE(recording.add(is_averaged ? averaged(frame, side) : repeated(frame, side)));
        }
        EXPECT_NEAR(recording.report().temporal_sigma_counts.value_or(0), 4, 0.5)
            << is_moving << side << is_averaged;
      }
    }
  }
}

// Noise below a count, which rounding hides from residuals.
TEST(Probe, TemporalNoiseOfACameraThatAveragesIsRightBelowACount) {
  RecordingProbe recording;
  for (unsigned i = 0; i < 6; ++i) {
    const auto frames = blurred(noise_frames_of(2.6, 300 + i), 3);
    ASSERT_TRUE(recording.add(frames[0]));
  }
  EXPECT_NEAR(recording.report().temporal_sigma_counts.value_or(0), 2.6 / 3, 0.1);
}

TEST(Probe, OfACameraAtRestLeavesTheFixedPatternOpen) {
  const auto clean = clean_frames("sim:desk?frames=1");
  std::vector<Image<std::uint16_t>> frames;
  for (unsigned i = 0; i < 8; ++i) {
    frames.push_back(add_noise(clean[0].view(), even(5), 3, i));
    // Somebody walks through a tenth of the view.
    for (int y = 0; y < 288; ++y) {
      for (int x = 0; x < 38; ++x) {
        frames.back()(static_cast<int>(40 * i) + x, y) += std::uint16_t{300};
      }
    }
  }
  const auto report = probe(frames);
  EXPECT_EQ(report.scene_moved, 0);
  EXPECT_FALSE(report.fixed_pattern_sigma_counts);
  EXPECT_FALSE(report.offset_map_gain_limit);
  EXPECT_NEAR(report.temporal_sigma_counts.value_or(0), 5, 0.15);
}

// Where noise is uneven the flatter half of a frame is its quieter half.
TEST(Probe, OfUnevenNoiseGivesItsRootMeanSquareAndItsMap) {
  const auto sigma = [](int x, int) { return x < 192 ? 8.0 : 15.0; };
  std::vector<Image<std::uint16_t>> frames;
  for (const Image<float>& clean : clean_frames("sim:desk?frames=3&width=384")) {
    frames.push_back(add_noise(clean.view(), sigma, 0, static_cast<unsigned>(frames.size())));
  }
  const auto report = probe(frames);
  EXPECT_NEAR(report.sigma_counts, 8, 1.2) << "of the flattest blocks; the map has the rest";
  EXPECT_NEAR(report.pixel_sigma_counts / std::hypot(8 / std::sqrt(2.0), 15 / std::sqrt(2.0)), 1,
              0.03);
  EXPECT_NEAR(report.frame_sigma_counts, 9.6, 0.5) << "the quieter half, and some";
  const NoiseMap& map = report.noise_map;
  ASSERT_GE(map.columns, 8);
  ASSERT_GE(map.rows, 6);
  ASSERT_EQ(map.sigma_counts.size(), static_cast<std::size_t>(map.columns * map.rows));
  for (int row = 0; row < map.rows; ++row) {
    const double* sigmas = map.sigma_counts.data() + row * map.columns;
    EXPECT_NEAR(sigmas[1], 8, 1.6);
    EXPECT_NEAR(sigmas[map.columns - 2], 15, 3);
  }
}

// Four times the noise in the right half.
Frames uneven(const Frames& frames) {
  Frames out;
  for (const auto& frame : frames) {
    Image<std::uint16_t>& made = out.emplace_back(frame.clone());
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 120; x < 240; ++x) {
        made(x, y) = static_cast<std::uint16_t>(3000 + 4 * (frame(x, y) - 3000));
      }
    }
  }
  return out;
}

// Twice each pixel less the mean of its neighbours across and down.
Frames sharpened(const Frames& frames) {
  Frames out;
  for (const auto& frame : frames) {
    Image<std::uint16_t>& made = out.emplace_back(frame.clone());
    for (int y = 1; y + 1 < frame.height(); ++y) {
      for (int x = 1; x + 1 < frame.width(); ++x) {
        const int beside = frame(x - 1, y) + frame(x + 1, y) + frame(x, y - 1) + frame(x, y + 1);
        made(x, y) = static_cast<std::uint16_t>(2 * frame(x, y) - beside / 4);
      }
    }
  }
  return out;
}

RecordingReport probe_for(Preset preset, const Frames& frames) {
  ProbeOptions options;
  options.preset = preset;
  RecordingProbe recording(options);
  for (const auto& frame : frames) {
    EXPECT_TRUE(recording.add(frame));
  }
  return recording.report();
}

// One number, whoever tells it: of every kind of noise, of none, and of a scene.
TEST(Probe, CallsSigmaWhatTheDetectorCallsSigma) {
  const std::vector<Frames> recordings = [] {
    std::vector<Frames> made;
    made.push_back(noise_frames(8));
    made.push_back(noise_frames(0.5));
    made.push_back(noise_frames(0));
    made.push_back(blurred(noise_frames(12), 2));
    made.push_back(uneven(noise_frames(5)));
    made.push_back(scene_frames("sim:desk?frames=2&width=160&height=120"));
    made.push_back(scene_frames("sim:desk?frames=2&width=160&height=120&sigma=0"));
    return made;
  }();
  for (const Preset preset : {Preset::kRobust, Preset::kFast, Preset::kPaper}) {
    auto detector = Detector::create(DetectorOptions(preset));
    ASSERT_TRUE(detector);
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      double sum = 0;
      for (const auto& frame : recordings[i]) {
        sum += detector->detect(frame)->sigma_counts;
      }
      EXPECT_DOUBLE_EQ(probe_for(preset, recordings[i]).sigma_counts,
                       sum / static_cast<double>(recordings[i].size()))
          << preset_name(preset) << " " << i;
    }
  }
}

TEST(Probe, TellsWhatTheSpectrumSaysOfTheNoise) {
  const auto kind_of = [](const Frames& frames) {
    return probe_for(Preset::kRobust, frames).noise_kind;
  };
  EXPECT_EQ(kind_of(noise_frames(8)), NoiseKind::kWhite);
  EXPECT_EQ(kind_of(noise_frames(60)), NoiseKind::kWhite);
  EXPECT_EQ(kind_of(uneven(noise_frames(6))), NoiseKind::kWhite);
  EXPECT_EQ(kind_of(blurred(noise_frames(20), 2)), NoiseKind::kSmooth);
  EXPECT_EQ(kind_of(blurred(noise_frames(40), 3)), NoiseKind::kSmooth);
  EXPECT_EQ(kind_of(sharpened(noise_frames(8))), NoiseKind::kSharpened);
  EXPECT_EQ(kind_of(noise_frames(0)), NoiseKind::kNone);
  // White noise and smooth noise of the same strength, as of a fixed pattern over several pixels.
  Frames mixed = blurred(noise_frames(24), 2);
  const Frames white = noise_frames(16);
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 240; ++x) {
        mixed[i](x, y) = static_cast<std::uint16_t>(mixed[i](x, y) + white[1 - i](x, y) - 3000);
      }
    }
  }
  EXPECT_EQ(kind_of(mixed), NoiseKind::kPartSmooth);
}

TEST(Probe, SpectrumOfWhiteNoiseIsOneAndStripesAddToItsBorder) {
  const RecordingReport white = probe_for(Preset::kRobust, noise_frames(10));
  double sum = 0;
  for (const float variance : white.spectrum) {
    EXPECT_NEAR(variance, 1, 0.6);
    sum += static_cast<double>(variance);
  }
  EXPECT_NEAR(sum / 64, 1, 0.1);
  RecordingReport striped = white;
  striped.column_sigma_counts = striped.sigma_counts / 2;
  striped.row_sigma_counts = 0;
  const NoiseSpectrum both = striped.spectrum_with_stripes();
  for (std::size_t i = 1; i < 8; ++i) {
    EXPECT_NEAR(both[i], white.spectrum[i] + 2, 1e-5) << "8 / 4";
    EXPECT_EQ(both[8 * i], white.spectrum[8 * i]);
    EXPECT_EQ(both[8 * i + i], white.spectrum[8 * i + i]);
  }
}

TEST(Probe, CountsLastingDeadPixels) {
  const auto report = probe(scene_frames("sim:desk?frames=6&bad_pixels=20"));
  ASSERT_TRUE(report.bad_pixels);
  EXPECT_NEAR(static_cast<double>(*report.bad_pixels), 20, 1);
  EXPECT_LT(report.passing_bad_pixels, 2);
}

TEST(Probe, TellsPassingPixelsFromDeadOnes) {
  auto frames = scene_frames("sim:desk?frames=6&bad_pixels=0");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i](100, 100) = 0;
    frames[i](150 + 10 * static_cast<int>(i), 50) = 16000;  // a different one in every frame
  }
  const auto report = probe(frames);
  EXPECT_EQ(report.bad_pixels, 1);
  EXPECT_NEAR(report.passing_bad_pixels, 1, 0.2);
}

std::vector<Image<std::uint16_t>> with_repeats(std::vector<Image<std::uint16_t>> frames,
                                               const std::vector<int>& repeats) {
  std::vector<Image<std::uint16_t>> longer;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (int k = 0; k <= repeats[i]; ++k) {
      longer.push_back(frames[i].clone());
    }
  }
  return longer;
}

TEST(Probe, FindsFreezesAndTheJumpsAfterThem) {
  auto frames = scene_frames("sim:desk?frames=5");
  for (std::size_t i = 3; i < frames.size(); ++i) {
    for (int y = 0; y < frames[i].height(); ++y) {
      for (int x = 0; x < frames[i].width(); ++x) {
        frames[i](x, y) += std::uint16_t{60};  // the shutter corrected all offsets
      }
    }
  }
  const auto report = probe(with_repeats(std::move(frames), {0, 1, 7, 0, 3}));
  EXPECT_EQ(report.frames, 16);
  EXPECT_EQ(report.repeated_frames, 11);
  EXPECT_EQ(report.longest_freeze, 7);
  EXPECT_EQ(report.offset_jumps, 1);
  EXPECT_NEAR(report.largest_jump_counts, 60, 3);
  EXPECT_NEAR(report.temporal_sigma_counts.value_or(0), 5.8, 0.2) << "repeats are no frames";
  EXPECT_GT(report.flicker_counts.value_or(0), 3.0);
}

TEST(Probe, AFreezeWithoutAnOffsetIsNoShutter) {
  const auto report = probe(with_repeats(scene_frames("sim:desk?frames=4"), {0, 6, 0, 0}));
  EXPECT_EQ(report.longest_freeze, 6);
  EXPECT_EQ(report.offset_jumps, 0);
  EXPECT_EQ(report.largest_jump_counts, 0);
}

TEST(Probe, OfFreshFramesFindsNoFreeze) {
  const auto report = probe(scene_frames("sim:corridor?frames=4"));
  EXPECT_EQ(report.repeated_frames, 0);
  EXPECT_EQ(report.longest_freeze, 0);
  EXPECT_EQ(report.offset_jumps, 0);
}

TEST(Probe, OfOneFrameLeavesOpenWhatTakesMore) {
  const auto report = probe(scene_frames("sim:desk?frames=1"));
  EXPECT_EQ(report.frames, 1);
  EXPECT_NEAR(report.sigma_counts, 5.8, 0.2);
  EXPECT_FALSE(report.temporal_sigma_counts);
  EXPECT_FALSE(report.fixed_pattern_share);
  EXPECT_FALSE(report.flicker_counts);
  EXPECT_FALSE(report.bad_pixels);
  EXPECT_NEAR(report.passing_bad_pixels, 5, 1);
}

TEST(Probe, Of8BitPicturesSuggestsNoGain) {
  std::vector<Image<std::uint16_t>> frames;
  frames.push_back(noise_image<std::uint16_t>(96, 72, 128, 40, 1));
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 96; ++x) {
      frames[0](x, y) = std::min<std::uint16_t>(frames[0](x, y), 255);
    }
  }
  const auto report = probe(frames, 8);
  EXPECT_EQ(report.container_bits, 8);
  EXPECT_EQ(report.used_bits, 8);
  EXPECT_NEAR(report.sigma_counts, 40, 2.5);
  for (const SuggestedOption& option : report.suggested) {
    EXPECT_NE(option.name, "scale.gain");
  }
}

TEST(Probe, OfConstantFramesFindsNothing) {
  Image<std::uint16_t> frame(64, 48);
  fill_pixels(frame.view(), std::uint16_t{3008});
  std::vector<Image<std::uint16_t>> frames;
  frames.push_back(frame.clone());
  frames.push_back(frame.clone());
  frames.push_back(std::move(frame));
  const auto report = probe(frames);
  EXPECT_EQ(report.sigma_counts, 0);
  EXPECT_EQ(report.range_counts, 0);
  EXPECT_FALSE(report.snr);
  EXPECT_EQ(report.repeated_frames, 2);
  EXPECT_EQ(report.clipped_share(0.5), 0);
  EXPECT_EQ(report.flicker_counts, 0);
  EXPECT_EQ(report.unused_low_bits, 0) << "one count tells nothing of a shift";
}

RecordingReport probe_by(const ProbeOptions& options, const Frames& frames) {
  RecordingProbe recording(options);
  for (const auto& frame : frames) {
    EXPECT_TRUE(recording.add(frame));
  }
  return recording.report();
}

ProbeOptions with_camera(const std::string& name) {
  ProbeOptions options;
  options.camera = *parse_counts_model(name);
  options.camera_source =
      name.find(':') == std::string::npos ? CameraSource::kName : CameraSource::kNumbers;
  return options;
}

// The counts of the desk are hundredths of a degree.
TEST(Probe, TellsTemperaturesOnlyWhereTheCameraFits) {
  const Frames desk = scene_frames("sim:desk?frames=1");
  for (const std::string wrong : {"optris", "lepton", "lepton-0.1"}) {
    const auto report = probe_by(with_camera(wrong), desk);
    EXPECT_TRUE(report.is_degc_implausible) << wrong;
    EXPECT_FALSE(report.min_degc || report.max_degc) << wrong;
    EXPECT_LT(report.implausible_degc[0], report.implausible_degc[1]);
  }
  const auto report = probe_by(with_camera("optris"), desk);
  EXPECT_GT(report.implausible_degc[0], 100) << "a desk";
  for (const std::string right : {"linear", "linear:0.01,0", "linear:0.1,-100"}) {
    const auto fitting = probe_by(with_camera(right), desk);
    EXPECT_FALSE(fitting.is_degc_implausible) << right;
    EXPECT_EQ(fitting.min_degc, parse_counts_model(right)->to_degc(fitting.min_counts));
  }
  EXPECT_TRUE(probe_by(with_camera("linear:0.01,-400"), desk).is_degc_implausible)
      << "below absolute zero";
  EXPECT_TRUE(probe_by({}, desk).is_degc_assumed);
  EXPECT_FALSE(report.is_degc_assumed);
}

// A camera at a furnace: hot, but with the noise of a camera.
TEST(Probe, BelievesACameraWhoseScaleIsGivenInNumbers) {
  Frames furnace;
  furnace.push_back(noise_image<std::uint16_t>(96, 72, 7000, 1, 3));
  EXPECT_TRUE(probe_by(with_camera("optris"), furnace).is_degc_implausible);
  const auto report = probe_by(with_camera("linear:0.1,-100"), furnace);
  EXPECT_NEAR(report.min_degc.value_or(0), 600, 1);
}

// What each preset would do with each suggestion for recordings of every kind.
TEST(Probe, EverySuggestionIsTakenAndChangesSomething) {
  std::vector<Frames> recordings;
  for (const std::string scene :
       {"sim:desk?frames=3", "sim:desk?frames=3&width=96&height=72",
        "sim:desk?frames=3&width=20&height=16", "sim:corridor?frames=3&sigma=40",
        "sim:desk?frames=3&column_sigma=30&row_sigma=20",
        "sim:desk?frames=3&flickering_pixels=3000", "sim:road?frames=3&camera=boson",
        "sim:empty?frames=3&sigma=0.3"}) {
    recordings.push_back(scene_frames(scene));
  }
  recordings.push_back(uneven(noise_frames(5)));
  recordings.push_back(uneven(noise_frames(500)));
  std::size_t suggestions = 0;
  for (const Preset preset : {Preset::kRobust, Preset::kFast, Preset::kPaper}) {
    const DetectorOptions usual(preset);
    for (const Frames& frames : recordings) {
      const RecordingReport report = probe_for(preset, frames);
      DetectorOptions all = usual;
      for (const SuggestedOption& option : report.suggested) {
        DetectorOptions changed = usual;
        const std::string setting = option.name + "=" + option.value;
        const Status status = io::apply_setting(setting, changed);
        ASSERT_TRUE(status) << preset_name(preset) << ": " << status.error().message;
        EXPECT_TRUE(changed.check()) << setting;
        EXPECT_NE(io::dump_config(changed), io::dump_config(usual)) << setting;
        EXPECT_TRUE(io::apply_setting(setting, all));
        ++suggestions;
      }
      EXPECT_TRUE(Detector::create(all)) << preset_name(preset);
    }
  }
  EXPECT_GT(suggestions, 10U);
}

TEST(Probe, OfTinyFramesDoesNotMeasureNoise) {
  for (int width = 1; width <= 12; ++width) {
    for (const int height : {1, 2, 7, 8, 9}) {
      RecordingProbe recording;
      for (unsigned seed = 0; seed < 3; ++seed) {
        ASSERT_TRUE(recording.add(noise_image<std::uint16_t>(width, height, 3000, 20, seed)));
      }
      const auto report = recording.report();
      EXPECT_EQ(report.frames, 3);
      EXPECT_EQ(report.column_profile_counts.size(), static_cast<std::size_t>(width));
      EXPECT_EQ(report.row_profile_counts.size(), static_cast<std::size_t>(height));
      EXPECT_EQ(report.sigma_counts > 0, std::min(width, height) >= 8) << width << "x" << height;
    }
  }
}

TEST(Probe, LeavesOutFramesOfAnotherKind) {
  RecordingProbe recording;
  EXPECT_EQ(recording.add({}).error().message, "frame without pixels");
  ASSERT_TRUE(recording.add(noise_image<std::uint16_t>(40, 30, 3000, 5, 1)));
  EXPECT_EQ(recording.add(noise_image<std::uint16_t>(30, 40, 3000, 5, 1)).error().message,
            "frame of 30x40 pixels in a recording of 40x30; left out");
  EXPECT_EQ(recording.add(noise_image<std::uint16_t>(40, 30, 100, 5, 1), 8).error().message,
            "frame of 8 bits in a recording of 16; left out");
  EXPECT_EQ(recording.add(noise_image<std::uint16_t>(40, 30, 100, 5, 1), 12).error().message,
            "frame of 12 bits; should be 8 or 16");
  ASSERT_TRUE(recording.add(noise_image<std::uint16_t>(40, 30, 3000, 5, 2)));
  EXPECT_EQ(recording.report().frames, 2);
}

TEST(Probe, OfNoFramesIsEmpty) {
  const RecordingReport report = RecordingProbe().report();
  EXPECT_EQ(report.frames, 0);
  EXPECT_TRUE(report.suggested.empty());
}

TEST(Probe, KeepsAnEvenSeriesOfLongRecordings) {
  RecordingProbe recording;
  const auto frame = noise_image<std::uint16_t>(16, 16, 3000, 5, 1);
  for (int i = 0; i < 4200; ++i) {
    ASSERT_TRUE(recording.add(frame));
  }
  const auto report = recording.report();
  EXPECT_EQ(report.frames, 4200);
  ASSERT_EQ(report.series.size(), 2100U);
  for (std::size_t i = 0; i < report.series.size(); ++i) {
    ASSERT_EQ(report.series[i].frame, static_cast<std::int64_t>(2 * i));
  }
}

TEST(Probe, GivesTheSameReportOnEveryTarget) {
  const auto frames = scene_frames("sim:desk?frames=3&width=97&height=67");
  const std::string expected = io::probe_to_json(probe(frames), {});
  test::for_each_simd_target(
      [&](const std::string&) { EXPECT_EQ(io::probe_to_json(probe(frames), {}), expected); });
}

}  // namespace
}  // namespace thermedge
