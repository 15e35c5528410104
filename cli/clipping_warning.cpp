#include "clipping_warning.hpp"

#include <fmt/core.h>

namespace thermedge::cli {

void ClippingWarning::frame(const std::string& source, ImageView<const std::uint16_t> frame,
                            const ClippedShares& clipped, Console& console) {
  if (is_said_ || clipped.both() <= kMuchClippedShare) {
    return;
  }
  is_said_ = true;
  console.warn(fmt::format(
      "{}: a gain of {:g} grey levels a count clips {:.1f} % of the pixels ({:.1f} % "
      "below, {:.1f} % above), and no edges can be seen there: {}{} (later frames are not checked)",
      source, gain_, 100 * clipped.both(), 100 * clipped.low, 100 * clipped.high, advice(frame),
      remedies_));
}

// The largest round gain that clips little.
std::string ClippingWarning::advice(ImageView<const std::uint16_t> frame) const {
  for (const double gain : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002}) {
    if (gain < gain_) {
      const double share = clipped_shares(frame, {.gain = gain}).both();
      if (share <= kMuchClippedShare) {
        return fmt::format("{}{:g} clips {:.1f} %", option_, gain, 100 * share);
      }
    }
  }
  return "a smaller gain, by " + option_ + "VALUE, clips less";
}

}  // namespace thermedge::cli
