// An 8-bit view of a sequence that does not flicker, for eyes and for trackers that need 8 bits.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/noise.hpp"

namespace thermedge {

struct StableGreyScaleOptions {
  // Grey levels per count, 0..1000; 0: chosen on the first frame so that one level is half of
  // its noise. Stays the same over the sequence, so that a level is always worth the same.
  double gain = 0.2;
  // The view stays put while the median of the frame is this near to its centre, levels, 0..127.
  double dead_band_levels = 32;
  // Beyond, the view follows by at most this number of levels a frame, 0..255.
  double slew_levels = 1;
  // A scene cut: more than this share of the pixels, 0..1, is clipped ...
  double cut_clipped_share = 0.03;
  // ... for this number of frames in a row, 1..1000, and at most half as much would be clipped with
  // the view centred on the median. Shorter flashes pass, and leave the view where it was.
  int cut_frames = 3;
};

template <OptionsOf<StableGreyScaleOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gain", o.gain, Bounds{0, 1000}, "grey levels per count (0: from the noise)");
  v("dead_band_levels", o.dead_band_levels, Bounds{0, 127},
    "grey levels that the median may move before the view follows");
  v("slew_levels", o.slew_levels, Bounds{0, 255},
    "most grey levels that the view moves in one frame");
  v("cut_clipped_share", o.cut_clipped_share, Bounds{0, 1},
    "share of clipped pixels that means a scene cut");
  v("cut_frames", o.cut_frames, Bounds{1, 1000},
    "consecutive clipped frames that mean a scene cut");
}

enum class GreyScaleEvent { kNone, kStart, kSceneCut };

// How the counts of a frame became levels: level = clamp(round(counts * gain + offset), 0, 255).
struct GreyScaleState {
  double gain = 0;                                       // levels per count
  double offset = 0;                                     // levels
  double clipped_low_share = 0, clipped_high_share = 0;  // of the pixels, 0..1
  GreyScaleEvent event =
      GreyScaleEvent::kNone;  // kStart: first frame; kSceneCut: the view jumped here
};

// Fails on the first option out of range.
[[nodiscard]] Status check_options(const StableGreyScaleOptions& options);

// Algorithm 1 with a centre that is held: level 127 is the median of the first frame until that of
// later frames leaves the dead band. Source: measured against Algorithm 1, whose centre follows the
// median of each frame, so that the level of a fixed count changes by half a level a frame.
// One object per sequence and thread. Halves round away from zero; the same result for every SIMD
// target. Allocates on the first frame of a size only. Cost: about 0.3 ms for 382x288.
class StableGreyScale {
 public:
  explicit StableGreyScale(const StableGreyScaleOptions& options = {}) : options_(options) {}

  // The next frame of the sequence -> `levels`, same size. Frames may change their size.
  // Errors, which leave the view as it was: sizes differ, empty frame, an option out of range.
  [[nodiscard]] Result<GreyScaleState> run(ImageView<const std::uint16_t> frame,
                                           ImageView<std::uint8_t> levels);

 private:
  struct Clipped {
    double low = 0, high = 0;
    [[nodiscard]] double share() const { return low + high; }
  };

  [[nodiscard]] Clipped clipped(ImageView<const std::uint16_t> frame, int anchor_counts,
                                double base_level) const;
  GreyScaleEvent place(ImageView<const std::uint16_t> frame);
  void follow(int median_counts);

  StableGreyScaleOptions options_;
  NoiseEstimator noise_;
  double gain_ = 0;        // 0: before the first frame
  int anchor_counts_ = 0;  // is shown at base_level_
  double base_level_ = 0;
  int clipped_frames_ = 0;  // in a row
};

}  // namespace thermedge
