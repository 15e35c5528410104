// The noise that is there, as every stage after it is told: how strong, of which spectrum, where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"

namespace thermedge {

// Side of the blocks that noise is measured in, px.
inline constexpr int kNoiseBlockPx = 8;

// How strong the noise is at a place, in units of its level in the frame: nodes of a grid, and
// between them by bilinear interpolation.
class NoiseLevelMap {
 public:
  // The noise is the same everywhere: nothing has to be evened out.
  [[nodiscard]] bool is_even() const { return nodes_.width() == 0; }
  // At the pixel (x, y) within the frame; 1 where the noise is even.
  [[nodiscard]] double at(int x, int y) const;
  // Of the pixels of row `y` into out[0 .. width of the frame). The noise is not even.
  void row(int y, float* out) const;
  // out = offset + (in - middle) / level, of frames of this map's size: the same noise everywhere.
  // `out` may be `in`. The noise is not even.
  void even_out(ImageView<const float> in, float middle, float offset, ImageView<float> out) const;
  // frame = frame * level + middle: undoes even_out with an offset of 0.
  void undo_even_out(float middle, ImageView<float> frame) const;

  // The nodes, row by row, the outermost in the middle of the outermost blocks. Even: empty.
  [[nodiscard]] ImageView<const float> nodes() const { return nodes_; }

  // Makes the memory of the map of a frame of this size.
  void reserve(int frame_width, int frame_height);
  void set_even() { nodes_.resize(0, 0); }
  // `nodes` has 2 columns and rows or more, all above 0, for a frame of this size.
  void set_nodes(ImageView<const float> nodes, int frame_width, int frame_height);

  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(nodes_, across_, down_, shares_);
  }

 private:
  // Node before a pixel, and how far it is on the way to the next one, 0..1.
  struct Place {
    int node = 0;
    double share = 0;
  };
  static void find_places(int pixels, int nodes, std::vector<Place>& places);
  [[nodiscard]] double on_column(int column, const Place& down) const;
  // task(x, run) for the runs of pixels of a row between two columns of nodes; x is the first one.
  template <class F>
  void for_each_run(int y, F&& task) const;

  Image<float> nodes_;
  std::vector<Place> across_, down_;  // of each column and row of the frame
  std::vector<double> shares_;        // those of across_ again, for kernels; one more at the end
};

// Variance of each coefficient of the orthonormal discrete cosine transform of blocks of 8 x 8
// pixels, in units of the square of the noise's level: 1 for white noise. [8 v + u], u across.
using NoiseSpectrum = std::array<float, kNoiseBlockPx * kNoiseBlockPx>;

[[nodiscard]] constexpr NoiseSpectrum white_spectrum() {
  NoiseSpectrum spectrum{};
  for (float& variance : spectrum) {
    variance = 1;
  }
  return spectrum;
}

struct NoiseModel {
  // Standard deviation at the scale of edges (periods of 5 to 16 px), counts; of white noise that
  // of its pixels. 0: none that could be told from the rounding to whole counts.
  double level_counts = 0;
  NoiseSpectrum spectrum = white_spectrum();
  NoiseLevelMap map;

  // White noise of this level everywhere.
  void set_white(double level) {
    level_counts = level;
    spectrum = white_spectrum();
    map.set_even();
  }
};

}  // namespace thermedge
