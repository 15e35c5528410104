// Random scenes at low contrast with exact edges: what detectors are compared on.
#pragma once

#include <cstdint>
#include <vector>

#include "shapes.hpp"
#include "thermedge/eval/counts.hpp"
#include "thermedge/image.hpp"
#include "thermedge/parallel_runner.hpp"

namespace thermedge::bench {

inline constexpr double kLeastAskedShare = 0.04;      // of the range: recall asks for such edges
inline constexpr double kLeastAcceptedShare = 0.004;  // precision accepts these
inline constexpr double kOpticsPx = 1;                // standard deviation of the blur

// A frame without noise and the edges in it.
struct CleanScene {
  Image<float> shares;     // of the range: 0 and 1 are the percentiles .5 and 99.5
  eval::CurveFrame edges;  // pieces of up to 4 px, each with its step as a share of the range
  eval::TruthMaps truth;   // from these, one pixel wide, without the frame's border
};

struct SceneVariation {
  // Steps from .001 of the range on instead of .05, with slopes and background as gentle.
  bool faint_steps = false;
  // One to three small things on top, 8 to 46 times as far from the rest as its range is wide;
  // the range is that of the scene without them.
  bool hot_things = false;
};

// 14 to 23 things, each a step of .05 to .7 warmer or colder than what it lies on and with a slope
// of its own, over a smooth background; 382x288. The same seed gives the same bits everywhere. Any
// thread.
[[nodiscard]] CleanScene random_scene(std::uint64_t seed, const SceneVariation& variation = {});

// Edges of at least this contrast, one pixel wide, without the frame's border.
[[nodiscard]] Image<std::uint8_t> truth_map(const eval::CurveFrame& edges, double least);

// Things painted one over the other, the last one on top.
class Painting {
 public:
  // Temperature = level + slope_x (x / width - .5) + slope_y (y / height - .5).
  struct Surface {
    double level = 0, slope_x = 0, slope_y = 0;
  };

  Painting(int width, int height, Surface ground) : width_(width), height_(height) {
    surfaces_.push_back(ground);
  }
  // `step`: how much warmer it is than what its outline's first corner inside the frame lies on.
  void add(Polygon outline, double step, double slope_x, double slope_y);

  // Behind optics and pixel aperture.
  [[nodiscard]] Image<float> render(ParallelRunner& runner) const;
  // Visible outlines in pieces of up to 4 px with the step across each.
  [[nodiscard]] eval::CurveFrame edges() const;

 private:
  // Which surface is seen at a point; 0: the ground.
  [[nodiscard]] std::size_t seen_at(eval::Point point) const;
  [[nodiscard]] double value(std::size_t surface, eval::Point point) const;
  // A place on an outline and what is seen beside it; the surface itself where it is hidden there.
  struct Sample {
    eval::Point at;
    std::size_t beside;
    double step;
  };
  [[nodiscard]] std::vector<Sample> sample_outline(std::size_t surface) const;
  void add_outline(std::size_t surface, eval::CurveFrame& frame) const;
  void render_row(double y, int margin_px, std::vector<double>& crossings,
                  std::vector<float>& row) const;

  int width_, height_;
  std::vector<Surface> surfaces_;
  std::vector<Polygon> outlines_;  // of surface i + 1
};

}  // namespace thermedge::bench
