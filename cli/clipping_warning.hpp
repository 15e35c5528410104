// Says that grey levels lose much of a frame.
#pragma once

#include <cstdint>
#include <string>

#include "console.hpp"
#include "thermedge/image.hpp"
#include "thermedge/radiometry/grey_scale.hpp"

namespace thermedge::cli {

// Warns of the first frame of a run of which more than kMuchClippedShare is clipped. `option` is
// what sets the gain, "--gain " or "--set grey_scale.gain=", and `gain` what it is; `remedies` are
// other ways out, to be read after it.
class ClippingWarning {
 public:
  ClippingWarning(std::string option, double gain, std::string remedies)
      : option_(std::move(option)), gain_(gain), remedies_(std::move(remedies)) {}

  // `frame`: the counts, which tell what gain would clip less.
  void frame(const std::string& source, ImageView<const std::uint16_t> frame,
             const ClippedShares& clipped, Console& console);

 private:
  [[nodiscard]] std::string advice(ImageView<const std::uint16_t> frame) const;

  std::string option_;
  double gain_;
  std::string remedies_;
  bool is_said_ = false;
};

}  // namespace thermedge::cli
