// Frames that detectors are compared on, with their truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "random_scene.hpp"
#include "thermedge/eval/counts.hpp"
#include "thermedge/frame.hpp"
#include "thermedge/image.hpp"

namespace thermedge::bench {

struct TestFrame {
  Image<std::uint16_t> counts;
  eval::TruthMaps truth;
  int bits = 16;  // 8: grey levels

  [[nodiscard]] Frame frame() const { return {counts.view(), bits}; }
};

// What the camera adds; the column pattern is sigma / 3, the row pattern sigma / 4.
struct Disturbance {
  double sigma_counts = 0;  // temporal noise
  bool stripes = true;
  int bad_pixels = 5;
};

inline constexpr double kRangeCounts = 130;  // of random scenes
inline constexpr double kMiddleCounts = 2700;

// `clean` in counts, as a sensor sees it that `seed` tells apart.
[[nodiscard]] Image<std::uint16_t> expose(ImageView<const float> clean,
                                          const Disturbance& disturbance, std::uint64_t seed);

// The scene over kRangeCounts; `seed` is that of the noise.
[[nodiscard]] Image<std::uint16_t> expose(const CleanScene& scene, double sigma_counts,
                                          std::uint64_t seed);

// Frame 0 of a scene of the simulator. Recall asks for edges of 40 counts and more, precision
// accepts 10 and more.
[[nodiscard]] TestFrame simulated(const std::string& scene, double sigma_counts,
                                  std::uint64_t seed);

// A prepared set: DIRECTORY/raw/CONDITION/NAME.png and DIRECTORY/gt/NAME.npz.
[[nodiscard]] std::vector<std::string> conditions_of(const std::string& directory);
// The first `most` of them by name.
[[nodiscard]] std::vector<TestFrame> prepared(const std::string& directory,
                                              const std::string& condition, int most);

// Uneven noise over its mean in logarithms: 1/2 at the left border and 2 at the right one.
[[nodiscard]] double uneven_noise(double x, int width);

// Flat frames of noise, or with a vignette that takes 5 sigma from the corners.
enum class Emptiness { kPlain, kStripes, kVignette };
[[nodiscard]] Image<std::uint16_t> empty_frame(Emptiness kind, double sigma_counts,
                                               std::uint64_t seed);

// One edge alone in the frame, and its places in steps of half a pixel.
struct SingleEdge {
  Image<float> clean;  // counts
  std::vector<eval::Point> points;
};
// A step of `contrast_counts` and `length_px`, straight or an arc with a radius of 1.2 times its
// length, at a place and direction of its own. Half of it rises above the frame on one side and
// half falls below it on the other; both fade exponentially with the distance, to 1 / e at 35 px,
// and end straight across the edge's ends; optics of 1 px.
[[nodiscard]] SingleEdge single_edge(double length_px, bool curved, double contrast_counts,
                                     std::uint64_t seed);

}  // namespace thermedge::bench
