// Measures the noise of a frame: its level at the scale of edges, its spectrum, its map.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/noise_model.hpp"

namespace thermedge {

// Where a line names no measurement, it tells what the value trades off.
struct NoiseModelTuning {
  // Fewer blocks give no spectrum and no map: medians over half of them are off by 12 % and more.
  std::size_t fewest_blocks = 64;
  // The flattest blocks that count: so large a share, and at least so many (or half of all).
  // Photographs have texture nearly everywhere; a smaller share is less precise.
  double flat_share = 0.1;
  std::size_t fewest_flat = 200;
  // Least variance of a coefficient, of the square of the level: what rounding and JPEG leave.
  double least_variance = 0.05;
  // Most growth of the variance from the frequency 1 to 0, which cannot be measured, as stripes and
  // slopes of the scene are there; bilinear enlargement by two has 1.2.
  double most_extension = 1.3;
  // The map is made of coefficients with at least this variance, in units of the square of the
  // level, at least so many of them, from the highest frequencies on: edges have hardly any energy
  // there, and where the noise has none either it tells nothing.
  double least_chosen_variance = 0.4;
  std::size_t fewest_coefficients = 9;
  // Blocks between its nodes, and half blocks to each side of a node that count for it: a longer
  // way misses changes, a shorter one is noise.
  int node_step_blocks = 3;
  int half_reach_halves = 7;
  // The quantile of their energies that is taken, which edges on half of the blocks hardly move,
  // and where it lies for a normal variable.
  double quantile = 0.3;
  double quantile_z = -0.5244;
  double even_within = 1.13;  // changes of the level up to this factor are taken for none
};

// Measures a frame on blocks of 8 x 8 pixels that cover it. For each coefficient the median of its
// magnitude over the half of the blocks that are flattest by other coefficients: edges and texture
// of the scene do not count unless they are everywhere, and offsets of columns and rows, which lie
// in the coefficients with a frequency of 0, never do. Blocks that hold invalid pixels, and those
// that are constant at the least or the greatest count of the frame (clipped), are left out.
//
// Level on white noise of 8 counts: 8.0-8.4; resampled half a pixel off 6.3, where the pixels'
// high-pass says 1.3; enlarged twice 8.7; behind a Gaussian of .7 px 5.3; JPEG within 5 % of
// before; on simulated scenes 2 to 5 % above the truth. One object per thread; allocates on the
// first frame of a size only. Sums are exact integers, so the same result everywhere, and that of a
// mirrored or transposed frame is the mirrored or transposed one. Cost: about 1 ms for 382x288.
class NoiseModelEstimator {
 public:
  explicit NoiseModelEstimator(const NoiseModelTuning& tuning = {}) : tuning_(tuning) {}

  // `valid`: nonzero where the frame is a measurement; empty: everywhere. `pixel_sigma_counts`, as
  // NoiseEstimator has it, is the level where there are too few blocks to tell.
  void measure(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> valid,
               double pixel_sigma_counts, NoiseModel& model);
  // The same without that: false, and an even map of no noise, where there are too few blocks.
  [[nodiscard]] bool find(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> valid,
                          NoiseModel& model);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(lefts_, tops_, coefficients_, energies_, usable_, sample_, flat_,
                             chosen_, nodes_);
  }

 private:
  static constexpr std::size_t kCoefficients = kNoiseBlockPx * kNoiseBlockPx;
  void transform_blocks(ImageView<const std::uint16_t> frame, ImageView<const std::uint8_t> valid);
  void find_spectrum(NoiseModel& model);
  void find_map(int width, int height, NoiseModel& model);
  void choose_coefficients(const NoiseSpectrum& spectrum);
  template <class Energy>
  void find_flat(Energy&& energy_of);
  [[nodiscard]] double variance_of_flat(std::size_t coefficient);
  [[nodiscard]] float node(int column, int row, int columns, int rows);

  NoiseModelTuning tuning_;
  std::vector<int> lefts_, tops_;                               // of the blocks
  std::vector<std::array<float, kCoefficients>> coefficients_;  // of usable blocks: counts
  std::vector<float> energies_;  // of the same, without frequency 0; then, of the chosen ones
  std::vector<std::int32_t>
      usable_;  // of all blocks, row by row: its place among the usable, or -1
  std::vector<float> sample_;
  std::vector<std::size_t> flat_;    // among the usable blocks
  std::vector<std::size_t> chosen_;  // coefficients that the map is made of
  double quantile_of_noise_ = 1;     // of their mean energy
  Image<float> nodes_;
};

}  // namespace thermedge
