// The noise of a recording, tile by tile: spatial, temporal and fixed pattern.
// What each means and why it is measured this way: RecordingReport.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "probe_counts.hpp"
#include "thermedge/image.hpp"
#include "thermedge/probe/probe.hpp"

namespace thermedge::detail {

// 1.4826 times the median of magnitudes: sigma where they are those of Gaussian values with mean 0.
// n stands for the interval n - 0.5 .. n + 0.5, in which the median is interpolated; 0 stays 0.
// Reorders `magnitudes`; 0 where there are none.
[[nodiscard]] double sigma_of_magnitudes(std::vector<std::int32_t>& magnitudes);

struct TiledNoiseTuning {
  int smallest_side_px = 8;  // shorter sides give no noise: the median is of too few pixels
  int tile_side_px = 32;  // about: a smaller one follows uneven noise closer, with less precision
  int least_pattern_frames = 4;  // with the scene moved: fewer leave too much of it in the maps
  int change_lag_px = 4;         // at which pixels of a camera that averages have nothing in common
  // A residual beyond this many sigma counts as this: an edge that passes is no pattern.
  double pattern_clip_sigmas = 4;
};

class TiledNoise {
 public:
  explicit TiledNoise(const TiledNoiseTuning& tuning = {}) : tuning_(tuning) {}

  // Measures a frame and returns its spatial sigma, counts: 0 where a side is under 8 px.
  // Frames have one size.
  double add(ImageView<const std::uint16_t> frame);
  // Compares the last frame with the one added before.
  void add_change();
  // Takes the last frame, in which the scene had moved, into one of the two maps of the pattern.
  void add_to_pattern();

  [[nodiscard]] double sigma_counts() const { return spatial_.value(); }
  [[nodiscard]] std::optional<double> temporal_sigma_counts() const;

  struct Pattern {
    double sigma_counts;  // root mean square over the tiles
    double share;         // of the spatial variance
  };
  [[nodiscard]] std::optional<Pattern> pattern() const;

 private:
  // Of the residuals. A tile covers the whole frame where that is smaller.
  struct Tile {
    int x, y, width, height;
    // Of the changes, added up over the frames, counts^2: of the residual, and at the lag.
    double residual_variances = 0, change_variances = 0;
  };
  void lay_tiles(int width, int height);
  void filter(ImageView<const std::uint16_t> frame);
  void fill_change();
  [[nodiscard]] double likeness_of_neighbours() const;
  template <class F>
  double tile_variance(const Tile& tile, double gain, F&& value);

  TiledNoiseTuning tuning_;
  std::vector<Tile> tiles_;
  Image<std::int32_t> residual_, previous_residual_;  // 6 times the noise, signed
  Image<std::int32_t> slope_, previous_slope_;        // |gx| + |gy| by Sobel
  Image<std::int32_t> counts_, previous_counts_;      // of the pixels that have a residual
  Image<std::int32_t> change_, change_slope_;         // scratch of add_change()
  std::vector<std::int32_t> slopes_, magnitudes_;
  double last_sigma_ = 0;
  Mean spatial_, temporal_;
  std::array<Image<std::int32_t>, 2> pattern_sums_;
  std::array<int, 2> pattern_frames_{};
};

}  // namespace thermedge::detail
