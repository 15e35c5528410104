// What happens to a stream of frames besides the scene: freezes, shutters, jumps, losses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "thermedge/frame.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/sequence/motion.hpp"

namespace thermedge {

// Bits of FrameEvents::bits.
enum FrameEvent : std::uint32_t {
  kFrozen = 1U << 0U,      // the picture of the frame before, to the bit
  kNearFrozen = 1U << 1U,  // that picture but for less noise than a new one would have
  kShutter = 1U << 2U,     // the shutter is closed: the source says so, or the picture turned flat
  kOffsetJump = 1U << 3U,  // the level of the whole picture jumped
  kCut = 1U << 4U,         // nothing of the frames before is to be found again
  kDropped = 1U << 5U,     // frames before this one were lost
  kClipped = 1U << 6U,     // over 1 % of the pixels are at the end of the range
};

inline constexpr std::array kFrameEvents = {
    EnumName{kFrozen, "frozen"},   EnumName{kNearFrozen, "near_frozen"},
    EnumName{kShutter, "shutter"}, EnumName{kOffsetJump, "offset_jump"},
    EnumName{kCut, "cut"},         EnumName{kDropped, "dropped"},
    EnumName{kClipped, "clipped"}};

struct FrameEvents {
  std::uint32_t bits = 0;  // FrameEvent
  // Whether the picture is a measurement of its own: not frozen, no shutter.
  bool valid = true;
  double gap = 1;  // frame times since the last frame; above 1 where frames were lost
  // Since the last shutter, freeze or offset jump; nothing where there was none, or without stamps.
  std::optional<double> since_shutter_s;

  [[nodiscard]] bool has(FrameEvent event) const { return (bits & event) != 0; }
};

struct EventTuning {
  // A near-frozen picture differs from the last one by less than this share of what new noise of
  // both would make: median magnitude over a sample of all pixels.
  double near_frozen_share = 0.35;
  // A shutter: the middle 98 % of the pixels span less than so many sigma, of a picture that
  // spanned more than so many before.
  double flat_sigmas = 6;
  double open_sigmas = 12;
  // Least jump of the level, in units of the noise of one pixel, and of its own deviation; and on
  // how many of the 16 parts of the picture it must be seen.
  double least_jump_sigmas = 0.5;
  double least_jump_deviations = 5;
  int least_jump_parts = 12;
  double gap_intervals = 1.5;  // frames were lost where stamps are so many median intervals apart
  double clipped_share = 0.01;
  int cut_frames = 3;  // frames without a motion, one after the other, that are a cut
};

// Finds the events of a stream, frame by frame. One object per thread; allocates on the first frame
// of a size only.
class EventFinder {
 public:
  explicit EventFinder(const EventTuning& tuning = {});
  EventFinder(EventFinder&&) noexcept;
  EventFinder& operator=(EventFinder&&) noexcept;
  ~EventFinder();

  // What the frame itself tells. `sigma_counts`: noise of a pixel as measured on the frames before;
  // 0: not known, and near-frozen frames and shutters are not found. Float frames: of their unit.
  FrameEvents look(const Frame& frame, double sigma_counts);
  // What the motion to a valid frame tells; added to `events`. `is_first`: there is no frame
  // before.
  void look_at_motion(const Motion& motion, bool is_first, double sigma_counts,
                      FrameEvents& events);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thermedge
