// BM3D (Dabov et al. 2007; parameters as in Lebrun, IPOL 2012).
#pragma once

#include <cstdint>
#include <vector>

#include "denoise_frame.hpp"
#include "simd/bm3d_group.hpp"
#include "simd/bm3d_match.hpp"
#include "thermedge/denoise.hpp"

namespace thermedge::detail {

// Both stages do the same: match blocks on a guide (the frame itself, then the first estimate),
// filter each group, add the blocks up. Reference blocks are cut into bands of rows; each band has
// its own sums, which are merged in band order.
class Bm3d {
 public:
  explicit Bm3d(const Bm3dOptions& options);

  // Makes the scratch memory for frames of this size, which run() would make otherwise.
  void prepare(int width, int height);

  // `out` may be `in`.
  void run(ImageView<const float> in, const NoiseUnits& units, ImageView<float> out,
           Runner& runner);

 private:
  enum class Stage { kHard, kWiener };
  struct Band {
    int first_reference_row = 0;
    int end_reference_row = 0;
    int first_row = 0;  // rows of the frame that its blocks may touch
    int end_row = 0;
  };

  void quantise_row(const float* values, int y);
  void load(ImageView<const float> in, const NoiseUnits& units, Runner& runner);
  void run_stage(Stage stage, Runner& runner);
  void filter_band(Stage stage, int band);
  void merge_rows(int first_row, int end_row);
  void finish_rows(int first_row, int end_row);

  [[nodiscard]] Band band(int index) const;
  [[nodiscard]] SearchWindow window_of(BlockPosition reference) const;
  [[nodiscard]] Accumulator accumulator(int band);

  Bm3dOptions options_;
  float profile_[kBlockPx];  // Kaiser window
  BlockWindow window_;       // its product with itself

  int width_ = 0;  // of the frame, at least a block
  int height_ = 0;
  int bands_ = 0;
  int band_rows_ = 0;           // most rows that the blocks of a band may touch
  Image<float> noisy_;          // in units of the noise
  Image<float> estimate_;       // of the stage before
  Image<std::int16_t> levels_;  // the guide as integers, for matching
  Image<std::int16_t> transposed_levels_;
  Image<float> band_sums_;  // band_rows_ rows for each band
  Image<float> band_weights_;
  Image<float> sums_;                        // merged
  Image<float> weights_;                     // merged, and spread by profile_ along the rows
  std::vector<MatchScratch> match_scratch_;  // one a band
};

}  // namespace thermedge::detail
