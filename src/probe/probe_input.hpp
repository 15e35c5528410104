// Frames that are not as the camera meant them: telemetry rows, double pictures, swapped bytes,
// borders that are no measurement.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/probe/probe.hpp"

namespace thermedge::detail {

// Where no line gives a source, values lie between what simulated and recorded frames without the
// fault show and what those with it do, far from both.
struct InputFaultTuning {
  std::int64_t most_frames = 8;  // looked at, from the first on: faults of the input are in all
  int smallest_side_px = 24;     // smaller frames tell nothing

  // Swapped bytes: of neighbours that differ, nearly all differ in the low byte of a count, and few
  // in the high byte.
  double most_low_changes = 0.5;    // share of the pairs whose low byte as read differs
  double least_high_changes = 0.9;  // share of the pairs whose high byte as read differs
  int least_unused_bits = 6;        // multiples of 64: too few values of the low byte to tell

  // Rows. Jumps from row to row are medians along them, in units of the usual one of the frame.
  int most_telemetry_rows = 8;
  double telemetry_jump = 8;         // least, into the telemetry
  double telemetry_roughness = 8;    // least, of neighbours along a row, in units of the usual one
  double telemetry_repeats = 0.4;    // least share of one count in a row that the picture lacks
  double telemetry_strangers = 0.5;  // least share of counts far from those of the picture
  double stranger_distance = 0.5;    // of such a count, in units of the picture's range
  double most_correlation = 0.5;     // of a telemetry row and the row of the picture beside it
  double seam_jump = 4;              // least, between the two pictures of a double one
  double least_likeness = 0.7;       // of the means of blocks of the two pictures
  double sure_likeness = 0.9;        // from which the seam need not be the largest jump

  // Borders: pixels of one count that lies far from all others.
  double least_invalid_share = 0.002;  // of the pixels
  double least_border_share = 0.95;    // of those with that count, connected to the border
  double least_gap = 0.25;             // to the other counts, in units of their range
};

// What one frame shows.
struct FrameFaults {
  bool is_swapped = false;
  int rows_above = 0, rows_below = 0;  // of telemetry
  enum class Double : std::uint8_t { kNo, kUseTop, kUseBottom } half = Double::kNo;
  std::optional<int> invalid_counts;

  friend bool operator==(const FrameFaults&, const FrameFaults&) = default;
};

class InputFaultFinder {
 public:
  explicit InputFaultFinder(const InputFaultTuning& tuning = {}) : tuning_(tuning) {}

  // `frame` as it was read; `valid` as Frame::valid. Constant frames tell nothing.
  void add(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> valid, int bits);
  // Faults that all frames have.
  [[nodiscard]] std::vector<InputFault> faults() const;

 private:
  InputFaultTuning tuning_;
  int width_ = 0, height_ = 0;
  std::int64_t frames_ = 0;
  std::optional<FrameFaults> common_;
};

// Of one frame, which has at least 24 px a side and is not constant.
[[nodiscard]] FrameFaults find_input_faults(ImageView<const std::uint16_t> frame,
                                            ImageView<const std::uint8_t> valid, int bits,
                                            const InputFaultTuning& tuning = {});

}  // namespace thermedge::detail
