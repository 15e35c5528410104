// Who is compared: everybody takes counts and gives a map of edges.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

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

// Counts -> edges, whole.
using WholeDetector =
    std::function<void(ImageView<const std::uint16_t> counts, ImageView<std::uint8_t> map)>;

// Ours as they come (`whole`), or every pair of a front and a finder as settings to choose from.
struct Competitor {
  std::string name;
  std::string family;  // thermedge, OpenCV or classical
  WholeDetector whole;
  std::vector<FrontEnd> fronts;
  std::vector<Finder> finders;

  [[nodiscard]] std::size_t settings() const { return whole ? 1 : fronts.size() * finders.size(); }
  [[nodiscard]] std::string setting_name(std::size_t setting) const;
  void run(std::size_t setting, ImageView<const std::uint16_t> counts,
           ImageView<std::uint8_t> map) const;
};

// The mask of a detector on one thread.
[[nodiscard]] WholeDetector thermedge_detector(const DetectorOptions& options);

// The presets, and each peer with the settings that it is tuned over.
[[nodiscard]] std::vector<Competitor> all_competitors();

// No filter, Gaussian, NL-means and BM3D of this library; median and bilateral of OpenCV.
[[nodiscard]] std::vector<FrontEnd> denoising_fronts();
// Detectors on levels with the thresholds that they are tuned over, one competitor each, without
// fronts.
[[nodiscard]] std::vector<Competitor> detectors_on_levels();

// OpenCV's Canny after a Gaussian and EDPF after one, from the least to the most cautious
// setting; empty without OpenCV.
[[nodiscard]] std::vector<Competitor> peers_for_detection();

}  // namespace thermedge::bench
