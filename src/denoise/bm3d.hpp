// BM3D (Dabov et al. 2007; parameters as in Lebrun, IPOL 2012).
#pragma once

#include <span>
#include <vector>

#include "bm3d_group_simd.hpp"
#include "bm3d_match_simd.hpp"
#include "float_frame.hpp"
#include "thermedge/stages/denoiser.hpp"

namespace thermedge::detail {

// Which of the reference blocks a stage takes; others than all for steps of 4 px only.
enum class Thinning {
  kNone,
  kChessboard,  // every other one, like the black squares of a chessboard
  kQuarter      // every other one of every other row: a quarter, side by side without a gap
};

struct StageSettings {
  int largest_group = 16;  // blocks: 1, 2, 4, 8, 16 or 32
  Thinning thinning = Thinning::kNone;
};

// What a profile stands for.
struct Bm3dSettings {
  Bm3dOptions options;
  Bm3dTuning tuning;
  int step_px = 4;            // distance of reference blocks: 1, 2, 4 or 8
  int search_radius_px = 16;  // largest displacement of matched blocks, 4..kLargestSearchRadius
  StageSettings hard;
  StageSettings wiener;
};
[[nodiscard]] Bm3dSettings bm3d_settings(const Bm3dOptions& options, const Bm3dTuning& tuning = {});

// Both stages do the same: match blocks on a guide (the frame itself, then the first estimate),
// filter each group, add the blocks up. Reference blocks are cut into bands of rows; each band has
// its own sums, which are merged in band order. The frame is continued to all sides by mirroring
// until the reference blocks cover it, equally far to opposite sides, so that a mirrored or turned
// frame has mirrored or turned blocks.
class Bm3d {
 public:
  explicit Bm3d(const Bm3dSettings& settings);

  // Makes the scratch memory for frames of this size, which run() would make otherwise.
  void prepare(int width, int height);

  // `out` may be `in`.
  void run(ImageView<const float> in, const NoiseUnits& units, ImageView<float> out,
           ParallelRunner& runner);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return memory_of(all_columns_, even_columns_, odd_columns_, noisy_, estimate_, guide_, bands_,
                     sums_, corner_weights_, weights_);
  }

 private:
  enum class Stage { kHard, kWiener };
  struct Band {
    int first_y = 0;  // rows of the reference blocks
    int end_y = 0;
    int first_row = 0;  // rows of the frame that the blocks of their groups may touch
    int end_row = 0;
  };
  struct BandScratch {
    Image<float> sums;
    Image<float> weights;
    MatchScratch match;
    std::vector<BlockGroup> groups;  // of a row

    [[nodiscard]] std::size_t memory_bytes() const {
      return memory_of(sums, weights, match, groups);
    }
  };

  [[nodiscard]] Band band(int index) const;
  [[nodiscard]] std::span<const int> columns_of(const StageSettings& stage, int y) const;
  void make_columns();
  void find_noise_of_coefficients(const NoiseSpectrum& spectrum);
  void load(ImageView<const float> in, const NoiseUnits& units, ParallelRunner& runner);
  void run_stage(Stage stage, ParallelRunner& runner);
  void filter_band(Stage stage, int index);
  void filter_row(Stage stage, int y, BandScratch& scratch, const Accumulator& sums) const;
  void merge_row(int y);
  void finish_row(int y);

  Bm3dSettings settings_;
  SearchPattern pattern_;
  float profile_[kBlockPx];  // Kaiser window
  BlockWindow window_;       // its product with itself

  // Of this frame's noise: thresholds of the first stage, variances for the second one.
  HardThresholds thresholds_;
  BlockCoefficients variances_;

  int width_ = 0;  // of the continued frame
  int height_ = 0;
  int left_ = 0;  // what it has before the first column and row of the frame
  int top_ = 0;
  std::vector<int> all_columns_;   // where reference blocks stand, in cells
  std::vector<int> even_columns_;  // and those of thinned rows
  std::vector<int> odd_columns_;
  Image<float> noisy_;     // in units of the noise
  Image<float> estimate_;  // of the stage before
  MatchGuide guide_;
  std::vector<BandScratch> bands_;
  Image<float> sums_;            // merged
  Image<float> corner_weights_;  // merged; columns begin left of the frame
  Image<float> weights_;         // spread by profile_ along the rows; rows begin above the frame
};

}  // namespace thermedge::detail
