// What a recording is like: range, noise and its parts, dead pixels, clipping, freezes; and which
// options of the detector suit it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/noise_model.hpp"
#include "thermedge/presets.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/radiometry/planck.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/bad_pixels.hpp"
#include "thermedge/stages/validity.hpp"

namespace thermedge {

// Where the response of a camera comes from: how far it can be trusted to be that of the recording.
enum class CameraSource {
  kName,    // one of camera_models(): temperatures and noise that no usual scene has are doubted
  kNumbers  // given for the recording, or stored with it: doubted where it gives no temperature
};

struct ProbeOptions {
  // Worth of a count, degC, > 0; not given: kDegcPerCount is assumed (paper section 2.3).
  std::optional<double> degc_per_count;
  std::optional<CountsModel> camera;  // instead of it, where known: tells temperatures too
  CameraSource camera_source = CameraSource::kName;
  bool find_input_faults = true;  // whether the frames are as read, so that `input` means something
  ValidityOptions validity;       // whether pixels that are no measurement are looked for
  BadPixelOptions bad_pixels;     // the rule for bad pixels
  Preset preset = Preset::kRobust;  // whose options are suggested
};

// Counts of all frames: bin i holds the pixels with edges_counts[i] <= count < edges_counts[i + 1].
// At most 256 bins of whole counts over the 0.1st to 99.9th percentile and a margin.
struct CountHistogram {
  std::vector<int> edges_counts;      // bins + 1
  std::vector<std::int64_t> pixels;   // of each bin
  std::int64_t below = 0, above = 0;  // pixels outside the bins
};

// The noise over the picture as the detector's noise model has it, mean over the frames; tiles of
// about 24 px, row by row. All 0 where there is none.
struct NoiseMap {
  int columns = 0, rows = 0;
  std::vector<double> sigma_counts;
};

// What the spectrum of noise tells of its past.
enum class NoiseKind {
  kNone,
  kWhite,       // neighbouring pixels have nothing in common
  kPartSmooth,  // they are a little alike
  kSmooth,      // they are alike: resampled, enlarged, blurred, compressed
  kSharpened    // more from pixel to pixel than over several
};
inline constexpr std::array kNoiseKinds = {
    EnumName{NoiseKind::kNone, "none"}, EnumName{NoiseKind::kWhite, "white"},
    EnumName{NoiseKind::kPartSmooth, "partly_smooth"}, EnumName{NoiseKind::kSmooth, "smooth"},
    EnumName{NoiseKind::kSharpened, "sharpened"}};

// By the mean variance of the frequencies with periods under 3.3 px, in units of that at the scale
// of edges: white noise has 0.9 to 1.1, resampled half a pixel off or enlarged 0.05 to 0.1, an
// image that was rotated 0.25, cameras with filters of their own 0.4 to 0.6.
[[nodiscard]] NoiseKind noise_kind(const NoiseSpectrum& spectrum);

// In at most 55 characters.
[[nodiscard]] std::string_view noise_kind_meaning(NoiseKind kind);

// One frame of the series. Of long recordings every 2nd, 4th ... frame is kept, at most 4096.
struct ProbeSample {
  std::int64_t frame = 0;
  int median_counts = 0;
  double sigma_counts = 0;
};

// Share of the pixels that Algorithm 1 would clip, mean over the frames.
struct GainClipping {
  double gain = 0;  // grey levels per count
  double share = 0;
};

// Frames that are not as the camera meant them, and the option of the input that mends them.
struct InputFault {
  std::string flag;    // "--crop"
  std::string option;  // "source.crop"; empty where there is the flag alone
  std::string value;   // of both
  std::string reason;  // in at most 60 characters
};

// One option of the detector as `--set name=value` takes it, and why it is suggested.
struct SuggestedOption {
  std::string name, value, reason;
};

// Values that the recording can't tell are nullopt. `share` and `gain` are parts of 1.
//
// Noise. `sigma_counts` is what the detector goes by. All other sigmas use the residual of [1 -2 1]
// x [1 -2 1] / 6: unit gain for white noise, blind to planes, columns and rows. A tile's sigma
// is 1.4826 times the median of the residual over the flatter half *of that tile*, the recording's
// the root mean square over the tiles, mean over the frames. Ranking the slopes within tiles
// matters where noise is uneven, because noise makes slopes: the flatter half of a whole frame is
// its quieter half, and that is what NoiseEstimator gives. A road camera with 15 counts in its cold
// sky and 8 on the ground has 9.6 by tiles (9.4 by the median over whole frames) and 8.4 by
// NoiseEstimator; of simulated halves with 8 and 15 counts (root mean square 12.0) the tiles
// give 11.8 and NoiseEstimator 9.6. Where noise is even they agree.
//
// Temporal sigma: of the difference of successive residuals, over sqrt 2. The residual hardly sees
// a scene that moves smoothly, and the flatter halves and the median leave out edges that move.
// Where a camera repeats or averages pixels, neighbours are alike and the residual is small. So it
// is multiplied by the ratio of the noise of a pixel and of the residual, of the difference D of
// successive frames: the former from D(x, y) - D(x + 4, y) - D(x, y + 4) + D(x + 4, y + 4), whose
// pixels have nothing in common, by the quarter of the tiles with the smallest ratio, because what
// moves adds to it. A camera that averages over time shows less here than it has.
//
// Fixed pattern: two maps of mean residuals, of every other frame in which the scene had moved; the
// noise in the two is independent, so (var(a + b) - var(a - b)) / 4 is the variance of the offsets
// of the pixels alone. Needs 4 such frames: a camera at rest can't tell its pattern from its scene.
// What never moves though the camera does (the vehicle's own bonnet) is taken for pattern. Medians
// over the whole picture are no substitute for the tiles where noise is uneven: on the road they
// give 36 % of the variance, the tiles 54 %; the latter foretells what a map of 8 frames does to
// the other frames (28 %, tried: 24 %).
struct RecordingReport {
  std::int64_t frames = 0;
  int width = 0, height = 0;     // px
  int container_bits = 0;        // 8 or 16
  int used_bits = 0;             // up to the highest bit that is ever set
  int unused_low_bits = 0;       // 2: all counts are multiples of 4
  double degc_per_count = 0;     // of a camera model: in the middle of the range
  bool is_degc_assumed = false;  // nobody told the worth of a count
  // The camera's response gives temperatures, or a noise, that this recording can't have: then
  // there are no others in degC.
  bool is_degc_implausible = false;
  std::array<double, 2> implausible_degc{};  // 1st to 99th percentile of all frames
  double implausible_sigma_degc = 0;
  CameraSource camera_source = CameraSource::kName;
  std::vector<InputFault> input;  // faults that all of the first 8 frames have

  // Range, counts.
  int min_counts = 0, max_counts = 0;        // of all frames
  std::optional<double> min_degc, max_degc;  // the same as temperatures, of a camera model
  double range_counts = 0;         // max - min of a frame (paper eq. 3), mean over the frames
  double robust_range_counts = 0;  // 99th - 1st percentile of a frame, mean over the frames
  std::optional<double> snr;       // robust_range_counts / sigma_counts
  CountHistogram histogram;

  // Noise, counts.
  // What the detector's result says of these frames (Detection::sigma_counts), mean over them:
  // presets robust and fast at the scale of edges, paper from pixel to pixel. 0: none to be told.
  double sigma_counts = 0;
  // The same in the unit of float frames, which is what the detector tells of those: of the scale
  // of the last one. Not there for counts.
  std::optional<double> sigma_value;
  NoiseSpectrum spectrum = white_spectrum();  // of the same; 1 for white noise
  NoiseKind noise_kind = NoiseKind::kNone;
  NoiseMap noise_map;
  double pixel_sigma_counts = 0;  // from pixel to pixel: temporal and fixed together
  double frame_sigma_counts = 0;  // the same as NoiseEstimator measures it on each frame
  std::optional<double> temporal_sigma_counts;       // of a pixel; needs two different frames
  std::optional<double> fixed_pattern_sigma_counts;  // offsets of the pixels
  std::optional<double> fixed_pattern_share;         // of the variance from pixel to pixel
  // By how much an offset map would lower that sigma: learned from 8 frames,
  // 1 - sqrt((1 - share) (1 + 1 / 8)), and from any number, 1 - sqrt(1 - share).
  std::optional<double> offset_map_gain_8_frames, offset_map_gain_limit;

  // Stripes, counts: as NoiseEstimator measures them, and the offset of each column (row) against
  // its up to 8 nearest, median along it, mean over the frames.
  double column_sigma_counts = 0, row_sigma_counts = 0;
  std::vector<double> column_profile_counts, row_profile_counts;

  // Pixels that are no measurement, mean over the frames: given with them, and found. Everything
  // else is measured with these filled from those around them.
  double given_invalid_pixels = 0, found_invalid_pixels = 0;
  double dead_rows = 0, dead_columns = 0;  // a frame, mean; replaced

  // Dead pixels: flagged in at least half of 3 or more different frames; and others, per frame.
  std::optional<std::int64_t> bad_pixels;
  double passing_bad_pixels = 0;

  std::vector<GainClipping> clipping;  // by falling gain

  // Sequence.
  std::int64_t repeated_frames = 0;  // bit-identical to the one before
  std::int64_t longest_freeze = 0;   // repeated frames in a row
  std::int64_t offset_jumps = 0;     // after 2 or more repeats, by more than sigma: a shutter (FFC)
  double largest_jump_counts = 0;    // median over the pixels of the difference
  std::int64_t scene_moved = 0;      // frames in which the scene had moved since the last such one
  std::optional<double> flicker_counts;  // |change of the median| from frame to frame, mean
  std::vector<ProbeSample> series;

  Preset preset = Preset::kRobust;         // whose options these are
  std::vector<SuggestedOption> suggested;  // where its defaults don't suit

  // The spectrum with what stripes add to the frequencies of 0, which the model leaves out: those
  // of columns in the first row, [u], those of rows in the first column, [8 v].
  [[nodiscard]] NoiseSpectrum spectrum_with_stripes() const;
  // Share clipped at a gain of `clipping`; 0 for other gains.
  [[nodiscard]] double clipped_share(double gain) const;
};

// From where on an option is suggested. Values that no line gives a source for are chosen so that
// recordings that need nothing get no suggestion.
struct SuggestionTuning {
  double most_clipped_share = 0.02;  // of the pixels, that a gain may clip, 0..1
  double coarsest_level_sigmas = 2;  // a level coarser than this many sigma hides what noise leaves
  double finest_level_sigmas = 0.25;  // a level finer than this many sigma shows noise alone
  double sigma_tolerance = 0.05;      // relative difference between two measurements of noise that
                                      // matters; NoiseEstimator is within .02
  double stripes_sigmas = 0.2;      // least stripes in units of the noise: strong edges alone look
                                    // like an eighth (noise.hpp)
  double passing_share = 2e-4;      // of the pixels, that are taken for dead and soon recover, 0..1
  double threshold_factor = 2;      // on bad_pixels.threshold_sigmas, where there are more
  double small_frame_scale = 0.75;  // below this part of the paper's frames (width and height
                                    // together) limits in pixels shrink with the frame
};

struct ProbeTuning {
  std::size_t most_samples = 4096;   // of the series: memory against detail
  std::int64_t shutter_repeats = 2;  // least repeats of a frame that a closed shutter makes; one
                                     // alone is a frame that came late
  std::int64_t least_frames_for_dead_pixels = 3;  // fewer do not tell lasting from passing
  std::size_t least_values_for_shift = 4;         // different counts; fewer are multiples by chance
  double range_tail_share = 0.01;  // robust_range_counts leaves out this share at both ends, 0..0.5
  SuggestionTuning suggestions = {};
};

// Looks at a recording frame by frame. Memory: a few pictures, whatever the number of frames.
// After the second frame add() allocates nothing but for the first frames in which it looks for
// faults of the input. Not thread-safe: one probe per thread.
// The same frames give the same report everywhere. Cost: about 11 ms a frame of 382x288.
class RecordingProbe {
 public:
  explicit RecordingProbe(const ProbeOptions& options = {}, const ProbeTuning& tuning = {});
  RecordingProbe(RecordingProbe&&) noexcept;
  RecordingProbe& operator=(RecordingProbe&&) noexcept;
  ~RecordingProbe();

  // `bits`: 8 or 16, of a pixel in the file. Errors, after which the recording goes on without the
  // frame: empty frame, another size or number of bits than the first, out of memory.
  // `valid` as Frame::valid. `counts_per_unit`: of float frames, whose nearest counts `frame` then
  // has (FloatScale); 0: the pixels are counts.
  [[nodiscard]] Status add(ImageView<const std::uint16_t> frame, int bits = 16,
                           ImageView<const std::uint8_t> valid = {}, double counts_per_unit = 0);

  // Of the frames so far; more may follow.
  [[nodiscard]] RecordingReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The options of a preset that suit a recording, in the order of the detector's list; fills
// `suggested`.
[[nodiscard]] std::vector<SuggestedOption> suggest_options(const RecordingReport& report,
                                                           Preset preset,
                                                           const SuggestionTuning& tuning = {});

}  // namespace thermedge
