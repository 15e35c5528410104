// Who is compared: everybody takes counts and gives a map of edges.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "thermedge/frame.hpp"
#include "thermedge/image.hpp"
#include "thermedge/options.hpp"

namespace thermedge::bench {

// What stands in front of a detector: counts -> 8-bit levels (Algorithm 1 and a filter).
struct FrontEnd {
  std::string name;
  std::function<void(ImageView<const std::uint16_t> counts, ImageView<std::uint8_t> levels)> run;
};

// Levels -> edges (nonzero), maps of one size.
struct Finder {
  std::string name;
  std::function<void(ImageView<const std::uint8_t> levels, ImageView<std::uint8_t> map)> run;
};

// Frame -> edges.
using WholeDetector = std::function<void(const Frame& frame, ImageView<std::uint8_t> map)>;

struct NamedDetector {
  std::string name;
  WholeDetector run;
};

// Whole detectors, or every pair of a front and a finder, as settings to choose from. What has
// fronts takes frames of 16 bits.
struct Competitor {
  std::string name;
  std::string family;  // thermedge, OpenCV or classical
  std::vector<NamedDetector> wholes;
  std::vector<FrontEnd> fronts;
  std::vector<Finder> finders;

  [[nodiscard]] std::size_t settings() const {
    return wholes.empty() ? fronts.size() * finders.size() : wholes.size();
  }
  [[nodiscard]] std::string setting_name(std::size_t setting) const;
  void run(std::size_t setting, const Frame& frame, ImageView<std::uint8_t> map) const;
};

// The mask of a detector on one thread.
[[nodiscard]] WholeDetector thermedge_detector(const DetectorOptions& options);
[[nodiscard]] Competitor thermedge_competitor(std::string name, const DetectorOptions& options);

// The presets, and each peer with the settings that it is tuned over, behind Algorithm 1.
[[nodiscard]] std::vector<Competitor> all_competitors();

// The same for frames of any range whose noise of `sigma_counts` is known: 8-bit peers get them
// with 4 levels for each sigma or stretched to the frame's range, whichever is better. Canny stands
// there a second time, on counts.
[[nodiscard]] std::vector<Competitor> competitors_in_noise(double sigma_counts);

// No filter, Gaussian, NL-means and BM3D of this library; median and bilateral of OpenCV.
[[nodiscard]] std::vector<FrontEnd> denoising_fronts();
// Detectors on levels with the thresholds that they are tuned over, one competitor each, without
// fronts.
[[nodiscard]] std::vector<Competitor> detectors_on_levels();

// OpenCV's Canny after a Gaussian and EDPF after one, from the least to the most cautious
// setting; empty without OpenCV.
[[nodiscard]] std::vector<Competitor> peers_for_detection();

}  // namespace thermedge::bench
