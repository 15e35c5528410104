// An 8-bit view of a sequence that does not flicker, for eyes and for trackers that need 8 bits.
#pragma once

#include <cstdint>

#include "thermedge/image.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/noise.hpp"

namespace thermedge {

struct StableGreyScaleOptions {
  // Grey levels per count, 0..1000, the same in all frames. 0: chosen on the first frame so that
  // its counts fill four fifths of the levels and a level is at least half of the noise; after that
  // it changes only where a scene no longer fits into the view, or fills little of it for long.
  double gain = 0;
  // The view stays put while the median of the frame is this near to where it was at the start,
  // levels, 0..127.
  double dead_band_levels = 32;
  // Beyond, the view follows by at most this number of levels a frame, 0..255.
  double slew_levels = 1;
  // Where more than this share of the pixels, 0..1, is clipped, the view moves towards them by up
  // to 10 levels a frame, and a chosen gain falls by up to 6 % a frame.
  double fit_clipped_share = 0.01;
  // A scene cut: more than this share of the pixels, 0..1, is clipped ...
  double cut_clipped_share = 0.03;
  // ... for this number of frames in a row, 1..1000. The view is then chosen anew, unless that
  // leaves more than half as much clipped. Shorter flashes pass, and leave the view where it was.
  int cut_frames = 3;
};

template <OptionsOf<StableGreyScaleOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gain", o.gain, Bounds{0, 1000}, "grey levels per count (0: from range and noise)");
  v("dead_band_levels", o.dead_band_levels, Bounds{0, 127},
    "grey levels that the median may move before the view follows");
  v("slew_levels", o.slew_levels, Bounds{0, 255},
    "most grey levels that the view moves in one frame");
  v("fit_clipped_share", o.fit_clipped_share, Bounds{0, 1},
    "share of clipped pixels from which the view moves towards them");
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

// Algorithm 1 with a view (gain and offset) that is held from frame to frame. With a gain that is
// given, level 127 is the median of the first frame; with a chosen one the range of the first
// frame, from the 0.5th to the 99.5th percentile, is in the middle of the view. With the default
// options and a chosen gain no more than two frames in a row have over 3 % of their pixels clipped.
// Source: measured against Algorithm 1, whose centre follows the median of each frame, so that the
// level of a fixed count changes by half a level a frame.
// One object per sequence and thread. Halves round away from zero; the same result for every SIMD
// target. Allocates on the first frame of a size only. Cost: about 0.4 ms for 382x288.
class StableGreyScale {
 public:
  explicit StableGreyScale(const StableGreyScaleOptions& options = {}) : options_(options) {}

  // The next frame of the sequence -> `levels`, same size. Frames may change their size.
  // Errors, which leave the view as it was: sizes differ, empty frame, an option out of range.
  [[nodiscard]] Result<GreyScaleState> run(ImageView<const std::uint16_t> frame,
                                           ImageView<std::uint8_t> levels);

 private:
  // level = (count - anchor_counts) * gain + base_level
  struct View {
    double gain = 0;  // 0: before the first frame
    int anchor_counts = 0;
    double base_level = 0;
    [[nodiscard]] double level(int counts) const {
      return (counts - anchor_counts) * gain + base_level;
    }
  };
  struct Clipped {
    double low = 0, high = 0;
    [[nodiscard]] double share() const { return low + high; }
  };
  // Counts at the 0.5th, 50th and 99.5th percentile of a frame.
  struct Extent {
    int low = 0, median = 0, high = 0;
    [[nodiscard]] int range() const { return high - low; }
  };

  [[nodiscard]] static Clipped clipped(ImageView<const std::uint16_t> frame, const View& view);
  [[nodiscard]] View chosen_for(ImageView<const std::uint16_t> frame, const Extent& extent);
  GreyScaleEvent place(ImageView<const std::uint16_t> frame);
  bool is_resting(double lost);
  void fit(const Extent& extent);
  void follow(const Extent& extent);
  void raise_gain(const Extent& extent);
  void set_gain(double gain, const Extent& extent);
  [[nodiscard]] bool may_fit(const Extent& extent) const;

  StableGreyScaleOptions options_;
  NoiseEstimator noise_;
  View view_;
  double home_level_ = 0;    // where the dead band of the median lies
  double largest_gain_ = 0;  // by the noise
  bool is_fitting_ = false;  // the frame before was clipped a little, and the view moved
  int clipped_frames_ = 0;   // in a row
  int narrow_frames_ = 0;    // in a row, that fill little of the view
};

}  // namespace thermedge
