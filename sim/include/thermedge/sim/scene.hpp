// Small thermal scenes with known edges: what demo and tests run on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/result.hpp"

namespace thermedge::sim {

// What the sensor does to the picture. All noise is seeded; fixed pattern and dead pixels stay the
// same over a sequence.
struct CameraOptions {
  int width = 382;                   // px, 16..4096
  int height = 288;                  // px, 16..4096
  double blur_px = 1.0;              // standard deviation of the optical blur, px, 0..20
  double sigma_counts = 5.8;         // temporal noise of a pixel, counts, 0..5000
  double column_sigma_counts = 1.2;  // fixed column pattern, counts, 0..5000
  double row_sigma_counts = 0.9;     // fixed row pattern, counts, 0..5000
  int dead_pixels = 5;               // stuck at 0 or at the largest count, 0..10000
};

struct SceneOptions {
  std::string name = "desk";  // "desk" (monitor, laptop, mug, phone, charger), "corridor" (walls,
                              // doors, pipes, lamps)
  std::uint64_t seed = 1;     // noise, fixed pattern and small variations of the objects, 0..9e15
  int frames = 1;             // 1..1e6; the camera moves by hand from frame to frame, a few px
  CameraOptions camera;
};

struct Point {
  double x = 0, y = 0;  // px, pixel centres at integers
};

// A visible piece of an outline, exact to the sub-pixel, with the step across it.
struct TrueEdge {
  std::vector<Point> points;  // at most 0.5 px apart
  bool closed = false;
  double contrast_counts = 0;  // mean absolute step across the edge, counts
  int object = 0;              // whose outline it is; the same over a sequence
};

struct TrueFrame {
  Image<std::uint16_t> counts;  // as the camera gives them
  Image<float> clean;           // without noise, pattern and dead pixels, counts
  std::vector<TrueEdge> edges;
};

// Parses "sim:NAME[?key=value&...]" with the keys seed, frames, sigma, column_sigma, row_sigma,
// blur, width, height, dead_pixels. Errors name the key and list what is known.
[[nodiscard]] Result<SceneOptions> parse_scene(std::string_view spec);

// Names of the scenes.
[[nodiscard]] std::vector<std::string> scene_names();

// Renders frame `index` (0 .. frames - 1). The same options and index give the same bits on every
// machine. Errors: unknown name, an option out of range. Thread-safe.
[[nodiscard]] Result<TrueFrame> render(const SceneOptions& options, int index);

}  // namespace thermedge::sim
